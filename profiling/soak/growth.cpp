#include "profiling/soak/growth.h"

#include <algorithm>
#include <map>

namespace stadion {
namespace {

using ByProcess = std::map<std::uint32_t, std::vector<SoakSample>>;

ByProcess byProcess(std::span<const SoakSample> samples) {
  ByProcess all;
  for (const SoakSample& s : samples) all[s.process].push_back(s);
  return all;
}

/// So many of each process: of their pairs there are half a million.
constexpr std::size_t kMost = 1000;

}  // namespace

std::vector<SoakSample> afterWarmUp(std::span<const SoakSample> samples, std::uint64_t frames) {
  std::vector<SoakSample> kept;
  for (const auto& [process, all] : byProcess(samples))
    for (const SoakSample& s : all)
      if (s.frame - all.front().frame >= frames) kept.push_back(s);
  return kept;
}

std::optional<double> slopeOf(std::span<const SoakSample> samples, std::uint64_t SoakSample::*figure) {
  std::vector<double> slopes;
  for (const auto& [process, all] : byProcess(samples)) {
    const std::size_t stride = all.size() / kMost + 1;
    for (std::size_t i = 0; i < all.size(); i += stride)
      for (std::size_t j = i + stride; j < all.size(); j += stride) {
        if (all[j].frame <= all[i].frame) continue;
        const double rise = static_cast<double>(all[j].*figure) - static_cast<double>(all[i].*figure);
        slopes.push_back(rise / static_cast<double>(all[j].frame - all[i].frame));
      }
  }
  if (slopes.empty()) return {};
  const auto middle = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() / 2);
  std::nth_element(slopes.begin(), middle, slopes.end());
  return *middle;
}

std::int64_t growthOf(std::span<const SoakSample> samples, std::uint64_t SoakSample::*figure) {
  std::int64_t most = 0;
  for (const auto& [process, all] : byProcess(samples)) {
    std::uint64_t earlier = 0, later = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      std::uint64_t& highest = i < (all.size() + 1) / 2 ? earlier : later;
      highest = std::max(highest, all[i].*figure);
    }
    if (all.size() > 1)
      most = std::max(most, static_cast<std::int64_t>(later) - static_cast<std::int64_t>(earlier));
  }
  return most;
}

}  // namespace stadion
