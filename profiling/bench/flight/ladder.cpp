#include "profiling/bench/flight/ladder.h"

#include "dynamics/flight/bias.h"
#include "dynamics/flight/flight_table.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stadion::bench {
namespace {

Trajectory flyModel(const Throw& t, const FlightModel& model, int hz) {
  const auto around = t.surroundings();
  const auto air = [&model](const Vec3& u, const Vec3& w) { return aerodynamics(model, kDensity, u, w); };
  return flyBy(t, hz, [&](RigidFlight& f) { runge_kutta::step4(f, 1.0 / hz, around, air); });
}

/// As shows do: the default step.
Trajectory flyDefault(const Throw& t, const FlightModel& model, int hz) {
  const ThingFacts& facts = factsOf(t.thing);
  const FlightStepper stepper(model, facts.body, t.air(), 1.0 / hz, facts.axis);
  FlightState s{t.start.p, t.start.v, t.start.q, momentumOf(facts.body, facts.axis, t.start.q, t.start.w)};
  return flyBy(t, hz, [&](RigidFlight& f) {
    stepper.step(s);
    f = {s.p, s.v, s.q, angularVelocityOf(facts.body, facts.axis, s)};
  });
}

/// No air on the centre; the nose follows by hand. The paper's own form acts once a frame.
Trajectory flyBiased(const Throw& t, const Bias& bias, int hz) {
  const ThingFacts& facts = factsOf(t.thing);
  const double h = 1.0 / hz;
  const FlightStepper stepper(BallisticFlight{}, facts.body, t.air(), h, facts.axis);
  FlightState s{t.start.p, t.start.v, t.start.q, momentumOf(facts.body, facts.axis, t.start.q, t.start.w)};
  return flyBy(t, hz, [&](RigidFlight& f) {
    const bool paper = bias.form == BiasForm::Paper;
    if (!paper) s.q = biased(bias, s.q, s.v, 0.5 * h);
    stepper.step(s);
    s.q = biased(bias, s.q, s.v, 0.5 * h);
    f = {s.p, s.v, s.q, angularVelocityOf(facts.body, facts.axis, s)};
  });
}

void addBias(std::vector<Rung>& rungs, Thing thing) {
  // Tuned on the reference flights; a discus only gets worse, so it shows the paper's usual strength.
  const double share = thing == Thing::Javelin ? 0.0205 : 0.03;
  const FlightShape& shape = factsOf(thing).shape;
  const auto add = [&](const char* name, const Bias& bias) {
    rungs.push_back({thing, name, [bias](const Throw& t) { return flyBiased(t, bias, 60); }});
  };
  add("bias", biasFor(shape, BiasForm::Flow, biasRate(share, 60)));
  add("bias=paper", biasFor(shape, BiasForm::Paper, share));
  add("bias=covariance", biasFor(shape, BiasForm::Covariance, 0.0625));
}

const char* shippedName(Thing thing) {
  return thing == Thing::Javelin ? "rod" : thing == Thing::Discus ? "plate" : "ball";
}

SetErrors summaryOf(const std::vector<FlightErrors>& all) {
  SetErrors s;
  const double n = static_cast<double>(std::max<std::size_t>(all.size(), 1));
  for (const FlightErrors& e : all) {
    s.range += e.range * e.range / n, s.landing += e.landing * e.landing / n;
    s.landingMost = std::max(s.landingMost, e.landing);
    s.attitude += e.attitude / n;
  }
  s.range = std::sqrt(s.range), s.landing = std::sqrt(s.landing);
  return s;
}

struct Pair {
  Throw release;
  Trajectory exact;
};

SetErrors errorsOn(const std::vector<Pair>& flights, const Rung& rung) {
  std::vector<FlightErrors> all;
  for (const Pair& p : flights)
    all.push_back(errorsOf(rung.fly(p.release), p.exact, factsOf(rung.thing).axis));
  return summaryOf(all);
}

/// Turning across the axis costs this per area and length squared at one angle: the mean of both planes.
double dampingAt(const AnyModel& model, const Vec3& u, const Vec3& k, const Vec3& side, double unit) {
  constexpr double kTurn = 0.3;
  double sum = 0;
  for (const Vec3& n : {side, Vec3(k.cross(side))})
    sum -= (model(u, kTurn * n).torque - model(u, -kTurn * n).torque).dot(n) / (2 * kTurn);
  return 0.5 * sum / (0.5 * kDensity * unit * u.norm());
}

/// The greatest difference of attitude between frame rates, on all samples of all flights [degrees].
double biasSpread(const std::vector<Pair>& flights) {
  const Bias bias = biasFor(factsOf(Thing::Javelin).shape, BiasForm::Flow, biasRate(0.0205, 60));
  double most = 0;
  for (const Pair& p : flights) {
    const Trajectory fine = flyBiased(p.release, bias, 1000);
    for (const int hz : {30, 60, 120}) {
      const Trajectory coarse = flyBiased(p.release, bias, hz);
      for (std::size_t i = 0; i + 1 < std::min(fine.size(), coarse.size()); ++i)
        most =
            std::max(most, (coarse[i].at.q * Vec3::UnitX() - fine[i].at.q * Vec3::UnitX()).norm() / kDegree);
    }
  }
  return most;
}

void addChecks(Ladder& ladder) {
  const auto limit = [&ladder](Thing thing, const std::string& rung, double landing, double attitude) {
    for (const RungResult& r : ladder.rungs) {
      if (r.thing != thing || r.rung != rung) continue;
      const std::string what = fmt::format("{} {} held out: ", factsOf(thing).name, rung);
      ladder.checks.push_back({what + "landing", 100 * r.held.landing, 100 * landing, 0, "%"});
      if (attitude > 0) ladder.checks.push_back({what + "attitude", r.held.attitude, attitude, 0, "deg"});
    }
  };
  limit(Thing::Javelin, "rod", 0.0045, 1.2);
  limit(Thing::Discus, "plate", 0.0045, 1.2);
  limit(Thing::Javelin, "rod from mesh", 0.05, 0);
  limit(Thing::Discus, "plate from mesh", 0.05, 0);
  limit(Thing::Javelin, "table", 0.0035, 0);
  limit(Thing::Discus, "table", 0.001, 0);
}

}  // namespace

