/// Recorded flights: read, refused, and looked up in between.

#include "dynamics/flight/trajectory.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

const std::string kColumns = "t,px,py,pz,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n";

std::string whyNoTrajectory(const std::string& text) {
  const auto read = readTrajectory(text, "f.csv");
  return read ? "" : format(read.error());
}

TEST(Trajectory, ATextGoesThereAndBack) {
  Trajectory flight;
  for (int i = 0; i < 3; ++i)
    flight.push_back(
        {.1 * i, {Vec3(i, 2, 3), Vec3(4, 5, i), det::expRotation(Vec3(.1 * i, .2, .3)), Vec3(7, 8, 9)}});
  const auto read = readTrajectory(trajectoryText(flight), "f.csv");
  ASSERT_TRUE(read) << format(read.error());
  ASSERT_EQ(read.value().size(), 3U);
  EXPECT_LE((read.value()[2].at.p - flight[2].at.p).norm(), 1e-11);
  EXPECT_LE((read.value()[2].at.q.coeffs() - flight[2].at.q.coeffs()).norm(), 1e-11);
}

TEST(Trajectory, ColumnsMayStandInAnyOrder) {
  const auto read = readTrajectory("# a remark\npx,py,pz,t,qw,qx,qy,qz,vx,vy,vz,wx,wy,wz\n"
                                   "1,2,3,0,1,0,0,0,4,5,6,7,8,9\n1,2,3,1,1,0,0,0,4,5,6,7,8,9\n",
                                   "f.csv");
  ASSERT_TRUE(read);
  EXPECT_EQ(read.value()[0].at.p, Vec3(1, 2, 3));
  EXPECT_EQ(read.value()[1].t, 1);
}

TEST(Trajectory, WhatIsWrongIsSaidWithItsPlace) {
  const std::string row = ",0,0,0,1,0,0,0,0,0,0,0,0,0\n";
  EXPECT_NE(whyNoTrajectory(kColumns + "0" + row).find("two rows"), std::string::npos);
  EXPECT_NE(whyNoTrajectory(kColumns + "0" + row + "0" + row).find("f.csv:3: error: t must rise"),
            std::string::npos);
  EXPECT_NE(
      whyNoTrajectory(kColumns + "0" + row + "1,0,0,0,2,0,0,0,0,0,0,0,0,0\n").find("f.csv:3: error: qw,qx"),
      std::string::npos);
  EXPECT_NE(whyNoTrajectory("t,px\n0,1\n").find("there is no column \"py\""), std::string::npos);
  EXPECT_NE(whyNoTrajectory(kColumns + "0" + row + "inf" + row).find("f.csv:3:1: error: \"inf\""),
            std::string::npos);
}

TEST(Trajectory, BetweenSamplesAParabolaIsExact) {
  const auto at = [](double t) {
    RigidFlight f;
    f.p = Vec3(20 * t, 0, 2 + 10 * t - 4.905 * t * t), f.v = Vec3(20, 0, 10 - 9.81 * t);
    f.q = det::expRotation(Vec3(0, t, 0));
    return f;
  };
  const Trajectory flight{{0, at(0)}, {.5, at(.5)}, {1.2, at(1.2)}};
  for (const double t : {0.0, .1, .5, .8, 1.2}) {
    const RigidFlight f = sampleAt(flight, t);
    EXPECT_LE((f.p - at(t).p).norm(), 1e-12) << t;
    EXPECT_LE((f.v - at(t).v).norm(), 1e-12) << t;
    EXPECT_LE(f.q.angularDistance(at(t).q), 1e-7) << t;
  }
  EXPECT_EQ(sampleAt(flight, 5).p, flight.back().at.p);
}

}  // namespace
}  // namespace stadion
