#include "cli/bench/bench_detection.h"

#include "cli/exit_code.h"
#include "cli/options/command_options.h"
#include "engine/base/installed_files.h"
#include "engine/base/plain_file.h"
#include "engine/core/state_hash.h"
#include "profiling/regression/statistics/detection.h"
#include "profiling/regression/statistics/instruction_comparison.h"
#include "profiling/regression/statistics/rank_test.h"
#include "show/base/stop_signal.h"
#include "show/regress/regress_rounds.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <future>
#include <memory>

namespace stadion {
namespace {

using namespace regression;

struct BenchDetectionOptions {
  std::size_t planted = 20, same = 100;
  double share = 5;  ///< [%]
  std::string by = "instructions", record;
  std::size_t rounds = 12;
  bool json = false;
};

/// Frames of the show that every trial plays.
constexpr std::uint64_t kFrames = 60;
/// So much is planted to learn what an iteration of it costs.
constexpr std::uint64_t kTriedIterations = 20'000;
/// How often a trial is made before it counts as not valid: what a stage costs may have changed.
constexpr int kMostAttempts = 3;

SuiteCase crowd(std::size_t rounds) {
  SuiteCase c;
  c.name = "crowd";
  c.show = shareFolder() + "/scripts/crowd.evs";
  c.walls = shareFolder() + "/scripts/suites/two.walls";
  c.size = "32x24";
  c.stereo = "off";
  c.frames = kFrames;
  c.input = "none";
  c.rounds = rounds;
  return c;
}

/// How much longer what was planted has made the stage, in the typical round [1].
double lengthenedBy(const std::vector<Round>& rounds, const std::string& stage) {
  std::vector<double> all;
  for (const Round& r : rounds)
    for (const SpanRow& row : r.now)
      if (row.isStage() && row.name() == stage) {
        const double us = typicalStages({row})[stage];
        all.push_back(row.plantedUs / (us - row.plantedUs));
      }
  return all.empty() ? 0 : median(all);
}

class DetectionExperiment {
public:
  DetectionExperiment(const BenchDetectionOptions& o, const std::atomic<bool>& stop)
      : o_(o), stop_(stop), case_(crowd(o.rounds)), program_(helperProgram("stadion")) {}

  /// What stages cost when nothing is planted, and what an iteration does. False, with the reason told, if
  /// that cannot be found out.
  bool calibrate() {
    const PlantedDelay tried{PlantedDelay::Where::Cull, "west", {}, 0, kTriedIterations};
    const bool done = o_.by == "times" ? calibrateTimes(tried) : calibrateInstructions(tried);
    if (!done) return false;
    const char* unit = o_.by == "times" ? "us" : "instructions";
    for (const auto& [stage, cost] : prices_.stages)
      std::fprintf(stderr, "%s: %.1f %s a frame\n", stage.c_str(), cost, unit);
    std::fprintf(stderr, "an iteration of what is planted: %.5f %s\n", prices_.iteration, unit);
    return prices_.iteration > 0;
  }

  std::optional<TrialResult> run(const Trial& trial) {
    const auto start = std::chrono::steady_clock::now();
    double share = o_.share / 100;
    TrialResult result;
    for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
      result = {trial.name(), trial.kind, {}, {}, {}, false, 0, o_.by, o_.share, 0, {}};
      const auto planted = plantedIn(trial, plain_, prices_, share);
      if (planted) result.planted = toText(*planted);
      const std::string stage = planted ? stageOf(*planted) : std::string();
      if (!(o_.by == "times" ? byTimes(result, stage) : byInstructions(result, stage))) return std::nullopt;
      result.right = planted ? !result.alarms.empty() && std::ranges::all_of(result.alarms,
                                                                             [&](const std::string& a) {
                                                                               return isNamedBy(*planted, a);
                                                                             })
                             : result.alarms.empty();
      if (result.valid()) break;
      share *= o_.share / std::max(0.1, result.lengthened);
    }
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }

private:
  bool printError(const std::string& what) {
    if (!stop_) std::fprintf(stderr, "stadion: %s\n", what.c_str());
    return false;
  }

