#include "pipeline/operator/operator_controls.h"

namespace stadion {

OperatorControls::OperatorControls(bool waits, double wallsEyeSeparation) : waits_(waits) {
  state_.wallsEyeSeparation = wallsEyeSeparation;
  beginGroup();
}

void OperatorControls::startWith(std::size_t mostInFlight) {
  if (mostInFlight > 0) state_.runMostInFlight = static_cast<double>(mostInFlight);
}

void OperatorControls::beginGroup() {
  ++groups_;
  state_.waiting = waits_;
  state_.paused = state_.headFrozen = state_.nextGroup = false;
  leaving_ = false;
  playback_.standFrom(0);
  playback_.setPaused(state_.still());
}

void OperatorControls::beginFrame(std::uint64_t frame) {
  for (auto [at, end] = recorded_.equal_range(frame); at != end; ++at) take(frame, at->second);
  for (const OperatorCommand& c : queue_.take()) take(frame, c);
  recorded_.erase(recorded_.begin(), recorded_.upper_bound(frame));
}

void OperatorControls::take(std::uint64_t frame, const OperatorCommand& command) {
  if (command.action == OperatorAction::NextGroup && (pictureAwaited_ || state_.nextGroup)) return;
  if (!state_.apply(command)) return;
  leaving_ = state_.nextGroup;
  if (command.action == OperatorAction::Step)
    playback_.step();
  else
    playback_.setPaused(state_.still());
  if (told) told(frame, command);
}

}  // namespace stadion
