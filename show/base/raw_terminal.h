#pragma once
/// A terminal that hands over each key at once and does not show it. Ctrl-C works as ever.
///
/// It is given back as it was in every way out of the program: when this object goes, when the program
/// exits, and by the signals that end it (except SIGKILL, which cannot be caught). Ctrl-Z gives it back; the
/// shell's `fg` gives it to the program again.
///
/// Threads  one at a time; the process has one of them at most, as it has one terminal.

#include <memory>

namespace stadion {

class RawTerminal {
public:
  /// Null if that is no terminal, or the program is in its background, or it has been taken already.
  static std::unique_ptr<RawTerminal> take(int file);
  ~RawTerminal();
  RawTerminal(const RawTerminal&) = delete;
  RawTerminal& operator=(const RawTerminal&) = delete;

  int file() const { return file_; }
  /// Returns true if this program gets the keys. A background process that touches the terminal is stopped.
  bool inForeground() const;

private:
  explicit RawTerminal(int file) : file_(file) {}
  int file_;
};

/// Gives the terminal back before the process ends at once. Does nothing if it has not been taken. May be
/// called in a signal's handler.
void giveTerminalBack();

}  // namespace stadion
