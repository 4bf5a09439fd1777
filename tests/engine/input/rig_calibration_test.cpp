#include "engine/input/rig_calibration.h"

#include "engine/maths/functions.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

/// What a system says that stands somewhere else and turned, of a sensor at X_RD in the room.
Pose said(const RigFile& truth, const Pose& X_RD) {
  return Pose{truth.origin, det::fromEuler(0, 0, truth.yaw)} * X_RD;
}

Pose on(double x, double y, double z) {
  return {Vec3(x, y, z), Quat::Identity()};
}

TEST(RigCalibration, TwoMarksAndALookFindTheRoomAndTheEyes) {
  for (const double yaw : {0.0, 1.2, 3.0, -2.0}) {
    RigFile truth = standardRig();
    truth.origin = Vec3(1.5, -0.7, 0.2), truth.yaw = yaw;
    const Pose X_DT{Vec3(0.01, 0.12, -0.08), det::fromEuler(-0.2, 0.1, 0.3)};
    const auto room = calibrateRoom(standardRig(), said(truth, on(0, 0, 0)), said(truth, on(0, 1.2, 0)));
    ASSERT_TRUE(room) << room.error().message;
    EXPECT_NEAR((room.value().origin - truth.origin).norm(), 0, 1e-12);
    EXPECT_NEAR(room.value().yaw, yaw, 1e-12);
    const Pose eyes{Vec3(0, 0, 1.63), Quat::Identity()};
    const auto rig = calibrateEyes(room.value(), "head", said(truth, eyes * X_DT.inverse()), 1.63);
    ASSERT_TRUE(rig) << rig.error().message;
    // Afterwards anything that is measured comes out where it is.
    const Pose elsewhere{Vec3(0.4, 0.3, 1.5), det::fromEuler(0.3, 0, -1)};
    const Pose found = rig.value().inRig(said(truth, elsewhere * X_DT.inverse()), rig.value().trackers[0]);
    EXPECT_NEAR((found.p - elsewhere.p).norm(), 0, 1e-12);
    EXPECT_NEAR(found.q.angularDistance(elsewhere.q), 0, 1e-7);
  }
}

TEST(RigCalibration, PosesThatMakeNoSenseAreRefused) {
  EXPECT_FALSE(calibrateRoom(standardRig(), on(0, 0, 0), on(0, 0.3, 0))) << "too near";
  EXPECT_FALSE(calibrateRoom(standardRig(), on(0, 0, 0), on(0, 0, 1))) << "up is another axis";
  EXPECT_FALSE(calibrateRoom(standardRig(), on(0, 0, 0), on(0, 1, 0.5))) << "a steep floor";
  EXPECT_FALSE(calibrateEyes(standardRig(), "head", on(0, 0, 1.0), 1.7)) << "eyes 0.7 m above their sensor";
  EXPECT_FALSE(calibrateEyes(standardRig(), "hat", on(0, 0, 1.7), 1.7));
}

TEST(RigCalibration, TheMeanOfAHeldPoseTakesOppositeQuaternionsForTheSame) {
  const Quat q = det::fromEuler(0.1, 0.2, 0.3);
  const HeldPose held =
      meanOf({{Vec3(1, 0, 0), q}, {Vec3(1.02, 0, 0), Quat(-q.w(), -q.x(), -q.y(), -q.z())}});
  EXPECT_NEAR(held.X_SD.p.x(), 1.01, 1e-12);
  EXPECT_NEAR(held.spread, 0.01, 1e-12);
  EXPECT_NEAR(held.X_SD.q.angularDistance(q), 0, 1e-7);
}

}  // namespace
}  // namespace stadion
