#include "engine/input/rig_file.h"
#include "engine/maths/angles.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

RigFile parsed(const std::string& text) {
  Diagnostics findings;
  const auto rig = parseRigFile(text, "hall.rig", findings);
  for (const Diagnostic& d : findings.all()) ADD_FAILURE() << format(d);
  return rig.value_or(RigFile{});
}

std::string refusal(const std::string& text) {
  Diagnostics findings;
  EXPECT_FALSE(parseRigFile(text, "hall.rig", findings)) << text;
  return findings.all().empty() ? "" : format(findings.all()[0]);
}

TEST(RigFile, EveryStatementIsRead) {
  const RigFile rig =
      parsed("stadion-rig 1\nunit cm\nup y\norigin 0.5 1 2 # middle\nyaw 90\nfilter 2 10\nhold 0.2\n"
             "ease 1\npredict 0.01\ntracker head offset 0 0.1 -0.05 turn 0 0 90 safe 0 0 1.6\n"
             "tracker club\n");
  EXPECT_EQ(rig.unit, 0.01);
  EXPECT_TRUE(rig.upIsY);
  EXPECT_EQ(rig.origin, Vec3(0.5, 1, 2));
  EXPECT_NEAR(rig.yaw, 90 * kDegree, 1e-12);
  EXPECT_EQ(rig.cutoff, 2);
  EXPECT_EQ(rig.beta, 10);
  EXPECT_EQ(rig.hold, 0.2);
  EXPECT_EQ(rig.ease, 1);
  EXPECT_EQ(rig.predict, 0.01);
  ASSERT_EQ(rig.trackers.size(), 2u);
  EXPECT_EQ(rig.trackers[0].safe, Vec3(0, 0, 1.6));
  EXPECT_EQ(rig.trackers[0].X_DT.p, Vec3(0, 0.1, -0.05));
  EXPECT_FALSE(rig.trackers[1].safe);
}

TEST(RigFile, WithoutTrackersThereAreHeadAndWand) {
  const RigFile rig = parsed("stadion-rig 1\n");
  ASSERT_EQ(rig.trackers.size(), 2u);
  EXPECT_EQ(rig.trackers[0].name, "head");
  EXPECT_EQ(rig.trackers[1].name, "wand");
}

TEST(RigFile, MistakesAreToldWithTheirPlace) {
  EXPECT_NE(refusal("stadion-walls 1\n").find("hall.rig:1:1"), std::string::npos);
  EXPECT_NE(refusal("stadion-rig 1\norigen 0 0 0\n").find("did you mean \"origin\""), std::string::npos);
  EXPECT_NE(refusal("stadion-rig 1\norigin 0 0\n").find("hall.rig:2:11"), std::string::npos);
  EXPECT_NE(refusal("stadion-rig 1\nyaw nan\n").find("hall.rig:2:5"), std::string::npos);
  EXPECT_NE(refusal("stadion-rig 1\npredict 7\n").find("from 0 to 0.1"), std::string::npos);
  EXPECT_NE(refusal("stadion-rig 1\nhold 0.1\nhold 0.2\n").find("given twice"), std::string::npos);
  EXPECT_NE(refusal("stadion-rig 1\ntracker wand\ntracker wand\n").find("two trackers"), std::string::npos);
  EXPECT_NE(refusal("stadion-rig 1\ntracker wand sideways 1 2 3\n").find("offset, turn, safe"),
            std::string::npos);
}

TEST(RigFile, WhatIsWrittenIsReadBack) {
  RigFile rig = standardRig();
  rig.origin = Vec3(0.123456, -2, 0.01), rig.yaw = -91.25 * kDegree, rig.upIsY = true;
  rig.trackers[0].X_DT = {Vec3(0.01, -0.02, 0.03), Quat(0.5, 0.5, -0.5, 0.5)};
  const std::string text = formatRigFile(rig);
  const RigFile again = parsed(text);
  EXPECT_EQ(formatRigFile(again), text);
  EXPECT_NEAR(again.trackers[0].X_DT.q.angularDistance(rig.trackers[0].X_DT.q), 0, 1e-7);
}

TEST(RigFile, AMeasurementIsPlacedInTheRig) {
  RigFile rig = standardRig();
  // The rig stands at (1, 2, 0) of the tracking system and looks along its -X.
  rig.origin = Vec3(1, 2, 0), rig.yaw = 90 * kDegree;
  const Pose X = rig.inRig({Vec3(0, 2, 1.5), Quat::Identity()}, rig.trackers[1]);
  EXPECT_NEAR((X.p - Vec3(0, 1, 1.5)).norm(), 0, 1e-12) << X.p.transpose();
  EXPECT_NEAR(((X.q * Vec3(0, 1, 0)) - Vec3(1, 0, 0)).norm(), 0, 1e-12) << "it points along the system's +Y";
}

TEST(RigFile, SystemsWithYUpwardsAreTurned) {
  RigFile rig = standardRig();
  rig.upIsY = true, rig.unit = 0.001;
  // 1.7 m up, half a metre ahead (-Z), turned a quarter to the left about up (+Y).
  const double h = std::sqrt(0.5);
  const Pose X = rig.inRig({Vec3(100, 1700, -500), Quat(h, 0, h, 0)}, rig.trackers[1]);
  EXPECT_NEAR((X.p - Vec3(0.1, 0.5, 1.7)).norm(), 0, 1e-12) << X.p.transpose();
  EXPECT_NEAR(((X.q * Vec3(0, 1, 0)) - Vec3(-1, 0, 0)).norm(), 0, 1e-12) << "what pointed ahead points left";
}

}  // namespace
}  // namespace stadion
