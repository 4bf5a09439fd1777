#include "dynamics/contact/contact_order.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr std::uint32_t kNoPlace = 0xffffffff;
constexpr double kRowsOfPair = 7;    ///< unknowns of two boxes on each other: four points, slip and spin
constexpr double kWorkOfEntry = 30;  ///< to make one entry of the matrix

/// Neighbours of each body, each once, in rising order.
std::vector<std::vector<std::uint32_t>> neighboursOf(std::size_t bodies, std::span<const LeaningPair> pairs) {
  std::vector<std::vector<std::uint32_t>> next(bodies);
  for (const auto& [a, b] : pairs)
    if (a < bodies && b < bodies && a != b) {
      next[a].push_back(b);
      next[b].push_back(a);
    }
  for (auto& list : next) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return next;
}

}  // namespace

std::vector<std::uint32_t> placesInLine(std::size_t bodies, std::span<const LeaningPair> pairs) {
  const auto next = neighboursOf(bodies, pairs);
  std::vector<std::uint32_t> place(bodies, kNoPlace), line, trial;
  std::vector<char> seen(bodies, 0);
  const auto walk = [&](std::uint32_t from, std::vector<std::uint32_t>& out) {
    out.assign(1, from);
    seen[from] = 1;
    std::vector<std::uint32_t> more;
    for (std::size_t i = 0; i < out.size(); ++i) {
      more.clear();
      for (const std::uint32_t b : next[out[i]])
        if (seen[b] == 0) {
          seen[b] = 1;
          more.push_back(b);
        }
      std::ranges::stable_sort(more, {}, [&](std::uint32_t b) { return next[b].size(); });
      out.insert(out.end(), more.begin(), more.end());
    }
  };
  std::uint32_t places = 0;
  for (std::uint32_t i = 0; i < bodies; ++i) {
    if (place[i] != kNoPlace) continue;
    walk(i, trial);  // what is farthest from anywhere is an end
    for (const std::uint32_t b : trial) seen[b] = 0;
    walk(trial.back(), line);
    for (const std::uint32_t b : line) place[b] = places++;
  }
  return place;
}

double workOfLine(std::size_t bodies, std::span<const LeaningPair> pairs) {
  const std::vector<std::uint32_t> place = placesInLine(bodies, pairs);
  std::vector<LeaningPair> line;
  for (const auto& [a, b] : pairs) {
    const std::uint32_t pa = a < bodies ? place[a] : kNoPlace, pb = b < bodies ? place[b] : kNoPlace;
    if (pa == kNoPlace && pb == kNoPlace) continue;
    line.push_back({pa == kNoPlace ? pb : pb == kNoPlace ? pa : std::max(pa, pb), std::min(pa, pb)});
  }
  std::ranges::sort(line);
  std::vector<std::size_t> first(bodies, line.size());
  double work = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    std::size_t from = i;
    for (const std::uint32_t b : line[i]) {
      first[b] = std::min(first[b], i);
      from = std::min(from, first[b]);
    }
    const double width = kRowsOfPair * static_cast<double>(i - from + 1);
    work += kRowsOfPair * width * (width + kWorkOfEntry);
  }
  return work;
}

}  // namespace stadion
