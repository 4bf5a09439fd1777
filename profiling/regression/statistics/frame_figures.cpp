#include "profiling/regression/statistics/frame_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace stadion::regression {
namespace {

/// The least value that `share` of the sorted ones do not exceed.
double percentile(const std::vector<double>& sorted, double share) {
  const double at = std::ceil(share * static_cast<double>(sorted.size()));
  return sorted[static_cast<std::size_t>(std::max(1.0, at)) - 1];
}

}  // namespace

std::string_view nameOf(TimeKind kind) {
  return kind == TimeKind::Processor ? "processor time" : "wall-clock time";
}

RunFigures figuresOf(const std::vector<double>& us, double budgetUs) {
  std::vector<double> sorted;
  for (std::size_t frame = kFirstFrames; frame < us.size(); ++frame)
    if (std::isfinite(us[frame])) sorted.push_back(us[frame]);
  if (sorted.empty()) return {};
  std::ranges::sort(sorted);
  RunFigures figures{
      {"mean", std::accumulate(sorted.begin(), sorted.end(), 0.0) / static_cast<double>(sorted.size())},
      {"p95", percentile(sorted, 0.95)},
      {"p99", percentile(sorted, 0.99)},
      {"longest", sorted.back()}};
  if (budgetUs > 0)
    figures[std::string(kLateFrames)] =
        static_cast<double>(sorted.end() - std::ranges::upper_bound(sorted, budgetUs));
  return figures;
}

std::vector<double> byFrame(const std::map<std::uint64_t, double>& us) {
  constexpr std::uint64_t kMostNumbered = 1'000'000;  // as a suite may have
  std::vector<double> values;
  for (const auto& [frame, value] : us) {
    if (frame > kMostNumbered) break;
    values.resize(frame, std::numeric_limits<double>::quiet_NaN());
    values.push_back(value);
  }
  return values;
}

double budgetOf(const SpanRow& row, double frameBudgetUs) {
  return row.stage == "frame" ? frameBudgetUs : 0;
}

}  // namespace stadion::regression
