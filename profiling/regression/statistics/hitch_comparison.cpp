#include "profiling/regression/statistics/hitch_comparison.h"

#include "profiling/regression/statistics/rank_test.h"
#include "profiling/regression/statistics/usual_times.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

namespace stadion::regression {
namespace {

constexpr std::array<double, 3> kLevels{1000, 4000,
                                        16000};  ///< excess of a long frame over its usual time [us]
constexpr double kLeastShare = 0.1;              ///< and as a share of it
constexpr double kDeviations = 6;                ///< and in usual deviations
constexpr double kLeastTail = 100;               ///< [us]: smaller differences of percentiles do not count

/// The runs in which a frame was long.
struct Mark {
  std::size_t frame = 0, level = 0;
  RunSet runs;
};

std::vector<Mark> longFramesOf(const StageSeries& s, const UsualTimes& usual) {
  std::vector<Mark> marks;
  for (std::size_t n = 0; n < usual.us.size(); ++n)
    for (std::size_t level = 0; level < kLevels.size(); ++level) {
      const double least =
          std::max({kLevels[level], kLeastShare * usual.us[n], kDeviations * usual.deviation});
      Mark mark{n, level, {}};
      for (std::size_t run = 0; run < s.runs.size(); ++run)
        if (usual.excess(s, run, n) > least) mark.runs.set(run);
      if (mark.runs.any()) marks.push_back(mark);
    }
  return marks;
}

double shareOf(const RunSet& runs, std::size_t all) {
  return static_cast<double>(runs.count()) / static_cast<double>(std::max<std::size_t>(1, all));
}

/// Returns how much more often it occurs in the runs called "now" than in the others.
double moreOften(const RunSet& runs, const RunSet& now, const RunDesign& design) {
  return shareOf(runs & now, design.now) - shareOf(runs & ~now, design.before);
}

struct LessRunSet {
  bool operator()(const RunSet& a, const RunSet& b) const { return a.to_string() < b.to_string(); }
};

/// A stage by one clock, prepared for both questions.
struct PreparedSeries {
  const StageSeries& series;
  UsualTimes usual;
  std::vector<Mark> marks;
};

using RunPatterns = std::set<RunSet, LessRunSet>;

/// Returns the different sets of runs in which a frame of the family was long.
RunPatterns patternsOf(const std::vector<PreparedSeries>& family) {
  RunPatterns patterns;
  for (const PreparedSeries& p : family)
    for (const Mark& m : p.marks) patterns.insert(m.runs);
  return patterns;
}

/// Returns, for each labelling of the runs, the largest difference that it gives any of the patterns.
std::vector<double> largestDifferences(const RunPatterns& patterns, const std::vector<RunSet>& labellings,
                                       const RunDesign& design) {
  std::vector<double> most;
  for (const RunSet& now : labellings) {
    double largest = 0;
    for (const RunSet& runs : patterns) largest = std::max(largest, moreOften(runs, now, design));
    most.push_back(largest);
  }
  return most;
}

/// Returns the median excess over the usual time in the runs called "now" in which the frame was long [us].
double excessNow(const PreparedSeries& stage, const Mark& m, const RunDesign& design) {
  const RunSet now = design.trueNow();
  std::vector<double> longer;
  for (std::size_t run = 0; run < design.runs(); ++run)
    if (now[run] && m.runs[run]) longer.push_back(stage.usual.excess(stage.series, run, m.frame));
  return median(std::move(longer));
}

/// Fills `same` with the frames for which `counts` is true, each once, and with their medians.
template <class Counts>
void describeFrames(const PreparedSeries& stage, const RunDesign& design, const Counts& counts,
                    LongFrames& same) {
  const RunSet now = design.trueNow();
  std::vector<double> excess, before, after;
  for (const Mark& m : stage.marks) {
    if (!counts(m) || (!same.frames.empty() && same.frames.back() == m.frame)) continue;
    same.frames.push_back(m.frame);
    before.push_back(shareOf(m.runs & ~now, design.before));
    after.push_back(shareOf(m.runs & now, design.now));
    excess.push_back(excessNow(stage, m, design));
  }
  same.excessUs = median(std::move(excess));
  same.before = median(std::move(before));
  same.now = median(std::move(after));
}

/// Answers the first question for all stages of a family.
void findSameFrames(const std::vector<PreparedSeries>& family, std::vector<StageFrames*>& found,
                    const RunDesign& design, const std::vector<RunSet>& labellings, double alarm) {
  const std::vector<double> most = largestDifferences(patternsOf(family), labellings, design);
  const RunSet now = design.trueNow();
  for (std::size_t i = 0; i < family.size(); ++i) {
    double best = 0;
    for (const Mark& m : family[i].marks) best = std::max(best, moreOften(m.runs, now, design));
    if (best <= 0) continue;
    LongFrames& same = found[i]->same;
    same.probability = shareAtLeast(most, best);
    found[i]->hitches = same.probability <= alarm;
    const auto isCertain = [&](const Mark& m) {
      const double share = moreOften(m.runs, now, design);
      return found[i]->hitches ? shareAtLeast(most, share) <= alarm : share >= best;
    };
    describeFrames(family[i], design, isCertain, same);
  }
}

/// A figure of all runs, prepared to be ranked under many labellings.
class RankedFigure {
public:
  RankedFigure(std::vector<double> values, double least, const RunDesign& design)
      : values_(std::move(values)), least_(least), design_(design) {
    if (!design.paired) {
      rank(values_);
      return;
    }
    std::vector<double> sizes;
    for (std::size_t r = 0; r < design.now; ++r)
      sizes.push_back(std::fabs(values_[2 * r + 1] - values_[2 * r]));
    rank(sizes);
    for (std::size_t r = 0; r < sizes.size(); ++r)
      if (sizes[r] == 0) ranks_[r] = 0;
  }