  MeasuringOptions measuring(std::size_t rounds) const { return {rounds, std::chrono::seconds(600), stop_}; }

  bool calibrateTimes(const PlantedDelay& tried) {
    const MeasuredRounds m =
        measureRounds(case_, "sequential", {program_}, {program_, toText(tried)}, measuring(3));
    if (!m.fault.empty() || stop_) return printError(m.fault);
    takePrices(m.rounds);
    std::vector<double> us;
    for (const Round& r : m.rounds)
      for (const SpanRow& row : r.now)
        if (row.plantedUs > 0) us.push_back(row.plantedUs);
    prices_.iteration = us.empty() ? 0 : median(us) / static_cast<double>(kTriedIterations);
    return true;
  }

  /// Of the program in which nothing is planted.
  void takePrices(const std::vector<Round>& rounds) {
    std::map<std::string, std::vector<double>> all;
    for (const Round& r : rounds)
      for (const auto& [stage, us] : typicalStages(r.before)) all[stage].push_back(us);
    for (auto& [stage, us] : all) prices_.stages[stage] = median(us);
    plain_ = rounds.front().before;
  }

  bool calibrateInstructions(const PlantedDelay& tried) {
    const auto [plain, planted] = countBoth(toText(tried));
    if (!plain.fault.empty() || !planted.fault.empty() || stop_)
      return printError(plain.fault.empty() ? planted.fault : plain.fault);
    plain_ = plain.rows;
    prices_.stages = stageInstructions(plain.rows);
    const std::string stage = stageOf(tried);
    prices_.iteration = (stageInstructions(planted.rows)[stage] - prices_.stages[stage]) /
                        static_cast<double>(kTriedIterations);
    return true;
  }

  /// Plays both side by side; no result comes from a clock.
  std::pair<CountedInstructions, CountedInstructions> countBoth(const std::string& planted) const {
    auto before = std::async(std::launch::async,
                             [&] { return countInstructions(case_, {program_}, true, measuring(1)); });
    CountedInstructions now = countInstructions(case_, {program_, planted}, true, measuring(1));
    return {before.get(), std::move(now)};
  }

  bool byTimes(TrialResult& result, const std::string& stage) {
    const MeasuredRounds m =
        measureRounds(case_, "sequential", {program_}, {program_, result.planted}, measuring(o_.rounds));
    if (!m.fault.empty() || stop_) return printError(m.fault);
    for (const StageShift& s : compareRounds(m.rounds, case_.tolerances.times / 100)) {
      result.seen.push_back(fmt::format("{} {:+.2f} %, p = {:.2g}", s.name, 100 * s.shift, s.probability));
      if (s.slower) result.alarms.push_back(s.culprit);
    }
    result.lengthened = stage.empty() ? 0 : 100 * lengthenedBy(m.rounds, stage);
    takePrices(m.rounds);  // the machine may have become busier
    return true;
  }

  bool byInstructions(TrialResult& result, const std::string& stage) {
    const auto [before, now] = countBoth(result.planted);
    if (!before.fault.empty() || !now.fault.empty())
      return printError(before.fault.empty() ? now.fault : before.fault);
    for (const InstructionShift& s :
         compareInstructions(instructionCounts(before.rows), now.rows, case_.tolerances.instructions / 100)) {
      result.seen.push_back(fmt::format("{} {:+.3f} % of {:.0f}", s.name, 100 * s.shift(), s.before));
      if (s.more) result.alarms.push_back(s.culprit);
      if (s.name == stage) result.lengthened = 100 * s.shift();
    }
    return true;
  }

