#include "pipeline/platform/calibration_file.h"

#include "engine/base/atomic_file.h"
#include "engine/base/plain_file.h"
#include "engine/display/wall_file.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace stadion {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "stadion-calibration";
constexpr int kVersion = 1;
constexpr std::size_t kMostBytes = 1 << 20;
constexpr std::uint32_t kMostWalls = WallFile::kMaxWalls, kMostPixels = 16384, kMostProcessors = 1 << 16;

/// An invalid statement in a file.
struct Wrong {
  std::string what;
};

const Json& member(const Json& object, const char* name) {
  if (!object.is_object() || !object.contains(name)) throw Wrong{std::string("\"") + name + "\" is missing"};
  return object[name];
}

std::string textIn(const Json& object, const char* name) {
  const Json& value = member(object, name);
  if (!value.is_string()) throw Wrong{std::string("\"") + name + "\" must be text"};
  return value.get<std::string>();
}

double numberIn(const Json& object, const char* name) {
  const Json& value = member(object, name);
  if (!value.is_number() || !(value.get<double>() > 0) || !std::isfinite(value.get<double>()))
    throw Wrong{std::string("\"") + name + "\" must be a number greater than 0"};
  return value.get<double>();
}

std::uint32_t countIn(const Json& object, const char* name, std::uint32_t least, std::uint32_t most) {
  const Json& value = member(object, name);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() < least || value.get<std::uint64_t>() > most)
    throw Wrong{std::string("\"") + name + "\" must be a whole number from " + std::to_string(least) +
                " to " + std::to_string(most)};
  return value.get<std::uint32_t>();
}

bool switchIn(const Json& object, const char* name) {
  const Json& value = member(object, name);
  if (!value.is_boolean()) throw Wrong{std::string("\"") + name + "\" must be true or false"};
  return value.get<bool>();
}

std::string wordIn(const Json& object, const char* name, const char* one, const char* other) {
  std::string word = textIn(object, name);
  if (word != one && word != other)
    throw Wrong{std::string("\"") + name + "\" must be \"" + one + "\" or \"" + other + "\""};
  return word;
}

const Json& listIn(const Json& object, const char* name) {
  const Json& value = member(object, name);
  if (!value.is_array()) throw Wrong{std::string("\"") + name + "\" must be a list"};
  return value;
}

MeasuredSetting settingOf(const Json& json) {
  MeasuredSetting m;
  m.setting.processes = wordIn(json, "wall_workers", "process", "thread") == "process";
  m.setting.rasteriserThreads = countIn(json, "rasteriser_threads", 0, kMostRasteriserThreads);
  m.setting.pinned = switchIn(json, "pinned");
  m.framesPerSecond = numberIn(json, "frames_per_second");
  m.cpuMs = numberIn(json, "cpu_ms_per_frame");
  m.rounds = countIn(json, "rounds", 1, 1'000'000);
  return m;
}

MeasuredRoom roomOf(const Json& json) {
  MeasuredRoom room;
  room.walls = countIn(json, "walls", 1, kMostWalls);
  room.width = countIn(json, "width", 1, kMostPixels);
  room.height = countIn(json, "height", 1, kMostPixels);
  room.look = wordIn(json, "look", "full", "plain");
  for (const Json& setting : listIn(json, "settings")) room.settings.push_back(settingOf(setting));
  return room;
}

MachineCalibration machineOf(const Json& json) {
  MachineCalibration m;
  m.machine.processor = textIn(json, "processor");
  m.machine.cores = countIn(json, "cores", 0, kMostProcessors);
  m.machine.processors = countIn(json, "hardware_threads", 0, kMostProcessors);
  m.machine.rasteriser = textIn(json, "rasteriser");
  m.machine.rasteriserBuild = textIn(json, "rasteriser_build");
  m.when = textIn(json, "measured");
  for (const Json& room : listIn(json, "rooms")) m.rooms.push_back(roomOf(room));
  return m;
}

