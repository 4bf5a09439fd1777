/// The orders that the headers claim, measured: what happens to errors when steps are halved.

#include "dynamics/motion/arc.h"
#include "dynamics/motion/drag_flight.h"
#include "engine/maths/functions.h"
#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;
using Real = long double;

double orderOf(double coarse, double fine) {
  return std::log2(coarse / fine);
}

/// x'' = f(t, x, v) by Runge and Kutta's classic method in long double.
template <class F>
std::array<Real, 6> solve(const Vec3& p, const Vec3& v, double seconds, int steps, F f) {
  using State = std::array<Real, 6>;
  State s{p.x(), p.y(), p.z(), v.x(), v.y(), v.z()};
  const Real h = static_cast<Real>(seconds) / steps;
  const auto rate = [&](Real t, const State& x) {
    const std::array<Real, 3> a = f(t, x);
    return State{x[3], x[4], x[5], a[0], a[1], a[2]};
  };
  const auto along = [](const State& x, const State& k, Real d) {
    State y = x;
    for (std::size_t i = 0; i < 6; ++i) y[i] += d * k[i];
    return y;
  };
  for (int n = 0; n < steps; ++n) {
    const Real t = n * h;
    const State a = rate(t, s), b = rate(t + h / 2, along(s, a, h / 2)),
                c = rate(t + h / 2, along(s, b, h / 2)), d = rate(t + h, along(s, c, h));
    for (std::size_t i = 0; i < 6; ++i) s[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
  }
  return s;
}

double distance(const std::array<Real, 6>& truth, const Vec3& p) {
  return static_cast<double>(std::sqrt((truth[0] - p.x()) * (truth[0] - p.x()) +
                                       (truth[1] - p.y()) * (truth[1] - p.y()) +
                                       (truth[2] - p.z()) * (truth[2] - p.z())));
}

/// The interpolation through a step: position, velocity and acceleration at both ends.
TEST(Convergence, TheQuinticThroughAStepIsOfOrderSix) {
  const auto at = [](double t, int d) {  // of sin(2 t), cos(3 t), exp(t / 2) and their derivatives
    const double s = std::sin(2 * t), c = std::cos(3 * t), e = std::exp(0.5 * t);
    return d == 0   ? Vec3(s, c, e)
           : d == 1 ? Vec3(2 * std::cos(2 * t), -3 * std::sin(3 * t), 0.5 * e)
                    : Vec3(-4 * s, -9 * c, 0.25 * e);
  };
  const auto error = [&](double h) {
    const Vec3 from[3] = {at(0.3, 0), at(0.3, 1), at(0.3, 2)},
               to[3] = {at(0.3 + h, 0), at(0.3 + h, 1), at(0.3 + h, 2)};
    const Path path = Path::hermite(from, to, h);
    double worst = 0;
    for (int i = 0; i <= 20; ++i)
      worst = std::max(worst, (path.position(i * h / 20) - at(0.3 + i * h / 20, 0)).norm());
    return worst;
  };
  for (const double h : {0.1, 0.05, 0.025}) EXPECT_NEAR(orderOf(error(h), error(h / 2)), 6, 0.3) << h;
}

TEST(Convergence, FlightUnderAFieldThatDiffersFromPlaceToPlaceKeepsItsTolerance) {
  Chance chance(101);
  double worst = 0;
  for (int i = 0; i < 12; ++i) {
    World w;
    ForceField f;
    f.law = SphericalField{-4, 10, SphericalField::Falloff::Linear};
    const FieldId centre = w.addField(f, true);
    const Vec3 p = Vec3(3, 0, 0) + chance.vector(), v = Vec3(0, 2, 0.5) + 0.5 * chance.vector();
    const BodyId b = addBall(w, centre, {.p = p, .v = v});
    play(w, 4);
    const auto truth = solve(p, v, 4, 20000, [](Real, const std::array<Real, 6>& x) {
      const Real r = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]), a = -4 * (1 - r / 10) / r;
      return std::array<Real, 3>{a * x[0], a * x[1], a * x[2]};
    });
    worst = std::max(worst, distance(truth, w.state(b).p));
  }
  std::printf("  spherical field: %.1e m after 4 s\n", worst);
  EXPECT_LE(worst, 1e-10);
}

/// The series ends with t^16: the error of one step, far beyond the horizon that the tolerance allows, falls
/// with the seventeenth power.
TEST(Convergence, TheDragSeriesIsOfOrderSixteen) {
  const Vec3 p(0, 0, 0), v(20, 3, 12), g(0, 0, -kG);
  for (const Drag& drag : {Drag{0, 0.05, Vec3::Zero()}, Drag{0.4, 0.02, {3, -2, 1}}}) {
    Path path;
    ASSERT_GT(dragFlight(p, v, g, drag, 1, 1e-10, path), 0.05);
    const auto error = [&](double t) {
      const auto truth = solve(p, v, t, 40000, [&](Real, const std::array<Real, 6>& x) {
        std::array<Real, 3> u, a;
        Real square = 0;
        for (int i = 0; i < 3; ++i) {
          u[static_cast<std::size_t>(i)] = x[static_cast<std::size_t>(3 + i)] - drag.wind[i];
          square += u[static_cast<std::size_t>(i)] * u[static_cast<std::size_t>(i)];
        }
        for (int i = 0; i < 3; ++i)
          a[static_cast<std::size_t>(i)] =
              g[i] - (drag.linear + drag.quadratic * std::sqrt(square)) * u[static_cast<std::size_t>(i)];
        return a;
      });
      return distance(truth, path.position(t));
    };
    double t = 2;  // the shortest time whose error is well above rounding, and twice as long
    while (error(t / 2) > 1e-11) t /= 2;
    const double coarse = error(1.4 * t), fine = error(1.4 * t / std::sqrt(2.0));
    EXPECT_NEAR(2 * orderOf(coarse, fine), 17, 2) << coarse << ' ' << fine;
  }
}

