#pragma once
/// Commands on their way from whoever heard them to the App thread.
///
///     queue.post({OperatorAction::Pause});            // a key: pause, or go on
///     queue.post({OperatorAction::Volume, 0.1, true});  // a little louder
///
/// Threads  post() from any thread; take() by App, at the start of a frame, so that a command takes effect
///          with a whole frame on all walls.
/// Errors   a full queue refuses (post() is false): nobody has taken anything for a long time.

#include "engine/input/operator_command.h"

#include <mutex>
#include <utility>
#include <vector>

namespace stadion {

class OperatorQueue {
public:
  static constexpr std::size_t kMost = 256;

  bool post(const OperatorCommand& command) {
    const std::lock_guard lock(mutex_);
    if (waiting_.size() == kMost) return false;
    waiting_.push_back(command);
    return true;
  }
  /// All that have come since the last call, in their order.
  std::vector<OperatorCommand> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(waiting_, {});
  }

private:
  std::mutex mutex_;
  std::vector<OperatorCommand> waiting_;
};

}  // namespace stadion
