#include "bench/flight/ladder.h"

#include "bench/flight/exact_table.h"
#include "dynamics/flight/bias.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stadion::bench {
namespace {

Trajectory flyModel(const Throw& t, const FlightModel& model, int hz) {
  const auto around = t.conditions();
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

/// No air on the centre; the nose follows the bias. The paper's own form acts once a frame.
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
  // Tuned on the reference flights. A discus only gets worse, so it uses the paper's usual strength.
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
    s.range += e.range * e.range / n;
    s.landing += e.landing * e.landing / n;
    s.landingMost = std::max(s.landingMost, e.landing);
    s.attitude += e.attitude / n;
  }
  s.range = std::sqrt(s.range);
  s.landing = std::sqrt(s.landing);
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

/// The same for a script's rung; NaN if it cannot be played.
SetErrors errorsOn(const std::vector<Pair>& flights, const ShowRung& rung, const ShowFlights& show,
                   Checks& checks) {
  std::vector<Throw> throws;
  for (const Pair& p : flights) throws.push_back(p.release);
  const auto flown = show.fly(rung, throws);
  if (!flown) {
    checks.push_back({rung.name + ": " + flown.error().message, NAN, 0, 0, ""});
    return {NAN, NAN, NAN, NAN};
  }
  std::vector<FlightErrors> all;
  for (std::size_t i = 0; i < flights.size(); ++i)
    all.push_back(errorsOf(flown.value()[i], flights[i].exact, factsOf(rung.thing).axis));
  return summaryOf(all);
}

/// Returns the greatest attitude difference between frame rates, on all samples of all flights [degrees].
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
      ladder.checks.push_back({what + "landing", 100 * r.heldOut.landing, 100 * landing, 0, "%"});
      if (attitude > 0) ladder.checks.push_back({what + "attitude", r.heldOut.attitude, attitude, 0, "deg"});
    }
  };
  for (const std::string where : {"", " in a show"}) {
    limit(Thing::Javelin, "rod" + where, 0.0045, 1.2);
    limit(Thing::Discus, "plate" + where, 0.0045, 1.2);
    limit(Thing::Javelin, "rod from mesh" + where, 0.05, 0);
    limit(Thing::Discus, "plate from mesh" + where, 0.05, 0);
    limit(Thing::Javelin, "table" + where, 0.0035, 0);
    limit(Thing::Discus, "table" + where, 0.001, 0);
  }
}

/// Adds the distances of a usual javelin throw by a script.
void addJavelinThrows(const ShowFlights& show, Checks& checks) {
  const Throw usual = thrown(Thing::Javelin, 30, 34, 0, 0, Vec3::Zero(), Vec3::Zero());
  for (const ShowRung& rung : show.rungsOf(Thing::Javelin)) {
    if (!rung.limited) continue;
    const auto flown = show.fly(rung, {usual});
    checks.push_back({"javelin at 30 m/s and 34 degrees, " + rung.name,
                      flown ? flown.value().front().back().at.p.x() : NAN, 91, 85, "m"});
  }
}

}  // namespace

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
  if (thing != Thing::Ball) add("table", tableOf(exactTable(thing)));
  return rungs;
}

Ladder measureLadder(const std::vector<ReferenceFlight>& references, int heldOutFlights,
                     const ShowFlights* show) {
  Ladder ladder;
  for (const Thing thing : {Thing::Javelin, Thing::Discus, Thing::Ball}) {
    std::vector<Pair> reference, others;
    for (const ReferenceFlight& r : references)
      if (r.release.thing == thing && r.smooth) reference.push_back({r.release, r.path});
    for (const Throw& t : heldOut(thing, heldOutFlights)) others.push_back({t, flyExactly(t)});
    for (const Rung& rung : rungsOf(thing))
      ladder.rungs.push_back({thing, rung.name, errorsOn(reference, rung), errorsOn(others, rung)});
    for (const ShowRung& rung : show ? show->rungsOf(thing) : std::vector<ShowRung>{})
      ladder.rungs.push_back({thing, rung.name, errorsOn(reference, rung, *show, ladder.checks),
                              errorsOn(others, rung, *show, ladder.checks)});
    if (thing == Thing::Javelin) {
      others.resize(std::min<std::size_t>(others.size(), 20));
      ladder.checks.push_back(
          {"bias: attitude at 30, 60, 120 Hz against 1000 Hz", biasSpread(others), 0.05, 0, "deg"});
    }
  }
  ladder.checks.push_back(
      {"bias of a ball: rate", biasFor(factsOf(Thing::Ball).shape, BiasForm::Flow, 1).rate, 0, 0, "1/s"});
  addChecks(ladder);
  if (show) addJavelinThrows(*show, ladder.checks);
  return ladder;
}

}  // namespace stadion::bench
