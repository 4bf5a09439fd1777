#include "engine/maths/functions.h"
#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>

#include <random>

namespace stadion {
namespace {

using namespace scenes;

double tilt(const World& w, BodyId b) {
  return det::logRotation(w.state(b).q).norm();
}

/// Seconds until a block of this size, on gravity tilted 0.02 rad beyond its balance, leans by 0.5 rad.
double tippingTime(double size, std::uint32_t fineness = 1) {
  const double a = std::atan2(0.1, 0.3) + 0.02, step = 1e-4 * std::sqrt(size);
  World w;
  w.setStepDivider(fineness);
  const FieldId g = addGravity(w, Vec3(kG * std::sin(a), 0, -kG * std::cos(a)));
  addFloor(w, 1);
  const BodyId b = addBox(
      w, g,
      {.half = size * Vec3(0.1, 0.1, 0.3), .pose = {{0, 0, 0.3 * size}, Quat::Identity()}, .friction = 1});
  double before = 0;
  for (Nanoseconds t = 0, dt = fromSeconds(step); t < fromSeconds(2); t += dt) {
    w.advance(t, t + dt);
    const double now = tilt(w, b);
    if (now >= 0.5) return toSeconds(t + dt) - (now - 0.5) / (now - before) * step;
    before = now;
  }
  return -1;
}

/// The same from the pendulum's equation.
double tippingTruth(double size) {
  const double lever = size * std::hypot(0.1, 0.3), h = 1e-5 * std::sqrt(size);
  const auto f = [&](double x) { return 0.75 * kG / lever * std::sin(x + 0.02); };
  double x = 0, v = 0, t = 0, before = 0;
  while (x < 0.5) {
    before = x;
    const double k1 = v, l1 = f(x), k2 = v + h / 2 * l1, l2 = f(x + h / 2 * k1), k3 = v + h / 2 * l2,
                 l3 = f(x + h / 2 * k2), k4 = v + h * l3, l4 = f(x + h * k3);
    x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), v += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4), t += h;
  }
  return t - (x - 0.5) / (x - before) * h;
}

TEST(LastingContact, FinerStepsComeNearerToTheTruth) {
  const double size = 1.0 / 64, truth = tippingTruth(size);
  EXPECT_LT(std::fabs(tippingTime(size, 8) - truth), std::fabs(tippingTime(size) - truth) / 10);
}

TEST(LastingContact, TippingConvergesAtSecondOrder) {
  // A smaller block falls faster through the same steps: its relative error is that of a longer step.
  const auto error = [](double size) {
    return std::fabs(tippingTime(size) - tippingTruth(size)) / std::sqrt(size);
  };
  const double coarse = error(1.0 / 64), fine = error(1.0 / 16), real = error(1);
  const double order = std::log2(coarse / fine);
  std::printf("  tipping: error %.2e s, order %.2f (%.2e, %.2e)\n", real, order, coarse, fine);
  EXPECT_LE(real, 1e-5);
  EXPECT_GE(order, 1.6);
}

TEST(LastingContact, ASlidingBoxStopsExactlyWhereverItGoes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(0, 1);
  double worst = 0;
  for (int i = 0; i < 40; ++i) {
    // Along the slope's line of fall, up or down, whichever way the box is turned.
    const double mu = 0.3 + 0.5 * u(random), slope = i % 2 ? std::atan(mu) * 0.9 * u(random) : 0,
                 heading = 2 * M_PI * u(random), sign = u(random) < 0.5 ? 1 : -1, v0 = 0.5 + 3 * u(random);
    const Vec3 along(std::cos(heading), std::sin(heading), 0);
    World w;
    const FieldId g = addGravity(w, kG * std::sin(slope) * along - kG * std::cos(slope) * Vec3::UnitZ());
    addFloor(w, mu);
    const BodyId b = addBox(w, g,
                            {.half = {0.15, 0.15, 0.05},
                             .pose = {{0, 0, 0.05}, det::fromEuler(0, 0, 6 * u(random))},
                             .v = sign * v0 * along,
                             .friction = mu});
    const double brake = kG * (mu * std::cos(slope) - sign * std::sin(slope));
    play(w, 10);
    worst = std::max(worst, (w.state(b).p - Vec3(0, 0, 0.05) - sign * v0 * v0 / (2 * brake) * along).norm());
    EXPECT_EQ(w.mode(b), BodyMode::Rest) << i;
  }
  std::printf("  sliding boxes: worst %.2e m\n", worst);
  EXPECT_LE(worst, 1e-6);
}

