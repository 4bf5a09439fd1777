#pragma once
/// What the operator has decided about the running show, as far as it lasts longer than a moment.
///
/// Threads  App's own. What the walls need of it travels with each frame (Presentation).
/// Errors   a value that is not finite or out of range is refused; the others are as documented.

#include "engine/input/operator_command.h"
#include "pipeline/frame/presentation.h"

#include <cstdint>

namespace stadion {

struct OperatorState {
  static constexpr double kWidestEyes = 1;   ///< [m]
  static constexpr double kMostLatency = 4;  ///< [frames]

  bool waiting = false;  ///< for Start
  bool paused = false;
  bool headFrozen = false;
  double volume = 1;                 ///< from 0 to 1
  double latency = 0;                ///< frames under way at most, a whole number; 0: as the run was started
  double runLatency = kMostLatency;  ///< with which it was started
  Presentation shown;
  double wallsEyeSeparation = 0.064;  ///< what the wall file says [m]
  bool nextGroup = false, end = false;

  /// False if the command's value makes no sense; then nothing changes.
  bool obey(const OperatorCommand& command);
  /// Whether show time stands still, but for single steps.
  bool still() const { return waiting || paused; }
  double eyeSeparation() const { return shown.eyeSeparation < 0 ? wallsEyeSeparation : shown.eyeSeparation; }
};

}  // namespace stadion