Json jsonOf(const MeasuredSetting& m) {
  return Json{{"wall_workers", m.setting.processes ? "process" : "thread"},
              {"rasteriser_threads", m.setting.rasteriserThreads},
              {"pinned", m.setting.pinned},
              {"frames_per_second", std::round(1e3 * m.framesPerSecond) / 1e3},
              {"cpu_ms_per_frame", std::round(1e3 * m.cpuMs) / 1e3},
              {"rounds", m.rounds}};
}

Json jsonOf(const MachineCalibration& m) {
  Json rooms = Json::array();
  for (const MeasuredRoom& room : m.rooms) {
    Json settings = Json::array();
    for (const MeasuredSetting& setting : room.settings) settings.push_back(jsonOf(setting));
    rooms.push_back(Json{{"walls", room.walls},
                         {"width", room.width},
                         {"height", room.height},
                         {"look", room.look},
                         {"settings", std::move(settings)}});
  }
  return Json{{"processor", m.machine.processor},
              {"cores", m.machine.cores},
              {"hardware_threads", m.machine.processors},
              {"rasteriser", m.machine.rasteriser},
              {"rasteriser_build", m.machine.rasteriserBuild},
              {"measured", m.when},
              {"rooms", std::move(rooms)}};
}

/// Returns the byte's line and column, counted from 1.
SourcePosition placeOf(const std::string& text, std::size_t byte, const std::string& file) {
  SourcePosition place{file, 1, 1};
  for (std::size_t i = 0; i + 1 < byte && i < text.size(); ++i) {
    ++place.column;
    if (text[i] == '\n') {
      ++place.line;
      place.column = 1;
    }
  }
  return place;
}

Diagnostic damaged(SourcePosition where, const std::string& what) {
  return {
      Severity::Error, std::move(where), what + "; remove the file, stadion calibrate writes a new one", {}};
}

}  // namespace

std::string calibrationFile() {
  if (const char* file = std::getenv("STADION_CALIBRATION"); file && *file)
    return std::string(file) == "none" ? "" : file;
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config && *config == '/') return std::string(config) + "/stadion/calibration.json";
  const char* home = std::getenv("HOME");
  return home && *home == '/' ? std::string(home) + "/.config/stadion/calibration.json" : "";
}

Result<Calibration> calibrationOf(const std::string& text, const std::string& file) {
  try {
    const Json json = Json::parse(text);
    const auto version = json.is_object() ? json.find(kFormat) : json.end();
    if (version == json.end()) return damaged({file, 0, 0}, "is no calibration of Stadion's");
    if (*version != kVersion)
      return damaged({file, 0, 0}, "was written by another version of Stadion (format " + version->dump() +
                                       ", this one knows " + std::to_string(kVersion) + ")");
    Calibration calibration;
    for (const Json& machine : listIn(json, "machines")) calibration.machines.push_back(machineOf(machine));
    return calibration;
  } catch (const Json::parse_error& e) {
    return damaged(placeOf(text, e.byte, file), "is no JSON");
  } catch (const Wrong& wrong) {
    return damaged({file, 0, 0}, wrong.what);
  }
}

std::string toJson(const Calibration& calibration) {
  constexpr int kIndent = 2;
  Json machines = Json::array();
  for (const MachineCalibration& m : calibration.machines) machines.push_back(jsonOf(m));
  const Json json{{kFormat, kVersion}, {"machines", std::move(machines)}};
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<Calibration> readCalibration(const std::string& file) {
  std::error_code unknown;
  if (file.empty() || !std::filesystem::exists(file, unknown)) return Calibration{};
  const Result<std::string> text = readPlainFile(file, kMostBytes);
  if (!text) return text.error();
  return calibrationOf(text.value(), file);
}

std::optional<Diagnostic> writeCalibration(const std::string& file, const Calibration& calibration) {
  std::error_code wrong;
  const auto folder = std::filesystem::path(file).parent_path();
  if (!folder.empty()) std::filesystem::create_directories(folder, wrong);
  if (wrong) {
    Diagnostic why;
    why.where.file = folder.string();
    why.message = "cannot be made: " + wrong.message();
    return why;
  }
  return writeFile(file, toJson(calibration));
}

}  // namespace stadion
