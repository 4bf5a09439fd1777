/// The default step: exact where air does nothing, bounded where it does everything, the same for one and
/// many.

#include "dynamics/flight/flight_step.h"

#include "dynamics/flight/flight_table.h"
#include "dynamics/flight/runge_kutta.h"
#include "dynamics/flight/swarm_step.h"
#include "dynamics/maths/double4.h"
#include "engine/maths/angles.h"

#include <bit>
#include <gtest/gtest.h>

namespace stadion {
namespace {

const FlightBody kThrownJavelin{.806, 1.5e-4, .42}, kThrownDiscus{2.0, .0131, .0073},
    kBall{.43, .0035, .0035};

struct Case {
  FlightModel model;
  FlightBody body;
  int axis;
  Vec3 w;
};
TableFlight table() {
  return tableFrom({{0, .06, 0, 0, .05}, {45 * kDegree, .7, .64, .03, .05}, {90 * kDegree, 1.14, 0, 0, .05}},
                   .038, .22, 2);
}
std::vector<Case> cases() {
  return {{BallisticFlight{}, kThrownJavelin, 0, Vec3(5, 1, 2)},
          {BallisticFlight{}, kThrownDiscus, 2, Vec3(.3, 0, -40)},
          {javelinFlight(), kThrownJavelin, 0, Vec3(100, .2, 0)},
          {discusFlight(), kThrownDiscus, 2, Vec3(.3, .1, -300)},
          {footballFlight(), kBall, 0, Vec3(3, 5, 60)},
          {table(), kThrownDiscus, 2, Vec3(.3, .1, -40)}};
}

FlightState start(const Case& c, int number = 0) {
  FlightState s;
  s.p = Vec3(0, number, 2), s.v = Vec3(20 + .01 * number, 1, 14);
  s.q = det::expRotation(Vec3(.1, -.6, .001 * number));
  s.L = momentumOf(c.body, c.axis, s.q, c.w);
  return s;
}

FlightAir windy() {
  return {Vec3(0, 0, -9.81), Vec3(-3, 2, .5), 1.2};
}

bool same(const FlightState& a, const FlightState& b) {
  const auto bits = [](const auto& x, const auto& y) {
    for (Eigen::Index i = 0; i < x.size(); ++i)
      if (std::bit_cast<std::uint64_t>(x[i]) != std::bit_cast<std::uint64_t>(y[i])) return false;
    return true;
  };
  return bits(a.p, b.p) && bits(a.v, b.v) && bits(a.q.coeffs(), b.q.coeffs()) && bits(a.L, b.L);
}

TEST(FlightStep, ManyBodiesAtOnceHaveTheBitsOfEachAlone) {
  constexpr int kBodies = 21;  // no whole number of lanes
  for (const Case& c : cases()) {
    const FlightStepper stepper(c.model, c.body, windy(), 1.0 / 60, c.axis);
    FlightSwarm swarm(kBodies);
    for (int i = 0; i < kBodies; ++i) swarm.set(static_cast<std::size_t>(i), start(c, i));
    for (int n = 0; n < 150; ++n) stepper.step(swarm);
    for (int i = 0; i < kBodies; ++i) {
      FlightState s = start(c, i);
      for (int n = 0; n < 150; ++n) stepper.step(s);
      EXPECT_TRUE(same(s, swarm.at(static_cast<std::size_t>(i)))) << c.model.index() << " body " << i;
    }
  }
}

/// What the stepper hands to the compiled forms, made here once more for two of them.
void runForm(const SwarmSteps& form, FlightSwarm& swarm) {
  // RodLaw and StepNumbers of flight/laws.h and step_kernel.h, in their order.
  const double law[] = {9.331e-4, .05328, .0015, .142, .298, .0103};
  const double h = 1.0 / 60, twist = .6 * h;
  const double numbers[] = {0,
                            0,
                            -9.81,
                            -3,
                            2,
                            .5,
                            h,
                            h / 2,
                            h * h / 8,
                            h / 4 / .42,
                            h / 2 * (1 / 1.5e-4 - 1 / .42),
                            1 / .42,
                            twist / .806,
                            twist};
  double* arrays[FlightSwarm::kArrays];
  for (std::size_t k = 0; k < FlightSwarm::kArrays; ++k) arrays[k] = swarm.array(k);
  for (int n = 0; n < 100; ++n) form.rods(law, numbers, arrays, swarm.size());
}

TEST(FlightStep, TwoLanesAndFourLanesGiveTheSameBits) {
  if (!hasAvx2()) GTEST_SKIP() << "this machine has no AVX2";
  const Case rod{javelinFlight(), kThrownJavelin, 0, Vec3(100, .2, 0)};
  FlightSwarm two(8), four(8);
  for (std::size_t i = 0; i < 8; ++i)
    two.set(i, start(rod, static_cast<int>(i))), four.set(i, start(rod, static_cast<int>(i)));
  runForm(kTwoSteps, two), runForm(kFourSteps, four);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_TRUE(same(two.at(i), four.at(i))) << i;
  EXPECT_GT((two.at(0).p - start(rod).p).norm(), 10);
}

TEST(FlightStep, WithoutAirItIsTheExactTopOnTheExactParabola) {
  for (const double h : {1.0 / 240, 1.0 / 30}) {
    const Case c{BallisticFlight{}, kThrownDiscus, 2, Vec3(2, 1, -300)};
    FlightState s = start(c);
    const FlightState s0 = s;
    const FlightStepper stepper(c.model, c.body, windy(), h, 2);
    const int n = static_cast<int>(std::lround(10 / h));
    for (int i = 0; i < n; ++i) stepper.step(s);
    EXPECT_LE((s.p - (s0.p + 10 * s0.v + 50 * Vec3(0, 0, -9.81))).norm(), 1e-10);
    const double spin = s0.L.dot(s0.q * Vec3::UnitZ()) * (1 / c.body.along - 1 / c.body.across);
    const Quat exact =
        det::expRotation(10 / c.body.across * s0.L) * s0.q * det::expRotation(Vec3(0, 0, 10 * spin));
    EXPECT_LE(det::logRotation(exact.conjugate() * s.q).norm(), 2e-9);  // 480 turns
    EXPECT_EQ(s.L, s0.L);
  }
}

TEST(FlightStep, AHundredThousandStepsKeepTheOrientationAUnit) {
  const Case c{BallisticFlight{}, kThrownJavelin, 0, Vec3(120, 3, -2)};
  FlightState s = start(c);
  const FlightStepper stepper(c.model, c.body, windy(), 1.0 / 60);
  for (int i = 0; i < 100000; ++i) stepper.step(s);
  EXPECT_NEAR(s.q.norm(), 1, 1e-14);
}

TEST(FlightStep, ItConvergesToRungeAndKutta) {
  for (const Case& c : cases()) {
    const Vec3 inertia = c.axis == 0 ? Vec3(c.body.along, c.body.across, c.body.across)
                                     : Vec3(c.body.across, c.body.across, c.body.along);
    const FlightState s0 = start(c);
    RigidFlight exact{s0.p, s0.v, s0.q, c.w};
    const auto air = [&c](const Vec3& u, const Vec3& w) { return aerodynamics(c.model, 1.2, u, w); };
    runge_kutta::DormandPrince(1e-11).advance(exact, 1,
                                              {c.body.mass, inertia, Vec3(0, 0, -9.81), windy().wind}, air);
    double before = 0;
    for (const int hz : {240, 480, 960}) {
      FlightState s = s0;
      const FlightStepper stepper(c.model, c.body, windy(), 1.0 / hz, c.axis);
      for (int i = 0; i < hz; ++i) stepper.step(s);
      const Vec3 k = Vec3::Unit(c.axis);
      const double error = (s.p - exact.p).norm() + (s.q * k - exact.q * k).norm();
      EXPECT_LE(error, before > 1e-9 ? 0.6 * before : 1) << c.model.index() << " at " << hz;
      before = error;
    }
    EXPECT_LE(before, 2e-3) << c.model.index();
  }
}

TEST(FlightStep, NoAirBreaksAStep) {
  for (const Case& c : cases()) {
    FlightBody dust = c.body;
    dust.mass *= 1e-9;
    const FlightStepper stepper(c.model, dust, {Vec3(0, 0, -9.81), Vec3(100, 0, 0), 1.2}, 1.0 / 30, c.axis);
    FlightState s = start(c);
    for (int i = 0; i < 300; ++i) {
      stepper.step(s);
      ASSERT_TRUE(s.p.allFinite() && s.v.allFinite() && s.q.coeffs().allFinite() && s.L.allFinite())
          << c.model.index() << " step " << i;
      ASSERT_LE(s.v.norm(), c.model.index() == 0 ? 200 : 300) << c.model.index();
    }
  }
}

TEST(FlightStep, AxialMomentumIsNotTouchedByTheAir) {
  const Case c{discusFlight(), kThrownDiscus, 2, Vec3(.3, .1, -40)};
  FlightState s = start(c);
  const FlightStepper stepper(c.model, c.body, windy(), 1.0 / 60);
  for (int i = 0; i < 200; ++i) stepper.step(s);
  EXPECT_NEAR(angularVelocityOf(c.body, 2, s).z(), -40, 1e-11);
}

TEST(FlightStep, MomentumAndAngularVelocityAreEachOthersInverse) {
  FlightState s;
  s.q = det::expRotation(Vec3(.4, 1, -2));
  const Vec3 w(3, -1, 40);
  s.L = momentumOf(kThrownDiscus, 2, s.q, w);
  EXPECT_LE((angularVelocityOf(kThrownDiscus, 2, s) - w).norm(), 1e-12);
}

}  // namespace
}  // namespace stadion
