#include "cli/bench_detection.h"

#include "cli/exit_code.h"
#include "cli/number_option.h"
#include "cli/regress_rounds.h"
#include "cli/stop_signal.h"
#include "engine/plain_file.h"
#include "profiling/regression/detection.h"
#include "profiling/regression/instruction_comparison.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

namespace stadion {
namespace {

using namespace regression;

struct Options {
  std::size_t planted = 20, same = 100;
  double share = 5;  ///< [%]
  std::string by = "instructions", record;
  std::size_t rounds = 12;
};

/// Frames of the show that every trial plays.
constexpr std::uint64_t kFrames = 60;

SuiteCase crowd(std::size_t rounds) {
  SuiteCase c;
  c.name = "crowd", c.show = STADION_ROOT "/scripts/crowd.evs",
  c.walls = STADION_ROOT "/scripts/suites/two.walls";
  c.size = "32x24", c.stereo = "off", c.frames = kFrames, c.input = "none", c.rounds = rounds;
  return c;
}

class Experiment {
public:
  Experiment(const Options& o, const std::atomic<bool>& stop)
      : o_(o), stop_(stop), case_(crowd(o.rounds)),
        program_(std::filesystem::canonical("/proc/self/exe").string()) {}

  /// What stages and nodes cost when nothing is planted. False, with the reason told, if that cannot be found
  /// out.
  bool calibrate() {
    const MeasuredRounds m = measureRounds(case_, "sequential", {program_}, measuring(1));
    if (!m.fault.empty()) return complain(m.fault);
    plain_ = m.rounds.front().now;
    nsPerIteration_ = burnNanoseconds();
    for (const auto& [stage, us] : typicalStages(plain_))
      std::fprintf(stderr, "%s: %.1f us a frame\n", stage.c_str(), us);
    return true;
  }

  std::optional<TrialResult> run(const Trial& trial) {
    const auto start = std::chrono::steady_clock::now();
    TrialResult result{trial.name(), trial.kind, {}, {}, {}, false, 0};
    const auto planted = plantedIn(trial, plain_, o_.share / 100, nsPerIteration_);
    if (planted) result.planted = toText(*planted);
    const bool done = o_.by == "times" ? byTimes(result) : byInstructions(result, trial.drawn);
    if (!done) return std::nullopt;
    result.right = planted
                       ? !result.alarms.empty() &&
                             std::ranges::all_of(result.alarms,
                                                 [&](const std::string& a) { return isNamedBy(*planted, a); })
                       : result.alarms.empty();
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }

private:
  bool complain(const std::string& what) {
    if (!stop_) std::fprintf(stderr, "stadion: %s\n", what.c_str());
    return false;
  }

  MeasuringOptions measuring(std::size_t rounds) const { return {rounds, std::chrono::seconds(600), stop_}; }

  bool byTimes(TrialResult& result) {
    const MeasuredRounds m =
        measureRounds(case_, "sequential", {program_}, {program_, result.planted}, measuring(o_.rounds));
    if (!m.fault.empty() || stop_) return complain(m.fault);
    for (const StageShift& s : compareRounds(m.rounds, case_.tolerances.times / 100)) {
      result.seen.push_back(fmt::format("{} {:+.2f} %, p = {:.2g}", s.name, 100 * s.shift, s.probability));
      if (s.slower) result.alarms.push_back(s.culprit);
    }
    return true;
  }

  bool byInstructions(TrialResult& result, bool drawn) {
    const CountedInstructions before = countInstructions(case_, {program_}, drawn, measuring(1));
    if (!before.fault.empty()) return complain(before.fault);
    const CountedInstructions now = countInstructions(case_, {program_, result.planted}, drawn, measuring(1));
    if (!now.fault.empty()) return complain(now.fault);
    for (const InstructionShift& s :
         compareInstructions(before.rows, now.rows, case_.tolerances.instructions / 100)) {
      result.seen.push_back(fmt::format("{} {:+.3f} % of {:.0f}", s.name, 100 * s.shift(), s.before));
      if (s.more) result.alarms.push_back(s.culprit);
    }
    return true;
  }

  const Options& o_;
  const std::atomic<bool>& stop_;
  SuiteCase case_;
  std::string program_;
  std::vector<SpanRow> plain_;
  double nsPerIteration_ = 1;
};

/// Results of trials that were done before, in the same file.
std::vector<TrialResult> doneBefore(const std::string& record) {
  constexpr std::size_t kMostBytes = 16 << 20;
  std::error_code none;
  if (record.empty() || !std::filesystem::exists(record, none)) return {};
  const Result<std::string> text = readPlainFile(record, kMostBytes);
  return text ? readTrials(text.value()) : std::vector<TrialResult>();
}

int benchDetection(const Options& o) {
  const std::atomic<bool>& stop = catchStopSignals();
  std::vector<TrialResult> results = doneBefore(o.record);
  if (!results.empty())
    std::fprintf(stderr, "%zu trials are in %s already\n", results.size(), o.record.c_str());
  Experiment experiment(o, stop);
  if (!experiment.calibrate()) return stop ? kStopped + stopSignal() : kInternalFault;
  std::ofstream record;
  if (!o.record.empty()) record.open(o.record, std::ios::app);
  for (const Trial& trial : trialsOf(o.planted, o.same)) {
    if (std::ranges::find(results, trial.name(), &TrialResult::trial) != results.end()) continue;
    const auto result = experiment.run(trial);
    if (stop) break;
    if (!result) return kInternalFault;
    std::fprintf(stderr, "%-14s %-28s %-5s %5.1f s  %s\n", result->trial.c_str(), result->planted.c_str(),
                 result->right ? "right" : "WRONG", result->seconds,
                 fmt::format("{}", fmt::join(result->alarms, "; ")).c_str());
    record << toJsonLine(*result) << std::flush;
    results.push_back(*result);
  }
  bool met = false;
  std::printf("%s", detectionTable(results, o.planted, o.same, met).c_str());
  if (stop) return kStopped + stopSignal();
  return met ? kOk : kCheckFailed;
}

}  // namespace

void addBenchDetection(CLI::App& bench, int& code) {
  auto o = std::make_shared<Options>();
  CLI::App* command = bench.add_subcommand(
      "detection",
      "Are slowdowns found that were planted in a node, in Cull and in Draw, and nothing where nothing is?");
  command->add_option("--trials", o->planted, "of each kind of slowdown")
      ->check(wholeNumberFrom(0, 1000))
      ->capture_default_str();
  command->add_option("--same", o->same, "comparisons of the program with itself")
      ->check(wholeNumberFrom(0, 10000))
      ->capture_default_str();
  command->add_option("--share", o->share, "by how much a stage is lengthened [%]")
      ->check(numberFrom(0.01, 1000))
      ->capture_default_str();
  command->add_option("--by", o->by, "what decides: instructions (callgrind) or times (rounds in turns)")
      ->check(CLI::IsMember({"instructions", "times"}))
      ->capture_default_str();
  command->add_option("--rounds", o->rounds, "of times")
      ->check(wholeNumberFrom(6, 80))
      ->capture_default_str();
  command->add_option(
      "--record", o->record,
      "keep each trial's result in this file; an experiment that was interrupted goes on from there");
  command->callback([o, &code] { code = benchDetection(*o); });
}

}  // namespace stadion
