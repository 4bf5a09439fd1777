#include "cli/bench/bench_prediction.h"

#include "bench/walls/wall_room.h"
#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "cli/terminal.h"
#include "engine/base/installed_files.h"
#include "engine/input/input_log.h"
#include "engine/input/tracker_feed.h"
#include "engine/input/tracker_names.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "pipeline/record/run_summary.h"
#include "show/player/player.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <functional>
#include <memory>
#include <random>

namespace stadion {
namespace {

constexpr double kAheads[] = {0, 1e3 / 60, 2e3 / 60, 50, 4e3 / 60, 100};  ///< [ms]
constexpr double kFrameRate = 60;                                         ///< [1/s]
constexpr double kJudgedAhead = 50;                                       ///< [ms]
constexpr double kMostShare = 0.5;  ///< of the error without prediction, of 95 % of the frames

struct BenchPredictionOptions {
  std::vector<std::string> logs{shareFolder() + "/scripts/olympia.input"};
  double trackerRate = 120;  ///< [1/s]
  double noise = 0.3;        ///< of a measurement in each axis [mm], and a tenth of it in degrees
  double seconds = 60;
  bool json = false;
};

/// Where a head truly is.
struct HeadPath {
  std::string name;
  std::function<Pose(Nanoseconds)> at;
};

struct Errors {
  std::vector<double> millimetres, degrees;
};

/// What a tracker measures of it: with noise that is the same in every run.
class NoisyTracker {
public:
  explicit NoisyTracker(double noise) : metres_(1e-3 * noise), radians_(0.1 * noise * kDegree) {}
  Pose of(const Pose& X) {
    const auto draw = [&](double size) {
      return Vec3(size * normal_(bits_), size * normal_(bits_), size * normal_(bits_));
    };
    const Vec3 shift = draw(metres_), turn = draw(radians_);
    return {X.p + shift, (det::expRotation(turn) * X.q).normalized()};
  }

private:
  double metres_, radians_;
  std::mt19937_64 bits_{1};
  std::normal_distribution<double> normal_;
};

/// Frame by frame: how far the head that is drawn now is from where it will be when that is seen.
Errors errorsOf(const HeadPath& path, const BenchPredictionOptions& o, double aheadMs, bool predicted) {
  TrackerFeed feed(standardRig());
  NoisyTracker measuring(o.noise);
  Errors errors;
  const Nanoseconds ahead = fromSeconds(1e-3 * aheadMs), begin = 1'000'000'000;
  std::uint64_t measured = 0;
  for (std::uint64_t n = 0;; ++n) {
    const Nanoseconds now = signatureAt(n, kFrameRate).time;
    if (toSeconds(now) > o.seconds) return errors;
    for (Nanoseconds t; (t = signatureAt(measured, o.trackerRate).time) <= now; ++measured)
      feed.pose(kHeadTracker, begin + t, measuring.of(path.at(t)));
    if (toSeconds(now) < 1) continue;  // it has just been heard of
    const auto told = feed.predictedHead(kHeadTracker, begin + now, predicted ? ahead : 0);
    const Pose truly = path.at(now + ahead);
    errors.millimetres.push_back(1e3 * (told->X_RH.p - truly.p).norm());
    errors.degrees.push_back(det::logRotation(told->X_RH.q * truly.q.conjugate()).norm() / kDegree);
  }
}

std::optional<HeadPath> pathOf(const std::string& file, Diagnostics& findings) {
  auto log = loadInputLog(file, findings);
  if (!log) return {};
  if (!log->find(kHeadTracker)) {
    findings.error({file, 0, 0}, "the log has no head; record one with --record-input");
    return std::nullopt;
  }
  const auto shared = std::make_shared<const InputLog>(std::move(*log));
  return HeadPath{std::filesystem::path(file).filename(), [shared](Nanoseconds t) {
                    InputSample sample;
                    shared->sampleAt(t, sample);
                    return sample.find(kHeadTracker)->X_RT;
                  }};
}

HeadPath walkOfBenchWalls() {
  return {"bench walls", [](Nanoseconds t) {
            const double s = toSeconds(t);
            return Pose{bench::headAt(s), det::expRotation(Vec3(0, 0, bench::headHeadingAt(s)))};
          }};
}

nlohmann::json json(const SampleStatistics& d) {
  return {{"mean", d.mean}, {"p95", d.p95}, {"max", d.max}};
}

/// One line of the table. Returns what prediction leaves of the error: of the way, of the turn.
std::pair<double, double> toldErrors(const HeadPath& path, const BenchPredictionOptions& o, double ahead) {
  const Errors off = errorsOf(path, o, ahead, false), on = errorsOf(path, o, ahead, true);
  const SampleStatistics way = sampleStatisticsOf(off.millimetres),
                         wayThen = sampleStatisticsOf(on.millimetres);
  const SampleStatistics turn = sampleStatisticsOf(off.degrees), turnThen = sampleStatisticsOf(on.degrees);
  if (o.json)
    std::printf("%s\n", nlohmann::json{{"bench", "prediction"},
                                       {"path", path.name},
                                       {"ahead_ms", ahead},
                                       {"without_mm", json(way)},
                                       {"with_mm", json(wayThen)},
                                       {"without_degrees", json(turn)},
                                       {"with_degrees", json(turnThen)}}
                            .dump()
                            .c_str());
  else
    std::printf("%-14s %6.1f  %7.2f %7.2f %7.2f  %7.2f %7.2f %7.2f   %6.3f %6.3f %6.3f  %6.3f %6.3f %6.3f\n",
                path.name.c_str(), ahead, way.mean, way.p95, way.max, wayThen.mean, wayThen.p95, wayThen.max,
                turn.mean, turn.p95, turn.max, turnThen.mean, turnThen.p95, turnThen.max);
  return {wayThen.p95 / way.p95, turnThen.p95 / turn.p95};
}

int benchPrediction(const BenchPredictionOptions& o) {
  Diagnostics findings;
  std::vector<HeadPath> paths{walkOfBenchWalls()};
  for (const std::string& file : o.logs)
    if (auto path = pathOf(file, findings)) paths.push_back(std::move(*path));
  stadion::printFindings(findings);
  if (findings.hasErrors()) return kBadInput;
  if (!o.json)
    std::printf(
        "a head measured %.0f times a second, with a noise of %.2f mm and %.3f degrees in each axis\n"
        "                        without prediction [mm]        with [mm]            without [degrees]     "
        "with [degrees]\n"
        "path            ms       mean     p95     max     mean     p95     max     mean    p95    max    "
        "mean    p95    max\n",
        o.trackerRate, o.noise, 0.1 * o.noise);
  bool ok = true;
  for (const HeadPath& path : paths)
    for (const double ahead : kAheads) {
      const auto [way, turn] = toldErrors(path, o, ahead);
      if (ahead == kJudgedAhead) ok = ok && way <= kMostShare && turn <= kMostShare;
    }
  if (!o.json) std::printf("%s\n", ok ? "ok" : "MISSED");
  return ok ? kOk : kCheckFailed;
}

}  // namespace

void addBenchPrediction(CLI::App& bench, int& code) {
  auto o = std::make_shared<BenchPredictionOptions>();
  CLI::App* command = bench.add_subcommand(
      "prediction",
      "How far off is a head that is drawn now when its picture is seen, with run --predict and "
      "without? At 50 ms it must halve what 95 % of the frames are off by");
  CommandOptions options(*command);
  options.add("LOG", o->logs);
  options.add("--tracker-rate", o->trackerRate);
  options.add("--noise", o->noise);
  options.add("--seconds", o->seconds, {.least = 2, .most = 3600});
  options.add("--json", o->json);
  command->callback([o, &code] { code = benchPrediction(*o); });
}

}  // namespace stadion
