#include "engine/input/rig_calibration.h"

#include "engine/maths/functions.h"

#include <fmt/format.h>

#include <algorithm>

namespace stadion {
namespace {

constexpr double kShortestAhead = 0.5;  ///< from the middle to the pose ahead [m]
constexpr double kSteepest = 0.2;       ///< height over distance of a floor
constexpr double kFarthestEyes = 0.5;   ///< from their sensor [m]

}  // namespace

HeldPose meanOf(const std::vector<Pose>& measured) {
  HeldPose held;
  Vec4 q = Vec4::Zero();
  for (const Pose& X : measured) {
    held.X_SD.p += X.p / static_cast<double>(measured.size());
    // q and -q are the same turn.
    q += X.q.coeffs().dot(measured[0].q.coeffs()) < 0 ? Vec4(-X.q.coeffs()) : X.q.coeffs();
  }
  held.X_SD.q.coeffs() = q.normalized();
  for (const Pose& X : measured) held.spread = std::max(held.spread, (X.p - held.X_SD.p).norm());
  return held;
}

Result<RigFile> calibrateRoom(RigFile rig, const Pose& middle, const Pose& ahead) {
  const Vec3 from = rig.levelled(middle).p, way = rig.levelled(ahead).p - from;
  const double distance = way.head<2>().norm();
  if (!from.allFinite() || !way.allFinite()) return Result<RigFile>::failure("a pose is not finite");
  if (distance < kShortestAhead)
    return Result<RigFile>::failure(
        fmt::format("the two marks are {:.2f} m apart, seen from above; they must be at least {} m apart (is "
                    "\"up\" or \"unit\" of the rig file wrong?)",
                    distance, kShortestAhead));
  if (std::fabs(way.z()) > kSteepest * distance)
    return Result<RigFile>::failure(fmt::format(
        "one mark is {:.2f} m higher than the other; is \"up\" of the rig file wrong?", std::fabs(way.z())));
  rig.origin = from;
  rig.yaw = det::atan2(-way.x(), way.y());
  return rig;
}

Result<RigFile> calibrateEyes(RigFile rig, const std::string& tracker, const Pose& head, double eyeHeight) {
  const auto at = std::ranges::find(rig.trackers, tracker, &RigTracker::name);
  if (at == rig.trackers.end())
    return Result<RigFile>::failure("the rig file has no tracker \"" + tracker + "\"");
  const Pose X_DT = rig.sensorInRig(head).inverse() * Pose{Vec3(0, 0, eyeHeight), Quat::Identity()};
  if (!X_DT.finite()) return Result<RigFile>::failure("the pose is not finite");
  if (X_DT.p.norm() > kFarthestEyes)
    return Result<RigFile>::failure(fmt::format(
        "the eyes would be {:.2f} m from their sensor; stand on the mark, and state how high the eyes are",
        X_DT.p.norm()));
  at->X_DT = X_DT;
  return rig;
}

}  // namespace stadion
