/// `stadion bench NAME`: measurements with a limit each.

#include "bench/overlap.h"
#include "cli/bench/bench_budgets.h"
#include "cli/bench/bench_detection.h"
#include "cli/bench/bench_dynamics.h"
#include "cli/bench/bench_flight.h"
#include "cli/bench/bench_looks.h"
#include "cli/bench/bench_plan.h"
#include "cli/bench/bench_prediction.h"
#include "cli/bench/bench_recording.h"
#include "cli/bench/bench_scale.h"
#include "cli/bench/bench_walls.h"
#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

int benchOverlap(bool json) {
  const OverlapTimes t;
  OverlapTimes shorter = t;
  shorter.frames = 30;
  const double pipelined = overlapPeriod(Mode::Pipelined, t),
               sequential = overlapPeriod(Mode::Sequential, shorter);
  const double slowest = std::max({t.app, t.cull, t.draw});
  const double sum = t.app + static_cast<double>(t.walls) * (t.cull + t.draw);
  const bool ok = pipelined <= 1.1 * slowest && std::abs(sequential - sum) <= 0.05 * sum;
  if (json)
    std::printf("%s\n", nlohmann::json{{"bench", "overlap"},
                                       {"walls", t.walls},
                                       {"pipelined_ms", pipelined},
                                       {"pipelined_limit_ms", 1.1 * slowest},
                                       {"sequential_ms", sequential},
                                       {"sequential_expected_ms", sum},
                                       {"ok", ok}}
                            .dump()
                            .c_str());
  else
    std::printf("stages that wait: App %.0f ms, Cull %.0f ms and Draw %.0f ms for each of %zu walls\n"
                "  pipelined   %7.2f ms a frame   (at most %.2f)\n"
                "  sequential  %7.2f ms a frame   (%.0f +- 5 %%)\n%s\n",
                t.app, t.cull, t.draw, t.walls, pipelined, 1.1 * slowest, sequential, sum,
                ok ? "ok" : "FAILED");
  return ok ? kOk : kCheckFailed;
}

}  // namespace

void addBenchCommand(CLI::App& app, int& code) {
  auto json = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("bench", "Measure, and fail when a limit is missed");
  command->require_subcommand(1);
  CLI::App* overlap =
      command->add_subcommand("overlap", "Do App, Cull and Draw overlap? Stages that only wait");
  CommandOptions(*overlap).add("--json", *json);
  overlap->callback([json, &code] { code = benchOverlap(*json); });
  addBenchDynamics(*command, code);
  addBenchFlight(*command, code);
  addBenchDetection(*command, code);
  addBenchPlan(*command, code);
  addBenchBudgets(*command, code);
  addBenchAttribution(*command, code);
  addBenchPrediction(*command, code);
  addBenchRecording(*command, code);
  addBenchWalls(*command, code);
  addBenchScale(*command, code);
  addBenchLooks(*command, code);
}

}  // namespace stadion
