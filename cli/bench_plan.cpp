#include "cli/bench_plan.h"

#include "cli/exit_code.h"
#include "cli/number_option.h"
#include "cli/plan_run.h"
#include "cli/stop_signal.h"
#include "profiling/plan/forecast.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <thread>

namespace stadion {
namespace {

struct Options {
  std::vector<std::string> shows;
  std::vector<std::size_t> walls{1, 2, 4, 6};
  std::string size = "240x180";
  std::uint64_t frames = 24;
  std::size_t rounds = 3;
  double within = 15;  ///< [%]
  bool json = false;
};

/// One number of walls, in one mode.
struct Combination {
  std::size_t walls;
  Mode mode;
  std::vector<double> measured, latencies;  ///< by round
};

double middleOf(std::vector<double> values) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

class Validation {
public:
  Validation(const Options& o, GlProvider& provider) : o_(o), provider_(provider) {}

  /// False, with the findings, if something of the user's is wrong. `met`: all within the limit.
  bool run(const std::string& script, Diagnostics& findings, bool& met) {
    PlanRunOptions options;
    options.show.script = script, options.show.walls = "cave6", options.show.size = o_.size;
    options.show.frames = o_.frames;
    if (!options.show.settle(findings)) return false;
    std::vector<Combination> combinations;
    for (const std::size_t walls : o_.walls)
      for (const Mode mode : {Mode::Sequential, Mode::Pipelined})
        combinations.push_back({walls, mode, {}, {}});
    MeasuredCosts costs;
    const double before = loadNow();
    // In turns, so that whatever else the machine does falls on what is measured and on what comes alike.
    for (std::size_t round = 0; round < o_.rounds; ++round) {
      options.walls = *std::ranges::max_element(o_.walls);
      if (!measureCosts(options, provider_, costs, findings)) return false;
      for (Combination& c : combinations) {
        options.walls = c.walls;
        const auto played = playTimes(options, c.mode, provider_, findings);
        if (!played) return false;
        c.measured.push_back(played->period), c.latencies.push_back(played->latency);
      }
      std::fprintf(stderr, "%s: round %zu of %zu\n", script.c_str(), round + 1, o_.rounds);
    }
    tell(script, costs, combinations, met, before);
    return true;
  }

private:
  void tell(const std::string& script, const MeasuredCosts& costs,
            const std::vector<Combination>& combinations, bool& met, double loadBefore) const {
    // What `stadion plan` would have said in each round.
    std::vector<std::vector<plan::FrameCost>> rounds;
    for (const auto& run : costs.runs) rounds.push_back(plan::plannedCosts({run}));
    plan::Plan p;
    p.machine.cores = std::max(1u, std::thread::hardware_concurrency());
    p.waitsInTurn = costs.waitsInTurn;
    p.frames = o_.frames;
    if (!o_.json)
      std::printf("%s, %s a wall and eye, %.0f cores, load %.1f to %.1f\n"
                  "walls  mode        predicted  measured  error   latency  measured\n",
                  script.c_str(), o_.size.c_str(), p.machine.cores, loadBefore, loadNow());
    for (const Combination& c : combinations) {
      p.walls = c.walls, p.pipelined = c.mode == Mode::Pipelined;
      std::vector<double> periods, latencies;
      for (const auto& frames : rounds) {
        const plan::Forecast f = plan::forecastOf(plan::scheduleOf(frames, p), p);
        periods.push_back(f.period), latencies.push_back(f.latency);
      }
      const double period = middleOf(periods), latency = middleOf(latencies);
      const double measured = middleOf(c.measured), error = period / measured - 1;
      const bool ok = std::abs(error) <= o_.within / 100;
      met = met && ok;
      const char* mode = p.pipelined ? "pipelined" : "sequential";
      if (o_.json)
        std::printf("%s\n", nlohmann::json{{"bench", "plan"},
                                           {"show", script},
                                           {"walls", c.walls},
                                           {"mode", mode},
                                           {"predicted_ms", period},
                                           {"measured_ms", measured},
                                           {"error", error},
                                           {"predicted_latency_ms", latency},
                                           {"measured_latency_ms", middleOf(c.latencies)},
                                           {"ok", ok}}
                                .dump()
                                .c_str());
      else
        std::printf("%5zu  %-10s %7.2f ms %6.2f ms %+5.1f %%  %6.2f ms %6.2f ms  %s\n", c.walls, mode, period,
                    measured, 100 * error, latency, middleOf(c.latencies), ok ? "ok" : "MISSED");
    }
  }

  const Options& o_;
  GlProvider& provider_;
};

int benchPlan(Options o) {
  if (o.shows.empty()) o.shows = {STADION_ROOT "/scripts/kick.evs", STADION_ROOT "/scripts/olympia.evs"};
  Diagnostics findings;
  auto provider = openGlProvider(GlProviderKind::OsMesa);
  if (!provider) return findings.add(provider.error()), tell(findings), kBadInput;
  bool met = true;
  Validation validation(o, *provider.value());
  for (const std::string& show : o.shows)
    if (!validation.run(show, findings, met)) {
      tell(findings);
      return catchStopSignals() ? kStopped + stopSignal() : kBadInput;
    }
  if (!o.json) std::printf("%s\n", met ? "ok" : "FAILED");
  return met ? kOk : kCheckFailed;
}

}  // namespace

void addBenchPlan(CLI::App& bench, int& code) {
  auto o = std::make_shared<Options>();
  CLI::App* command = bench.add_subcommand(
      "plan",
      "Does what `stadion plan` predicts come true on this machine? Measures, predicts and plays, in turns");
  command->add_option("SHOW", o->shows, "shows to play (default: kick and olympia)");
  command->add_option("--counts", o->walls, "numbers of walls of cave6 to play on")
      ->check(wholeNumberFrom(1, 6))
      ->delimiter(',')
      ->capture_default_str();
  command->add_option("--size", o->size, "WIDTHxHEIGHT in pixels of one eye's picture")
      ->capture_default_str();
  command->add_option("--frames", o->frames, "of each run")
      ->check(wholeNumberFrom(12, 100000))
      ->capture_default_str();
  command->add_option("--rounds", o->rounds, "the middle one counts")
      ->check(wholeNumberFrom(1, 99))
      ->capture_default_str();
  command->add_option("--within", o->within, "how far off the period may be [%]")
      ->check(numberFrom(0.01, 1000))
      ->capture_default_str();
  command->add_flag("--json", o->json, "one JSON object a line");
  command->callback([o, &code] { code = benchPlan(*o); });
}

}  // namespace stadion
