/// What rests under a field whose strength changes starts to move when it should.

#include "engine/maths/functions.h"
#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

/// Calls each(time) after each frame of a field whose strength is `strength(t)`, even between frames.
template <class S, class F>
void playUnder(World& w, FieldId field, double seconds, double rate, S strength, F each) {
  const auto frames = static_cast<std::uint64_t>(seconds * rate + 0.5);
  for (std::uint64_t n = 1; n <= frames; ++n) {
    const TimeSignature s = signatureAt(n, rate);
    w.setFieldStrength(field, strength(toSeconds(s.time - s.step)), strength(toSeconds(s.time)));
    w.advance(s.time - s.step, s.time);
    each(toSeconds(s.time));
  }
}

FieldId addPush(World& w, const Vec3& push) {
  ForceField f;
  f.law = LinearField{push, LinearField::Unit::Acceleration};
  return w.addField(f, true);
}

double ramp(double t) {
  return std::clamp(t - 0.5, 0.0, 2.0);  // half a second of peace first
}

TEST(VaryingStrength, ABoxAtRestSlidesFromTheMomentAtWhichFrictionIsOvercome) {
  // Push 4 s(t) m/s2 against 0.5 g: it starts when s = g / 8, and then v' = 4 s - g / 2.
  const double start = 0.5 + kG / 8;
  for (const double rate : {30., 60., 96., 240.}) {
    World w;
    const FieldId g = addGravity(w), push = addPush(w, {4, 0, 0});
    addFloor(w, 0.5);
    const BodyId b =
        addBox(w, g, {.half = {0.15, 0.15, 0.05}, .pose = {{0, 0, 0.05}, Quat::Identity()}, .friction = 0.5});
    w.hook(b, push, 0);
    double earliest = 0, worst = 0;
    playUnder(w, push, 2.4, rate, ramp, [&](double t) {
      const double since = std::max(0.0, t - start), truth = 4 * since * since * since / 6;
      if (since == 0) earliest = std::max(earliest, w.state(b).p.head<2>().norm());
      worst = std::max(worst, std::fabs(w.state(b).p.x() - truth));
      EXPECT_EQ(w.counters().limited, 0u);
    });
    EXPECT_LE(earliest, 1e-9) << rate << ": it stands until then";
    EXPECT_LE(worst, 2e-4) << rate;
    std::printf("  box at %g Hz: %.1e m\n", rate, worst);
  }
}

TEST(VaryingStrength, ATallBoxTipsFromTheMomentAtWhichItsEdgeNoLongerHoldsIt) {
  // A push at the centre, of half width 0.1 and half height 0.3, tips it once it exceeds g / 3.
  const double start = 0.5 + kG / 12, lever = std::hypot(0.1, 0.3), balance = std::atan2(0.1, 0.3);
  for (const double rate : {30., 60., 240.}) {
    World w;
    const FieldId g = addGravity(w), push = addPush(w, {4, 0, 0});
    addFloor(w, 1);
    const BodyId b =
        addBox(w, g, {.half = {0.1, 0.1, 0.3}, .pose = {{0, 0, 0.3}, Quat::Identity()}, .friction = 1});
    w.hook(b, push, 0);
    // x'' = 3/4 / r (a cos(x - balance) + g sin(x - balance)), about the edge.
    double x = 0, v = 0, t = start, worst = 0;
    playUnder(w, push, 1.9, rate, ramp, [&](double now) {
      const double tilt = det::logRotation(w.state(b).q).norm();
      EXPECT_TRUE(now >= start || tilt <= 1e-9) << tilt;
      const auto f = [&](double at, double angle) {
        return 0.75 / lever * (4 * ramp(at) * std::cos(angle - balance) + kG * std::sin(angle - balance));
      };
      while (t < now) {
        const double h = std::min(1e-4, now - t), k1 = v, l1 = f(t, x), k2 = v + h / 2 * l1,
                     l2 = f(t + h / 2, x + h / 2 * k1), k3 = v + h / 2 * l2,
                     l3 = f(t + h / 2, x + h / 2 * k2), k4 = v + h * l3, l4 = f(t + h, x + h * k3);
        x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), v += h / 6 * (l1 + 2 * l2 + 2 * l3 + l4), t += h;
      }
      worst = std::max(worst, std::fabs(tilt - x));
    });
    std::printf("  tipping at %g Hz: %.1e rad of %.2f\n", rate, worst, x);
    EXPECT_GT(x, 0.2);
    EXPECT_LE(worst, 2e-3) << rate;
  }
}

