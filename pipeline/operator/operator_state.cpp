#include "pipeline/operator/operator_state.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

void turn(bool& what, const OperatorCommand& command) {
  what = command.value ? *command.value != 0 : !what;
}

bool set(double& what, double now, double most, const OperatorCommand& command) {
  if (!command.value) return false;
  const double wanted = command.relative ? now + *command.value : *command.value;
  // A relative step beyond the end stops there; an absolute value beyond it is an error.
  if (!command.relative && (wanted < 0 || wanted > most)) return false;
  what = std::clamp(wanted, 0.0, most);
  return true;
}

bool setWhole(double& what, double now, double least, double most, const OperatorCommand& command) {
  if (!command.value || *command.value != std::floor(*command.value)) return false;
  const double wanted = command.relative ? now + *command.value : *command.value;
  if (!command.relative && (wanted < least || wanted > most)) return false;
  what = std::clamp(wanted, least, most);
  return true;
}

bool isCue(const OperatorCommand& command) {
  const double number = command.value.value_or(0);
  return !command.relative && number >= 1 && number <= OperatorState::kMostCues &&
         number == std::floor(number);
}

}  // namespace

bool OperatorState::apply(const OperatorCommand& command) {
  if (command.value && !std::isfinite(*command.value)) return false;
  switch (command.action) {
  case OperatorAction::Start: waiting = false; return true;
  case OperatorAction::Pause: turn(paused, command); return true;
  case OperatorAction::Step: return paused;
  case OperatorAction::Black: turn(presentation.black, command); return true;
  case OperatorAction::TestPattern: turn(presentation.pattern, command); return true;
  case OperatorAction::Cue: return isCue(command);
  case OperatorAction::NextGroup: nextGroup = true; return true;
  case OperatorAction::SwapEyes: turn(presentation.swapEyes, command); return true;
  case OperatorAction::EyeSeparation:
    return set(presentation.eyeSeparation, eyeSeparation(), kWidestEyes, command);
  case OperatorAction::FreezeHead: turn(headFrozen, command); return true;
  case OperatorAction::Volume: return set(volume, volume, 1, command);
  case OperatorAction::Latency: {
    const double now = mostInFlight > 0 ? mostInFlight : runMostInFlight;
    return setWhole(mostInFlight, now, 1, kMostInFlight, command);
  }
  case OperatorAction::End: end = true; return true;
  }
  return false;
}

}  // namespace stadion
