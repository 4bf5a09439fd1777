#include "show/player/drawing_plan.h"

#include "engine/base/diagnostic.h"
#include "pipeline/platform/calibration_file.h"

#include <algorithm>
#include <fmt/format.h>
#include <thread>

namespace stadion {
namespace {

/// The best of what was measured; where nothing has all that is wished for, without the wish that changes
/// least.
const MeasuredSetting* nearestTo(DrawWishes wishes, const MeasuredRoom& room) {
  if (const MeasuredSetting* found = best(room, wishes)) return found;
  wishes.pinned.reset();
  if (const MeasuredSetting* found = best(room, wishes)) return found;
  wishes.rasteriserThreads.reset();
  return best(room, wishes);
}

DrawSetting asWished(DrawSetting setting, const DrawWishes& wishes) {
  setting.processes = wishes.processes.value_or(setting.processes);
  setting.rasteriserThreads = wishes.rasteriserThreads.value_or(setting.rasteriserThreads);
  setting.pinned = wishes.pinned.value_or(setting.pinned);
  return setting;
}

/// What was measured of the best, and of the best of the other kind.
std::string figuresOf(const MeasuredSetting& chosen, const MeasuredRoom& room) {
  std::string text = fmt::format("{:.1f} frames/s with {} wall{}", chosen.framesPerSecond, room.walls,
                                 room.walls == 1 ? "" : "s");
  DrawWishes other;
  other.processes = !chosen.setting.processes;
  if (const MeasuredSetting* m = best(room, other))
    text += fmt::format(", by {} {:.1f}", m->setting.processes ? "processes" : "threads", m->framesPerSecond);
  return text;
}

}  // namespace

KnownMachine knownMachine(Diagnostics& findings) {
  KnownMachine known;
  known.processors = std::max(1u, std::thread::hardware_concurrency());
  const std::string file = calibrationFile();
  const auto warn = [&](std::string what) { findings.warning({file, 0, 0}, std::move(what)); };
  const Result<Calibration> calibration = readCalibration(file);
  if (!calibration) {
    Diagnostic why = calibration.error();
    why.severity = Severity::Warning;
    why.message += "; until then nothing is known of this machine";
    findings.add(std::move(why));
    return known;
  }
  const Calibration& all = calibration.value();
  if (all.machines.empty()) return known;
  const Machine here = thisMachine();
  if (const MachineCalibration* measured = all.of(here)) {
    known.measured = *measured;
    return known;
  }
  warn(fmt::format("was measured on another machine ({}), not on this one ({}), and is not used: stadion "
                   "calibrate measures this one",
                   textOf(all.machines.back().machine), textOf(here)));
  return known;
}

DrawingPlan::DrawingPlan(const DrawingNeeds& needs, const KnownMachine& machine)
    : drawsWithGl_(needs.cpuThreads == 0) {
  DrawingNeeds here = needs;
  here.wishes.processes = false;
  here_ = choose(here, machine);
  chosen_ = needs.here.empty() ? choose(needs, machine) : here_;
  if (!needs.here.empty()) drawHere(needs.here);
}

void DrawingPlan::drawHere(const std::string& why) {
  chosen_ = {here_.setting, why + "; " + here_.why};
}

DrawingPlan::Choice DrawingPlan::choose(const DrawingNeeds& needs, const KnownMachine& machine) {
  if (needs.cpuThreads > 0) return chooseForCpu(needs);
  const DrawWishes& wishes = needs.wishes;
  const MeasuredRoom* room =
      machine.measured ? roomFor(*machine.measured, needs.walls, nameOf(needs.look)) : nullptr;
  if (const MeasuredSetting* found = room ? nearestTo(wishes, *room) : nullptr) {
    const DrawSetting setting = asWished(found->setting, wishes);
    std::string why = "calibrated " + machine.measured->when;
    why += setting == found->setting ? ": " + figuresOf(*found, *room) : ", and as asked for";
    return {setting, std::move(why)};
  }
  const char* unknown = machine.measured ? "no room like this one is calibrated" : "not calibrated";
  return {unmeasuredSetting(machine.processors, needs.walls, wishes),
          fmt::format("{}; stadion calibrate measures what is fastest here", unknown)};
}

DrawingPlan::Choice DrawingPlan::chooseForCpu(const DrawingNeeds& needs) {
  const DrawWishes& wishes = needs.wishes;  // LP_NUM_THREADS among them is OpenGL's
  const bool pinned = wishes.pinned.value_or(false);
  if (wishes.processes.value_or(false)) {
    const auto share = static_cast<std::uint32_t>(needs.cpuThreads / std::max<std::size_t>(1, needs.walls));
    return {{true, share <= 1 ? 0 : share, pinned}, "processes were asked for"};
  }
  const char* why = pinned ? "all walls share one pool of threads, so no wall is pinned"
                           : "all walls share one pool of threads";
  return {{false, needs.cpuThreads, false}, why};
}

std::string DrawingPlan::text(std::size_t walls) const {
  const DrawSetting& s = setting();
  if (drawsWithGl_) return textOf(s, walls);
  const std::uint32_t threads = std::max(1u, s.rasteriserThreads);
  return fmt::format(
      "{}{} thread{} of the CPU renderer{}{}",
      s.processes ? fmt::format("{} process{}, each with ", walls, walls == 1 ? "" : "es") : "", threads,
      threads == 1 ? "" : "s", s.processes ? "" : " for all walls", s.pinned ? ", pinned" : "");
}

}  // namespace stadion
