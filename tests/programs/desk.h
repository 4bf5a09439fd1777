#pragma once
/// A desk for tests: a display that exists in memory only, a program that runs on it, and hands for keyboard
/// and mouse.

#include "tests/programs/program.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <sys/types.h>
#include <vector>

namespace stadion {

/// A program that runs beside the test.
class RunningProgram {
public:
  explicit RunningProgram(const ProgramRun& run);
  /// Ends it, if it still runs.
  ~RunningProgram();

  /// What it has written to its standard output and error so far.
  std::string out() const, err() const;
  /// Waits until its standard error contains the text `times` times; false if it ends before, or does not in
  /// good time.
  bool says(const std::string& text, int times = 1) const;
  /// Waits for anything else; false if it is not so when the program has ended, or does not come in good
  /// time.
  bool waitUntil(const std::function<bool()>& condition) const;
  bool runs() const;
  /// Of the program, and of its process group.
  pid_t pid() const { return child_; }
  /// Ends it at once, as a power cut would.
  void kill();
  /// Waits for its end and returns its exit status; -1 if it does not end in good time.
  int status();

private:
  TestFolder folder_;
  pid_t child_ = -1;
  mutable int status_ = -1;  ///< known once somebody has asked whether it runs
  mutable bool ended_ = false;
};

/// An X server without a screen to look at (Xvfb, or Xorg with its driver "dummy"), and hands (xdotool).
class Display {
public:
  /// Null if one of the programs is not there: the test is to be skipped then. `more`: other words for Xvfb.
  static std::unique_ptr<Display> open(std::vector<std::string> screens = {"1000x800x24"},
                                       std::vector<std::string> more = {});
  /// One screen of 640x480 on a monitor that DPMS can switch off. Null if a program or module is missing.
  static std::unique_ptr<Display> openWithMonitor();

  const std::string& name() const { return name_; }  ///< ":99"
  /// `words` as xdotool understands them: {"key", "space"}.
  void hands(std::vector<std::string> words) const;
  /// The server ends, and with it every connection.
  void breakDown() { server_->kill(); }
  /// What there is to see on a screen, written to a PNG file.
  bool photograph(const std::string& file, int screen = 0) const;

private:
  Display() = default;
  static std::unique_ptr<Display> start(const ProgramRun& server);
  std::unique_ptr<TestFolder> folder_;
  std::unique_ptr<RunningProgram> server_;
  std::string name_;
};

/// Returns a UDP port without a listener. No other test takes it while this process runs.
std::uint16_t freePort();

/// `stadion` with these arguments, on that display.
ProgramRun onDisplay(const Display& display, std::vector<std::string> arguments);

}  // namespace stadion
