/// The rungs against their formulas as docs/flight.md prints them, and what must hold of any of them.

#include "dynamics/flight/flight_model.h"

#include "bench/flight/bodies.h"
#include "dynamics/flight/flight_shape.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace stadion {
namespace {

constexpr double kAir = 1.2;

Vec3 randomVector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> d(-size, size);
  return {d(random), d(random), d(random)};
}

void expectNear(const Vec3& a, const Vec3& b, double relative) {
  EXPECT_LE((a - b).norm(), relative * (b.norm() + 1e-12)) << a.transpose() << " / " << b.transpose();
}

TEST(FlightModel, RodIsItsClosedForm) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const Vec3 u = randomVector(random, 30), w = randomVector(random, 5);
    const Wrench f = aerodynamics(javelinFlight(), kAir, u, w);
    const double V = u.norm(), up = std::sqrt(u.y() * u.y() + u.z() * u.z());
    const double aq = .5 * kAir * .05328 * up, al = .5 * kAir * .0015 * u.x(), m = .142 * aq + .298 * al;
    expectNear(f.force, {-.5 * kAir * 9.331e-4 * V * u.x(), -(aq + al) * u.y(), -(aq + al) * u.z()}, 1e-13);
    expectNear(f.torque,
               {0, -m * u.z() - .5 * kAir * .0103 * V * w.y(), m * u.y() - .5 * kAir * .0103 * V * w.z()},
               1e-13);
  }
}

TEST(FlightModel, PlateIsItsClosedFormWithStall) {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    Vec3 u = randomVector(random, 25);
    u.z() *= i % 2 ? 0.3 : 1;
    const Wrench f = aerodynamics(discusFlight(), kAir, u, Vec3(1, 2, -40));
    const double V = u.norm(), s = std::fabs(u.z()) / V, g = 1 / (1 + std::pow(s * s / .262, 8)),
                 h = .5 * kAir;
    const double lift = g * (.08147 + .00782 * s) + (1 - g) * .0398 * (1.6 - .6 * s);
    expectNear(f.force, -h * V * .002004 * u - h * V * lift * u.z() * Vec3::UnitZ(), 1e-12);
    expectNear(f.torque, -h * .003009 * g * u.z() * Vec3(u.y(), -u.x(), 0), 1e-12);
  }
}

TEST(FlightModel, BallHasADragCrisisAndMagnusLiftThatSaturates) {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const Vec3 u = randomVector(random, 25), w = randomVector(random, i % 2 ? 60 : 0.01);
    const Wrench f = aerodynamics(footballFlight(), kAir, u, w);
    const double V = u.norm(), area = kPi * .11 * .11, q = .5 * kAir * area * V * V;
    const Vec3 h = u / V, side = w.cross(h);
    const double CD = .155 + .346 / (1 + std::exp((V - 12.19) / 1.309)), Sp = .11 * side.norm() / V;
    const double CL = .33 * -std::expm1(-Sp / .17);
    expectNear(f.force, q * (CL * side.normalized() - CD * h), 1e-12);
    EXPECT_EQ(f.torque, Vec3::Zero());
  }
}

TEST(FlightModel, NothingMovesNothingAndNothingIsNaN) {
  const FlightModel models[] = {BallisticFlight{}, javelinFlight(), discusFlight(), footballFlight(),
                                TableFlight{}};
  for (const FlightModel& m : models) {
    const Wrench still = aerodynamics(m, kAir, Vec3::Zero(), Vec3(0, 3, 300));
    EXPECT_LE(still.force.norm(), 1e-12) << m.index();
    EXPECT_LE(still.torque.norm(), 1e-12) << m.index();
    for (const double speed : {1e-160, 1e-9, 1e3, 1e6})
      for (const Vec3& d : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 2, 3)}) {
        const Wrench f = aerodynamics(m, kAir, speed * d, Vec3(1, -2, 300));
        EXPECT_TRUE(f.force.allFinite() && f.torque.allFinite()) << m.index() << " " << speed;
      }
  }
}

TEST(FlightModel, AirTakesEnergyFromShippedBodies) {
  std::mt19937 random(4);
  const FlightModel models[] = {javelinFlight(), discusFlight(), footballFlight()};
  for (const FlightModel& m : models)
    for (int i = 0; i < 200; ++i) {
      const Vec3 u = randomVector(random, 30);
      EXPECT_LT(aerodynamics(m, kAir, u, randomVector(random, 20)).force.dot(u), 0) << m.index();
    }
}

TEST(FlightModel, WindTurnsAJavelinsNoseTowardsWhereItFlies) {
  for (const double angle : {0.1, 0.5, 1.5, 2.5}) {
    const Vec3 u(20 * std::cos(angle), 20 * std::sin(angle), 0);  // flies left of where it points
    EXPECT_GT(aerodynamics(javelinFlight(), kAir, u, Vec3::Zero()).torque.z(), 0) << angle;
  }
}

