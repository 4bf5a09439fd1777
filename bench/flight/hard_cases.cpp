#include "bench/flight/hard_cases.h"

#include "bench/flight/exact_table.h"
#include "dynamics/flight/bias.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion::bench {
namespace {

bool finite(const FlightState& s) {
  return s.p.allFinite() && s.v.allFinite() && s.q.coeffs().allFinite() && s.L.allFinite();
}

std::vector<std::pair<const ThingFacts*, FlightModel>> allModels() {
  std::vector<std::pair<const ThingFacts*, FlightModel>> all;
  for (const Thing thing : {Thing::Javelin, Thing::Discus, Thing::Ball}) {
    const ThingFacts& f = factsOf(thing);
    all.emplace_back(&f, f.shipped);
    if (thing != Thing::Ball) all.emplace_back(&f, tableOf(exactTable(thing)));
  }
  return all;
}

/// Bodies so light that drag takes k |v| h = 1e6 of their speed in a step. The speed through air must fall
/// and must not reverse. The result is the greatest ratio of speed after to speed before; infinite on a
/// reversal.
Check lightBodies() {
  double most = 0;
  for (auto [facts, model] : allModels()) {
    FlightBody dust = facts->body;
    const Wrench pull = aerodynamics(model, kDensity, Vec3(30, 0, 3), Vec3::Zero());
    dust.mass = pull.force.norm() / 30 / 60 / 1e6;
    const FlightStepper stepper(model, dust, {Vec3(0, 0, -kGravity), Vec3::Zero(), kDensity}, 1.0 / 60,
                                facts->axis);
    FlightState s;
    s.v = Vec3(30, 0, 3);
    for (int i = 0; i < 60; ++i) {
      const Vec3 v = s.v;
      const double before = v.norm() + kGravity / 60;
      stepper.step(s);
      // It may fall as far as gravity pulls it in the step, but must not be thrown back.
      const bool turned = s.v.dot(v) < -kGravity / 60 * v.norm();
      most = finite(s) && !turned ? std::max(most, s.v.norm() / before) : INFINITY;
    }
  }
  return {"light bodies, k |v| dt = 1e6: speed after / before, at most", most, 1, 0, ""};
}

/// A discus at 300 rad/s in steps of 1/30 s, ten seconds without air: the error of its axis.
Check fastSpin() {
  const ThingFacts& f = factsOf(Thing::Discus);
  const FlightStepper stepper(BallisticFlight{}, f.body, {Vec3::Zero(), Vec3::Zero(), kDensity}, 1.0 / 30,
                              f.axis);
  FlightState s;
  s.L = momentumOf(f.body, f.axis, s.q, Vec3(2, 0, -300));
  const Vec3 L = s.L, k0 = s.q * Vec3::UnitZ();
  for (int i = 0; i < 300; ++i) stepper.step(s);
  const Vec3 exact = det::expRotation(10 / f.body.across * L) * k0;
  return {"300 rad/s at 30 Hz, 10 s free: axis", (s.q * Vec3::UnitZ() - exact).norm() / kDegree, 1e-6, 0,
          "deg"};
}

/// The same in air: the nutation of its axis relative to a discus with fine steps, in 2 s.
Check fastSpinInAir() {
  const ThingFacts& f = factsOf(Thing::Discus);
  const Throw t = thrown(Thing::Discus, 25, 35, -10, 0, Vec3(0, 0, -300), Vec3::Zero());
  Vec3 axis[2];
  for (const int fine : {0, 1}) {
    const int hz = fine ? 3840 : 30;
    const FlightStepper stepper(f.shipped, f.body, t.air(), 1.0 / hz, f.axis);
    FlightState s{t.start.p, t.start.v, t.start.q, momentumOf(f.body, f.axis, t.start.q, t.start.w)};
    for (int i = 0; i < 2 * hz; ++i) stepper.step(s);
    axis[fine] = s.q * Vec3::UnitZ();
  }
  const double off = (axis[0] - axis[1]).norm() / kDegree;
  return {"300 rad/s at 30 Hz, 2 s in air: axis", std::isfinite(off) ? off : INFINITY, 1, 0, "deg"};
}

/// Everything at rest in still air, and falling from there: no model gives NaN.
Check fromRest() {
  double wrong = 0;
  for (auto [facts, model] : allModels()) {
    const FlightStepper stepper(model, facts->body, {Vec3(0, 0, -kGravity), Vec3::Zero(), kDensity}, 1.0 / 60,
                                facts->axis);
    FlightState s;
    for (int i = 0; i < 60; ++i) stepper.step(s);
    wrong += !finite(s) || !(s.v.z() < -4);
  }
  for (const BiasForm form : {BiasForm::Flow, BiasForm::Paper, BiasForm::Covariance}) {
    const Bias bias{form, 0.5, Vec3(1, 0.1, 0.1)};
    wrong += biased(bias, Quat::Identity(), Vec3::Zero(), 1).coeffs() != Quat::Identity().coeffs();
  }
  return {"from rest: models that do not fall, or are undefined", wrong, 0, 0, ""};
}

/// A javelin that flies exactly backwards turns round by bias; by air it stays balanced or turns, and stays
/// finite.
Check backwards() {
  Quat q(Eigen::AngleAxisd(kPi, Vec3::UnitZ()));
  const Vec3 v(30, 0, 0);
  const Bias bias{BiasForm::Flow, 2, Vec3(1, 0.001, 0.001)};
  for (int i = 0; i < 600; ++i) q = biased(bias, q, v, 1.0 / 60);
  const ThingFacts& f = factsOf(Thing::Javelin);
  const FlightStepper stepper(f.shipped, f.body, {Vec3::Zero(), Vec3::Zero(), kDensity}, 1.0 / 60, f.axis);
  FlightState s;
  s.v = Vec3(-30, 0, 0);
  for (int i = 0; i < 600; ++i) stepper.step(s);
  const Vec3 nose = q * Vec3::UnitX();
  const double off = std::atan2(nose.cross(v).norm(), nose.dot(v)) / kDegree;
  return {"thrown backwards: nose off the flight after 10 s of bias", finite(s) ? off : INFINITY, 1e-3, 0,
          "deg"};
}

/// A gust of 100 m/s across the flight: no body gets faster than the gust.
Check gust() {
  double most = 0;
  for (auto [facts, model] : allModels())
    for (const Vec3& wind : {Vec3(-100, 0, 0), Vec3(0, 100, 0), Vec3(0, 0, 100)}) {
      const FlightStepper stepper(model, facts->body, {Vec3(0, 0, -kGravity), wind, kDensity}, 1.0 / 60,
                                  facts->axis);
      FlightState s;
      s.v = Vec3(25, 0, 15);
      if (facts->axis == 2) s.L = momentumOf(facts->body, 2, s.q, Vec3(0, 0, -40));
      for (int i = 0; i < 300; ++i) {
        stepper.step(s);
        most = finite(s) ? std::max(most, s.v.norm()) : INFINITY;
      }
    }
  return {"gusts of 100 m/s, 5 s: greatest speed", most, 160, 0, "m/s"};
}

}  // namespace

Checks measureHardCases() {
  return {lightBodies(), fastSpin(), fastSpinInAir(), fromRest(), backwards(), gust()};
}

}  // namespace stadion::bench
