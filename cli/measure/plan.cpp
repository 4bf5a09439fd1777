/// `stadion plan SHOW`: predicts frames a second and latency for other machines, walls and modes.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/options/command_programs.h"
#include "cli/options/renderer_options.h"
#include "cli/options/show_options.h"
#include "cli/terminal.h"
#include "engine/base/installed_files.h"
#include "engine/base/plain_file.h"
#include "engine/display/wall_file.h"
#include "engine/hall_formats/hall_import.h"
#include "engine/plain_text/number_text.h"
#include "profiling/plan/diagram.h"
#include "profiling/plan/report.h"
#include "show/base/stop_signal.h"
#include "show/measure/plan_run.h"
#include "show/output/output_files.h"
#include "show/player/output_conflicts.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <thread>

namespace stadion {
namespace {

constexpr std::size_t kMostWalls = WallFile::kMaxWalls;
constexpr std::uint64_t kFramesMeasured = 60;
constexpr double kQuietPlan = 0.5;  ///< threads of others for each core

struct PlanOptions {
  PlanRunOptions run;
  std::string walls = "cave4", mode = "all", stereo = "pair", pace = "free", from, out;
  RendererOptions renderer;
  std::optional<std::size_t> count;  ///< of walls to plan, if known before the costs are
  double cores = 0;                  ///< 0 = as here
  std::size_t machines = 1, wallCount = 0, mostInFlight = 0;
  std::string cullDraw = "overlap";
  bool processes = false, json = false;
};

double coresHere() {
  return std::max(1u, std::thread::hardware_concurrency());
}

double rasterThreadsHere() {
  const char* threads = std::getenv("LP_NUM_THREADS");
  return std::max(1.0, threads ? std::atof(threads) : coresHere());
}

std::optional<plan::ShowCosts> readFrom(const std::string& file, Diagnostics& findings) {
  constexpr std::size_t kMostBytes = 64 << 20;
  const Result<std::string> text = readPlainFile(file, kMostBytes);
  if (!text) {
    findings.add(text.error());
    return std::nullopt;
  }
  Result<plan::ShowCosts> costs = plan::readCosts(text.value(), file);
  if (!costs) {
    findings.add(costs.error());
    return std::nullopt;
  }
  return std::move(costs.value());
}

std::optional<plan::ShowCosts> measure(PlanOptions& o, Diagnostics& findings) {
  ShowOptions& show = o.run.show;
  if (show.frames == 0 && show.seconds == 0) show.frames = kFramesMeasured;
  if (show.frames == 0) {
    show.frames = static_cast<std::uint64_t>(std::ceil(show.seconds * show.rate));
    show.seconds = 0;
  }
  if (!show.complete(findings)) return {};
  const auto walls = loadHall(show.walls, shareFolder() + "/walls", findings);
  if (!walls) return {};
  const RendererSettings settings = o.renderer.settings(findings);
  if (findings.hasErrors()) return {};
  auto renderer = ShowRenderer::open(settings);
  if (!renderer) {
    findings.add(renderer.error());
    return std::nullopt;
  }
  o.run.layout = *stereoLayout(o.stereo);
  o.run.walls = std::min(o.count.value_or(walls->walls.size()), walls->walls.size());
  const double load = loadNow();
  MeasuredCosts measured;
  TerminalReporter terminal;
  if (!measureCosts(o.run, *renderer.value(), terminal, measured, findings)) return {};

  plan::ShowCosts costs;
  costs.show = std::filesystem::path(show.script).filename().string();
  costs.size = fmt::format("{}x{}", show.width, show.height);
  costs.look = nameOf(show.look);
  costs.eyes = o.stereo == "off" ? 1 : 2;
  costs.walls = walls->names();
  costs.walls.resize(o.run.walls);
  const bool byCpu = !renderer.value()->drawsWithGl();
  costs.renderer = byCpu ? "cpu" : "gl";
  costs.cores = coresHere();
  costs.rasterThreads = byCpu ? renderer.value()->threads() : rasterThreadsHere();
  costs.waitsInTurn = measured.waitsInTurn;
  costs.frames = plan::plannedCosts(measured.runs);
  if (costs.frames.empty()) {
    findings.error({}, "no frame could be measured: ask for more with --frames");
    return std::nullopt;
  }
  if (load > kQuietPlan * coresHere() || plan::wasStarved(costs.frames))
    findings.warning({},
                     fmt::format("others were at work on this machine (load {:.1f} before, {:g} cores): what "
                                 "is said of threads, and so what is predicted, may be far off; measure "
                                 "again when it is quiet",
                                 load, coresHere()));
  return costs;
}

plan::Question questionOf(const PlanOptions& o, const plan::ShowCosts& costs) {
  plan::Question q;
  q.sequential = o.mode != "pipelined";
  q.pipelined = o.mode != "sequential";
  q.plan.pipelined = q.pipelined;
  q.plan.walls = o.count.value_or(costs.walls.size());
  q.plan.machine = plan::machineWith(o.cores > 0 ? o.cores : costs.cores, costs);
  q.plan.machines = o.machines;
  q.plan.takesTurns = costs.renderer != "cpu";
  q.plan.waitsInTurn = costs.waitsInTurn;
  q.plan.rasterisers = o.processes ? q.plan.walls : 1;
  q.plan.pace = o.pace == "lock" ? Pace::Lock : o.pace == "float" ? Pace::Float : Pace::Free;
  q.plan.newest = o.pace != "free";
  q.plan.rate = o.run.show.rate;
  q.plan.mostInFlight = o.mostInFlight;
  q.plan.drawBeginsEarly = o.cullDraw == "overlap";
  q.plan.frames = std::max<std::size_t>(costs.frames.size(), 24);
  return q;
}

/// What was measured elsewhere is planned for as many walls as a room has: by number alone.
void countWallsOf(PlanOptions& o, Diagnostics& findings) {
  if (const auto walls = loadHall(o.run.show.walls, shareFolder() + "/walls", findings))
    o.count = walls->walls.size();
}

void refuseMeasuring(const CLI::App& command, Diagnostics& findings) {
  for (const char* option :
       {"--size", "--stereo", "--look", "--frames", "--seconds", "--input", "--asset-root", "--app-threads",
        "--gl", "--renderer", "--gl-submission", "--draw-threads"})
    if (command.count(option) > 0)
      findings.error({}, std::string(option) + " is for measuring; --from has measured costs");
}

int planShow(PlanOptions o, const CLI::App& command) {
  Diagnostics findings;
  if (o.wallCount > 0) o.count = o.wallCount;
  o.run.show.walls = o.count ? "cave6" : o.walls;
  OutputFiles files(o.out, {"plan.svg", "plan.json"});
  std::vector<NamedFile> named = files.named();
  named.insert(named.begin(), {"--from", o.from, false});
  refuseOverwriting({&o.run.show, 1}, named, findings);
  if (!o.from.empty()) refuseMeasuring(command, findings);
  if (o.mode == "sequential")
    for (const char* option : {"--latency", "--cull-draw"})
      if (command.count(option) > 0)
        findings.error({}, std::string(option) +
                               " says how stages overlap, which those of --mode sequential do not: leave one "
                               "of them out");
  if (!o.from.empty() && !o.count && command.count("--walls") > 0) countWallsOf(o, findings);
  if (findings.hasErrors()) return exitWith(findings, kBadInput);
  if (!files.open(findings)) return exitWith(findings, kBadInput);  // before anything is measured
  const auto costs = o.from.empty() ? measure(o, findings) : readFrom(o.from, findings);
  printFindings(findings);
  if (!costs) return stopSignal() ? kStopped + stopSignal() : kBadInput;
  const plan::Question question = questionOf(o, *costs);
  const std::string json = reportJson(*costs, question) + "\n";
  std::fputs((o.json ? json : reportText(*costs, question)).c_str(), stdout);
  if (!files.areWanted()) return kOk;
  const std::string title =
      fmt::format("{}: {} walls, {}, {:g} cores", costs->show, question.plan.walls,
                  question.plan.pipelined ? "pipelined" : "sequential", question.plan.machine.cores);
  files.write("plan.svg", diagramSvg(scheduleOf(costs->frames, question.plan), 4, title));
  files.write("plan.json", json);
  findings = {};
  const bool written = files.commit(findings);
  return exitWith(findings, written ? kOk : kBadInput);
}

constexpr const char* kPlanFooter =
    R"(The show is played here first, some frames of it, sequentially, and the processor time of App, of each wall's Cull and
Draw is measured; of Draw, what its calls take and what the software rasteriser's threads take for them. Then the frame
loop is played through without it, event by event: threads that share the processors alike, three slots of scene state, two
draw lists a wall, walls that take turns with their calls, one rasteriser for all of them, a swap for all walls together.

--wall-count 4 means the first four walls of cave6; beyond six, those again. With --walls, all walls of the file are measured.
Beside --from, --walls says how many walls are planned for.

The part "what would change it" plays the same frames on other machines: there the rasteriser has a thread for each core (32
at most) and keeps the same part of them busy. Walls as processes have a rasteriser each.

