#include "show/measure/calibrate_rooms.h"

#include "engine/base/installed_files.h"
#include "engine/display/wall_file.h"
#include "engine/hall_formats/hall_import.h"
#include "engine/plain_text/number_text.h"
#include "pipeline/platform/setting_trials.h"
#include "show/regress/regress_child.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <set>
#include <thread>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kLeastLimit = 5;          ///< for one setting [s]
constexpr double kOverhead = 0.8;          ///< of a process that begins to draw [s], about
constexpr double kRoundsWanted = 3;        ///< for which there is to be time
constexpr std::uint32_t kLargest = 16384;  ///< [pixels]

double secondsSince(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

std::uint32_t processorsHere() {
  return std::max(1u, std::thread::hardware_concurrency());
}

struct RoomFigures {
  double framesPerSecond = 0, cpuMs = 0;
  std::string rasteriser;
};

std::optional<RoomFigures> figuresOf(const std::string& text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return {};
  const RoomFigures f{json.value("frames_per_second", 0.0), json.value("cpu_ms_per_frame", 0.0),
                      json.value("rasteriser", "")};
  return f.framesPerSecond > 0 && f.cpuMs > 0 ? std::optional(f) : std::nullopt;
}

std::optional<RoomFigures> measure(const RoomToMeasure& room, const DrawSetting& setting, double window,
                                   const std::string& folder, std::chrono::seconds limit,
                                   const std::atomic<bool>& stop) {
  std::vector<std::string> words{std::filesystem::canonical("/proc/self/exe"),
                                 "calibrate",
                                 "--measured-setting",
                                 wordOf(setting),
                                 "--measured-folder",
                                 folder,
                                 "--walls",
                                 room.walls,
                                 "--size",
                                 room.size,
                                 "--look",
                                 room.room.look,
                                 "--measured-time",
                                 fmt::format("{}", window)};
  // All symbols are bound at the start: else the first frames pay for the linking.
  return figuresOf(runChild(words, limit, stop, {"LD_BIND_NOW=1"}).out);
}

}  // namespace

std::string wordOf(const DrawSetting& s) {
  return fmt::format("{}:{}:{}", s.processes ? "process" : "thread", s.rasteriserThreads,
                     s.pinned ? "pinned" : "free");
}

std::optional<DrawSetting> settingOf(const std::string& word) {
  const std::size_t first = word.find(':'), second = word.find(':', first + 1);
  if (first == std::string::npos || second == std::string::npos) return {};
  DrawSetting s;
  s.processes = word.starts_with("process:");
  s.pinned = word.ends_with(":pinned");
  std::from_chars(word.data() + first + 1, word.data() + second, s.rasteriserThreads);
  return word == wordOf(s) ? std::optional(s) : std::nullopt;
}

std::vector<RoomToMeasure> roomsToMeasure(const RoomRequest& wanted, Diagnostics& findings) {
  const auto sides = parseSize(wanted.size);
  const auto fits = [](std::uint32_t side) { return side >= 1 && side <= kLargest; };
  if (!sides || !fits(sides->first) || !fits(sides->second))
    findings.error({}, "--size: \"" + wanted.size +
                           "\" is not WIDTHxHEIGHT in pixels from 1x1 to 16384x16384, such as 800x600");
  std::vector<RoomToMeasure> rooms;
  std::set<std::size_t> counts;
  double parts = 0;
  for (const std::string& name : wanted.walls) {
    const auto walls = loadHall(name, shareFolder() + "/walls", findings);
    if (!walls || !sides) continue;
    RoomToMeasure room{name, wanted.size};
    room.room.walls = walls->walls.size();
    room.room.look = nameOf(wanted.look);
    room.room.width = sides->first;
    room.room.height = sides->second;
    if (!counts.insert(room.room.walls).second)
      findings.error({}, "--walls: another room has as many walls as " + name +
                             "; what is remembered goes by their number");
    rooms.push_back(std::move(room));
    parts += 1 + static_cast<double>(rooms.back().room.walls);
  }
  for (RoomToMeasure& room : rooms)
    room.seconds = wanted.seconds * (1 + static_cast<double>(room.room.walls)) / parts;
  return rooms;
}

Result<RoomMeasurement> measureRoom(const RoomToMeasure& wanted, const std::string& folder,
                                    const std::atomic<bool>& stop,
                                    const std::function<void(const std::string&)>& progress) {
  const auto settings = settingsToTry(processorsHere(), wanted.room.walls);
  // A single wall's own processors are all there are.
  SettingTrials trials(settings, wanted.room.walls > 1 && processorsHere() > 1);
  const double window = std::clamp(
      wanted.seconds / (kRoundsWanted * static_cast<double>(settings.size())) - kOverhead, 0.3, 5.0);
  RoomMeasurement found{wanted.room, {}};
  const auto limit = std::chrono::seconds(std::lround(std::max(kLeastLimit, wanted.seconds / kRoundsWanted)));
  const Clock::time_point begin = Clock::now();
  double longest = 0;
  while (trials.any() && !stop && (!trials.anyMeasured() || secondsSince(begin) + longest < wanted.seconds)) {
    const DrawSetting setting = trials.next();
    const Clock::time_point start = Clock::now();
    progress(fmt::format("{:3.0f} s  {}, {}: ", secondsSince(begin), wanted.walls,
                         textOf(setting, wanted.room.walls)));
    const auto figures = measure(wanted, setting, window, folder, limit, stop);
    longest = std::max(longest, secondsSince(start));
    if (stop) progress("stopped\n");
    if (stop) break;
    if (!figures) {
      progress(fmt::format("left out: nothing came of it within {} s\n", limit.count()));
      trials.failed();
      continue;
    }
    progress(fmt::format("{:.2f} frames/s\n", figures->framesPerSecond));
    trials.measured(figures->framesPerSecond, figures->cpuMs);
    found.rasteriser = figures->rasteriser;
  }
  if (!trials.allTried() && !stop)
    progress("not everything could be tried in that time; --seconds gives more\n");
  found.room.settings = trials.results();
  if (found.room.settings.empty() && !stop)
    return Result<RoomMeasurement>::failure(wanted.walls +
                                            ": nothing could be measured in that time; --seconds gives more");
  return found;
}

}  // namespace stadion