  /// Larger if "now" exceeds the rest by more; nothing if the typical run exceeds it by less than `least`.
  double score(const RunSet& now) const {
    if (design_.paired) {
      std::vector<double> differences;
      double sum = 0;
      for (std::size_t r = 0; r < design_.now; ++r) {
        const double d = values_[2 * r + 1] - values_[2 * r];
        differences.push_back(now[2 * r + 1] ? d : -d);
        if (differences.back() > 0) sum += ranks_[r];
        if (differences.back() < 0) sum -= ranks_[r];
      }
      return median(std::move(differences)) > least_ ? sum : kNone;
    }
    std::vector<double> before, after;
    double sum = 0;
    for (std::size_t run = 0; run < values_.size(); ++run) {
      (now[run] ? after : before).push_back(values_[run]);
      if (now[run]) sum += ranks_[run];
    }
    return median(std::move(after)) - median(std::move(before)) > least_ ? sum : kNone;
  }

  static constexpr double kNone = -1e300;

private:
  void rank(const std::vector<double>& of) {
    std::vector<double> sorted = of;
    std::ranges::sort(sorted);
    for (const double v : of) {
      const auto [first, last] = std::equal_range(sorted.begin(), sorted.end(), v);
      ranks_.push_back(static_cast<double>((first - sorted.begin()) + (last - sorted.begin()) + 1) / 2);
    }
  }

