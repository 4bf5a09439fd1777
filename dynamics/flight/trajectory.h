#pragma once
/// Recorded flights: what models are compared with and fitted to.
///
/// File     comma-separated, columns t, px,py,pz, qw,qx,qy,qz (body to world), vx,vy,vz (world), wx,wy,wz
///          (body), in any order, SI units, z up; the last row is the landing. t rises.

#include "dynamics/flight/runge_kutta.h"
#include "engine/base/diagnostic.h"

#include <string>
#include <string_view>
#include <vector>

namespace stadion {

struct TrajectorySample {
  double t = 0;  ///< [s]
  RigidFlight at;
};

using Trajectory = std::vector<TrajectorySample>;

/// At least two rows. Errors have file, line and column.
Result<Trajectory> readTrajectory(std::string_view text, const std::string& file);
std::string trajectoryText(const Trajectory& trajectory);

/// Between the samples: position by the cubic that keeps the velocities, velocity likewise, orientation with
/// constant angular velocity. Beyond the ends: the ends.
RigidFlight sampleAt(const Trajectory& trajectory, double t);

}  // namespace stadion
