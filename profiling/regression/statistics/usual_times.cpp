#include "profiling/regression/statistics/usual_times.h"

#include "profiling/regression/statistics/rank_test.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stadion::regression {
namespace {

/// The lower quartile: of twice the runs of one side, at most half have a planted delay.
double lowerQuartile(std::vector<double>& values) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4);
  std::ranges::nth_element(values, at);
  return *at;
}

std::size_t framesIn(const StageSeries& s) {
  std::size_t frames = 0;
  for (const auto& run : s.runs) frames = std::max(frames, run.size());
  return frames;
}

}  // namespace

double at(const std::vector<double>& run, std::size_t frame) {
  return frame < run.size() ? run[frame] : std::numeric_limits<double>::quiet_NaN();
}

double UsualTimes::excess(const StageSeries& s, std::size_t run, std::size_t frame) const {
  return at(s.runs[run], frame) / levels[run] - us[frame];
}

UsualTimes usualTimes(const StageSeries& s) {
  UsualTimes usual;
  const std::size_t frames = framesIn(s);
  std::vector<double> middle(frames, 0), values;
  for (std::size_t n = 0; n < frames; ++n) {
    values.clear();
    for (const auto& run : s.runs)
      if (std::isfinite(at(run, n))) values.push_back(at(run, n));
    middle[n] = median(values);
  }
  for (const auto& run : s.runs) {
    values.clear();
    for (std::size_t n = 0; n < run.size(); ++n)
      if (std::isfinite(run[n]) && middle[n] > 0) values.push_back(run[n] / middle[n]);
    const double level = median(values);
    usual.levels.push_back(level > 0 ? level : 1);
  }
  std::vector<double> deviations;
  for (std::size_t n = 0; n < frames; ++n) {
    values.clear();
    for (std::size_t run = 0; run < s.runs.size(); ++run)
      if (const double us = at(s.runs[run], n) / usual.levels[run]; std::isfinite(us)) values.push_back(us);
    usual.us.push_back(values.empty() ? 0 : lowerQuartile(values));
    for (const double us : values) deviations.push_back(std::fabs(us - usual.us.back()));
  }
  usual.deviation = std::max(s.leastDeviation, median(std::move(deviations)));
  return usual;
}

}  // namespace stadion::regression
