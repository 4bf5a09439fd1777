#include "profiling/regression/statistics/kept_frames.h"

#include "profiling/regression/statistics/rank_test.h"
#include "profiling/regression/statistics/usual_times.h"

#include <algorithm>
#include <cmath>

namespace stadion::regression {
namespace {

// Less than what makes a frame long (hitch_comparison.cpp), so that a later comparison finds all of them.
constexpr double kKeptExcess = 500;  ///< [us]
constexpr double kKeptShare = 0.05, kKeptDeviations = 3;

std::string clockOf(TimeKind kind) {
  return kind == TimeKind::Processor ? "processor" : "elapsed";
}

RunFigures scaled(const RunFigures& figures, double by) {
  RunFigures all = figures;
  for (auto& [name, value] : all)
    if (name != kLateFrames) value *= by;
  return all;
}

KeptStage keptOf(const StageSeries& s, const std::vector<double>& calibrationMs) {
  StageSeries inKernels = s;
  const double toUs = 1000 * median(calibrationMs);
  for (std::size_t run = 0; run < s.runs.size(); ++run) {
    const double by = 1 / (1000 * calibrationMs[run]);
    for (double& us : inKernels.runs[run]) us *= by;
    inKernels.figures[run] = scaled(s.figures[run], by);
  }
  const UsualTimes usual = usualTimes(inKernels);
  KeptStage kept{usual.us, usual.deviation, usual.levels, {}, inKernels.figures};
  for (std::size_t run = 0; run < s.runs.size(); ++run) {
    auto& longer = kept.longer.emplace_back();
    for (std::size_t n = 0; n < usual.us.size(); ++n) {
      const double excess = usual.excess(inKernels, run, n);
      if (excess > std::max({kKeptExcess / toUs, kKeptShare * usual.us[n], kKeptDeviations * usual.deviation}))
        longer[n] = excess;
    }
  }
  return kept;
}

/// One round, put together again.
std::vector<double> runOf(const KeptStage& kept, std::size_t round, double toUs) {
  std::vector<double> us;
  for (std::size_t n = 0; n < kept.usual.size(); ++n) {
    const auto longer = kept.longer[round].find(n);
    const double excess = longer == kept.longer[round].end() ? 0 : longer->second;
    us.push_back(kept.levels[round] * (kept.usual[n] + excess) * toUs);
  }
  return us;
}

bool isWhole(const KeptStage& kept) {
  const std::size_t rounds = kept.levels.size();
  return rounds > 0 && kept.longer.size() == rounds && kept.figures.size() == rounds;
}

}  // namespace

KeptStages keep(const std::vector<StageSeries>& series, const std::vector<double>& calibrationMs) {
  KeptStages all;
  for (const StageSeries& s : series)
    if (s.runs.size() == calibrationMs.size()) all[s.name][clockOf(s.kind)] = keptOf(s, calibrationMs);
  return all;
}

std::vector<StageSeries> joined(const KeptStages& kept, const std::vector<StageSeries>& now,
                                const std::vector<double>& calibrationMs) {
  std::vector<StageSeries> all;
  const double toUs = 1000 * median(calibrationMs);
  for (const StageSeries& s : now) {
    const auto stage = kept.find(s.name);
    if (stage == kept.end()) continue;
    const auto found = stage->second.find(clockOf(s.kind));
    if (found == stage->second.end() || !isWhole(found->second)) continue;
    const KeptStage& before = found->second;
    StageSeries both{s.stage, s.name, s.kind, {}, {}, before.deviation * toUs};
    for (std::size_t round = 0; round < before.levels.size(); ++round) {
      both.runs.push_back(runOf(before, round, toUs));
      both.figures.push_back(scaled(before.figures[round], toUs));
    }
    for (std::size_t run = 0; run < s.runs.size() && run < calibrationMs.size(); ++run) {
      const double by = toUs / (1000 * calibrationMs[run]);
      std::vector<double>& us = both.runs.emplace_back(s.runs[run]);
      for (double& v : us) v *= by;
      both.figures.push_back(scaled(s.figures[run], by));
    }
    all.push_back(std::move(both));
  }
  return all;
}

std::size_t roundsIn(const KeptStages& kept) {
  std::size_t rounds = 0;
  for (const auto& [stage, clocks] : kept)
    for (const auto& [clock, frames] : clocks) {
      if (!isWhole(frames) || (rounds > 0 && frames.levels.size() != rounds)) return 0;
      rounds = frames.levels.size();
    }
  return rounds;
}

}  // namespace stadion::regression
