/// `stadion tracker`: shows what live trackers say, and finds out where the room is in their coordinates.

#include "cli/commands.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/options/run_options.h"
#include "cli/terminal.h"
#include "engine/base/atomic_file.h"
#include "engine/input/rig_calibration.h"
#include "engine/input/tracker_names.h"
#include "engine/maths/angles.h"
#include "show/base/stop_signal.h"
#include "show/console/tracker_device.h"
#include "show/player/player.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;
using Status = TrackerFeed::Status;

constexpr auto kShowEvery = std::chrono::milliseconds(500);
constexpr auto kMeasureEvery = std::chrono::milliseconds(5);
constexpr auto kHoldStill = std::chrono::seconds(1);
constexpr double kStill = 0.02;  ///< how far a held pose may stray [m]

struct TrackerToolOptions {
  TrackerOptions trackers;
  double seconds = 0, eyeHeight = 0;
  std::string floorTracker = kWandTracker, headTracker = kHeadTracker;
  bool json = false, calibrate = false;
};

std::string listOf(const Vec3& v) {
  return fmt::format("{:7.3f} {:7.3f} {:7.3f}", v.x(), v.y(), v.z());
}

/// Where it points: to the left of ahead, and upwards [degrees].
std::pair<double, double> aim(const Pose& X) {
  const Vec3 d = X.q * Vec3::UnitY();
  return {std::atan2(-d.x(), d.y()) / kDegree, std::asin(std::clamp(d.z(), -1.0, 1.0)) / kDegree};
}

std::string rowOf(const Status& s) {
  const auto [left, up] = aim(s.X_RT);
  std::string row = fmt::format("{:<12} {:>7} {:>6.1f}  {:23}   {:23}  {:6.1f} {:6.1f}  {:#x}", s.name,
                                s.heard     ? "heard"
                                : s.age > 0 ? fmt::format("{:.1f} s", s.age)
                                            : "silent",
                                s.rate, s.posed || !s.heard ? listOf(s.X_SD.p) : "no pose",
                                s.posed || !s.heard ? listOf(s.X_RT.p) : "no pose", left, up, s.buttons);
  for (std::size_t i = 0; i < s.axes.size(); ++i)
    if (s.axes[i] != 0) row += fmt::format("  {}:{:.2f}", i, s.axes[i]);
  return row;
}

void showTable(TrackerDevice& device, bool again) {
  const auto all = device.trackers().status();
  const FeedCounts c = device.trackers().counts();
  if (again) std::printf("\033[%zuA", all.size() + 2);
  std::printf("\033[K%-12s %7s %6s  %-23s   %-23s  %6s %6s  %s\n", "tracker", "", "Hz", "as sent",
              "in the rig [m]", "left", "up", "buttons, axes");
  for (const Status& s : all) std::printf("\033[K%s\n", rowOf(s).c_str());
  std::printf(
      "\033[Ktaken %llu, refused %llu, of unknown trackers %llu, too late %llu, not understood %llu\n",
      static_cast<unsigned long long>(c.taken), static_cast<unsigned long long>(c.refused),
      static_cast<unsigned long long>(c.unknown), static_cast<unsigned long long>(c.late),
      static_cast<unsigned long long>(device.misunderstood()));
  std::fflush(stdout);
}

void showJson(TrackerDevice& device) {
  nlohmann::json out;
  const auto vector = [](const Vec3& v) { return nlohmann::json{v.x(), v.y(), v.z()}; };
  const auto pose = [&](const Pose& X) {
    return nlohmann::json{{"position", vector(X.p)}, {"quaternion", {X.q.w(), X.q.x(), X.q.y(), X.q.z()}}};
  };
  for (const Status& s : device.trackers().status())
    out["trackers"].push_back({{"name", s.name},
                               {"heard", s.heard},
                               {"posed", s.posed},
                               {"age_s", s.age},
                               {"rate_hz", s.rate},
                               {"as_sent", pose(s.X_SD)},
                               {"in_rig", pose(s.X_RT)},
                               {"buttons", s.buttons},
                               {"axes", s.axes}});
  const FeedCounts c = device.trackers().counts();
  out["taken"] = c.taken;
  out["refused"] = c.refused;
  out["unknown"] = c.unknown;
  out["late"] = c.late;
  out["not_understood"] = device.misunderstood();
  std::printf("%s\n", out.dump().c_str());
  std::fflush(stdout);
}

int show(const TrackerToolOptions& o, TrackerDevice& device, const std::atomic<bool>& stop) {
  const auto end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(o.seconds));
  const bool redraw = !o.json && isatty(1) == 1;
  for (bool again = false; !stop; again = true) {
    std::this_thread::sleep_for(o.seconds > 0 ? std::min<Clock::duration>(kShowEvery, end - Clock::now())
                                              : kShowEvery);
    if (o.json)
      showJson(device);
    else
      showTable(device, again && redraw);
    if (o.seconds > 0 && Clock::now() >= end) break;
  }
  return stop ? kStopped + stopSignal() : kOk;
}