TEST(FlightModel, CoefficientsGoThereAndBack) {
  for (const FlightModel& m :
       {FlightModel(javelinFlight()), FlightModel(discusFlight(0.3)), FlightModel(footballFlight())}) {
    const std::vector<double> c = coefficientsOf(m);
    ASSERT_EQ(c.size(), coefficientsOf(kindOf(m)).size());
    for (std::size_t i = 0; i < c.size(); ++i) {
      EXPECT_GE(c[i], coefficientsOf(kindOf(m))[i].least) << coefficientsOf(kindOf(m))[i].name;
      EXPECT_LE(c[i], coefficientsOf(kindOf(m))[i].most) << coefficientsOf(kindOf(m))[i].name;
    }
    const auto back = modelFrom(kindOf(m), c);
    ASSERT_TRUE(back);
    EXPECT_EQ(coefficientsOf(*back), c);
    EXPECT_FALSE(modelFrom(kindOf(m), std::span(c).first(c.size() - 1)));
  }
  EXPECT_FALSE(modelFrom(FlightKind::Ballistic, {}));
}

TEST(FlightShape, AJavelinAndADiscusAreMeasured) {
  const FlightShape j = measureShape(bodies::javelin(96), Vec3(-1.05, 0, 0));
  EXPECT_TRUE(j.elongated());
  EXPECT_NEAR(j.length, 2.65, 1e-6);
  EXPECT_NEAR(j.sideArea, 0.0569, 1e-4);
  EXPECT_NEAR(j.sideArm, 0.201, 1e-3);
  expectNear(j.q_NA * Vec3::UnitX(), Vec3::UnitX(), 1e-9);  // the nose
  const FlightShape d = measureShape(bodies::discus(96), Vec3::Zero());
  EXPECT_FALSE(d.elongated());
  EXPECT_NEAR(d.topArea, kPi * .11 * .11, 1e-4);
  EXPECT_NEAR(std::fabs((d.q_NA * Vec3::UnitZ()).z()), 1, 1e-9);
  EXPECT_TRUE(measureShape(bodies::ball(0.11), Vec3::Zero()).round());
}

TEST(FlightShape, TheNoseIsWhereTheMassIsWhicheverWayTheMeshLies) {
  Mesh m = bodies::javelin();
  for (auto& p : m.positions) p = {-p[0], -p[1], p[2]};  // half a turn about z
  const FlightShape s = measureShape(m, Vec3(1.05, 0, 0));
  expectNear(s.q_NA * Vec3::UnitX(), -Vec3::UnitX(), 1e-6);
  EXPECT_GT(s.sideArm, 0.19);
}

TEST(FlightShape, ANoseThatIsStatedGoesBefore) {
  const FlightShape s = measureShape(bodies::javelin(), Vec3(-1.05, 0, 0), Vec3(-1, 0, 0));
  expectNear(s.q_NA * Vec3::UnitX(), -Vec3::UnitX(), 1e-6);
  EXPECT_LT(s.sideArm, -0.19);
}

TEST(FlightShape, WhatFollowsFromTheShapeIsLikeTheShippedFit) {
  const std::vector<double> rod =
      coefficientsOf(FlightModel(rodFrom(measureShape(bodies::javelin(96), Vec3(-1.05, 0, 0)))));
  const std::vector<double> fit = coefficientsOf(FlightModel(javelinFlight()));
  for (const std::size_t i : {0U, 1U, 2U, 3U, 5U}) EXPECT_NEAR(rod[i] / fit[i], 1, 0.45) << i;
  const std::vector<double> plate =
      coefficientsOf(FlightModel(plateFrom(measureShape(bodies::discus(96), Vec3::Zero()))));
  const std::vector<double> disc = coefficientsOf(FlightModel(discusFlight()));
  for (const std::size_t i : {0U, 1U, 2U, 3U, 4U, 5U}) EXPECT_NEAR(plate[i] / disc[i], 1, 0.1) << i;
}

TEST(FlightShape, AreasArmsAndAirScaleWithTheSize) {
  const FlightShape once = measureShape(bodies::javelin(), Vec3(-1.05, 0, 0)), twice = once.scaled(2);
  const RodFlight a = rodFrom(once), b = rodFrom(twice);
  const auto fit = shippedFlight(FlightKind::Rod, "javelin", twice);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(b.crossArea / a.crossArea, 4, 1e-12);
  EXPECT_NEAR(b.crossArm / a.crossArm, 2, 1e-12);
  EXPECT_NEAR(b.damping / a.damping, 16, 1e-12);
  EXPECT_NEAR(std::get<RodFlight>(*fit).crossArea / javelinFlight().crossArea, 4, 1e-5);
  EXPECT_FALSE(shippedFlight(FlightKind::Rod, "discus", once));
}

}  // namespace
}  // namespace stadion