  ./stadion plan scripts/kick.evs --wall-count 6
  ./stadion plan scripts/olympia.evs --walls cave4 --cores 16 --out plan    # plan/plan.svg, a timing diagram; plan/plan.json
  ./stadion plan scripts/kick.evs --latency 1 --cull-draw apart
  ./stadion plan scripts/kick.evs --json > costs.json; ./stadion plan --from costs.json --cores 8 --pace lock --rate 60

./stadion bench plan compares what is predicted with what comes.)";

}  // namespace

void addPlanCommand(CLI::App& app, int& code) {
  auto o = std::make_shared<PlanOptions>();
  CLI::App* command = addListedCommand(app, "plan");
  ShowOptions& show = o->run.show;
  CommandOptions options(*command);
  options.add("SHOW", show.script);
  options.add("--from", o->from).excludes("SHOW");
  options.add("--walls", o->walls);
  options.add("--wall-count", o->wallCount, {.most = kMostWalls}).excludes("--walls");
  options.add("--cores", o->cores);
  options.add("--machines", o->machines);
  options.add("--processes", o->processes);
  options.add("--mode", o->mode);
  options.add("--pace", o->pace);
  options.add("--latency", o->mostInFlight);
  options.add("--cull-draw", o->cullDraw);
  options.add("--stereo", o->stereo, {.words = "pair|off"});
  options.add("--size", show.size);
  options.add("--look", show.look);
  addLengthOptions(*command, show);
  o->renderer.addTo(*command);
  options.add("--out", o->out);
  options.add("--json", o->json);
  command->footer(kPlanFooter);
  command->callback([o, command, &code] {
    if (o->from.empty() && o->run.show.script.empty()) throw CLI::RequiredError("SHOW");
    code = planShow(*o, *command);
  });
}

}  // namespace stadion
