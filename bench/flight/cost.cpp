#include "bench/flight/cost.h"

#include "bench/flight/exact_table.h"
#include "dynamics/flight/bias.h"
#include "engine/maths/median.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <functional>
#include <memory>

namespace stadion::bench {
namespace {

constexpr int kSteps = 400;            ///< of one body in a round
constexpr std::size_t kBodies = 1000;  ///< of a swarm, which makes one step in a round

FlightState startOf(const Throw& t) {
  const ThingFacts& f = factsOf(t.thing);
  return {t.start.p, t.start.v, t.start.q, momentumOf(f.body, f.axis, t.start.q, t.start.w)};
}

/// An object to be timed; `run` makes `steps` steps of a body.
struct TimedRun {
  std::string name;
  std::function<void()> run;
  double steps = 1;
  std::vector<double> ns;  ///< of a body's step, round by round
};

/// The state lives as long as the timed object. Its path does not matter, but it must stay finite, so it
/// restarts each round.
template <class Step>
TimedRun single(const std::string& name, const Throw& t, Step step) {
  const FlightState start = startOf(t);
  auto state = std::make_shared<FlightState>(start);
  return {name,
          [start, state, step] {
            *state = start;
            for (int i = 0; i < kSteps; ++i) step(*state);
          },
          kSteps,
          {}};
}

TimedRun swarm(const std::string& name, const Throw& t, std::shared_ptr<const FlightStepper> stepper) {
  auto bodies = std::make_shared<FlightSwarm>(kBodies);
  auto left = std::make_shared<int>(0);
  return {name,
          [=] {
            if ((*left)-- == 0) {  // each starts a little differently
              FlightState s = startOf(t);
              for (std::size_t i = 0; i < kBodies; ++i, s.v *= 1.0001) bodies->set(i, s);
              *left = 200;
            }
            stepper->step(*bodies);
          },
          kBodies,
          {}};
}

std::vector<TimedRun> everything() {
  std::vector<TimedRun> all;
  const auto add = [&all](const std::string& name, const Throw& t, const FlightModel& model, bool many) {
    const ThingFacts& f = factsOf(t.thing);
    auto stepper = std::make_shared<const FlightStepper>(model, f.body, t.air(), 1.0 / 60, f.axis);
    all.push_back(single(name, t, [stepper](FlightState& s) { stepper->step(s); }));
    if (many) all.push_back(swarm(name + " x 1000", t, stepper));
  };
  const Throw javelin = thrown(Thing::Javelin, 30, 34, 4, 0, Vec3(0, .1, 0), Vec3::Zero()),
              discus = thrown(Thing::Discus, 25, 35, -10, 0, Vec3(0, 0, -40), Vec3::Zero()),
              ball = thrown(Thing::Ball, 25, 20, 0, 0, Vec3(0, 0, 60), Vec3::Zero());
  add("ballistic", javelin, BallisticFlight{}, true);
  const auto bias = [&](const std::string& name, const Bias& b) {
    auto stepper = std::make_shared<const FlightStepper>(BallisticFlight{}, factsOf(Thing::Javelin).body,
                                                         javelin.air(), 1.0 / 60, 0);
    const bool twice = b.form != BiasForm::Paper;
    all.push_back(single(name, javelin, [b, stepper, twice](FlightState& s) {
      if (twice) s.q = biased(b, s.q, s.v, 1.0 / 120);
      stepper->step(s);
      s.q = biased(b, s.q, s.v, 1.0 / 120);
    }));
  };
  const FlightShape& shape = factsOf(Thing::Javelin).shape;
  bias("bias=paper", biasFor(shape, BiasForm::Paper, 0.0205));
  bias("bias", biasFor(shape, BiasForm::Flow, biasRate(0.0205, 60)));
  bias("bias=covariance", biasFor(shape, BiasForm::Covariance, 0.0625));
  add("rod", javelin, factsOf(Thing::Javelin).shipped, true);
  add("plate", discus, factsOf(Thing::Discus).shipped, true);
  add("ball", ball, factsOf(Thing::Ball).shipped, true);
  add("table", discus, tableOf(exactTable(Thing::Discus)), false);
  return all;
}

double medianRatio(const TimedRun& a, const TimedRun& b) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a.ns.size(); ++i) ratios.push_back(a.ns[i] / b.ns[i]);
  return median(ratios);
}

const TimedRun* find(const std::vector<TimedRun>& all, const std::string& name) {
  const auto found = std::ranges::find(all, name, &TimedRun::name);
  return found == all.end() ? nullptr : &*found;
}

void addChecks(Costs& costs) {
  for (const StepCost& s : costs.steps) {
    if (s.rung == "rod") {
      costs.checks.push_back({"rod step / the paper's bias step", s.ofBias, 0.75, 0, ""});
      costs.checks.push_back({"rod step / force-free step", s.ofFree, 2.1, 0, ""});
    }
    if (s.batch > 0)
      costs.checks.push_back(
          {fmt::format("{} in batches of 1000 / single", s.rung), s.batchOfOne, 0.5, 0, ""});
  }
}

}  // namespace

Costs measureCosts(int rounds) {
  std::vector<TimedRun> all = everything();
  constexpr int kWarm = 20;
  for (int round = -kWarm; round < std::max(rounds, 1); ++round)
    for (TimedRun& t : all) {
      const auto start = std::chrono::steady_clock::now();
      t.run();
      const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - start;
      if (round >= 0) t.ns.push_back(took.count() / t.steps);
    }
  Costs costs;
  const TimedRun &free = *find(all, "ballistic"), &paper = *find(all, "bias=paper");
  for (const TimedRun& t : all) {
    if (t.name.ends_with(" x 1000")) continue;
    StepCost s{t.name, median(t.ns), 0, medianRatio(t, free), medianRatio(t, paper), 0};
    if (const TimedRun* many = find(all, t.name + " x 1000")) {
      s.batch = median(many->ns);
      s.batchOfOne = medianRatio(*many, t);
    }
    costs.steps.push_back(s);
  }
  addChecks(costs);
  return costs;
}

}  // namespace stadion::bench
