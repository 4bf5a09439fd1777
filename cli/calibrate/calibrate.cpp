/// `stadion calibrate`: measures how walls are drawn fastest on this machine, and remembers it.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/options/command_programs.h"
#include "cli/terminal.h"
#include "pipeline/platform/calibration_file.h"
#include "show/base/stop_signal.h"
#include "show/base/temporary_folder.h"
#include "show/measure/calibrate_measure.h"
#include "show/measure/calibrate_rooms.h"
#include "show/measure/calibration_show.h"
#include "show/measure/plan_run.h"

#include <CLI/CLI.hpp>
#include <fmt/chrono.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

namespace stadion {
namespace {

constexpr double kQuietShare = 0.5;  ///< threads of others for each processor

struct CalibrateOptions {
  std::vector<std::string> walls{"cave4", "powerwall"};
  std::string size = "800x600";
  Look look = Look::Full;
  double seconds = 50;
  bool forget = false, json = false;
  // For the program itself, one setting in a process of its own.
  std::string one, folder;
  double window = 1;
};

int measureOne(const CalibrateOptions& o) {
  const auto setting = settingOf(o.one);
  if (!setting || o.walls.size() != 1) return kBadInput;
  Diagnostics findings;
  const auto figures =
      measureSetting({*setting, o.folder, o.walls.front(), o.size, o.look, o.window}, findings);
  printFindings(findings);
  if (!figures) return printError(figures.error(), kInternalFault);
  std::printf("%s\n", nlohmann::json{{"frames_per_second", figures.value().framesPerSecond},
                                     {"cpu_ms_per_frame", figures.value().cpuMs},
                                     {"rasteriser", figures.value().rasteriser}}
                          .dump()
                          .c_str());
  return kOk;
}

std::string nowText() {
  return fmt::format("{:%Y-%m-%d %H:%M} UTC", fmt::gmtime(std::chrono::system_clock::now()));
}

void warnIfBusy(double load) {
  const double processors = std::max(1u, std::thread::hardware_concurrency());
  if (load > kQuietShare * processors)
    std::fprintf(stderr,
                 "stadion: others are at work on this machine (load %.1f, %g processors): what is fastest "
                 "beside them may not be when it is quiet\n",
                 load, processors);
}

std::string tableOf(const MeasuredRoom& room, const std::string& name) {
  std::string text =
      fmt::format("{}: {} wall{}, {} x {} pixels an eye, {} look\n"
                  "  {:<10} {:>18}  {:<6} {:>9} {:>13} {:>7}\n",
                  name, room.walls, room.walls == 1 ? "" : "s", room.width, room.height, room.look,
                  "drawn by", "rasteriser threads", "pinned", "frames/s", "cpu ms/frame", "rounds");
  const MeasuredSetting* chosen = best(room);
  for (const MeasuredSetting& m : room.settings)
    text += fmt::format("  {:<10} {:>18}  {:<6} {:>9.2f} {:>13.1f} {:>7}{}\n",
                        m.setting.processes ? "processes" : "threads", m.setting.rasteriserThreads,
                        m.setting.pinned ? "yes" : "no", m.framesPerSecond, m.cpuMs, m.rounds,
                        &m == chosen ? "  <- best" : "");
  return text;
}

/// What was known of other machines and rooms stays.
int remember(const std::string& file, Calibration known, MachineCalibration measured,
             const CalibrateOptions& o) {
  const MachineCalibration shown = measured;
  known.add(std::move(measured));
  if (const auto wrong = writeCalibration(file, known)) return printError(*wrong, kBadInput);
  if (o.json) {
    std::printf("%s", toJson({{shown}}).c_str());
    return kOk;
  }
  std::printf("%s\n", textOf(shown.machine).c_str());
  for (std::size_t i = 0; i < shown.rooms.size(); ++i)
    std::printf("\n%s", tableOf(shown.rooms[i], o.walls[i]).c_str());
  std::printf("\nremembered in %s; stadion run and view draw by it from now on with --gl osmesa\n",
              file.c_str());
  return kOk;
}

int forget(const std::string& file) {
  if (std::remove(file.c_str()) == 0)
    std::printf("removed %s\n", file.c_str());
  else
    std::printf("there is nothing to forget: no %s\n", file.c_str());
  return kOk;
}

int calibrate(const CalibrateOptions& o) {
  if (!o.one.empty()) return measureOne(o);
  const std::string file = calibrationFile();
  if (file.empty()) {
    std::fprintf(stderr, "stadion: there is no place to remember it: set STADION_CALIBRATION to a "
                         "file's name, or HOME to your folder\n");
    return kBadInput;
  }
  if (o.forget) return forget(file);
  const Result<Calibration> known = readCalibration(file);
  if (!known) return printError(known.error(), kBadInput);
  Diagnostics findings;
  const std::atomic<bool>& stop = catchStopSignals();
  auto rooms = roomsToMeasure({o.walls, o.size, o.look, o.seconds}, findings);
  printFindings(findings);
  if (findings.hasErrors()) return kBadInput;
  warnIfBusy(loadNow());
  const TemporaryFolder folder;
  if (const std::string wrong = writeCalibrationShow(folder.path("")); !wrong.empty()) {
    std::fprintf(stderr, "stadion: %s\n", wrong.c_str());
    return kBadInput;
  }
  MachineCalibration measured;
  measured.machine = thisMachine();
  for (const RoomToMeasure& room : rooms) {
    const auto found = measureRoom(room, folder.path(""), stop,
                                   [](const std::string& text) { std::fputs(text.c_str(), stderr); });
    if (stop) {
      std::fprintf(stderr, "stadion: stopped; nothing is remembered\n");
      return kStopped + stopSignal();
    }
    if (!found) return printError(found.error(), kCheckFailed);
    measured.rooms.push_back(found.value().room);
    measured.machine.rasteriser = found.value().rasteriser;
  }
  measured.when = nowText();
  return remember(file, known.value(), std::move(measured), o);
}

}  // namespace

void addCalibrateCommand(CLI::App& app, int& code) {
  auto o = std::make_shared<CalibrateOptions>();
  CLI::App* command = addListedCommand(app, "calibrate");
  CommandOptions options(*command);
  options.add("--walls", o->walls);
  options.add("--size", o->size);
  options.add("--look", o->look);
  options.add("--seconds", o->seconds, {.least = 1, .most = 3600});
  options.add("--forget", o->forget);
  options.add("--json", o->json);
  options.add("--measured-setting", o->one);
  options.add("--measured-folder", o->folder);
  options.add("--measured-time", o->window);
  command->footer(
      "--walls may be repeated: a run takes the measured room with the nearest number of walls. --seconds is "
      "the time for\n"
      "all measurements; more make the result surer. Use the --size and --look of your shows.\n\n"
      "Measures OpenGL in software (--gl osmesa) alone. The CPU renderer, which draws where no graphics card "
      "is, needs no\n"
      "calibration: all walls share one pool of threads.\n\n"
      "With software (Mesa's llvmpipe) all contexts of a process share one rasteriser. Which is faster then, "
      "a\n"
      "thread for each wall in one process, with rasteriser threads that help it, or a process for each "
      "wall,\n"
      "depends on the machine. Both are tried here with several numbers of rasteriser threads, the best "
      "ones\n"
      "also pinned: each wall on processors of its own. The pictures are the same in every case.\n\n"
      "What is found is kept in ~/.config/stadion/calibration.json (or $XDG_CONFIG_HOME; "
      "STADION_CALIBRATION\n"
      "names another file, or none), for this processor, number of cores and build of Mesa. stadion run "
      "takes\n"
      "it for --wall-workers auto, --pin auto and the rasteriser's threads, and says so in its summary;\n"
      "LP_NUM_THREADS in the environment overrides it. Best on a machine that has nothing else to do.");
  command->callback([o, &code] { code = calibrate(*o); });
}

}  // namespace stadion
