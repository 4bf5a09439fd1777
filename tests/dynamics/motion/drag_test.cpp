#include "dynamics/motion/drag_flight.h"
#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace stadion {
namespace {

using namespace scenes;

struct Flight {
  std::array<long double, 6> s;  ///< position, velocity
};

/// Runge and Kutta's fourth order in long double with steps of a tenth of a millisecond: an error near 1e-15.
Flight reference(const Vec3& p, const Vec3& v, const Vec3& g, const Drag& drag, double seconds) {
  Flight f{{p.x(), p.y(), p.z(), v.x(), v.y(), v.z()}};
  const auto rate = [&](const std::array<long double, 6>& s) {
    std::array<long double, 6> d;
    std::array<long double, 3> u;
    long double square = 0;
    for (int i = 0; i < 3; ++i)
      u[static_cast<std::size_t>(i)] = s[static_cast<std::size_t>(3 + i)] - drag.wind[i];
    for (const long double x : u) square += x * x;
    const long double size = std::sqrt(square);
    for (std::size_t i = 0; i < 3; ++i) {
      d[i] = s[3 + i];
      d[3 + i] = g[static_cast<int>(i)] - (drag.linear + drag.quadratic * size) * u[i];
    }
    return d;
  };
  const int steps = static_cast<int>(std::lround(seconds * 10000));
  const long double h = static_cast<long double>(seconds) / steps;
  for (int n = 0; n < steps; ++n) {
    const auto at = [&](const std::array<long double, 6>& k, long double x) {
      std::array<long double, 6> s = f.s;
      for (std::size_t i = 0; i < 6; ++i) s[i] += x * k[i];
      return s;
    };
    const auto a = rate(f.s), b = rate(at(a, h / 2)), c = rate(at(b, h / 2)), d = rate(at(c, h));
    for (std::size_t i = 0; i < 6; ++i) f.s[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  }
  return f;
}

double distance(const Flight& f, const Vec3& p) {
  long double square = 0;
  for (std::size_t i = 0; i < 3; ++i)
    square += (f.s[i] - p[static_cast<int>(i)]) * (f.s[i] - p[static_cast<int>(i)]);
  return static_cast<double>(std::sqrt(square));
}

struct ThrownBall {
  World world;
  BodyId ball = 0;

  /// A ball whose drag in air of density 1 is `quadratic` [1/m].
  ThrownBall(const Vec3& p, const Vec3& v, const Drag& drag, const Vec3& g) {
    const FieldId pull = addGravity(world, g);
    ForceField air;
    air.law = MediumField{1.0, drag.linear, drag.wind};
    const FieldId medium = world.addField(air, true);
    BodyDef d;
    d.shape = world.addShape(BallShape{Vec3::Zero(), 0.11});
    d.mass = massOfSphere(Vec3::Zero(), 0.11, 1).withMass(0.43);
    d.pose.p = p, d.v = v, d.dragArea = 2 * drag.quadratic * 0.43;
    ball = world.addBody(d);
    world.hook(ball, pull, 0), world.hook(ball, medium, 0);
  }
};

void fly(World& w, double seconds, double rate) {
  for (std::uint64_t n = 1; n <= static_cast<std::uint64_t>(std::lround(seconds * rate)); ++n) {
    const TimeSignature s = signatureAt(n, rate);
    w.advance(s.time - s.step, s.time);
  }
}

const Vec3 kDown(0, 0, -9.81);

TEST(Drag, AFootballAndABeachBallFlyAsTheReferenceDoes) {
  for (const double k : {0.0132, 0.354}) {
    ThrownBall t({0, 0, 1.5}, {25, 3, 12}, {0, k, Vec3::Zero()}, kDown);
    fly(t.world, 2.5, 60);
    EXPECT_LT(distance(reference({0, 0, 1.5}, {25, 3, 12}, kDown, {0, k, Vec3::Zero()}, 2.5),
                       t.world.state(t.ball).p),
              1e-9)
        << k;
  }
}

TEST(Drag, AnyThrowInAnyWindIsWithinANanometre) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int i = 0; i < 20; ++i) {
    const Vec3 v(30 * u(random), 30 * u(random), 30 * u(random)),
        wind(8 * u(random), 8 * u(random), u(random));
    const Drag drag{0.1 * (1 + u(random)), 0.1 * (1 + u(random)), i % 2 ? wind : Vec3(Vec3::Zero())};
    ThrownBall t({0, 0, 100}, v, drag, kDown);
    fly(t.world, 1.5, 60);
    EXPECT_LT(distance(reference({0, 0, 100}, v, kDown, drag, 1.5), t.world.state(t.ball).p), 1e-9) << i;
  }
}

