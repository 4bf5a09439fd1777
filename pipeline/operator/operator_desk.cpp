#include "pipeline/operator/operator_desk.h"

namespace stadion {

OperatorDesk::OperatorDesk(bool waits, double wallsEyeSeparation) : waits_(waits) {
  state_.wallsEyeSeparation = wallsEyeSeparation;
  beginGroup();
}

void OperatorDesk::startWith(std::size_t latency) {
  if (latency > 0) state_.runLatency = static_cast<double>(latency);
}

void OperatorDesk::beginGroup() {
  ++groups_;
  state_.waiting = waits_;
  state_.paused = state_.headFrozen = state_.nextGroup = false;
  leaving_ = false;
  playback_.standFrom(0);
  playback_.setPaused(state_.still());
}

void OperatorDesk::beginFrame(std::uint64_t frame) {
  for (auto [at, end] = recorded_.equal_range(frame); at != end; ++at) take(frame, at->second);
  for (const OperatorCommand& c : queue_.take()) take(frame, c);
  recorded_.erase(recorded_.begin(), recorded_.upper_bound(frame));
}

void OperatorDesk::take(std::uint64_t frame, const OperatorCommand& command) {
  if (command.action == OperatorAction::NextGroup && (pictureAwaited_ || state_.nextGroup)) return;
  if (!state_.obey(command)) return;
  leaving_ = state_.nextGroup;
  if (command.action == OperatorAction::Step)
    playback_.step();
  else
    playback_.setPaused(state_.still());
  if (told) told(frame, command);
}

}  // namespace stadion