TEST(VaryingStrength, ABoxThatStrengthNeverOvercomesDoesNotMoveAtAll) {
  World w;
  const FieldId g = addGravity(w), push = addPush(w, {4, 0, 0});
  addFloor(w, 0.5);
  const BodyId b =
      addBox(w, g, {.half = {0.15, 0.15, 0.05}, .pose = {{0, 0, 0.05}, Quat::Identity()}, .friction = 0.5});
  w.hook(b, push, 0);
  playUnder(
      w, push, 6, 60, [](double t) { return 1.2 * std::sin(3 * t); },
      [&](double) { EXPECT_LE((w.state(b).p - Vec3(0, 0, 0.05)).norm(), 1e-9); });
}

TEST(VaryingStrength, AHeapWokenOffItsStepsGoesOnAndItsFramesEnd) {
  World w;
  const FieldId g = addGravity(w);
  addFloor(w, 0.5, 0.2);
  for (int k = 0; k < 4; ++k) {
    const double d = (k & 1 ? 1 : -1) * 0.65;
    w.addCollider({w.addShape(BoxShape{{k < 2 ? Vec3(d, 0, 1) : Vec3(0, d, 1), Quat::Identity()},
                                       k < 2 ? Vec3(0.25, 1, 1) : Vec3(1, 0.25, 1)}),
                   {},
                   {0.5, 0.2, 0.0}});
  }
  Chance chance(121);
  std::vector<BodyId> heap;
  for (int i = 0; i < 40; ++i)
    heap.push_back(addBall(w, g,
                           {.radius = 0.1,
                            .mass = 0.1,
                            .p = Vec3(-0.2 + 0.2 * (i % 3), -0.2 + 0.2 * (i / 3 % 3), 0.3 + 0.25 * (i / 9)) +
                                 0.01 * chance.vector(),
                            .restitution = 0.2,
                            .friction = 0.5,
                            .rolling = 0.05}));
  Watch watch(w, heap);
  Nanoseconds now = 0;
  const auto go = [&](Nanoseconds step) {
    w.advance(now, now + step);
    now += step;
    watch.look();
    EXPECT_EQ(w.counters().limited, 0u);
  };
  for (int n = 0; n < 720 && !watch.asleep(); ++n) go(16'666'667);
  ASSERT_TRUE(watch.asleep());
  // Pushes at odd times, between the steps of 8 ms and of 2 ms, of one after the other.
  for (int k = 0; k < 25; ++k) {
    go(1'234'567 + 777'777 * k);
    const BodyId kicked = heap[static_cast<std::size_t>(17 * k) % heap.size()];
    ASSERT_TRUE(w.push(kicked, 0.02 * (k + 1) * chance.direction(), w.state(kicked).p));
    watch.busiest = 0;
    for (int n = 0; n < 12; ++n) go(k % 2 ? 3'141'593 : 16'666'667);
    EXPECT_LE(watch.busiest, 5000u) << k;
  }
  for (int n = 0; n < 900 && !watch.asleep(); ++n) go(16'666'667);
  EXPECT_TRUE(watch.asleep());
  EXPECT_TRUE(watch.finite);
}

TEST(VaryingStrength, ABallIsLiftedOffItsFaceWhereThePullBecomesTooMuch) {
  // It rolls under an attractor half a metre above the floor; steps sixteen times as fine agree.
  Vec3 end[2];
  for (const bool fine : {false, true}) {
    World w;
    if (fine) w.setStepDivider(16);
    const FieldId g = addGravity(w);
    ForceField f;
    f.law = SphericalField{-300, 1.0, SphericalField::Falloff::Linear, LinearField::Unit::Acceleration};
    f.start.p = f.end.p = {2, 0, 0.5};
    const FieldId pull = w.addField(f, true);
    addFloor(w, 0.5, 0);
    const BodyId b = addBall(
        w, g, {.radius = 0.1, .p = {0, 0, 0.1}, .v = {6, 0, 0}, .omega = {0, 60, 0}, .friction = 0.5});
    w.hook(b, pull, 0);
    double highest = 0;
    play(w, 0.3, 60, [&](double) { highest = std::max(highest, w.state(b).p.z()); });
    EXPECT_GT(highest, 0.15) << "it leaves the floor";
    end[fine] = w.state(b).p;
  }
  std::printf("  lifted ball: %.1e m\n", (end[0] - end[1]).norm());
  EXPECT_LE((end[0] - end[1]).norm(), 1e-4);
}

}  // namespace
}  // namespace stadion
