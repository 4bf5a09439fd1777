#include "profiling/soak/growth.h"

#include "engine/maths/median.h"

#include <algorithm>
#include <map>
#include <utility>

namespace stadion {
namespace {

using ByProcess = std::map<std::uint32_t, std::vector<SoakSample>>;

using ByVisit = std::map<std::pair<std::uint32_t, std::uint64_t>, std::vector<SoakSample>>;

ByVisit byVisit(std::span<const SoakSample> samples) {
  ByVisit all;
  for (const SoakSample& s : samples) all[{s.process, s.visit}].push_back(s);
  return all;
}

ByProcess byProcess(std::span<const SoakSample> samples) {
  ByProcess all;
  for (const SoakSample& s : samples) all[s.process].push_back(s);
  return all;
}

/// Limit for each series: it has half a million pairs.
constexpr std::size_t kMost = 1000;
constexpr std::size_t kFewestVisits = 10;

struct Point {
  double x = 0, y = 0;
};

/// Adds the slopes between any two of them.
void addSlopes(const std::vector<Point>& points, std::vector<double>& slopes) {
  const std::size_t stride = points.size() / kMost + 1;
  for (std::size_t i = 0; i < points.size(); i += stride)
    for (std::size_t j = i + stride; j < points.size(); j += stride)
      if (points[j].x > points[i].x)
        slopes.push_back((points[j].y - points[i].y) / (points[j].x - points[i].x));
}

}  // namespace

std::vector<SoakSample> afterWarmUp(std::span<const SoakSample> samples, std::uint64_t frames) {
  std::vector<SoakSample> kept;
  for (const auto& [visit, all] : byVisit(samples))
    for (const SoakSample& s : all)
      if (s.frame - all.front().frame >= frames) kept.push_back(s);
  return kept;
}

std::optional<double> slopeOf(std::span<const SoakSample> samples, std::uint64_t SoakSample::*figure) {
  std::vector<double> slopes;
  for (const auto& [visit, all] : byVisit(samples)) {
    std::vector<Point> points;
    for (const SoakSample& s : all)
      points.push_back({static_cast<double>(s.frame), static_cast<double>(s.*figure)});
    addSlopes(points, slopes);
  }
  if (slopes.empty()) return {};
  return median(std::move(slopes));
}

std::optional<double> slopeOfVisits(std::span<const SoakSample> samples, std::uint64_t SoakSample::*figure) {
  std::map<std::uint32_t, std::vector<Point>> visits;  // by process
  for (const auto& [visit, all] : byVisit(samples)) {
    std::vector<Point>& points = visits[visit.first];
    points.push_back({static_cast<double>(points.size()), static_cast<double>(all.back().*figure)});
  }
  std::vector<double> slopes;
  for (const auto& [process, points] : visits)
    if (points.size() >= kFewestVisits) addSlopes(points, slopes);
  if (slopes.empty()) return {};
  return median(std::move(slopes));
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
