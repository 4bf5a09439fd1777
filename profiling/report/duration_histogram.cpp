#include "profiling/report/duration_histogram.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stadion {
namespace {

constexpr std::size_t kBins = 48;

double rank(const std::vector<float>& sorted, double percent) {
  const auto at = static_cast<std::size_t>(std::ceil(percent / 100 * static_cast<double>(sorted.size())));
  return static_cast<double>(sorted[std::max<std::size_t>(at, 1) - 1]);
}

}  // namespace

DurationHistogram durationHistogramOf(std::vector<float> ms) {
  DurationHistogram d;
  d.count = ms.size();
  if (ms.empty()) return d;
  std::ranges::sort(ms);
  d.mean = std::accumulate(ms.begin(), ms.end(), 0.0) / static_cast<double>(ms.size());
  d.median = rank(ms, 50);
  d.p95 = rank(ms, 95);
  d.p99 = rank(ms, 99);
  d.most = static_cast<double>(ms.back());
  const double least = static_cast<double>(ms.front());
  const double room = std::max(d.p99 - least, 1e-6);
  d.from = std::max(0.0, least - 0.04 * room);
  d.step = (1.12 * room + (least - d.from)) / kBins;
  d.bins.resize(kBins);
  for (const float v : ms) {
    const double bin = (static_cast<double>(v) - d.from) / d.step;
    ++d.bins[static_cast<std::size_t>(std::clamp(bin, 0.0, kBins - 1.0))];
  }
  return d;
}

}  // namespace stadion