TEST(LastingContact, AnyMassStandsOnAnyOther) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int i = 0; i < 30; ++i) {
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, 0.5);
    const double ratio = std::pow(10.0, 6 * u(random)), h = 0.25;
    std::vector<BodyId> stack;
    for (int k = 0; k < 3; ++k)
      stack.push_back(addBox(
          w, g,
          {.half = Vec3::Constant(h),
           .mass = k == 2 ? ratio : 1,
           .pose = {{0.05 * u(random), 0.05 * u(random), h + 2 * h * k}, det::fromEuler(0, 0, u(random))},
           .friction = 0.5}));
    const Vec3 p = w.state(stack[2]).p;
    play(w, 10);
    EXPECT_LE((w.state(stack[2]).p - p).norm(), 1e-6) << "ratio " << ratio;
  }
}

TEST(LastingContact, AStackDoesNotDriftInAMinute) {
  World w;
  const FieldId g = addGravity(w);
  addFloor(w, 0.5);
  BodyId top = 0;
  for (int i = 0; i < 10; ++i)
    top = addBox(
        w, g,
        {.half = Vec3::Constant(0.25), .pose = {{0, 0, 0.25 + 0.5 * i}, Quat::Identity()}, .friction = 0.5});
  play(w, 60);
  const Vec3 p = w.state(top).p;
  EXPECT_LE(std::fabs(p.z() - 4.75), 1e-6);
  EXPECT_LE(std::hypot(p.x(), p.y()), 1e-6);
}

struct Heap {
  World w;
  std::vector<BodyId> balls;
  explicit Heap(int count, unsigned seed = 7) {
    const FieldId g = addGravity(w);
    addFloor(w, 0.5, 0.3);
    for (int k = 0; k < 4; ++k) {
      const double d = (k & 1 ? 1 : -1) * 0.75;
      BoxShape wall;
      wall.half = k < 2 ? Vec3(0.25, 1, 6) : Vec3(1, 0.25, 6);
      wall.pose.p = k < 2 ? Vec3(d, 0, 6) : Vec3(0, d, 6);
      w.addCollider({w.addShape(wall), {}, {0.5, 0.3, 0.0}});
    }
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-0.03, 0.03);
    for (int i = 0; i < count; ++i)
      balls.push_back(addBall(w, g,
                              {.radius = 0.1,
                               .mass = 0.1,
                               .p = {-0.27 + 0.27 * (i % 3) + u(random),
                                     -0.27 + 0.27 * (i / 3 % 3) + u(random), 0.3 + 0.3 * (i / 9)},
                               .restitution = 0.3,
                               .friction = 0.5}));
  }
};

TEST(LastingContact, AHeapOfBallsLosesEnergyAndKeepsItsShape) {
  Heap heap(90);
  double energy = 1e300, first = 0, rise = 0, deepest = 0, last = 0;
  play(heap.w, 6, 60, [&](double) {
    double e = 0;
    last = 0;
    for (const BodyId b : heap.balls) {
      const Vec3 p = heap.w.state(b).p;
      e += heap.w.kineticEnergy(b) + heap.w.mass(b) * kG * p.z();
      last = std::max(last, 0.1 - p.z());
      EXPECT_LE(p.head<2>().cwiseAbs().maxCoeff(), 0.42);
      for (const BodyId o : heap.balls)
        if (o < b) last = std::max(last, 0.2 - (heap.w.state(o).p - p).norm());
    }
    if (first == 0) first = e;
    rise = std::max(rise, (e - energy) / first);
    deepest = std::max(deepest, last);
    energy = e;
  });
  std::printf("  heap: deepest %.2e m, at the end %.2e m, energy rises by %.2e\n", deepest, last, rise);
  EXPECT_LE(deepest, 0.01);
  EXPECT_LE(last, 0.001);
  EXPECT_LE(rise, 1e-12);
}

TEST(LastingContact, TheLastOfAHeapToFallAsleepGainNoEnergy) {
  for (const unsigned seed : {1U, 12U}) {
    Heap heap(90, seed);
    double energy = 1e300, first = 0, rise = 0;
    play(heap.w, 4, 60, [&](double) {
      double e = 0;
      for (const BodyId b : heap.balls)
        e += heap.w.kineticEnergy(b) + heap.w.mass(b) * kG * heap.w.state(b).p.z();
      if (first == 0) first = e;
      rise = std::max(rise, (e - energy) / first);
      energy = e;
    });
    EXPECT_LE(rise, 1e-12) << seed;
  }
}