TEST(Convergence, TheSpinSeriesIsOfOrderSixteenAndItsHorizonKeepsTheTolerance) {
  const Vec3 inertia(1, 2, 3.2);
  Chance chance(102);
  double worst = 0;
  for (int i = 0; i < 20; ++i) {
    const Quat q = chance.turn();
    const Vec3 L = chance.scale(0.1, 300) * chance.direction();
    const Spin spin = Spin::free(q, L, inertia);
    // The truth in a hundred short arcs.
    const auto truth = [&](double t) {
      Quat at = q;
      for (int k = 0; k < 100; ++k) at = Spin::free(at, L, inertia).orientation(t / 100);
      return at;
    };
    const auto error = [&](double t) {
      return 2 * (spin.orientation(t).coeffs() - truth(t).coeffs()).norm();
    };
    worst = std::max(worst, error(spin.horizon));
    const double t = 2.2 * spin.horizon;
    EXPECT_NEAR(2 * orderOf(error(t), error(t / std::sqrt(2.0))), 17, 3.5) << i;
  }
  std::printf("  spin at its horizon: %.1e rad\n", worst);
  EXPECT_LE(worst, 5e-13);
}

/// A spun ball under constant torque that is not along its spin: Magnus to fourth order.
TEST(Convergence, ADrivenSpinIsWithinMillionthsOfARadian) {
  const Vec3 omega(30, 5, -10), alpha(0, 40, 20);
  const Spin spin = Spin::driven(Quat::Identity(), omega, alpha, 1);
  for (const double t : {0.1, 0.3, 1.0}) {
    Quat truth = Quat::Identity();  // by the turns of the middles of many pieces
    const int n = 200000;
    for (int i = 0; i < n; ++i) truth = det::expRotation(t / n * (omega + (i + 0.5) * t / n * alpha)) * truth;
    EXPECT_LE(det::logRotation(truth.conjugate() * spin.orientation(t)).norm(), 3e-6) << t;
  }
}

/// A ball that rolls, without slipping, in a hollow of the field: pulls from the middles of steps.
double rollingError(std::uint32_t fineness) {
  World w;
  w.setStepDivider(fineness);
  const FieldId g = addGravity(w);
  ForceField f;
  f.law = SphericalField{-6, 10, SphericalField::Falloff::Linear};
  const FieldId hollow = w.addField(f, true);
  addFloor(w, 0.9);
  const Vec3 p(2, 0.3, 0.1), v(0.2, 1, 0);
  const BodyId b = addBall(w, g, {.p = p, .v = v, .omega = Vec3::UnitZ().cross(v) / 0.1, .friction = 0.9});
  w.hook(b, hollow, 0);
  play(w, 1);
  const auto truth = solve(p, v, 1, 20000, [](Real, const std::array<Real, 6>& x) {
    const Real r = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]), a = -6 * (1 - r / 10) / r * 5 / 7;
    return std::array<Real, 3>{a * x[0], a * x[1], 0};
  });
  return distance(truth, w.state(b).p);
}

TEST(Convergence, ABallThatRollsUnderAVaryingPullConvergesAtSecondOrder) {
  double before = rollingError(1);
  std::printf("  rolling: %.1e m", before);
  EXPECT_LE(before, 1e-5);
  for (const std::uint32_t parts : {2u, 4u, 8u}) {
    const double now = rollingError(parts);
    EXPECT_NEAR(orderOf(before, now), 2, 0.4) << parts;
    std::printf(", %.1e", now);
    before = now;
  }
  std::printf("\n");
}

/// A box that slides down on one edge's side of the floor while a spherical field pulls: steps of the solver.
double slidingError(std::uint32_t fineness) {
  World w;
  w.setStepDivider(fineness);
  const FieldId g = addGravity(w);
  ForceField f;
  f.law = SphericalField{-6, 10, SphericalField::Falloff::Linear};
  const FieldId hollow = w.addField(f, true);
  addFloor(w, 0);
  const Vec3 p(2, 0.3, 0.05), v(0.2, 1, 0);
  const BodyId b =
      addBox(w, g, {.half = {0.15, 0.15, 0.05}, .pose = {p, Quat::Identity()}, .v = v, .friction = 0});
  w.hook(b, hollow, 0);
  play(w, 1);
  const auto truth = solve(p, v, 1, 20000, [](Real, const std::array<Real, 6>& x) {
    const Real r = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]), a = -6 * (1 - r / 10) / r;
    return std::array<Real, 3>{a * x[0], a * x[1], 0};
  });
  return distance(truth, w.state(b).p);
}

TEST(Convergence, ABoxThatSlidesUnderAVaryingPullConvergesAtSecondOrder) {
  double before = slidingError(1);
  std::printf("  sliding: %.1e m", before);
  EXPECT_LE(before, 1e-5);
  for (const std::uint32_t parts : {2u, 4u}) {
    const double now = slidingError(parts);
    EXPECT_NEAR(orderOf(before, now), 2, 0.5) << parts;
    std::printf(", %.1e", now);
    before = now;
  }
  std::printf("\n");
}

}  // namespace
}  // namespace stadion
