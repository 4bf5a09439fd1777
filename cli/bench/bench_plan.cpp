#include "cli/bench/bench_plan.h"

#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/options/renderer_options.h"
#include "cli/terminal.h"
#include "engine/base/installed_files.h"
#include "engine/hall_formats/hall_import.h"
#include "engine/maths/median.h"
#include "profiling/plan/forecast.h"
#include "show/base/stop_signal.h"
#include "show/measure/plan_run.h"

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

struct BenchPlanOptions {
  std::vector<std::string> shows;
  std::vector<std::size_t> counts;  ///< of walls; none: 1, 2, 4 and 6, or all of a hall
  std::string walls = "cave6", size = "240x180";
  std::uint64_t frames = 24;
  std::size_t rounds = 5;
  double within = 15;  ///< [%]
  RendererOptions renderer;
  bool processes = false, json = false;
};

/// One number of walls, in one mode.
struct Combination {
  std::size_t walls;
  Mode mode;
  struct Round {
    double predicted, measured;                ///< period [ms]
    double predictedLatency, measuredLatency;  ///< [ms]
  };
  std::vector<Round> rounds{};

  double middleOfRounds(double Round::*what) const;
};

double Combination::middleOfRounds(double Round::*what) const {
  std::vector<double> values;
  for (const Round& r : rounds) values.push_back(r.*what);
  return median(std::move(values));
}

class Validation {
public:
  Validation(const BenchPlanOptions& o, ShowRenderer& renderer) : o_(o), renderer_(renderer) {}

  /// False, with the findings, if something of the user's is wrong. `met`: all within the limit.
  bool run(const std::string& script, Diagnostics& findings, bool& met) {
    PlanRunOptions options;
    options.show.script = script;
    options.show.walls = o_.walls;
    options.processes = o_.processes;
    options.show.size = o_.size;
    options.show.frames = o_.frames;
    if (!options.show.complete(findings)) return false;
    std::vector<Combination> combinations;
    for (const std::size_t walls : o_.counts)
      for (const Mode mode : {Mode::Sequential, Mode::Pipelined})
        if (mode == Mode::Pipelined || !o_.processes) combinations.push_back({walls, mode});
    const double before = loadNow();
    if (!lengthen(options, findings)) return false;
    // In turns, and what is predicted from beside what is to come: machines are not as fast at all times.
    for (std::size_t round = 0; round < o_.rounds; ++round) {
      for (Combination& c : combinations) {
        const auto forecast = predict(options, c, findings);
        if (!forecast) return false;
        options.walls = c.walls;
        const auto played = playTimes(options, c.mode, renderer_, terminal_, findings);
        if (!played) return false;
        c.rounds.push_back({forecast->period, played->period, forecast->latency, played->latency});
      }
      std::fprintf(stderr, "%s: round %zu of %zu\n", script.c_str(), round + 1, o_.rounds);
    }
    print(script, options.show.frames, combinations, met, before);
    return true;
  }

private:
  /// What `stadion plan` says now.
  std::optional<plan::Forecast> predict(PlanRunOptions options, const Combination& c, Diagnostics& findings) {
    options.walls = *std::ranges::max_element(o_.counts);
    MeasuredCosts costs;
    if (!measureCosts(options, renderer_, terminal_, costs, findings)) return {};
    plan::Plan p;
    p.machine.cores = std::max(1u, std::thread::hardware_concurrency());
    p.takesTurns = renderer_.drawsWithGl();
    p.waitsInTurn = costs.waitsInTurn;
    p.frames = options.show.frames;
    p.walls = c.walls;
    p.rasterisers = o_.processes ? c.walls : 1;
    p.pipelined = c.mode == Mode::Pipelined;
    return plan::forecastOf(plan::scheduleOf(plan::plannedCosts(costs.runs), p), p);
  }

  /// Short runs say little: they last as many frames as are asked for, and a second.
  bool lengthen(PlanRunOptions& options, Diagnostics& findings) {
    constexpr double kShortest = 1000;  // [ms]
    const Combination least{*std::ranges::min_element(o_.counts), Mode::Pipelined};
    const auto forecast = predict(options, least, findings);
    if (!forecast) return false;
    const auto frames = static_cast<std::uint64_t>(kShortest / std::max(forecast->period, 0.1));
    options.show.frames = std::max(options.show.frames, frames);
    return true;
  }

