#pragma once
/// A body flown beside its recorded flight. Internal to dynamics/flight/.

#include "dynamics/flight/fit.h"

namespace stadion {

/// The axis whose direction is judged: that of symmetry.
int fitAxis(const FitTask& task);

/// From the recording's start: states at its times, and the landing on the height where it ends. The last
/// sample is the landing.
Trajectory flyBeside(const Trajectory& recorded, const FitTask& task, const FlightModel& model,
                     const Bias& bias);

/// How far off, sample by sample, in tolerances: of the centre (3 numbers) and the axis (3), and of the
/// landing (2).
Eigen::VectorXd apart(const Trajectory& flown, const Trajectory& recorded, int axis,
                      const FitTolerance& tolerance);

/// Landing in parts of the range, mean angle of the axis in degrees.
FitErrors errorsBetween(const Trajectory& flown, const Trajectory& recorded, int axis);

}  // namespace stadion