  const BenchDetectionOptions& o_;
  const std::atomic<bool>& stop_;
  SuiteCase case_;
  std::string program_;
  std::vector<SpanRow> plain_;
  StagePrices prices_;
};

/// A hash of the program that is tried: a trial of another build says nothing of this one.
std::string thisProgram() {
  const Result<std::string> bytes = readPlainFile(helperProgram("stadion"), std::size_t{1} << 30);
  StateHash hash;
  if (bytes) hash.add(std::string_view(bytes.value()));
  return fmt::format("{:016x}", hash.value());
}

/// Results of trials that were done before, in the same file: of this build and experiment, and valid.
std::vector<TrialResult> doneBefore(const BenchDetectionOptions& o, const std::string& program) {
  const std::string& record = o.record;
  constexpr std::size_t kMostBytes = 16 << 20;
  std::error_code none;
  if (record.empty() || !std::filesystem::exists(record, none)) return {};
  const Result<std::string> text = readPlainFile(record, kMostBytes);
  std::vector<TrialResult> done = text ? readTrials(text.value()) : std::vector<TrialResult>();
  std::erase_if(done, [&](const TrialResult& r) {
    return r.program != program || r.by != o.by || r.share != o.share || !r.valid();
  });
  return done;
}

std::string lineOf(const TrialResult& r) {
  return fmt::format("{:<14} {:<26} {:>7} {:<9} {:>5.1f} s  {}\n", r.trial, r.planted,
                     r.planted.empty() ? "" : fmt::format("{:.2f} %", r.lengthened),
                     !r.valid() ? "not valid"
                     : r.right  ? "right"
                                : "WRONG",
                     r.seconds, fmt::join(r.alarms, "; "));
}

/// Prints a table, or an object for each trial and one for all. Returns whether all limits are met.
bool tellTrials(const std::vector<TrialResult>& results, const BenchDetectionOptions& o) {
  bool met = false;
  const std::string table = detectionTable(results, o.planted, o.same, met);
  std::fputs(table.c_str(), o.json ? stderr : stdout);
  if (!o.json) return met;
  for (const TrialResult& r : results) std::fputs(toJsonLine(r).c_str(), stdout);
  std::printf("%s\n",
              nlohmann::json{{"bench", "detection"}, {"trials", results.size()}, {"ok", met}}.dump().c_str());
  return met;
}

int benchDetection(const BenchDetectionOptions& o) {
  const std::atomic<bool>& stop = catchStopSignals();
  const std::string program = thisProgram();
  std::vector<TrialResult> results = doneBefore(o, program);
  if (!results.empty())
    std::fprintf(stderr, "%zu trials are in %s already\n", results.size(), o.record.c_str());
  DetectionExperiment experiment(o, stop);
  if (!experiment.calibrate()) return stop ? kStopped + stopSignal() : kInternalFault;
  std::ofstream record;
  if (!o.record.empty()) record.open(o.record, std::ios::app);
  for (const Trial& trial : trialsOf(o.planted, o.same)) {
    if (std::ranges::find(results, trial.name(), &TrialResult::trial) != results.end()) continue;
    auto result = experiment.run(trial);
    if (stop) break;
    if (!result) return kInternalFault;
    result->program = program;
    std::fprintf(stderr, "%s", lineOf(*result).c_str());
    record << toJsonLine(*result) << std::flush;
    results.push_back(*result);
  }
  const bool met = tellTrials(results, o);
  if (stop) return kStopped + stopSignal();
  return met ? kOk : kCheckFailed;
}

}  // namespace

void addBenchDetection(CLI::App& bench, int& code) {
  auto o = std::make_shared<BenchDetectionOptions>();
  CLI::App* command = bench.add_subcommand(
      "detection",
      "Are slowdowns found that were planted in a node, in Cull and in Draw, and nothing where nothing is?");
  CommandOptions options(*command);
  options.add("--trials", o->planted);
  options.add("--same", o->same);
  options.add("--share", o->share);
  options.add("--by", o->by);
  options.add("--rounds", o->rounds, {.least = 10, .most = 80});
  options.add("--record", o->record);
  options.add("--json", o->json);
  command->callback([o, &code] { code = benchDetection(*o); });
}

}  // namespace stadion
