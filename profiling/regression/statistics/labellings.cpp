#include "profiling/regression/statistics/labellings.h"

#include <algorithm>
#include <numeric>
#include <random>

namespace stadion::regression {
namespace {

constexpr std::size_t kMostLabellings = 4096;
constexpr std::size_t kMostPairsInFull = 12;
constexpr double kRounding = 1e-9;

/// Labelling of pairs. The bits of `swapped` are the rounds in which the two runs exchange names.
template <class Swapped>
RunSet pairsWith(std::size_t rounds, const Swapped& swapped) {
  RunSet now;
  for (std::size_t r = 0; r < rounds; ++r) now.set(2 * r + (swapped(r) ? 0 : 1));
  return now;
}

std::vector<RunSet> pairedLabellings(std::size_t rounds) {
  std::vector<RunSet> all;
  if (rounds <= kMostPairsInFull) {
    for (std::size_t bits = 0; bits < std::size_t{1} << rounds; ++bits)
      all.push_back(pairsWith(rounds, [&](std::size_t r) { return (bits >> r & 1) != 0; }));
    return all;
  }
  std::mt19937_64 random(1);
  all.push_back(pairsWith(rounds, [](std::size_t) { return false; }));
  while (all.size() < kMostLabellings)
    all.push_back(pairsWith(rounds, [&](std::size_t) { return (random() >> 32 & 1) != 0; }));
  return all;
}

}  // namespace

RunSet RunDesign::trueNow() const {
  RunSet set;
  for (std::size_t run = 0; run < runs(); ++run)
    if (paired ? run % 2 == 1 : run >= before) set.set(run);
  return set;
}

std::vector<RunSet> labellingsOf(const RunDesign& design) {
  if (design.paired) return pairedLabellings(design.now);
  std::vector<RunSet> all{design.trueNow()};
  std::vector<std::size_t> order(design.runs());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 random(1);
  while (all.size() < kMostLabellings) {
    RunSet now;
    for (std::size_t i = 0; i < design.now; ++i) {  // the first ones of a shuffled order
      std::swap(order[i], order[i + random() % (order.size() - i)]);
      now.set(order[i]);
    }
    all.push_back(now);
  }
  return all;
}

double shareAtLeast(const std::vector<double>& values, double observed) {
  if (values.empty()) return 1;
  const auto count = std::ranges::count_if(values, [&](double v) { return v >= observed - kRounding; });
  return static_cast<double>(count) / static_cast<double>(values.size());
}

}  // namespace stadion::regression
