/// `stadion soak [SHOW...]`: plays shows for very many frames, and looks whether anything grows or changes.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/findings_json.h"
#include "cli/options/command_options.h"
#include "cli/options/command_programs.h"
#include "cli/options/plugin_option.h"
#include "cli/options/renderer_options.h"
#include "cli/terminal.h"
#include "engine/base/installed_files.h"
#include "show/base/stop_signal.h"
#include "show/measure/soak_run.h"
#include "show/measure/soak_verdicts.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace stadion {
namespace {

struct SoakOptions {
  std::vector<std::string> plugins;
  SoakPlan plan;
  std::string record;
  RendererOptions renderer;
  bool noMemory = false;  ///< what grows is not judged
  bool json = false;
};

double framesPerSecond(const SoakCounts& c) {
  return static_cast<double>(c.frames) / std::max(c.seconds, 1e-3);
}

void printAsText(const SoakOptions& o, const SoakRecord& record, const std::vector<SoakVerdict>& verdicts) {
  const SoakCounts& c = record.counts;
  std::printf("soak of %s: %ju frames in %ju visits by %u processes, %.0f frames a second\n",
              fmt::format("{}", fmt::join(o.plan.shows, ", ")).c_str(), static_cast<std::uintmax_t>(c.frames),
              static_cast<std::uintmax_t>(c.visits), record.processes(), framesPerSecond(c));
  std::printf(
      "  %ju files loaded or unloaded, %ju throws, %ju measurements refused, %ju walls' processes killed\n",
      static_cast<std::uintmax_t>(c.changes), static_cast<std::uintmax_t>(c.throws),
      static_cast<std::uintmax_t>(c.refused), static_cast<std::uintmax_t>(c.killed));
  for (const SoakVerdict& v : verdicts)
    std::printf("  %-6s %s\n", !v.ok ? "-" : *v.ok ? "ok" : "FAILED", v.what.c_str());
}

void printAsJson(const SoakOptions& o, const SoakRecord& record, const std::vector<SoakVerdict>& verdicts) {
  const SoakCounts& c = record.counts;
  nlohmann::ordered_json judged = nlohmann::ordered_json::array();
  for (const SoakVerdict& v : verdicts) {
    nlohmann::ordered_json ok = nullptr;
    if (v.ok) ok = *v.ok;
    judged.push_back({{"what", v.what}, {"ok", ok}});
  }
  printJson({{"ok", isWell(verdicts)},
             {"shows", o.plan.shows},
             {"frames", c.frames},
             {"visits", c.visits},
             {"processes", record.processes()},
             {"frames_per_second", framesPerSecond(c)},
             {"files_changed", c.changes},
             {"throws", c.throws},
             {"measurements_refused", c.refused},
             {"walls_killed", c.killed},
             {"verdicts", judged}});
}

/// Prints what the soak showed, and returns it.
std::vector<SoakVerdict> tellVerdicts(const SoakOptions& o, const SoakRecord& record) {
  const std::vector<SoakVerdict> verdicts = verdictsOf(record, o.plan.frames, !o.noMemory);
  o.json ? printAsJson(o, record, verdicts) : printAsText(o, record, verdicts);
  return verdicts;
}

int soak(SoakOptions o) {
  Diagnostics findings;
  const std::atomic<bool>& stop = catchStopSignals();
  SoakPlan& plan = o.plan;
  if (plan.shows.empty()) plan.shows = {shareFolder() + "/scripts/soak/soak.evs"};
  const std::string what = fmt::format("{}, look {}, visits of {} frames", fmt::join(plan.shows, ", "),
                                       nameOf(plan.look), plan.visit);
  TerminalReporter terminal;
  const RendererSettings settings = o.renderer.settings(findings);
  const auto record = SoakRecord::open(o.record, what, terminal.faultFunction(), findings);
  printFindings(findings);
  if (!record || findings.hasErrors()) return kBadInput;
  if (record->counts.frames >= plan.frames) {
    std::fprintf(stderr, "soak: it is finished, by the record: nothing is played\n");
    return isWell(tellVerdicts(o, *record)) ? kOk : kCheckFailed;
  }
  const auto renderer = ShowRenderer::open(settings);
  if (!renderer) {
    std::fprintf(stderr, "stadion: %s\n", renderer.error().message.c_str());
    return kInternalFault;
  }
  record->begin();
  if (!playSoak(plan, *record, *renderer.value(), terminal, stop)) return kBadInput;
  const std::vector<SoakVerdict> verdicts = tellVerdicts(o, *record);
  record->end(failuresToKeep(verdicts));
  if (!isWell(verdicts)) return kCheckFailed;
  if (record->incomplete()) return kBadInput;
  return record->counts.frames < plan.frames ? kStopped + stopSignal() : kOk;
}

}  // namespace

void addSoakCommand(CLI::App& app, int& code) {
  auto o = std::make_shared<SoakOptions>();
  CLI::App* command = addListedCommand(app, "soak");
  CommandOptions options(*command);
  options.add("SHOW", o->plan.shows);
  options.add("--frames", o->plan.frames, {.least = 1000});
  options.add("--visit", o->plan.visit);
  options.add("--record", o->record);
  options.add("--look", o->plan.look);
  o->renderer.addTo(*command);
  addPluginOption(*command, o->plugins, o->plan.types);
  options.add("--no-memory", o->noMemory);
  options.add("--json", o->json);
  command->footer(
      "Without SHOW a show is played that loads, unloads and throws. Shows are played in turns.\n"
      "Fails (exit code 1) if memory grows by 1 KiB or more in 10 000 frames of a visit, or by 4 KiB from\n"
      "visit to visit, or could not be judged; if handles or threads become more, if a frame is not one "
      "tick\n"
      "after the one before, or if the same frame of a show has another state than before: also when it is\n"
      "stopped. docs/all-day.md");
  command->callback([o, &code] { code = soak(*o); });
}

}  // namespace stadion
