#include "bench/grid_show.h"
#include "cli/bench/bench_recording.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/terminal.h"
#include "engine/base/atomic_file.h"
#include "engine/base/installed_files.h"
#include "show/base/stop_signal.h"
#include "show/base/temporary_folder.h"
#include "show/measure/profile_run.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <memory>

namespace stadion {
namespace {

struct BenchAttributionOptions {
  std::uint64_t frames = 320;
  bool json = false;
};

struct Show {
  std::string name, script, walls, size;
  double drawOnNodes = 0;  ///< at least; 0: no limit
};

/// A figure with its limit.
struct Line {
  std::string what;
  double share, limit;
  bool atLeast;
  bool met() const { return atLeast ? share >= limit : share <= limit; }
};

std::vector<Line> linesOf(const ShowFigures& f, const Show& show) {
  double measured = 0, found = 0;
  for (const StageBreakdown* e : {&f.app, &f.cull, &f.draw}) {
    measured += e->measured;
    found += std::min(e->measured, e->nodes + e->named);
  }
  const double alone = f.alone.nodes + f.alone.named;
  const double both = f.app.measured + f.cull.measured;
  std::vector<Line> lines = {
      {"App + Cull + Draw, by the clock, on named nodes or parts of stages", found / measured, 0.98, true},
      {"App on named nodes or parts", f.app.covered(), 0, true},
      {"Cull on named nodes or parts", f.cull.covered(), 0, true},
      {"Draw on named nodes or parts", f.draw.covered(), 0, true},
      {"parts of the stages themselves, of App + Cull", both > 0 ? (f.app.named + f.cull.named) / both : 0,
       0.1, false},
      {"off: the sum of what was drawn alone, before scaling, from the eyes drawn whole",
       std::abs(f.alone.covered() - 1), 0.15, false}};
  lines.push_back({"Draw on nodes", alone > 0 ? f.alone.nodes / alone : 0, show.drawOnNodes, true});
  return lines;
}

bool tellFigures(const ShowFigures& f, const Show& show, bool json) {
  bool met = true;
  if (!json)
    std::printf("%s, %s, %s: App %.3f ms, Cull %.3f ms, Draw %.1f ms a frame; %llu frames\n",
                show.name.c_str(), show.walls.c_str(), show.size.c_str(), f.app.measured, f.cull.measured,
                f.draw.measured, static_cast<unsigned long long>(f.frames));
  for (const Line& line : linesOf(f, show)) {
    met = met && line.met();
    const bool limited = line.limit > 0;
    if (json)
      std::printf("%s\n", nlohmann::json{{"bench", "attribution"},
                                         {"show", show.name},
                                         {"figure", line.what},
                                         {"share", line.share},
                                         {"limit", line.limit},
                                         {"ok", line.met()}}
                              .dump()
                              .c_str());
    else
      std::printf("  %6.1f %%  %s%s\n", 100 * line.share, line.what.c_str(),
                  limited ? fmt::format("  (at {} {:g} %)  {}", line.atLeast ? "least" : "most",
                                        100 * line.limit, line.met() ? "ok" : "MISSED")
                                .c_str()
                          : "");
  }
  return met;
}

int benchAttribution(const BenchAttributionOptions& o) {
  const TemporaryFolder folder;
  Diagnostics findings;
  if (const auto wrong = writeFile(folder.path("grid.evs"), gridScript())) {
    findings.add(*wrong);
    return exitWith(findings, kBadInput);
  }
  const std::string scripts = shareFolder() + "/scripts/";
  const Show shows[] = {{"kick", scripts + "kick.evs", "desktop", "400x300", 0},
                        {"olympia", scripts + "olympia.evs", "desktop", "400x300", 0},
                        {"grid of 10 000 nodes", folder.path("grid.evs"), "desktop", "160x120", 0.85}};
  bool met = true;
  TerminalReporter terminal;
  for (const Show& show : shows) {
    ProfileRunOptions options;
    options.show.script = show.script;
    options.show.walls = show.walls;
    options.show.size = show.size;
    options.show.mode = Mode::Sequential;  // so that nothing else of the process is at work meanwhile
    options.show.frames = o.frames;
    options.show.assetRoots = {scripts};
    options.renderer = {RendererChoice::Gl, GlProviderKind::OsMesa};  // it draws single nodes
    if (!options.show.complete(findings)) return exitWith(findings, kBadInput);
    Failure failure;
    OutputFiles none({}, {});
    const auto figures = profileShow(options, none, terminal, findings, failure);
    printFindings(findings);
    if (!figures) return stopSignal() ? kStopped + stopSignal() : kBadInput;
    met = tellFigures(*figures, show, o.json) && met;
  }
  if (!o.json) std::printf("draw: processor time, each batch alone\n%s\n", met ? "ok" : "FAILED");
  return met ? kOk : kCheckFailed;
}

}  // namespace

void addBenchAttribution(CLI::App& bench, int& code) {
  auto o = std::make_shared<BenchAttributionOptions>();
  CLI::App* command = bench.add_subcommand(
      "attribution",
      "How much of the frames of kick, Olympia and a grid of 10 000 nodes is found with nodes?");
  CommandOptions options(*command);
  options.add("--frames", o->frames, {.least = 24, .most = 1e5});
  options.add("--json", o->json);
  command->callback([o, &code] { code = benchAttribution(*o); });
}

}  // namespace stadion
