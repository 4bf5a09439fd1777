#pragma once
/// The operator's keys in the terminal that the show was started from.
///
/// While it lives the terminal hands over each key at once and does not show it (raw_terminal.h). Only if the
/// standard input is a terminal and the program is in its foreground.
///
/// Threads    one of its own, which posts into the queue.
/// Ownership  borrows the queue.

#include "pipeline/operator/operator_queue.h"
#include "pipeline/target/window.h"
#include "show/base/raw_terminal.h"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace stadion {

/// Returns the command of a key; nothing if the key has none.
std::optional<OperatorCommand> operatorCommandOf(char key);
/// Returns the command of a key that was pressed in a window.
std::optional<OperatorCommand> operatorCommandOf(Key key);
/// All keys, a line or two.
std::string operatorKeysHelp();

class OperatorKeys {
public:
  using Say = std::function<void(const std::string&)>;

  /// Null if the terminal is not interactive. `say` receives the help, on the thread of the keys.
  static std::unique_ptr<OperatorKeys> open(int terminal, OperatorQueue& queue, Say say);
  ~OperatorKeys();
  OperatorKeys(const OperatorKeys&) = delete;
  OperatorKeys& operator=(const OperatorKeys&) = delete;

private:
  OperatorKeys(std::unique_ptr<RawTerminal> terminal, OperatorQueue& queue, Say say);
  void readKeys();

  std::unique_ptr<RawTerminal> terminal_;
  OperatorQueue& queue_;
  Say say_;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

}  // namespace stadion