/// A square post of 10 cm, half a metre high, on the floor.
Mesh post() {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back(i & 1 ? 0.05 : -0.05, i & 2 ? 0.05 : -0.05, i & 4 ? 0.5 : 0);
  return meshOf(corners, {{0, 2, 1},
                          {1, 2, 3},
                          {4, 5, 6},
                          {5, 7, 6},
                          {0, 1, 4},
                          {1, 5, 4},
                          {2, 6, 3},
                          {3, 6, 7},
                          {0, 4, 2},
                          {2, 4, 6},
                          {1, 3, 5},
                          {3, 7, 5}});
}

TEST(LastingContact, ABallPutInsideAMeshComesOutWithoutAJumpAndRests) {
  for (const double height : {0.0, 0.03, 0.2}) {
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, 0.5, 0.3);
    w.addCollider({w.addShape(MeshShape(TriangleTree(post()))), {}, {0.5, 0.3, 0.0}});
    const BodyId ball = addBall(
        w, g,
        {.radius = 0.11, .p = {0.004, 0.001, height}, .restitution = 0.3, .friction = 0.5, .rolling = 0.01});
    Vec3 last = w.state(ball).p;
    play(w, 20, 60, [&](double) {
      const Vec3 p = w.state(ball).p;
      EXPECT_LE((p - last).norm(), 0.05) << height << " at " << p.transpose() << " from " << last.transpose();
      last = p;
    });
    EXPECT_GE(last.z(), 0.109) << height;
    EXPECT_GE(last.head<2>().norm(), 0.15) << height;
    EXPECT_TRUE(w.state(ball).asleep()) << height;
  }
}

TEST(LastingContact, AFieldThatIsOffKeepsNoBodyAwakeHoweverItMoves) {
  World w;
  addFloor(w, 0.5);
  const BodyId box = addBox(
      w, addGravity(w),
      {.half = {0.3, 0.2, 0.1}, .pose = {{0, 0, 0.3}, det::fromEuler(0.4, 0.7, 0.2)}, .friction = 0.5});
  ForceField push;
  push.law = LinearField{{5, 0, 0}, LinearField::Unit::Acceleration};
  const FieldId hand = w.addField(push);
  w.hook(box, hand, 0);
  for (std::uint64_t n = 1; n <= 300; ++n) {
    const TimeSignature s = signatureAt(n, 60);
    const auto at = [](double t) { return Pose{{t, 0, 0}, det::fromEuler(0, 0, t)}; };
    if (n == 240) {
      EXPECT_TRUE(w.state(box).asleep());
      w.switchField(hand, true, s.time - s.step);
    }
    w.moveField(hand, at(toSeconds(s.time - s.step)), at(toSeconds(s.time)));
    w.advance(s.time - s.step, s.time);
  }
  EXPECT_FALSE(w.state(box).asleep()) << "on, it pushes";
}

TEST(LastingContact, TheFrameRateChangesNothing) {
  const auto result = [](double rate) {
    Heap heap(40);
    const FieldId g = addGravity(heap.w);
    const BodyId box = addBox(heap.w, g,
                              {.half = {0.3, 0.2, 0.1},
                               .pose = {{5, 0, 1}, det::fromEuler(0.4, 0.7, 0.2)},
                               .v = {1, 0.5, 0},
                               .omega = {2, 1, 3},
                               .restitution = 0.3,
                               .friction = 0.5});
    const BodyId slider = addBox(heap.w, g,
                                 {.half = {0.15, 0.15, 0.05},
                                  .pose = {{9, 9, 0.05}, Quat::Identity()},
                                  .v = {2, 1, 0},
                                  .friction = 0.5});
    play(heap.w, 3, rate);
    std::vector<Vec3> p{heap.w.state(box).p, heap.w.state(slider).p};
    for (const BodyId b : heap.balls) p.push_back(heap.w.state(b).p);
    return p;
  };
  const std::vector<Vec3> one = result(30);
  for (const double rate : {60.0, 120.0, 240.0}) {
    const std::vector<Vec3> other = result(rate);
    double worst = 0;
    for (std::size_t i = 0; i < one.size(); ++i) worst = std::max(worst, (one[i] - other[i]).norm());
    std::printf("  30 against %g Hz: %.2e m\n", rate, worst);
    EXPECT_LE(worst, 1e-9);
  }
}

}  // namespace
}  // namespace stadion
