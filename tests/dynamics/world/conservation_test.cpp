/// What has no force on it keeps its momenta and its energy.

#include "engine/maths/functions.h"
#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

TEST(Conservation, AFreeBodyKeepsBothMomentaToRoundingAndItsEnergyToTheSeries) {
  Chance chance(91);
  double worst = 0;
  for (int i = 0; i < 40; ++i) {
    World w;
    BodyDef d;
    const Vec3 half = {chance.scale(0.02, 1), chance.scale(0.02, 1), chance.scale(0.02, 1)};
    d.shape = w.addShape(BoxShape{{}, half});
    d.mass = massOfBox({}, half, 1).withMass(chance.scale(1e-3, 1e3));
    d.pose = {10 * chance.vector(), chance.turn()}, d.v = 20 * chance.vector();
    d.omega = chance.scale(0.1, 300) * chance.direction();
    const BodyId b = w.addBody(d);
    const Balance before = balanceOf(w, {b}, Vec3::Zero(), d.pose.p);
    const Vec3 own = w.state(b).L;
    const double spinning = before.kinetic - 0.5 * w.mass(b) * d.v.squaredNorm();
    double energy = 0;
    play(w, 10, 60, [&](double t) {
      const Balance now = balanceOf(w, {b}, Vec3::Zero(), d.pose.p);
      EXPECT_EQ(now.momentum, before.momentum) << i;
      EXPECT_EQ(w.state(b).L, own) << i;
      EXPECT_LE((w.state(b).p - d.pose.p - t * d.v).norm(), 1e-12 * (1 + w.state(b).p.norm())) << i;
      energy = std::max(energy, std::fabs(now.kinetic - before.kinetic) / spinning);
    });
    EXPECT_LE(energy, 2e-10) << i;
    worst = std::max(worst, energy);
  }
  std::printf("  energy of tops %.1e after 10 s\n", worst);
}

TEST(Conservation, GravityGivesMomentumAtItsRateAndEnergyWhatItTakes) {
  World w;
  const FieldId g = addGravity(w);
  const BodyId b = addBox(w, g, {.half = {0.3, 0.2, 0.1}, .v = {3, -1, 12}, .omega = {4, 2, 9}});
  const Balance before = balanceOf(w, {b}, Vec3(0, 0, -kG));
  play(w, 5, 60, [&](double t) {
    const Balance now = balanceOf(w, {b}, Vec3(0, 0, -kG));
    EXPECT_LE((now.momentum - before.momentum - t * Vec3(0, 0, -kG)).norm(), 1e-12);
    EXPECT_NEAR(now.energy() / before.energy(), 1, 1e-12);
  });
}

/// Balls in a closed room, nothing lost anywhere.
struct Room {
  World w;
  std::vector<BodyId> balls;
  explicit Room(unsigned seed, double friction = 0) {
    Chance chance(seed);
    for (int i = 0; i < 27; ++i)
      balls.push_back(addBall(w, 0,
                              {.radius = 0.05,
                               .mass = chance.scale(0.3, 3),
                               .p = {0.12 * (i % 3), 0.12 * (i / 3 % 3), 0.12 * (i / 9)},
                               .v = 3 * chance.vector(),
                               .restitution = 1,
                               .friction = friction}));
    for (int k = 0; k < 6; ++k) {
      BoxShape wall;
      wall.half = Vec3::Constant(0.75), wall.half[k / 2] = 0.15;
      wall.pose.p = Vec3::Constant(0.12), wall.pose.p[k / 2] += (k & 1 ? 1 : -1) * 0.65;
      w.addCollider({w.addShape(wall), {}, {friction, 1.0, 0.0}});
    }
  }
};

TEST(Conservation, TwentySevenBallsInABoxKeepTheirEnergy) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    Room room(seed);
    Watch watch(room.w, room.balls, Vec3::Zero());
    std::uint64_t impacts = 0, tired = 0;
    double worst = 0;
    play(room.w, 5, 60, [&](double) {
      watch.look();
      impacts += room.w.counters().impacts, tired += room.w.counters().dampedBounces;
      worst = std::max(worst, std::fabs(watch.last / watch.first - 1));
    });
    EXPECT_GT(impacts, 500u);
    EXPECT_EQ(tired, 0u);
    EXPECT_LE(worst, 1e-10) << seed;
    for (const BodyId b : room.balls)
      EXPECT_LE((room.w.state(b).p - Vec3::Constant(0.12)).cwiseAbs().maxCoeff(), 0.45 + 1e-9);
  }
}

TEST(Conservation, OnlyTheWallsGiveTheBallsMomentum) {
  // What the events of the walls say is what the sum of the momenta has changed by.
  Room room(4);
  const Vec3 before = balanceOf(room.w, room.balls, Vec3::Zero()).momentum;
  Vec3 given = Vec3::Zero();
  // Counts all reported impacts: releases come at 0.5 m, so each pair reports one until then.
  for (int frames = 0; frames < 2; ++frames) {
    const TimeSignature s = signatureAt(static_cast<std::uint64_t>(frames) + 1, 60);
    room.w.advance(s.time - s.step, s.time);
    for (const ContactEvent& e : room.w.events())
      if (!e.other.isBody) given += e.impulse * e.normal;
  }
  EXPECT_LE((balanceOf(room.w, room.balls, Vec3::Zero()).momentum - before - given).norm(), 1e-12);
}

TEST(Conservation, ACloudThatMeetsInSpaceKeepsMomentumAndAngularMomentumThroughHundredsOfImpacts) {
  for (const double friction : {0.0, 0.5}) {
    World w;
    Chance chance(93);
    std::vector<BodyId> cloud;
    for (int i = 0; i < 60; ++i) {
      const Vec3 p(i % 4 - 1.5, i / 4 % 4 - 1.5, i / 16 - 1.5);
      cloud.push_back(addBall(w, 0,
                              {.radius = 0.2,
                               .mass = chance.scale(0.1, 10),
                               .p = p + 0.05 * chance.vector(),
                               .v = -2 * p + chance.vector(),
                               .omega = 20 * chance.vector(),
                               .restitution = 1,
                               .friction = friction}));
    }
    const Balance before = balanceOf(w, cloud, Vec3::Zero());
    Watch watch(w, cloud, Vec3::Zero());
    std::uint64_t impacts = 0;
    play(w, 3, 60, [&](double) {
      watch.look();
      impacts += w.counters().impacts;
    });
    const Balance after = balanceOf(w, cloud, Vec3::Zero());
    EXPECT_GT(impacts, 100u);
    EXPECT_LE((after.momentum - before.momentum).norm(), 1e-11) << friction;
    EXPECT_LE((after.angular - before.angular).norm(), 1e-10) << friction;
    EXPECT_NEAR(watch.last / watch.first, 1, friction > 0 ? 0.5 : 1e-11);
    EXPECT_LE(watch.greatestRise, 1e-12 * watch.first) << "friction takes, and gives nothing";
    EXPECT_EQ(watch.limited, 0u);
  }
}

}  // namespace
}  // namespace stadion
