#pragma once
/// The operator's keys in the terminal that the show was started from.
///
/// While it lives the terminal hands over each key at once and does not show it; Ctrl-C works as ever. Only
/// if the standard input is a terminal and the program is in its foreground.
///
/// Threads    one of its own, which posts into the queue.
/// Ownership  borrows the queue; gives the terminal back as it was.

#include "pipeline/operator/operator_queue.h"

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <thread>

namespace stadion {

/// What a key asks for; nothing if it is none of ours.
std::optional<OperatorCommand> operatorCommandOf(char key);
/// All keys, a line or two.
std::string operatorKeysHelp();

class OperatorKeys {
public:
  /// Null where nobody can press a key.
  static std::unique_ptr<OperatorKeys> open(int terminal, OperatorQueue& queue);
  ~OperatorKeys();
  OperatorKeys(const OperatorKeys&) = delete;
  OperatorKeys& operator=(const OperatorKeys&) = delete;

private:
  struct Terminal;
  OperatorKeys(std::unique_ptr<Terminal> terminal, OperatorQueue& queue);
  void listen();

  std::unique_ptr<Terminal> terminal_;
  OperatorQueue& queue_;
  std::atomic<bool> ending_ = false;
  std::thread thread_;
};

}  // namespace stadion