  void print(const std::string& script, std::uint64_t frames, const std::vector<Combination>& combinations,
             bool& met, double loadBefore) const {
    if (!o_.json)
      std::printf("%s in %s%s, %s a wall and eye, %u cores, load %.1f to %.1f, %zu rounds of %llu frames\n"
                  "walls  mode        predicted  measured  error (of rounds)       latency  measured\n",
                  script.c_str(), o_.walls.c_str(), o_.processes ? ", a process for each wall" : "",
                  o_.size.c_str(), std::thread::hardware_concurrency(), loadBefore, loadNow(), o_.rounds,
                  static_cast<unsigned long long>(frames));
    for (const Combination& c : combinations) {
      using Round = Combination::Round;
      const double period = c.middleOfRounds(&Round::predicted),
                   measured = c.middleOfRounds(&Round::measured),
                   latency = c.middleOfRounds(&Round::predictedLatency),
                   measuredLatency = c.middleOfRounds(&Round::measuredLatency);
      std::vector<double> errors;
      for (const Round& r : c.rounds) errors.push_back(r.predicted / r.measured - 1);
      const auto [least, most] = std::ranges::minmax(errors);
      const double error = median(std::move(errors));
      const bool ok = std::abs(error) <= o_.within / 100;
      met = met && ok;
      const char* mode = c.mode == Mode::Pipelined ? "pipelined" : "sequential";
      if (o_.json)
        std::printf("%s\n", nlohmann::json{{"bench", "plan"},
                                           {"show", script},
                                           {"room", o_.walls},
                                           {"processes", o_.processes},
                                           {"walls", c.walls},
                                           {"mode", mode},
                                           {"predicted_ms", period},
                                           {"measured_ms", measured},
                                           {"error", error},
                                           {"error_least", least},
                                           {"error_most", most},
                                           {"predicted_latency_ms", latency},
                                           {"measured_latency_ms", measuredLatency},
                                           {"ok", ok}}
                                .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                                .c_str());
      else
        std::printf("%5zu  %-10s %7.2f ms %6.2f ms %+5.1f %% (%+5.1f .. %+5.1f)  %6.2f ms %6.2f ms  %s\n",
                    c.walls, mode, period, measured, 100 * error, 100 * least, 100 * most, latency,
                    measuredLatency, ok ? "ok" : "MISSED");
    }
  }

  const BenchPlanOptions& o_;
  ShowRenderer& renderer_;
  TerminalReporter terminal_;
};

/// How many walls are played: 1, 2, 4 and 6 of a CAVE, all of any other room, unless the user says so.
bool countWalls(BenchPlanOptions& o, Diagnostics& findings) {
  const auto room = loadHall(o.walls, shareFolder() + "/walls", findings);
  if (!room) return false;
  if (o.counts.empty())
    o.counts = o.walls == "cave6" ? std::vector<std::size_t>{1, 2, 4, 6} : std::vector{room->walls.size()};
  const std::size_t most = *std::ranges::max_element(o.counts);
  if (most > room->walls.size())
    findings.error({}, fmt::format("--counts {}: {} has {} wall{}; name a room with more by --walls", most,
                                   o.walls, room->walls.size(), room->walls.size() == 1 ? "" : "s"));
  return !findings.hasErrors();
}

int benchPlan(BenchPlanOptions o) {
  if (o.shows.empty())
    o.shows = {shareFolder() + "/scripts/kick.evs", shareFolder() + "/scripts/olympia.evs"};
  Diagnostics findings;
  if (!countWalls(o, findings)) return exitWith(findings, kBadInput);
  const RendererSettings settings = o.renderer.settings(findings);
  if (findings.hasErrors()) return exitWith(findings, kBadInput);
  const auto renderer = ShowRenderer::open(settings);
  if (!renderer) {
    findings.add(renderer.error());
    return exitWith(findings, kBadInput);
  }
  bool met = true;
  Validation validation(o, *renderer.value());
  for (const std::string& show : o.shows)
    if (!validation.run(show, findings, met)) {
      printFindings(findings);
      return catchStopSignals() ? kStopped + stopSignal() : kBadInput;
    }
  if (!o.json) std::printf("%s\n", met ? "ok" : "FAILED");
  return met ? kOk : kCheckFailed;
}

}  // namespace

void addBenchPlan(CLI::App& bench, int& code) {
  auto o = std::make_shared<BenchPlanOptions>();
  CLI::App* command = bench.add_subcommand(
      "plan",
      "Does what `stadion plan` predicts come true on this machine? Measures, predicts and plays, in turns");
  CommandOptions options(*command);
  options.add("SHOW", o->shows);
  options.add("--counts", o->counts);
  options.add("--walls", o->walls);
  options.add("--processes", o->processes);
  options.add("--size", o->size);
  options.add("--frames", o->frames, {.least = 12, .most = 1e5});
  options.add("--rounds", o->rounds, {.most = 99});
  options.add("--within", o->within, {.least = 0.01});
  o->renderer.addTo(*command);
  options.add("--json", o->json);
  command->footer(
      "Plays kick and olympia if no SHOW is named. Quick shows play at least a second. --within limits "
      "the error of the\npredicted period in the middle round. With --walls, all walls of that room are "
      "played; with --processes, each by a\nprocess of its own, pipelined.");
  command->callback([o, &code] { code = benchPlan(*o); });
}

}  // namespace stadion