TEST(Drag, AStraightThrowUpStandsStillAtItsApexAndComesBack) {
  const Drag drag{0, 0.0132, Vec3::Zero()};
  ThrownBall t({0, 0, 1}, {0, 0, 10}, drag, kDown);
  fly(t.world, 2, 60);
  EXPECT_LT(distance(reference({0, 0, 1}, {0, 0, 10}, kDown, drag, 2), t.world.state(t.ball).p), 1e-8);
}

TEST(Drag, DoesNotDependOnTheFrameRate) {
  Vec3 first = Vec3::Zero();
  for (const double rate : {30.0, 60.0, 96.0, 144.0, 240.0}) {
    ThrownBall t({0, 0, 1.5}, {25, 3, 12}, {0, 0.1, {3, 0, 0}}, kDown);
    fly(t.world, 2, rate);
    if (rate == 30) first = t.world.state(t.ball).p;
    EXPECT_EQ(t.world.state(t.ball).p, first) << rate;
  }
}

TEST(Drag, ARegionHoldsBackOnlyInside) {
  World w;
  ForceField air;
  MediumField law;
  law.viscosity = 2, law.region = MediumField::Region::Box, law.half = {1, 5, 5};
  air.law = law;
  const FieldId medium = w.addField(air, true);
  const BodyId ball = addBall(w, 0, {.p = {-3, 0, 0}, .v = {10, 0, 0}});
  w.hook(ball, medium, 0);
  fly(w, 1, 60);
  EXPECT_NEAR(w.state(ball).v.x(), 10 - 2 * 2, 1e-6);  // dv/dx = -c over the two metres inside
}

TEST(Fields, APointAttractsByTheInverseSquareAndKeepsEnergyAndArea) {
  World w;
  ForceField sun;
  sun.law = PointField{-4, 0, LinearField::Unit::Acceleration};
  const FieldId field = w.addField(sun, true);
  const BodyId ball = addBall(w, 0, {.p = {1, 0, 0}, .v = {0, 2.2, 0}});
  w.hook(ball, field, 0);
  const auto energy = [&] { return 0.5 * w.state(ball).v.squaredNorm() - 4 / w.state(ball).p.norm(); };
  const double e0 = 0.5 * 2.2 * 2.2 - 4;
  for (int i = 1; i <= 300; ++i) {
    w.advance(signatureAt(static_cast<std::uint64_t>(i - 1), 60).time,
              signatureAt(static_cast<std::uint64_t>(i), 60).time);
    ASSERT_NEAR(energy(), e0, 1e-9) << i;
    ASSERT_NEAR(w.state(ball).p.cross(w.state(ball).v).z(), 2.2, 1e-9) << i;
  }
}

TEST(Fields, AVortexTurnsThingsRound) {
  World w;
  ForceField whirl;
  whirl.law = VortexField{3, 0.5, 0.5};
  const FieldId field = w.addField(whirl, true);
  const BodyId ball = addBall(w, 0, {.p = {2, 0, 0}});
  w.hook(ball, field, 0);
  fly(w, 0.1, 60);
  const Vec3 v = w.state(ball).v;
  EXPECT_NEAR(v.y(), 0.1 * 3 * 0.5 / 2, 1e-3);         // around, 1 / r beyond the core
  EXPECT_NEAR(v.x(), -0.5 * 0.1 * 3 * 0.5 / 2, 1e-3);  // and inward, half as much
}

}  // namespace
}  // namespace stadion
