/// What is being accelerated, however slowly, does not stop; what is in balance sleeps.

#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

TEST(SlowMotion, ABoxWithoutFrictionGoesWhereATiltedPullTakesIt) {
  World w;
  const double a = 0.0009 * kG;
  const FieldId g = addGravity(w, {a, 0, -kG});
  addFloor(w);
  const BodyId b = addBox(w, g, {.pose = {{0, 0, 0.5}, Quat::Identity()}});
  play(w, 8);
  EXPECT_NEAR(w.state(b).p.x(), 0.5 * a * 64, 1e-9);
}

TEST(SlowMotion, ABoxWithoutFrictionThatHasBeenPushedDriftsForEver) {
  for (const double push : {2e-4, 1.5e-3, 3e-3}) {
    World w;
    const FieldId g = addGravity(w);
    addFloor(w);
    const BodyId b = addBox(w, g, {.pose = {{0, 0, 0.5}, Quat::Identity()}});
    ForceField f;
    f.law = LinearField{{push, 0, 0}, LinearField::Unit::Acceleration};
    f.duration = 1'000'000'000;
    w.hook(b, w.addField(f, true), 0);
    play(w, 11);
    EXPECT_NEAR(w.state(b).v.x(), push, 1e-9) << push;
    EXPECT_NEAR(w.state(b).p.x(), 10.5 * push, 1e-8) << push;
  }
}

TEST(SlowMotion, ABoxOnAMeshDriftsToo) {
  World w;
  const FieldId g = addGravity(w);
  const Mesh floor = gridMesh(-5, 5, -5, 5, 1, 1);
  w.addCollider({w.addShape(MeshShape(TriangleTree(floor))), {}, {0.0, 0.0, 0.0}});
  const BodyId b = addBox(w, g, {.pose = {{0.3, 0, 0.5}, Quat::Identity()}});
  play(w, 0.5);
  w.push(b, Vec3(1.5e-3, 0, 0), w.state(b).p);
  Nanoseconds now = 500'000'000;
  for (int n = 0; n < 600; ++n, now += 16'000'000) w.advance(now, now + 16'000'000);
  EXPECT_NEAR(w.state(b).v.x(), 1.5e-3, 1e-9);
}

TEST(SlowMotion, ABoxJustAboveTheAngleOfFrictionSlides) {
  World w;
  const double slope = std::atan(0.5) + 2e-4, a = kG * (std::sin(slope) - 0.5 * std::cos(slope));
  const FieldId g = addGravity(w, kG * Vec3(std::sin(slope), 0, -std::cos(slope)));
  addFloor(w, 0.5);
  const BodyId b = addBox(w, g, {.pose = {{0, 0, 0.5}, Quat::Identity()}, .friction = 0.5});
  play(w, 8);
  EXPECT_NEAR(w.state(b).p.x(), 0.5 * a * 64, 1e-6);
}

TEST(SlowMotion, ATallBoxFallsOverHoweverLittleItIsPastItsBalance) {
  for (const double past : {0.2, 0.02, 0.01, 0.003}) {
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, 1);
    const double tilt = std::atan2(0.2, 1) + past * M_PI / 180;
    const Quat q(Eigen::AngleAxisd(tilt, Vec3::UnitX()));
    const Vec3 edge = q * Vec3(0, -0.2, -1);
    const BodyId b = addBox(w, g, {.half = {0.2, 0.2, 1}, .pose = {{0, 0, -edge.z()}, q}, .friction = 1});
    play(w, 12);
    EXPECT_LE(w.state(b).p.z(), 0.21) << past;
    EXPECT_TRUE(w.state(b).asleep()) << past;
  }
}

TEST(SlowMotion, SmallHeapsFallAsleepAllTheSame) {
  Chance chance(17);
  for (int n = 0; n < 4; ++n) {
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, 0.5, 0.2);
    std::vector<BodyId> heap;
    for (int i = 0; i < 4; ++i) {
      BodyDef d = solidBody(w, (n + i) % 3 ? Solid::Box : n % 2 ? Solid::Convex : Solid::Mesh, 0.2, 1 + i);
      d.pose = {Vec3(0.1 * i, 0.05 * i, 0.4 + 0.5 * i), chance.turn()};
      d.surface = {0.5, 0.2, 0.05};
      heap.push_back(addSolid(w, g, d));
    }
    Watch watch(w, heap);
    double asleep = 0;
    play(w, 20, 60, [&](double t) {
      watch.look();
      if (!watch.asleep()) asleep = t;
    });
    std::printf("  heap %d asleep after %.2f s\n", n, asleep);
    EXPECT_LT(asleep, 15) << n;
  }
}

}  // namespace
}  // namespace stadion
