/// `stadion walls FILE`: lints a wall file and draws its floor plan or its test pattern, or simulates the hall.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/findings_json.h"
#include "cli/options/command_options.h"
#include "cli/terminal.h"
#include "cli/walls/adjust_walls.h"
#include "cli/walls/simulate_walls.h"
#include "cli/walls/wall_pattern.h"
#include "engine/base/installed_files.h"
#include "engine/display/wall_lint.h"
#include "engine/hall_formats/hall_import.h"
#include "engine/plain_text/number_text.h"
#include "pipeline/platform/processor_set.h"
#include "pipeline/target/graphics_card.h"
#include "show/base/stop_signal.h"
#include "show/player/drawing_plan.h"
#include "show/player/player.h"
#include "show/player/thread_count.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <string_view>
#include <tuple>

namespace stadion {
namespace {

constexpr std::array<std::string_view, 5> kPatternKinds{"room", "pixels", "blend", "gamma", "bars"};

struct WallsOptions {
  std::string file, out, stereo = "off", size, kind, write;
  bool pattern = false, json = false, simulate = false, adjust = false;
  PatternOptions shown;  ///< from the others
  SimulateOptions simulated;
  AdjustOptions adjusted;

  void addTo(CLI::App& command) {
    CommandOptions options(command);
    options.add("WALLS", file).required();
    options.add("--pattern", pattern);
    options.add("--adjust", adjust).excludes("--pattern");
    options.add("--commands", adjusted.commands).needs("--adjust");
    options.add("--pattern-kind", kind);
    options.add("--simulate", simulate).excludes("--pattern").excludes("--adjust");
    options.add("--heads", simulated.heads).needs("--simulate");
    options.add("--every", simulated.every).needs("--simulate");
    options.add("--moved", simulated.moved).needs("--simulate");
    options.add("--wrong-gamma", simulated.wrongGamma).needs("--simulate");
    options.add("--out", out);
    options.add("--write", write);
    options.add("--json", json);
    options.add("--stereo", stereo);
    options.add("--size", size, {.least = 16});
    command.footer(
        R"(--pattern shows border, metres, the wall's name, L or R, and a cube of 1 m in the middle of the room. Projectors show
azimuths and elevations around the visitor instead. --pattern-kind blend is white with all ramps between projectors.
--adjust: Tab chooses a projector, 1 to 4 a corner pin, 5 to 8 the left, top, right or bottom edge of its ramps. Arrows
move by 1 pixel, with Shift by 10, with Control by 0.1. U undoes, R redoes, S saves, Q quits.
--size is for walls whose pixels neither the file nor the output states.)");
  }

  bool complete(Diagnostics& findings) {
    if (!size.empty()) std::tie(shown.width, shown.height) = *parseSize(size);
    if (!out.empty() && !pattern && !simulate && !adjusted.commands)
      findings.error({}, "--out needs --pattern, --simulate or --commands: the floor plan is printed");
    if (json && (pattern || adjust))
      findings.error({}, "--json describes the walls, and --pattern and --adjust show them: leave one out");
    if (!write.empty() && (pattern || simulate || json || adjust))
      findings.error({}, "--write converts the walls: leave out --pattern, --simulate, --adjust and --json");
    if (!kind.empty() && !pattern && !adjust)
      findings.error({}, "--pattern-kind needs --pattern or --adjust");
    shown.out = out;
    simulated.out = out;
    simulated.json = json;
    for (std::size_t k = 0; k < kPatternKinds.size(); ++k)
      if (kind == kPatternKinds[k]) shown.pattern = static_cast<HallPattern>(k);
    shown.windowStereo = windowStereo(*stereoLayout(stereo));
    adjusted.pattern = shown.pattern;
    adjusted.out = out;
    adjusted.windowStereo = shown.windowStereo;
    adjusted.width = shown.width;
    adjusted.height = shown.height;
    return !findings.hasErrors();
  }
};

/// Of a run without options: --renderer auto.
ThreadCount threadsHere(std::size_t walls, std::size_t processors, Diagnostics& findings) {
  if (!graphicsCardFile()) return threadsOfCpuRenderer(static_cast<std::uint32_t>(processors), walls);
  DrawingNeeds needs;
  needs.walls = walls;
  return threadsOf(DrawingPlan(needs, knownMachine(findings)).setting(), walls);
}

nlohmann::ordered_json describe(const WallFile& walls, const ThreadCount& threads, std::size_t processors,
                                const Diagnostics& findings) {
  using Json = nlohmann::ordered_json;
  const auto point = [](const Vec3& p) { return Json::array({p.x(), p.y(), p.z()}); };
  Json all = Json::array();
  for (const WallEntry& e : walls.walls)
    all.push_back({{"name", e.wall.name},
                   {"kind", e.panorama ? panoramaKindName(e.panorama->kind) : e.noun()},
                   {"lower_left_m", point(e.wall.lowerLeft)},
                   {"lower_right_m", point(e.wall.lowerRight)},
                   {"upper_left_m", point(e.wall.upperLeft)},
                   {"pixels", e.pixels.width > 0 ? Json::array({e.pixels.width, e.pixels.height}) : Json()}});
  return {{"ok", true},
          {"file", walls.file},
          {"eye_separation_m", walls.eyeSeparation},
          {"walls", all},
          {"threads",
           {{"app", threads.app},
            {"cull", threads.cull},
            {"draw", threads.draw},
            {"rasteriser", threads.rasteriser}}},
          {"processors", processors},
          {"findings", jsonOf(findings)}};
}

int convert(const WallFile& walls, const std::string& path) {
  Diagnostics findings;
  if (const auto fault = writeHall(walls, path, findings)) findings.add(*fault);
  printFindings(findings);
  return findings.hasErrors() ? kBadInput : kOk;
}

int lookAtWalls(WallsOptions o) {
  Diagnostics findings;
  const bool settled = o.complete(findings);
  const auto walls = settled ? loadHall(o.file, shareFolder() + "/walls", findings) : std::nullopt;
  printFindings(findings);
  if (o.json && !walls) printJson({{"ok", false}, {"findings", jsonOf(findings)}});
  if (!walls) return kBadInput;
  if (!o.write.empty()) return convert(*walls, o.write);
  if (o.simulate) return simulateWalls(*walls, o.simulated);
  if (o.adjust) return adjustWalls(*walls, o.adjusted, catchStopSignals());
  if (o.pattern) return showPattern(*walls, o.shown, catchStopSignals());
  Diagnostics ofMachine;
  const std::size_t processors = std::max<std::size_t>(1, processorsOfThisThread().size());
  const ThreadCount threads = threadsHere(walls->walls.size(), processors, ofMachine);
  printFindings(ofMachine);
  if (o.json) {
    printJson(describe(*walls, threads, processors, findings));
    return kOk;
  }
  std::printf("%s\n%s", floorPlan(*walls).c_str(), textOf(threads, processors, o.file).c_str());
  return kOk;
}

}  // namespace

void addWallsCommand(CLI::App& app, int& code) {
  auto o = std::make_shared<WallsOptions>();
  CLI::App* command =
      app.add_subcommand("walls", "Check a wall file and print its floor plan, or show its test pattern");
  o->addTo(*command);
  command->callback([o, &code] { code = lookAtWalls(*o); });
}

}  // namespace stadion