TableFlight exactTable(Thing thing) {
  const ThingFacts& facts = factsOf(thing);
  const bool rod = facts.axis == 0;
  const double area = rod ? facts.shape.sideArea : facts.shape.topArea, length = rod ? 2.65 : 0.22;
  std::vector<FlightTableRow> rows;
  const Vec3 k = Vec3::Unit(facts.axis), side = Vec3::UnitY();
  // Close rows where a javelin flies.
  for (double degrees = 0; degrees <= (rod ? 180 : 90); degrees += rod ? (degrees < 20 ? 1 : 5) : 2.5) {
    const double a = degrees * kDegree, speed = 30;
    // The nose is above the velocity: air from below.
    const Vec3 u(speed * std::cos(a), 0, -speed * std::sin(a));
    const Wrench f = facts.exact(u, Vec3::Zero());
    const Vec3 h = u / speed, up(std::sin(a), 0, std::cos(a));
    const double q = 0.5 * kDensity * speed * speed * area;
    rows.push_back({a, -f.force.dot(h) / q, f.force.dot(up) / q, -f.torque.y() / (q * length),
                    dampingAt(facts.exact, u, k, side, area * length * length)});
  }
  return tableFrom(rows, area, length, facts.axis);
}

std::vector<Rung> rungsOf(Thing thing) {
  const ThingFacts& facts = factsOf(thing);
  std::vector<Rung> rungs;
  const auto add = [&](const std::string& name, const FlightModel& model) {
    rungs.push_back({thing, name, [model](const Throw& t) { return flyModel(t, model, 240); }});
  };
  add("ballistic", BallisticFlight{});
  if (thing != Thing::Ball) addBias(rungs, thing);
  const std::string name = shippedName(thing);
  if (thing != Thing::Ball) add(name + " from mesh", facts.fromMesh);
  add(name, facts.shipped);
  rungs.push_back({thing, name + ", 60 Hz",
                   [model = facts.shipped](const Throw& t) { return flyDefault(t, model, 60); }});
  if (thing != Thing::Ball) add("table", exactTable(thing));
  return rungs;
}

Ladder measureLadder(const std::vector<ReferenceFlight>& references, int held) {
  Ladder ladder;
  for (const Thing thing : {Thing::Javelin, Thing::Discus, Thing::Ball}) {
    std::vector<Pair> reference, others;
    for (const ReferenceFlight& r : references)
      if (r.release.thing == thing && r.smooth) reference.push_back({r.release, r.path});
    for (const Throw& t : heldOut(thing, held)) others.push_back({t, flyExactly(t)});
    for (const Rung& rung : rungsOf(thing))
      ladder.rungs.push_back({thing, rung.name, errorsOn(reference, rung), errorsOn(others, rung)});
    if (thing == Thing::Javelin) {
      others.resize(std::min<std::size_t>(others.size(), 20));
      ladder.checks.push_back(
          {"bias: attitude at 30, 60, 120 Hz against 1000 Hz", biasSpread(others), 0.05, 0, "deg"});
    }
  }
  ladder.checks.push_back(
      {"bias of a ball: rate", biasFor(factsOf(Thing::Ball).shape, BiasForm::Flow, 1).rate, 0, 0, "1/s"});
  addChecks(ladder);
  return ladder;
}

}  // namespace stadion::bench