/// Asks for a pose to be held and measures it.
Result<Pose> heldPose(TrackerDevice& device, const std::string& tracker, const std::string& ask,
                      const std::atomic<bool>& stop) {
  std::fprintf(stderr, "%s, and press Enter.\n", ask.c_str());
  std::string line;
  if (!std::getline(std::cin, line))
    return Result<Pose>::failure("Enter was not pressed; the input has ended");
  std::vector<Pose> measured;
  for (const auto end = Clock::now() + kHoldStill; Clock::now() < end && !stop;
       std::this_thread::sleep_for(kMeasureEvery))
    for (const Status& s : device.trackers().status())
      if (s.name == tracker && s.heard) measured.push_back(s.X_SD);
  if (measured.empty()) return Result<Pose>::failure("nothing was heard of the tracker \"" + tracker + "\"");
  const HeldPose held = meanOf(measured);
  const double spread = held.spread * device.rig().unit;
  if (spread > kStill)
    return Result<Pose>::failure(fmt::format("\"{}\" moved by {:.0f} mm while it was measured; hold it still",
                                             tracker, 1000 * spread));
  std::fprintf(stderr, "  %s, within %.1f mm\n", listOf(held.X_SD.p).c_str(), 1000 * spread);
  return held.X_SD;
}

Result<RigFile> calibrated(const TrackerToolOptions& o, TrackerDevice& device,
                           const std::atomic<bool>& stop) {
  const auto middle =
      heldPose(device, o.floorTracker,
               "1. Lay the tracker \"" + o.floorTracker + "\" on the middle of the floor", stop);
  if (!middle) return middle.error();
  const auto ahead = heldPose(device, o.floorTracker,
                              "2. Lay it a metre or more straight ahead, towards the front wall", stop);
  if (!ahead) return ahead.error();
  auto rig = calibrateRoom(device.rig(), middle.value(), ahead.value());
  if (!rig || o.eyeHeight == 0) return rig;
  const auto head = heldPose(device, o.headTracker,
                             "3. Stand on the middle with the glasses on, look straight ahead", stop);
  if (!head) return head.error();
  return calibrateEyes(std::move(rig.value()), o.headTracker, head.value(), o.eyeHeight);
}

int calibrate(const TrackerToolOptions& o, TrackerDevice& device, const std::atomic<bool>& stop) {
  auto rig = calibrated(o, device, stop);
  std::optional<Diagnostic> wrong;
  if (!rig) wrong = rig.error();
  if (rig) wrong = writeFile(o.trackers.rig, formatRigFile(rig.value()));
  if (wrong) {
    std::fprintf(stderr, "stadion: %s; %s is as it was\n", wrong->message.c_str(), o.trackers.rig.c_str());
    return stop ? kStopped + stopSignal() : kCheckFailed;
  }
  std::printf("%s", formatRigFile(rig.value()).c_str());
  std::fprintf(stderr, "written to %s\n", o.trackers.rig.c_str());
  return kOk;
}

int trackerTool(TrackerToolOptions o) {
  Diagnostics findings;
  if (o.calibrate && o.trackers.rig.empty()) findings.error({}, "--calibrate needs --rig FILE to write to");
  TrackerOptions open = o.trackers;
  std::error_code none;
  if (o.calibrate && !std::filesystem::exists(open.rig, none)) open.rig.clear();  // a first one
  const auto say = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  const auto device = findings.hasErrors() ? nullptr : TrackerDevice::open(open, say, findings);
  printFindings(findings);
  if (!device) return kBadInput;
  std::fprintf(stderr, "listening to %s\n", device->description().c_str());
  const std::atomic<bool>& stop = catchStopSignals();
  return o.calibrate ? calibrate(o, *device, stop) : show(o, *device, stop);
}

}  // namespace

void addTrackerCommand(CLI::App& app, int& code) {
  auto o = std::make_shared<TrackerToolOptions>();
  CLI::App* command = app.add_subcommand("tracker", "Show what live trackers say, and calibrate them");
  addTrackerOptions(*command, o->trackers);
  BoundOption(*command, *command->get_option("--tracker")).required();
  CommandOptions options(*command);
  options.add("--seconds", o->seconds, {.least = 0.1, .most = 1e6});
  options.add("--json", o->json);
  options.add("--calibrate", o->calibrate);
  options.add("--floor-tracker", o->floorTracker);
  options.add("--head-tracker", o->headTracker);
  options.add("--eye-height", o->eyeHeight);
  command->footer("Ends at Ctrl-C or after --seconds. --json prints twice a second.");
  command->callback([o, &code] { code = trackerTool(*o); });
}

}  // namespace stadion
