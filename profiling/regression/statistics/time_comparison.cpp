#include "profiling/regression/statistics/time_comparison.h"

#include "profiling/regression/statistics/rank_test.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stadion::regression {
namespace {

const SpanRow* find(const std::vector<SpanRow>& rows, const std::string& key) {
  const auto at = std::ranges::find_if(rows, [&](const SpanRow& r) { return r.key() == key; });
  return at == rows.end() ? nullptr : &*at;
}

/// A row of a build without frames counts by its mean.
bool judged(const SpanRow& r) {
  const bool enough = r.frames.empty() ? r.msMean > 0 : r.frames.size() > 2 * kFirstFrames;
  return r.isStage() && r.stage != "swap" && enough;
}

/// f(before, now) of each frame that both have, but the first ones.
template <class F>
std::vector<double> overFrames(const SpanRow& before, const SpanRow& now, const F& f) {
  std::vector<double> values;
  for (const auto& [frame, us] : now.frames) {
    const auto at = before.frames.find(frame);
    if (frame >= kFirstFrames && at != before.frames.end() && at->second > 0 && us > 0)
      values.push_back(f(at->second, us));
  }
  return values;
}

double ratio(const SpanRow& before, const SpanRow& now) {
  if (before.frames.empty() || now.frames.empty()) return std::log(now.msMean / before.msMean);
  return median(overFrames(before, now, [](double a, double b) { return std::log(b / a); }));
}

/// Returns a row's growth in the typical frame, times the share of frames in which it has costs [us].
double growth(const SpanRow& before, const SpanRow& now, std::size_t frames) {
  const std::vector<double> more = overFrames(before, now, [](double a, double b) { return b - a; });
  return median(more) * static_cast<double>(more.size()) /
         static_cast<double>(std::max<std::size_t>(1, frames));
}

std::string belowPrefix(const SpanRow& stage) {
  return stage.stage + "|" + stage.wall + "|";
}

std::string culpritOf(const SpanRow& stage, const std::vector<Round>& rounds) {
  const std::string prefix = belowPrefix(stage);
  const std::size_t frames = stage.frames.size();
  std::vector<double> whole;
  for (const Round& r : rounds)
    whole.push_back(growth(*find(r.before, stage.key()), *find(r.now, stage.key()), frames));
  std::vector<std::pair<SpanRow, double>> grown;
  for (const SpanRow& row : rounds.front().now) {
    if (row.isStage() || row.frames.empty() || !row.key().starts_with(prefix)) continue;
    std::vector<double> more;
    for (const Round& r : rounds)
      if (const SpanRow* before = find(r.before, row.key()), *now = find(r.now, row.key()); before && now)
        more.push_back(growth(*before, *now, frames));
    grown.emplace_back(row, typicalShift(more));
  }
  return culpritIn(stage.name(), grown, typicalShift(whole));
}

}  // namespace

std::string culpritIn(const std::string& stage, const std::vector<std::pair<SpanRow, double>>& grownRows,
                      double stageGrowth) {
  const auto most = std::ranges::max_element(grownRows, {}, [](const auto& g) { return g.second; });
  if (most == grownRows.end()) return stage;
  if (most->second >= stageGrowth / 2) return most->first.name();
  return stage + fmt::format(", no single node ({:.0f} % of it in {})",
                             100 * std::max(0.0, most->second) / std::max(1e-12, stageGrowth),
                             most->first.name());
}

std::map<std::string, double> typicalStages(const std::vector<SpanRow>& rows) {
  std::map<std::string, double> typical;
  for (const SpanRow& r : rows) {
    if (!judged(r)) continue;
    std::vector<double> us;
    for (const auto& [frame, value] : r.frames)
      if (frame >= kFirstFrames) us.push_back(value);
    typical[r.name()] = us.empty() ? 1000 * r.msMean : median(std::move(us));
  }
  return typical;
}

std::vector<StageShift> compareRounds(const std::vector<Round>& rounds, double tolerance) {
  std::vector<StageShift> shifts;
  std::vector<double> probabilities;
  std::vector<const SpanRow*> stages;
  if (rounds.empty()) return shifts;
  for (const SpanRow& row : rounds.front().now) {
    if (!judged(row)) continue;
    std::vector<double> ratios, before;
    for (const Round& r : rounds) {
      const SpanRow *was = find(r.before, row.key()), *is = find(r.now, row.key());
      if (!was || !is) break;
      ratios.push_back(ratio(*was, *is));
      before.push_back(typicalStages({*was})[row.name()]);
    }
    if (ratios.size() != rounds.size()) continue;
    shifts.push_back({row.key(), row.name(), median(before), std::expm1(typicalShift(ratios)), 1});
    probabilities.push_back(shifts.back().beforeUs < kShortest ? 1 : signedRankTest(ratios));
    stages.push_back(&row);
  }
  const std::vector<double> corrected = correctedForMany(probabilities);
  const double stageCount = static_cast<double>(shifts.size());
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    StageShift& s = shifts[i];
    s.probability = corrected[i];
    if (s.beforeUs >= kShortest && leastSignedRank(rounds.size()) * stageCount > kAlarm)
      s.unfit = fmt::format("{} rounds are too few to tell anything of {} stages; --rounds takes more",
                            rounds.size(), shifts.size());
    const bool certain = s.probability <= kAlarm;
    s.slower = certain && s.shift > tolerance;
    s.faster = certain && s.shift < -tolerance;
    if (s.slower) s.culprit = culpritOf(*stages[i], rounds);
  }
  return shifts;
}

