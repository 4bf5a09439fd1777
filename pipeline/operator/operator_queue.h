#pragma once
/// Commands on their way from the input devices to the App thread.
///
///     queue.post({OperatorAction::Pause});            // a key: pause, or go on
///     queue.post({OperatorAction::Volume, 0.1, true});  // a little louder
///
/// Threads  post() from any thread; take() by App, at the start of a frame, so that a command takes effect
///          with a whole frame on all walls.
/// Errors   A full queue refuses commands (post() returns false): App has not taken any for a long time.

#include "engine/input/operator_command.h"

#include <algorithm>
#include <chrono>
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
    if (command.action == OperatorAction::NextGroup) nextGroupAsked_ = std::chrono::steady_clock::now();
    waiting_.push_back(command);
    return true;
  }
  /// Returns the time of the last request for the next group.
  std::chrono::steady_clock::time_point nextGroupAsked() const {
    const std::lock_guard lock(mutex_);
    return nextGroupAsked_;
  }
  /// Returns the number of such commands since take().
  std::size_t count(OperatorAction action) const {
    const std::lock_guard lock(mutex_);
    return static_cast<std::size_t>(std::ranges::count(waiting_, action, &OperatorCommand::action));
  }
  /// Returns all commands since the last call, in their order.
  std::vector<OperatorCommand> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(waiting_, {});
  }

private:
  mutable std::mutex mutex_;
  std::vector<OperatorCommand> waiting_;
  std::chrono::steady_clock::time_point nextGroupAsked_{};
};

}  // namespace stadion
