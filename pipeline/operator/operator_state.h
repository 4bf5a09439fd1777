#pragma once
/// The operator's lasting decisions about the running show.
///
/// Threads  App's own. The part that the walls need travels with each frame (Presentation).
/// Errors   a value that is not finite or out of range is refused; the others are as documented.

#include "engine/input/operator_command.h"
#include "pipeline/frame/presentation.h"

#include <cstdint>

namespace stadion {

struct OperatorState {
  static constexpr double kWidestEyes = 1;    ///< [m]
  static constexpr double kMostInFlight = 4;  ///< [frames]
  static constexpr double kMostCues = 32;

  bool waiting = false;  ///< for Start
  bool paused = false;
  bool headFrozen = false;
  double volume = 1;        ///< from 0 to 1
  double mostInFlight = 0;  ///< limit of frames in flight, a whole number; 0: as the run was started
  double runMostInFlight = kMostInFlight;  ///< the limit at the run's start
  Presentation presentation;
  double wallsEyeSeparation = 0.064;  ///< from the wall file [m]
  bool nextGroup = false, end = false;

  /// Applies a command. Returns false, and changes nothing, if its value makes no sense.
  bool apply(const OperatorCommand& command);
  /// Returns true if show time stands still, except for single steps.
  bool still() const { return waiting || paused; }
  double eyeSeparation() const {
    return presentation.eyeSeparation < 0 ? wallsEyeSeparation : presentation.eyeSeparation;
  }
};

}  // namespace stadion
