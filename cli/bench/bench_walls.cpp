#include "cli/bench/bench_walls.h"

#include "bench/walls/wall_files.h"
#include "bench/walls/walls_judge.h"
#include "bench/walls/walls_plot.h"
#include "bench/walls/walls_table.h"
#include "cli/bench/walls_measure.h"
#include "cli/bench/walls_record_head.h"
#include "cli/bench/walls_rounds.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/options/renderer_options.h"
#include "cli/terminal.h"
#include "engine/base/atomic_file.h"
#include "show/base/temporary_folder.h"
#include "show/output/output_folder.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <memory>

namespace stadion {
namespace {

constexpr std::size_t kFewRounds = 5;

struct BenchWallsOptions {
  WallsSetting one;
  bool measureOne = false, control = false;
  std::string layout = "flat";
  std::vector<std::string> scenes{"a", "b", "c"};
  std::size_t rounds = kFewRounds;
  double minutes = 14;
  std::string drawnBy;  ///< empty: thread for one case, process for the table
  bool scaling = false, json = false;
  std::string out, record;
  RendererOptions renderer;
};

/// In this process, so that its processor time is that setting's.
int measureOne(WallsSetting s, const std::string& out, bool control) {
  if (control) {
    std::printf("%s\n", measureTicks(s.frames).dump().c_str());
    return kOk;
  }
  const TemporaryFolder folder;
  const std::string wrong =
      bench::writeWallScene(folder.path(""), sceneOf(s), s.walls, !s.flat, s.warm + s.frames + 1);
  if (!wrong.empty()) {
    std::fprintf(stderr, "stadion: %s\n", wrong.c_str());
    return kBadInput;
  }
  const auto row = measureWalls(s, folder.path(""));
  if (!row) return printError(row.error(), kInternalFault);
  const std::string line = row.value().dump() + "\n";
  std::fputs(line.c_str(), stdout);
  if (const auto unwritten = out.empty() ? std::nullopt : writeFile(out + "/rows.jsonl", line))
    return printError(*unwritten, kBadInput);
  return kOk;
}

void reportMissingPrograms(const bench::WallsPrograms& programs) {
  if (programs.floor.empty())
    std::fprintf(stderr, "stadion: stadion-walls-floor is missing beside the program; build the target "
                         "walls_programs\n");
  if (programs.osg.empty())
    std::fprintf(stderr,
                 "stadion: OpenSceneGraph's program is not built, and what is compared with it is left out. "
                 "To have it, install and build it with\n  ./stadion setup peers\n");
}

std::optional<Diagnostic> addFile(OutputFolder& folder, const std::string& name, const std::string& content) {
  if (auto wrong = folder.note(name)) return wrong;
  return writeFile(folder.pathOf(name), content);
}

std::optional<Diagnostic> writeAll(OutputFolder& folder, const bench::WallsResults& results, bool scaling) {
  std::string rows;
  for (const std::string& name : results.names())
    for (const nlohmann::json& row : results.rowsOf(name)) rows += row.dump() + "\n";
  if (auto wrong = addFile(folder, "rows.jsonl", rows)) return wrong;
  return scaling ? addFile(folder, "scaling.svg", bench::scalingPlot(results))
                 : addFile(folder, "walls.svg", bench::wallsPlot(results));
}

int report(const WallsOutcome& outcome, const BenchWallsOptions& o) {
  const auto findings =
      o.scaling ? bench::judgeScaling(outcome.results) : bench::judgeTable(outcome.results, o.scenes);
  std::FILE* to = o.json ? stderr : stdout;
  std::fprintf(to, "%s\n%s\n%s", bench::tableOf(outcome.results).c_str(),
               bench::picturesOf(outcome.results).c_str(), bench::textOf(findings).c_str());
  std::fprintf(to, "%zu round%s%s\n", outcome.rounds, outcome.rounds == 1 ? "" : "s",
               outcome.rounds < kFewRounds && !o.scaling
                   ? ": so few say little; medians of five are what counts"
                   : "");
  for (const std::string& failure : outcome.failures) std::fprintf(stderr, "stadion: %s\n", failure.c_str());
  return bench::noneMissed(findings) && outcome.failures.empty() ? kOk : kCheckFailed;
}

int benchTable(const BenchWallsOptions& o) {
  const auto programs = bench::wallsPrograms(std::filesystem::canonical("/proc/self/exe"));
  std::unique_ptr<OutputFolder> out;
  if (!o.out.empty()) {
    auto opened = OutputFolder::open(o.out);
    if (!opened) return printError(opened.error(), kBadInput);
    out = std::move(opened.value());
    out->clear();
  }
  reportMissingPrograms(programs);
  const std::string drawnBy = o.drawnBy.empty() ? "process" : o.drawnBy;
  const bench::WallsChoice choice{o.scenes, !programs.osg.empty(), !programs.floor.empty(), drawnBy};
  WallsRounds how{o.rounds, o.minutes, o.record, recordHead(programs, drawnBy), !o.scaling, o.scenes};
  if (o.json)
    how.row = [](const nlohmann::json& row) { std::printf("%s\n", row.dump().c_str()), std::fflush(stdout); };
  const auto outcome = playRounds(o.scaling ? scalingCases(choice) : tableCases(choice), programs, how);
  if (!outcome) return printError(outcome.error(), kBadInput);
  const int code = report(outcome.value(), o);
  if (out)
    if (const auto wrong = writeAll(*out, outcome.value().results, o.scaling))
      return printError(*wrong, kBadInput);
  return code;
}

int refuse(const std::string& why) {
  std::fprintf(stderr, "stadion: %s\n", why.c_str());
  return kBadInput;
}

/// What would be passed over in silence; empty: nothing.
std::string ignoredIn(const CLI::App& command, const BenchWallsOptions& o) {
  const auto isGiven = [&](const std::string& name) { return command.count(name) > 0; };
  const WallsSetting& one = o.one;
  if (!o.measureOne) {
    if (o.scaling && isGiven("--scenes"))
      return "--scaling has scenes of its own: leave out --scenes, or --scaling for the table";
    if (!o.renderer.words().empty())
      return "the table compares OpenGL with OpenGL: --renderer, --gl and --draw-threads need --one";
    return {};
  }
  for (const char* name : {"--scenes", "--rounds", "--minutes", "--scaling", "--record"})
    if (isGiven(name))
      return std::string(name) + " is for the table, and --one measures one setting: leave one of them out";
  if (o.control)
    for (const CLI::Option* given : command.get_options())
      if (given->count() > 0 && !given->check_lname("one") && !given->check_lname("control") &&
          !given->check_lname("frames") && !given->check_lname("json"))
        return "--control draws nothing, it only waits for ticks: leave out " + given->get_name();
  if (one.kind == "STRICT" && !one.without.empty())
    return "--without leaves out a trick, and STRICT has none: say --class OPEN or --class SUBMIT";
  if (one.mode == Mode::Sequential && isGiven("--latency"))
    return "--latency is for frames that overlap, and --mode sequential has one under way: leave one of them "
           "out";
  if (const std::size_t nodes = sceneOf(one).nodes(); one.moving > nodes)
    return "--moving " + std::to_string(one.moving) + " is more than the " + std::to_string(nodes) +
           " nodes that there are: say --scene-nodes " + std::to_string(one.moving) + ", or move fewer";
  return {};
}

int benchWalls(const CLI::App& command, const BenchWallsOptions& o) {
  if (const std::string ignored = ignoredIn(command, o); !ignored.empty()) return refuse(ignored);
  if (!o.measureOne) return benchTable(o);
  WallsSetting one = o.one;
  std::error_code unmade;  // reported as a picture that cannot be written
  if (!o.out.empty()) {
    std::filesystem::create_directories(o.out, unmade);
    one.pictures = o.out + "/picture";
  }
  if (const std::string why = unwritable(one); !why.empty()) return refuse(why);
  one.flat = o.layout == "flat";
  if (!o.drawnBy.empty()) one.drawnBy = o.drawnBy;
  Diagnostics findings;
  one.renderer = o.renderer.settings(findings);
  if (findings.hasErrors()) return exitWith(findings, kBadInput);
  return measureOne(std::move(one), o.out, o.control);
}

void addTableTo(CommandOptions& options, BenchWallsOptions& o) {
  options.add("--scenes", o.scenes, {.words = "a|b|c"});
  options.add("--rounds", o.rounds, {.most = 99});
  options.add("--minutes", o.minutes);
  options.add("--scaling", o.scaling);
  options.add("--json", o.json);
  options.add("--out", o.out);
  options.add("--record", o.record);
}

void addOneTo(CommandOptions& options, BenchWallsOptions& o) {
  WallsSetting& one = o.one;
  options.add("--one", o.measureOne);
  const auto add = [&](const char* name, auto& value, const OptionLimits& limits = {}) {
    options.add(name, value, limits).needs("--one");
  };
  add("--scene", one.scene);
  add("--class", one.kind);
  add("--without", one.without);
  add("--mode", one.mode, {.words = "pipelined|sequential"});
  add("--pace", one.pace, {.words = "free|lock"});
  add("--latency", one.mostInFlight);
  add("--layout", o.layout);
  add("--wall-count", one.walls, {.most = 6});
  add("--width", one.width);
  add("--height", one.height);
  add("--warm", one.warm);
  add("--frames", one.frames, {.most = 1000});
  add("--scene-nodes", one.nodes);
  add("--moving", one.moving, {.least = 1});
  add("--far", one.far);
  add("--control", o.control);
}

}  // namespace

void addBenchWalls(CLI::App& bench, int& code) {
  auto o = std::make_shared<BenchWallsOptions>();
  CLI::App* command =
      bench.add_subcommand("walls", "A room of stereo walls beside OpenSceneGraph and bare OpenGL");
  CommandOptions options(*command);
  addTableTo(options, *o);
  addOneTo(options, *o);
  o->renderer.addTo(*command);
  options.add("--wall-workers", o->drawnBy, {.words = "thread|process"});
  command->footer(
      "--out DIR receives the rows and a plot; with --one its row and the pictures of the next frame, "
      "picture_WALL_EYE.ppm.\n"
      "With --pace lock, frames begin on ticks of 1/60 s.");
  command->callback([o, command, &code] { code = benchWalls(*command, *o); });
}

}  // namespace stadion