  std::vector<double> values_;
  std::vector<double> ranks_{};
  double least_;
  RunDesign design_;
};

/// Returns the number of long frames of each run.
std::vector<double> longCounts(const PreparedSeries& p, std::size_t level) {
  std::vector<double> counts(p.series.runs.size(), 0);
  for (const Mark& m : p.marks)
    if (m.level == level && m.frame >= kFirstFrames)
      for (std::size_t run = 0; run < counts.size(); ++run) counts[run] += m.runs[run] ? 1 : 0;
  return counts;
}

bool isLongCount(const std::string& figure) {
  return figure.starts_with("frames longer");
}

bool isCount(const std::string& figure) {
  return figure == kLateFrames || isLongCount(figure);
}

/// Returns a figure of all runs, if all have it.
std::optional<std::vector<double>> inAllRuns(const StageSeries& s, const std::string& figure) {
  std::vector<double> values;
  for (const RunFigures& run : s.figures) {
    const auto found = run.find(figure);
    if (found == run.end() || !std::isfinite(found->second)) return std::nullopt;
    values.push_back(found->second);
  }
  return values;
}

struct AskedFigure {
  std::size_t stage = 0;
  std::string name;
  std::vector<double> values;
  double least = 0;
};

std::vector<AskedFigure> figuresToAsk(const std::vector<PreparedSeries>& family, double tolerance) {
  std::vector<AskedFigure> asked;
  for (std::size_t i = 0; i < family.size(); ++i) {
    const StageSeries& s = family[i].series;
    for (const std::string_view figure : {std::string_view("mean"), std::string_view("p95"),
                                          std::string_view("p99"), std::string_view("longest"), kLateFrames})
      if (auto values = inAllRuns(s, std::string(figure))) {
        const double typical = median(*values), tail = figure == "mean" ? 0 : kLeastTail;
        if (figure == "mean" && typical < kShortest) continue;
        const double least = figure == kLateFrames ? 0.5 : std::max(tail, tolerance * typical);
        asked.push_back({i, std::string(figure), std::move(*values), least});
      }
    for (std::size_t level = 0; level < kLevels.size(); ++level)
      asked.push_back({i, fmt::format("frames longer than usual by {:g} ms", kLevels[level] / 1000),
                       longCounts(family[i], level), 0.5});
  }
  return asked;
}

/// Answers the second question for all stages of a family. Each figure has its own distribution over the
/// labellings; the least probability among them answers for all.
void compareFigures(const std::vector<PreparedSeries>& family, std::vector<StageFrames*>& found,
                    const RunDesign& design, const std::vector<RunSet>& labellings, const HitchOptions& o) {
  const std::vector<AskedFigure> asked = figuresToAsk(family, o.tolerance);
  std::vector<double> least(labellings.size(), 1), own;
  for (const AskedFigure& a : asked) {
    const RankedFigure ranked(a.values, a.least, design);
    std::vector<double> scores;
    for (const RunSet& now : labellings) scores.push_back(ranked.score(now));
    std::vector<double> sorted = scores;
    std::ranges::sort(sorted);
    const auto probability = [&](double score) {
      if (score == RankedFigure::kNone) return 1.0;
      const auto below = std::ranges::lower_bound(sorted, score - 1e-9) - sorted.begin();
      return 1 - static_cast<double>(below) / static_cast<double>(sorted.size());
    };
    for (std::size_t i = 0; i < scores.size(); ++i) least[i] = std::min(least[i], probability(scores[i]));
    own.push_back(probability(scores.front()));
  }
  for (double& p : least) p = -p;  // smaller means stronger evidence
  const RunSet now = design.trueNow();
  for (std::size_t i = 0; i < asked.size(); ++i) {
    std::vector<double> before, after;
    for (std::size_t run = 0; run < asked[i].values.size(); ++run)
      (now[run] ? after : before).push_back(asked[i].values[run]);
    FigureShift shift{asked[i].name, median(std::move(before)), median(std::move(after)), 1, false};
    if (own[i] < 1) shift.probability = shareAtLeast(least, -own[i]);
    shift.worse = shift.probability <= o.alarm;
    found[asked[i].stage]->figures.push_back(std::move(shift));
  }
}

const SpanRow* rowWith(const std::vector<SpanRow>& rows, const std::string& key) {
  const auto found = std::ranges::find_if(rows, [&](const SpanRow& r) { return r.key() == key; });
  return found == rows.end() ? nullptr : &*found;
}

const std::map<std::uint64_t, double>& timesOf(const SpanRow& row, TimeKind kind) {
  return kind == TimeKind::Processor ? row.frames : row.elapsed;
}

/// Adds the rows that each list of `runs` has, by one clock.
void addSeries(std::vector<StageSeries>& all, const std::vector<const std::vector<SpanRow>*>& runs,
               double frameBudgetUs) {
  for (const SpanRow& row : *runs.front())
    for (const TimeKind kind : {TimeKind::Processor, TimeKind::Elapsed}) {
      if (!row.isStage() || row.stage == "swap") continue;
      StageSeries s{row.key(), row.name(), kind, {}, {}};
      for (const std::vector<SpanRow>* run : runs) {
        const SpanRow* same = rowWith(*run, s.stage);
        if (!same || timesOf(*same, kind).size() <= 2 * kFirstFrames) break;
        s.runs.push_back(byFrame(timesOf(*same, kind)));
        s.figures.push_back(
            figuresOf(s.runs.back(), kind == TimeKind::Elapsed ? budgetOf(row, frameBudgetUs) : 0));
      }
      if (s.runs.size() == runs.size()) all.push_back(std::move(s));
    }
}

/// Returns the frames of a run to explain: those that are long in all runs, or its own longest.
std::vector<std::size_t> framesToExplain(const StageFrames& found, const std::vector<double>& us) {
  if (found.hitches) return found.same.frames;
  std::vector<double> sorted;
  for (std::size_t n = kFirstFrames; n < us.size(); ++n)
    if (std::isfinite(us[n])) sorted.push_back(us[n]);
  if (sorted.empty()) return {};
  std::ranges::sort(sorted);
  const double typical = median(sorted), longest = sorted.back();
  std::vector<std::size_t> frames;
  for (std::size_t n = kFirstFrames; n < us.size(); ++n)
    if (us[n] > typical && us[n] >= typical + (longest - typical) / 2) frames.push_back(n);
  return frames;
}

/// Returns the median excess of a row over its typical frame in these frames [us].
double excessIn(const std::vector<double>& us, const std::vector<std::size_t>& frames, std::size_t all) {
  std::vector<double> typical, there;
  for (const double v : us)
    if (std::isfinite(v)) typical.push_back(v);
  const double usual = 2 * typical.size() > all ? median(std::move(typical)) : 0;
  for (const std::size_t n : frames) there.push_back(std::isfinite(at(us, n)) ? at(us, n) - usual : 0);
  return median(std::move(there));
}

std::string listed(const std::vector<std::size_t>& frames) {
  constexpr std::size_t kMostListed = 8;
  const std::vector<std::size_t> first(
      frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(std::min(kMostListed, frames.size())));
  return fmt::format("{} {}{}", frames.size() == 1 ? "frame" : "frames", fmt::join(first, ", "),
                     frames.size() > kMostListed ? fmt::format(" and {} more", frames.size() - kMostListed)
                                                 : "");
}

std::string valueOf(const std::string& figure, double value) {
  return isCount(figure) ? fmt::format("{:g}", value) : fmt::format("{:.4g} ms", value / 1000);
}

/// Of several larger numbers of long frames, keeps the one with the longest frames.
std::vector<FigureShift> worseFiguresOf(const StageFrames& f) {
  std::vector<FigureShift> worse;
  for (const FigureShift& s : f.figures) {
    if (!s.worse) continue;
    if (!worse.empty() && isLongCount(worse.back().figure) && isLongCount(s.figure)) worse.pop_back();
    worse.push_back(s);
  }
  return worse;
}

/// Returns the failures; else the figures in short.
std::string saidOf(const StageFrames& f) {
  std::vector<std::string> parts;
  if (f.hitches)
    parts.push_back(
        fmt::format("{} longer by {:.1f} ms in {:.0f} % of the rounds, before in {:.0f} % (p = {:.2g})",
                    listed(f.same.frames), f.same.excessUs / 1000, 100 * f.same.now, 100 * f.same.before,
                    f.same.probability));
  const std::vector<FigureShift> worse = worseFiguresOf(f);
  for (const FigureShift& s : worse)
    parts.push_back(
        fmt::format("{} {} (was {})", s.figure, valueOf(s.figure, s.now), valueOf(s.figure, s.before)));
  if (!worse.empty())
    parts.back() +=
        fmt::format(", p = {:.2g}", std::ranges::max(worse, {}, &FigureShift::probability).probability);
  if (parts.empty())
    for (const FigureShift& s : f.figures) {
      if (isLongCount(s.figure)) continue;
      if (isCount(s.figure))
        parts.push_back(fmt::format("{} {:g} (was {:g})", s.figure, s.now, s.before));
      else
        parts.push_back(fmt::format("{} {:+.1f} %", s.figure, 100 * (s.now / std::max(1e-9, s.before) - 1)));
    }
  return fmt::format("{}: {}", nameOf(f.kind), fmt::join(parts, ", "));
}

}  // namespace

bool StageFrames::worse() const {
  return hitches || std::ranges::any_of(figures, &FigureShift::worse);
}

std::vector<StageFrames> compareFrames(const std::vector<StageSeries>& series, const RunDesign& design,
                                       const HitchOptions& options) {
  std::vector<StageFrames> found;
  for (const StageSeries& s : series) found.push_back({s.stage, s.name, s.kind, {}, false, {}});
  const std::vector<RunSet> labellings = labellingsOf(design);
  for (const TimeKind kind : {TimeKind::Processor, TimeKind::Elapsed}) {
    std::vector<PreparedSeries> family;
    std::vector<StageFrames*> results;
    for (std::size_t i = 0; i < series.size(); ++i) {
      if (series[i].kind != kind) continue;
      UsualTimes usual = usualTimes(series[i]);
      std::vector<Mark> marks = longFramesOf(series[i], usual);
      family.push_back({series[i], std::move(usual), std::move(marks)});
      results.push_back(&found[i]);
    }
    findSameFrames(family, results, design, labellings, options.alarm);
    compareFigures(family, results, design, labellings, options);
  }
  return found;
}

std::vector<StageSeries> seriesOf(const std::vector<Round>& rounds, double frameBudgetUs) {
  std::vector<StageSeries> all;
  std::vector<const std::vector<SpanRow>*> runs;
  for (const Round& r : rounds) {
    runs.push_back(&r.before);
    runs.push_back(&r.now);
  }
  if (!runs.empty()) addSeries(all, runs, frameBudgetUs);
  return all;
}

std::vector<StageSeries> seriesOfNow(const std::vector<Round>& rounds, double frameBudgetUs) {
  std::vector<StageSeries> all;
  std::vector<const std::vector<SpanRow>*> runs;
  for (const Round& r : rounds) runs.push_back(&r.now);
  if (!runs.empty()) addSeries(all, runs, frameBudgetUs);
  return all;
}

std::map<std::string, double> typicalFigures(const std::vector<StageSeries>& series) {
  std::map<std::string, std::vector<double>> all;
  for (const StageSeries& s : series)
    for (const RunFigures& run : s.figures)
      for (const auto& [figure, value] : run) {
        const std::string name = fmt::format("{} of {}, {}", figure, s.name, nameOf(s.kind));
        figure == kLateFrames ? all[name].push_back(value) : all[name + " [ms]"].push_back(value / 1000);
      }
  std::map<std::string, double> typical;
  for (auto& [name, values] : all) typical[name] = median(std::move(values));
  return typical;
}

std::string culpritOf(const StageFrames& found, const std::vector<Round>& rounds) {
  std::map<std::string, std::vector<double>> grown;  // by row, round by round
  std::map<std::string, SpanRow> rows;
  std::vector<double> whole;
  const bool ofFrame = found.name == "frame";
  const std::string prefix = found.stage.substr(0, found.stage.find('|', found.stage.find('|') + 1) + 1);
  for (const Round& r : rounds) {
    const SpanRow* stage = rowWith(r.now, found.stage);
    if (!stage) continue;
    const std::vector<double> us = byFrame(timesOf(*stage, found.kind));
    const std::vector<std::size_t> frames = framesToExplain(found, us);
    if (frames.empty()) continue;
    whole.push_back(excessIn(us, frames, us.size()));
    for (const SpanRow& row : r.now) {
      const auto& times = timesOf(row, found.kind);
      const bool within =
          ofFrame ? row.isStage() && row.stage != "frame" : !row.isStage() && row.key().starts_with(prefix);
      if (!within || times.empty()) continue;
      grown[row.key()].push_back(excessIn(byFrame(times), frames, us.size()));
      rows.emplace(row.key(), row);
    }
  }
  std::vector<std::pair<SpanRow, double>> all;
  for (const auto& [key, more] : grown) all.emplace_back(rows.at(key), median(more));
  const double growth = median(whole);
  if (!ofFrame) return culpritIn(found.name, all, growth);
  const auto most = std::ranges::max_element(all, {}, [](const auto& g) { return g.second; });
  if (most != all.end() && most->second >= growth / 2) return most->first.name();
  return "frame, between the stages";
}

std::vector<Check> checksOf(const std::vector<StageFrames>& found, const std::vector<std::string>& culprits,
                            const std::string& with, std::size_t rounds) {
  std::vector<Check> checks;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const StageFrames& f = found[i];
    const std::string metric = f.name == "frame" ? "whole frames" : "frames of " + f.name;
    auto check = std::ranges::find(checks, metric, &Check::metric);
    if (check == checks.end())
      check = checks.insert(check,
                            {metric, Outcome::Passed, fmt::format("against {} in {} rounds", with, rounds)});
    // Failures come first, and alone.
    if (f.worse() && check->outcome == Outcome::Passed) {
      check->outcome = Outcome::Failed;
      check->culprit = culprits[i];
      check->said = saidOf(f);
    } else if (f.worse() || check->outcome == Outcome::Passed)
      check->said += "; " + saidOf(f);
    if (f.worse()) check->figures.push_back(f.name + " [" + std::string(nameOf(f.kind)) + "]");
  }
  return checks;
}

}  // namespace stadion::regression
