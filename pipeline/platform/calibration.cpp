#include "pipeline/platform/calibration.h"

#include <algorithm>
#include <tuple>

namespace stadion {
namespace {

bool has(const DrawSetting& s, const DrawWishes& w) {
  return (!w.processes || *w.processes == s.processes) &&
         (!w.rasteriserThreads || *w.rasteriserThreads == s.rasteriserThreads) &&
         (!w.pinned || *w.pinned == s.pinned);
}

bool isSameRoom(const MeasuredRoom& a, const MeasuredRoom& b) {
  return a.walls == b.walls && a.look == b.look;
}

}  // namespace

const MachineCalibration* Calibration::of(const Machine& machine) const {
  const auto found =
      std::ranges::find_if(machines, [&](const MachineCalibration& m) { return m.machine.isLike(machine); });
  return found == machines.end() ? nullptr : &*found;
}

void Calibration::add(MachineCalibration measured) {
  const auto known = std::ranges::find_if(
      machines, [&](const MachineCalibration& m) { return m.machine.isLike(measured.machine); });
  if (known == machines.end()) {
    machines.push_back(std::move(measured));
    return;
  }
  for (const MeasuredRoom& room : known->rooms)
    if (std::ranges::none_of(measured.rooms, [&](const MeasuredRoom& m) { return isSameRoom(m, room); }))
      measured.rooms.push_back(room);
  *known = std::move(measured);
}

const MeasuredSetting* best(const MeasuredRoom& room, const DrawWishes& wishes) {
  double fastest = 0;
  for (const MeasuredSetting& m : room.settings)
    if (has(m.setting, wishes)) fastest = std::max(fastest, m.framesPerSecond);
  const MeasuredSetting* best = nullptr;
  for (const MeasuredSetting& m : room.settings)
    if (has(m.setting, wishes) && m.framesPerSecond >= (1 - kAlike) * fastest)
      if (!best || m.cpuMs < best->cpuMs) best = &m;
  return best;
}

const MeasuredRoom* roomFor(const MachineCalibration& machine, std::size_t walls, const std::string& look) {
  const MeasuredRoom* nearest = nullptr;
  const auto distance = [&](const MeasuredRoom& r) {
    return std::tuple(r.look != look, r.walls > walls ? r.walls - walls : walls - r.walls);
  };
  for (const MeasuredRoom& room : machine.rooms)
    if ((room.walls == 1) == (walls == 1) && (!nearest || distance(room) < distance(*nearest)))
      nearest = &room;
  return nearest;
}

std::vector<DrawSetting> settingsToTry(std::uint32_t processors, std::size_t walls) {
  const std::uint32_t all = std::clamp(processors, 1u, kMostRasteriserThreads);
  const auto share =
      std::max<std::uint32_t>(1, all / static_cast<std::uint32_t>(std::max<std::size_t>(1, walls)));
  std::vector<DrawSetting> settings;
  for (const DrawSetting& s :
       {DrawSetting{false, all}, DrawSetting{true, 0}, DrawSetting{true, share}, DrawSetting{true, all},
        DrawSetting{false, (all + 1) / 2}, DrawSetting{false, 0}})
    if (std::ranges::find(settings, s) == settings.end()) settings.push_back(s);
  return settings;
}

}  // namespace stadion