std::vector<StageShift> compareTimes(const StageTimesByName& baseline, const StageTimesByName& now,
                                     const std::map<std::string, double>& us, double tolerance) {
  std::vector<StageShift> shifts;
  std::vector<double> probabilities;
  for (const auto& [name, times] : now) {
    const auto before = baseline.find(name);
    if (before == baseline.end()) continue;
    const double typical = us.contains(name) ? us.at(name) : 0, was = median(before->second);
    StageShift& s = shifts.emplace_back(StageShift{name, name, typical});
    if (was > 0)
      s.shift = median(times) / was - 1;
    else
      s.unfit =
          fmt::format("the baseline's times of it cannot be compared with: {}; --update measures new ones",
                      before->second.empty() ? "there are none" : fmt::format("the middle one is {:g}", was));
    probabilities.push_back(typical < kShortest || was <= 0 ? 1 : rankSumTest(before->second, times));
  }
  const std::vector<double> corrected = correctedForMany(probabilities);
  const double stageCount = static_cast<double>(shifts.size());
  for (std::size_t i = 0; i < shifts.size(); ++i) {
    StageShift& s = shifts[i];
    const std::size_t before = baseline.at(s.name).size(), rounds = now.at(s.name).size();
    if (s.unfit.empty() && s.beforeUs >= kShortest && leastRankSum(before, rounds) * stageCount > kAlarm)
      s.unfit = fmt::format("{} and {} rounds are too few to tell anything of {} stages; --update takes more",
                            before, rounds, shifts.size());
    s.probability = corrected[i];
    s.slower = corrected[i] <= kAlarm && s.shift > tolerance;
    s.faster = corrected[i] <= kAlarm && s.shift < -tolerance;
    if (s.slower) s.culprit = s.name;
  }
  return shifts;
}

CostsByNode nodeTimes(const std::vector<Round>& rounds, const std::vector<double>& calibrationMs) {
  std::map<std::string, std::size_t> frames;
  std::map<std::string, std::map<std::string, std::vector<double>>> all;
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    for (const SpanRow& r : rounds[i].now)
      if (r.isStage()) frames[r.stageName()] = r.frames.size();
    for (const SpanRow& r : rounds[i].now) {
      if (r.isStage() || r.frames.empty()) continue;
      std::vector<double> us;
      for (const auto& [frame, value] : r.frames)
        if (frame >= kFirstFrames) us.push_back(value);
      const double share = static_cast<double>(r.frames.size()) /
                           static_cast<double>(std::max<std::size_t>(1, frames[r.stageName()]));
      all[r.stageName()][r.node()].push_back(1e-3 * median(us) * share / calibrationMs[i]);
    }
  }
  CostsByNode costs;
  for (const auto& [stage, nodes] : all)
    for (const auto& [node, each] : nodes) costs[stage][node] = median(each);
  return costs;
}

std::vector<Check> unmatchedStages(const std::map<std::string, double>& before,
                                   const std::map<std::string, double>& now, const std::string& metric,
                                   const std::string& with) {
  std::vector<Check> checks;
  const auto tell = [&](const std::string& name, const std::string& said) {
    checks.push_back({metric + " of " + name, Outcome::Failed, said, name});
  };
  for (const auto& [name, us] : now)
    if (!before.contains(name)) tell(name, fmt::format("{} has no such stage", with));
  for (const auto& [name, us] : before)
    if (!now.contains(name)) tell(name, fmt::format("{} has it, this build does not", with));
  return checks;
}

bool isAlarm(const Check& check) {
  return check.outcome == Outcome::Failed && !check.figures.empty();
}

void confirm(std::vector<Check>& checks, const std::vector<Check>& again, std::size_t rounds) {
  for (Check& c : checks) {
    if (!isAlarm(c)) continue;
    const auto same = std::ranges::find(again, c.metric, &Check::metric);
    if (same != again.end() && isAlarm(*same)) {
      c.said += fmt::format("; again in {} more rounds", rounds);
      continue;
    }
    c.outcome = Outcome::Passed;
    c.culprit.clear();
    c.figures.clear();
    c.said += fmt::format("; not in {} more rounds: by chance", rounds);
  }
}

std::vector<Check> checksOf(const std::vector<StageShift>& shifts, const std::string& with, double tolerance,
                            std::size_t rounds) {
  std::vector<Check> checks;
  for (const StageShift& s : shifts) {
    Check c{"times of " + s.name, s.slower ? Outcome::Failed : Outcome::Passed, {}, s.culprit};
    if (s.slower) c.figures = {s.name + " [ms]"};
    if (!s.unfit.empty()) {
      c.outcome = Outcome::Failed;
      c.said = s.unfit;
    } else if (s.beforeUs < kShortest) {
      c.outcome = Outcome::Skipped;
      c.said =
          fmt::format("{:.1f} us a frame is too short to be timed; instructions can be counted", s.beforeUs);
    } else {
      c.said =
          fmt::format("{:+.1f} % against {} ({:.1f} us a frame), p = {:.2g} in {} rounds, tolerance {:g} %{}",
                      100 * s.shift, with, s.beforeUs, s.probability, rounds, 100 * tolerance,
                      s.faster ? ": faster" : "");
    }
    checks.push_back(std::move(c));
  }
  return checks;
}

}  // namespace stadion::regression
