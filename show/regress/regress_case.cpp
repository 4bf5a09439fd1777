#include "show/regress/regress_case.h"

#include "profiling/regression/spans/instruction_counter.h"
#include "profiling/regression/statistics/hitch_comparison.h"
#include "profiling/regression/statistics/instruction_comparison.h"
#include "profiling/regression/statistics/rank_test.h"
#include "profiling/report/show_figures.h"
#include "show/base/processor_name.h"
#include "show/regress/regress_child.h"
#include "show/regress/regress_hint.h"
#include "show/regress/regress_rounds.h"
#include "show/regress/state_location.h"

#include <fmt/format.h>

#include <algorithm>
#include <sys/resource.h>

namespace stadion {
namespace {

using namespace regression;

constexpr const char* kCountWork = "--count-work";

struct CaseRun {
  std::optional<RunFacts> facts{};
  std::string fault{};
  bool refused = false;  ///< for a mistake of the user's
  std::vector<std::string> warnings{};
};

/// Processor time of programs that were played and have ended [s].
double childrensSeconds() {
  rusage used{};
  getrusage(RUSAGE_CHILDREN, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

class CasePlay {
public:
  CasePlay(const SuiteCase& c, const RegressSettings& o, const RegressReference& with, Baseline* update,
           const std::atomic<bool>& stop, const RegressProgress& progress)
      : case_(c), o_(o), with_(with), update_(update), stop_(stop), progress_(progress) {}

  CaseResult play(const std::string& mode, const CaseRun* first, const std::string& firstMode) {
    const auto start = std::chrono::steady_clock::now();
    const double processor = childrensSeconds();
    result_ = {};
    result_.name = playedName(case_, mode);
    progress_(result_.name);
    last_ = run(o_.program, mode);
    result_.fault = last_.fault;
    result_.refused = last_.refused;
    if (last_.facts) {
      result_.facts = allOf(*last_.facts);
      result_.warnings = last_.warnings;
      compareExactly(mode);
      if (first && first->facts) compareModes(*first->facts, firstMode, mode);
      if (update_) takeUpFacts(mode);
      if (case_.metrics.times && result_.fault.empty()) takeTimes(mode);
      // The mode does not change what is done.
      if (case_.metrics.instructions && !first && result_.fault.empty()) takeInstructions();
    }
    result_.processorSeconds = childrensSeconds() - processor;
    result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::move(result_);
  }
  const CaseRun& last() const { return last_; }

private:
  CaseRun run(const std::string& program, const std::string& mode) {
    std::vector<std::string> words = playWords(program, case_, mode);
    words.emplace_back(kCountWork);
    ChildResult child = runChild(words, o_.limit, stop_);
    if (child.status == 2 && child.err.find(kCountWork) != std::string::npos) {  // an older build
      words.pop_back();
      child = runChild(words, o_.limit, stop_);
    }
    if (!child.fault.empty()) return {{}, program + ": " + child.fault, child.status == 2};
    auto facts = factsOf(child.out);
    if (!facts) return {{}, program + ": it did not print a summary as JSON"};
    if (drawnByCpuRenderer(facts->renderer))
      facts->renderer = "CPU renderer";  // its pixels are the same on all processors
    else
      facts->renderer += " on " + processorName();
    return {std::move(facts), {}, false, warningsIn(child.err)};
  }

  void takeUpFacts(const std::string& mode) {
    takeUp(*last_.facts, o_.asked, case_, result_.name, *update_);
    BaselineCase& kept = (*update_)[result_.name];
    if (!kept.states.empty() && !o_.asked.state) return;
    const auto history = stateHistory(case_, {o_.program, mode}, o_.limit, stop_);
    kept.states = keptStates(history);
    kept.fields = keptFields(case_, {o_.program, mode}, history.size(), o_.limit, stop_);
  }

  void add(std::vector<Check> checks) {
    for (Check& c : checks) result_.checks.push_back(std::move(c));
  }

  void compareExactly(const std::string& mode) {
    if (!with_.program.empty()) return compareBuilds(mode);
    if (update_) return;
    const auto at = with_.baseline ? with_.baseline->find(result_.name) : Baseline::const_iterator();
    if (with_.baseline && at != with_.baseline->end())
      add(located(compareFacts(*last_.facts, {&at->second.facts, "the baseline"}, case_.metrics),
                  [&] { return sinceBaseline(at->second, mode); }));
    else if (with_.baseline)
      result_.checks.push_back({"baseline", Outcome::Failed, notInTheBaseline(mode)});
    else
      add(compareFacts(*last_.facts, {nullptr, "a suite without a baseline"}, case_.metrics));
  }

  std::string notInTheBaseline(const std::string& mode) const {
    SuiteCase other = case_;
    other.look = case_.look == "full" ? "plain" : "full";
    if (const std::string name = playedName(other, mode); with_.baseline->contains(name))
      return fmt::format(
          "{} knows the case in the look {} alone ({}), which cannot be compared; --update adds {}",
          with_.baselineFile, other.look, name, result_.name);
    return fmt::format("{} knows no case {}; --update adds it", with_.baselineFile, result_.name);
  }

  void compareBuilds(const std::string& mode) {
    const CaseRun other = run(with_.program, mode);
    if (!other.facts) {
      result_.fault = other.fault;
      result_.refused = other.refused;
      return;
    }
    // Figures that an older build lacks cannot be compared.
    RunFacts known = *last_.facts;
    const auto keep = [](NamedFacts& mine, const NamedFacts& theirs) {
      std::erase_if(mine, [&](const auto& fact) { return !theirs.contains(fact.first); });
    };
    keep(known.state, other.facts->state);
    keep(known.counts, other.facts->counts);
    add(located(compareFacts(known, {&*other.facts, "the other build"}, case_.metrics), [&] {
      return stateLocation(case_, {o_.program, mode}, {with_.program, mode}, o_.limit, stop_);
    }));
  }

  /// Says where states begin to differ, if they do.
  template <class Where>
  std::vector<Check> located(std::vector<Check> checks, const Where& where) const {
    for (Check& c : checks) {
      if (c.metric != "state" || c.outcome != Outcome::Failed) continue;
      progress_(result_.name + ": where the state differs");
      if (const std::string place = where(); !place.empty()) c.said += "; " + place;
    }
    return checks;
  }

  /// A baseline keeps hashes of frames, and the fields of nodes after a few of them.
  std::string sinceBaseline(const BaselineCase& kept, const std::string& mode) const {
    if (kept.states.empty()) return "--update keeps the states of frames, which would say in which it begins";
    return stateLocation(case_, {o_.program, mode}, KeptStates{kept.states, kept.fields}, o_.limit, stop_);
  }

  /// Whatever the mode, the state and the pictures are the same.
  void compareModes(const RunFacts& first, const std::string& firstMode, const std::string& mode) {
    Metrics metrics = case_.metrics;
    metrics.counts = false;
    const auto where = [&] {
      return stateLocation(case_, {o_.program, mode}, {o_.program, firstMode}, o_.limit, stop_);
    };
    for (Check& c : located(compareFacts(*last_.facts, {&first, firstMode}, metrics), where)) {
      c.metric += " as " + firstMode;
      c.amongModes = true;
      result_.checks.push_back(std::move(c));
    }
  }

  MeasuringOptions measuring() const { return {case_.rounds, o_.limit, stop_}; }

  /// Of this case in the baseline; null if there is none.
  const BaselineCase* known() const {
    if (!with_.baseline || !with_.program.empty() || update_) return nullptr;
    const auto at = with_.baseline->find(result_.name);
    return at == with_.baseline->end() ? nullptr : &at->second;
  }

  bool failed(const std::string& fault, bool refused = false) {
    result_.fault = fault;
    result_.refused = refused;
    return !fault.empty();
  }

  void nothingFor(const std::string& metric) {
    result_.checks.push_back(
        {metric, Outcome::Skipped,
         fmt::format("there are no {} to compare with: --against BUILD, or --update", metric)});
  }

  static std::map<std::string, double> typicalOf(const StageTimesByName& times) {
    std::map<std::string, double> typical;
    for (const auto& [stage, all] : times) typical[stage] = median(all);
    return typical;
  }

  void takeTimes(const std::string& mode) {
    const bool needed = !with_.program.empty() || update_ || (known() && !known()->times.empty());
    if (!needed) return nothingFor("times");
    progress_(fmt::format("{}: times, {} rounds", result_.name, case_.rounds));
    if (!with_.program.empty()) return compareTimesWithBuild(mode);
    const MeasuredRounds m = measureRounds(case_, mode, {o_.program}, measuring());
    if (failed(m.fault)) return;
    keepMilliseconds(m);
    if (update_)
      keepTimes(m);
    else
      compareTimesWithBaseline(m, mode);
  }

  void compareTimesWithBuild(const std::string& mode) {
    const auto measure = [&] {
      return measureRounds(case_, mode, {with_.program}, {o_.program}, measuring());
    };
    const MeasuredRounds m = measure();
    if (failed(m.fault)) return;
    keepMilliseconds(m);
    std::vector<Check> checks = compareTimesOfBuilds(m.rounds);
    const bool done = confirmed(checks, measure, [&](const MeasuredRounds& again) {
      return compareTimesOfBuilds(again.rounds, kAlarm);
    });
    if (!done) return;
    add(std::move(checks));
    const Round& first = m.rounds.front();
    add(unmatchedStages(typicalStages(first.before), typicalStages(first.now), "times", "the other build"));
  }

  /// If a check gives an alarm, measures again and confirms the checks by the second measurement. Returns
  /// false if that failed.
  template <class Measure, class Compare>
  bool confirmed(std::vector<Check>& checks, const Measure& measureAgain, const Compare& compare) {
    if (std::ranges::none_of(checks, isAlarm)) return true;
    progress_(fmt::format("{}: times, {} more rounds to confirm", result_.name, case_.rounds));
    const MeasuredRounds again = measureAgain();
    if (failed(again.fault)) return false;
    confirm(checks, compare(again), case_.rounds);
    return true;
  }

  /// Returns the times that keepMilliseconds() has noted, in multiples of the calibration kernel's.
  StageTimesByName calibratedTimes(const MeasuredRounds& m) const {
    StageTimesByName times;
    for (const auto& [stage, ms] : result_.milliseconds)
      for (std::size_t i = 0; i < ms.size(); ++i) times[stage].push_back(ms[i] / m.calibrationMs[i]);
    return times;
  }

  /// Puts the times into the baseline.
  void keepTimes(const MeasuredRounds& m) {
    const StageTimesByName times = calibratedTimes(m);
    BaselineCase& kept = (*update_)[result_.name];
    kept.times = times;
    kept.frames = keep(seriesOfNow(m.rounds, frameBudgetUs()), m.calibrationMs);
    kept.nodeTimes = noticeableNodes(nodeTimes(m.rounds, m.calibrationMs), typicalOf(times));
  }

  void compareTimesWithBaseline(const MeasuredRounds& m, const std::string& mode) {
    const double tolerance = case_.tolerances.times / 100;
    const StageTimesByName times = calibratedTimes(m);
    const CostsByNode nodes = nodeTimes(m.rounds, m.calibrationMs);
    const std::vector<SpanRow>& rows = m.rounds.front().now;
    auto shifts = compareTimes(known()->times, times, typicalStages(rows), tolerance);
    for (StageShift& s : shifts) {
      if (!s.slower) continue;
      const double before = median(known()->times.at(s.name));
      s.culprit = culpritSince(s.name, before, s.shift * before, known()->nodeTimes, nodes, rows);
    }
    add(checksOf(shifts, "the baseline", tolerance, case_.rounds));
    compareFramesWithBaseline(m, mode);
    add(unmatchedStages(typicalOf(known()->times), typicalOf(times), "times", "the baseline"));
  }

  /// Typical frames, then all others.
  std::vector<Check> compareTimesOfBuilds(const std::vector<Round>& rounds, double alarm = kHitchAlarm) {
    const double tolerance = case_.tolerances.times / 100;
    std::vector<StageShift> shifts = compareRounds(rounds, tolerance);
    askWhichNode(shifts);
    std::vector<Check> checks = checksOf(shifts, "the other build", tolerance, case_.rounds);
    const auto found = compareFrames(seriesOf(rounds, frameBudgetUs()), {rounds.size(), rounds.size(), true},
                                     {tolerance, alarm});
    for (Check& c : checksOf(found, culpritsOf(found, rounds), "the other build", rounds.size()))
      checks.push_back(std::move(c));
    return checks;
  }

  void compareFramesWithBaseline(const MeasuredRounds& m, const std::string& mode) {
    const KeptStages& kept = known()->frames;
    const std::size_t before = roundsIn(kept);
    if (before == 0 || before + m.rounds.size() > kMostRuns) {
      result_.checks.push_back(
          {"frames", Outcome::Skipped, "the baseline keeps no frames to compare with; --update takes them"});
      return;
    }
    std::vector<Check> checks = framesSince(kept, m);
    const bool done = confirmed(
        checks, [&] { return measureRounds(case_, mode, {o_.program}, measuring()); },
        [&](const MeasuredRounds& again) { return framesSince(kept, again, kAlarm); });
    if (done) add(std::move(checks));
  }

  std::vector<Check> framesSince(const KeptStages& kept, const MeasuredRounds& m,
                                 double alarm = kHitchAlarm) {
    const auto found =
        compareFrames(joined(kept, seriesOfNow(m.rounds, frameBudgetUs()), m.calibrationMs),
                      {roundsIn(kept), m.rounds.size(), false}, {case_.tolerances.times / 100, alarm});
    return checksOf(found, culpritsOf(found, m.rounds), "the baseline", m.rounds.size());
  }

  static std::vector<std::string> culpritsOf(const std::vector<StageFrames>& found,
                                             const std::vector<Round>& rounds) {
    std::vector<std::string> culprits;
    for (const StageFrames& f : found) culprits.push_back(f.worse() ? culpritOf(f, rounds) : "");
    return culprits;
  }

  /// A frame that takes longer is late.
  double frameBudgetUs() const {
    const double rate = case_.rate > 0 ? case_.rate : last_.facts ? last_.facts->rate : 0;
    return rate > 0 ? 1e6 / rate : 0;
  }

  /// App's nodes are known from the rounds; those of Cull and Draw are asked for.
  void askWhichNode(std::vector<StageShift>& shifts) {
    std::optional<ProfileOfBoth> both;
    for (StageShift& s : shifts) {
      if (!s.slower || s.stage.starts_with("app")) continue;
      if (!both) both.emplace(case_, with_.program, o_.program, o_.limit, stop_);
      const std::size_t bar = s.stage.find('|'), next = s.stage.find('|', bar + 1);
      const std::string node =
          both->grewMost(s.stage.substr(0, bar), s.stage.substr(bar + 1, next - bar - 1));
      if (!node.empty()) s.culprit += ", most of it in " + node + " by `stadion profile`";
    }
  }

  void keepMilliseconds(const MeasuredRounds& m) {
    result_.frameFigures = typicalFigures(seriesOfNow(m.rounds, frameBudgetUs()));
    for (const Round& r : m.rounds) {
      for (const auto& [stage, us] : typicalStages(r.now)) result_.milliseconds[stage].push_back(us / 1000);
      for (const SpanRow& row : r.now)
        if (row.elapsedUs > 0) result_.elapsedMs[row.name()].push_back(row.elapsedUs / 1000);
    }
  }

  /// What counts instructions: what counted those of the baseline; else hardware if there is any, and
  /// callgrind on request. Null if nothing does; then the checks say why.
  std::optional<CountedBy> counterOf() {
    const std::string why = whyNotByHardware();
    const bool kept = known() && !known()->instructions.empty();
    const bool byHardware = kept ? known()->countedBy == nameOf(CountedBy::Hardware) : why.empty();
    if (byHardware && why.empty()) return CountedBy::Hardware;
    if (!byHardware && o_.instructions) return CountedBy::Callgrind;
    result_.checks.push_back(
        {"instructions", Outcome::Skipped,
         byHardware ? "the baseline's were counted by hardware counters: " + why
         : why.empty()
             ? "the baseline's were counted by callgrind: --instructions does so again (half a minute a case)"
             : fmt::format("counted on request: --instructions (callgrind, half a minute a case); {}", why)});
    return std::nullopt;
  }

  void takeInstructions() {
    const bool needed = !with_.program.empty() || update_ || (known() && !known()->instructions.empty());
    const auto by = counterOf();
    if (!by) return;
    if (!needed) return nothingFor("instructions");
    progress_(fmt::format("{}: instructions, by {}", result_.name, nameOf(*by)));
    const CountedInstructions now = countInstructions(case_, {o_.program}, true, measuring(), *by);
    if (failed(now.fault, now.refused)) return;
    result_.instructions = stageInstructions(now.rows);
    const std::string how = fmt::format(", by {}", nameOf(*by));
    if (update_) {
      BaselineCase& kept = (*update_)[result_.name];
      kept.instructions = result_.instructions;
      kept.countedBy = nameOf(*by);
      kept.nodeInstructions = noticeableNodes(nodeInstructions(now.rows), result_.instructions);
    } else if (with_.program.empty()) {
      compareCounts({known()->instructions, known()->nodeInstructions}, now, "the baseline", how);
    } else {
      const CountedInstructions before = countInstructions(case_, {with_.program}, true, measuring(), *by);
      if (!failed(before.fault, before.refused))
        compareCounts(instructionCounts(before.rows), now, "the other build", how);
    }
  }

  void compareCounts(const InstructionCounts& before, const CountedInstructions& now, const std::string& with,
                     const std::string& how) {
    const double tolerance = case_.tolerances.instructions / 100;
    add(checksOf(compareInstructions(before, now.rows, tolerance), with + how, tolerance));
    add(unmatchedStages(before.stages, result_.instructions, "instructions", with));
  }

  const SuiteCase& case_;
  const RegressSettings& o_;
  const RegressReference& with_;
  Baseline* update_;
  const std::atomic<bool>& stop_;
  const RegressProgress& progress_;
  CaseResult result_;
  CaseRun last_;
};

}  // namespace

std::vector<CaseResult> playCase(const SuiteCase& c, const RegressSettings& o, const RegressReference& with,
                                 Baseline* update, const std::atomic<bool>& stop,
                                 const RegressProgress& progress) {
  CasePlay play(c, o, with, update, stop, progress);
  std::vector<CaseResult> results;
  CaseRun first;
  for (std::size_t i = 0; i < c.modes.size() && !stop; ++i) {
    results.push_back(play.play(c.modes[i], i > 0 ? &first : nullptr, c.modes.front()));
    if (i == 0) first = play.last();
  }
  return results;
}

}  // namespace stadion
