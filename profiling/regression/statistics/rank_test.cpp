#include "profiling/regression/statistics/rank_test.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace stadion::regression {
namespace {

constexpr std::size_t kMostExact = 80;  ///< figures of both sides in rankSumTest
constexpr std::size_t kMostPairs = 250;

std::vector<double> finite(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  return values;
}

/// Twice the rank of each value, from the least; equal ones share the mean of their ranks, so that twice it
/// is whole.
std::vector<std::uint32_t> doubledRanks(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
  std::vector<std::uint32_t> ranks(values.size());
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    while (end < order.size() && values[order[end]] == values[order[first]]) ++end;
    for (std::size_t i = first; i < end; ++i) ranks[order[i]] = static_cast<std::uint32_t>(first + 1 + end);
    first = end;
  }
  return ranks;
}

/// Returns both tails of a distribution at the integer value `at`; weights[i] is the weight of value i.
double bothTails(const std::vector<double>& weights, std::size_t at) {
  double below = 0, above = 0, all = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    all += weights[i];
    if (i <= at) below += weights[i];
    if (i >= at) above += weights[i];
  }
  return std::min(1.0, 2 * std::min(below, above) / all);
}

double normalTails(double z) {
  return std::min(1.0, std::erfc(std::fabs(z) / std::sqrt(2.0)));
}

std::vector<double> growing(std::size_t count, double first) {
  std::vector<double> values(count);
  std::iota(values.begin(), values.end(), first);
  return values;
}

/// Of the sum of the doubled ranks of `count` figures out of all.
double approximateRankSum(const std::vector<std::uint32_t>& ranks, std::size_t count, double sum) {
  const double n = static_cast<double>(ranks.size()), m = static_cast<double>(count);
  double squares = 0;
  for (const std::uint32_t r : ranks) squares += std::pow(static_cast<double>(r) - (n + 1), 2);
  const double variance = m * (n - m) / (n * (n - 1)) * squares;
  return variance > 0 ? normalTails((sum - m * (n + 1)) / std::sqrt(variance)) : 1;
}

}  // namespace

// The weights of all sums that 2^n ways of giving the ranks signs can have, built up rank by rank.
double signedRankTest(const std::vector<double>& differences) {
  std::vector<double> kept = finite(differences);
  std::erase(kept, 0.0);
  if (kept.size() > kMostPairs) kept.resize(kMostPairs);
  if (kept.empty()) return 1;
  std::vector<double> sizes;
  for (const double d : kept) sizes.push_back(std::fabs(d));
  const std::vector<std::uint32_t> ranks = doubledRanks(sizes);

  std::size_t total = 0, positive = 0;
  std::vector<double> weights{1};
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    const std::size_t rank = ranks[i];
    total += rank;
    if (kept[i] > 0) positive += rank;
    weights.resize(total + 1, 0);
    // Halved at each step: the weights are probabilities and stay in range.
    for (std::size_t sum = total + 1; sum-- > 0;)
      weights[sum] = (weights[sum] + (sum >= rank ? weights[sum - rank] : 0)) / 2;
  }
  return bothTails(weights, positive);
}

// The weights of the sums of all subsets of the ranks with the size of a.
double rankSumTest(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> all = finite(a);
  const std::size_t count = all.size();
  for (const double v : finite(b)) all.push_back(v);
  if (count == 0 || count == all.size()) return 1;
  const std::vector<std::uint32_t> ranks = doubledRanks(all);
  const std::size_t sum =
      std::accumulate(ranks.begin(), ranks.begin() + static_cast<std::ptrdiff_t>(count), std::size_t{0});
  if (all.size() > kMostExact) return approximateRankSum(ranks, count, static_cast<double>(sum));

  const std::size_t total = std::accumulate(ranks.begin(), ranks.end(), std::size_t{0});
  std::vector<std::vector<double>> weights(count + 1, std::vector<double>(total + 1, 0));
  weights[0][0] = 1;
  for (const std::size_t rank : ranks)
    for (std::size_t chosen = count; chosen > 0; --chosen)
      for (std::size_t s = rank; s <= total; ++s) weights[chosen][s] += weights[chosen - 1][s - rank];
  return bothTails(weights[count], sum);
}

double leastSignedRank(std::size_t differences) {
  return signedRankTest(growing(differences, 1));
}

double leastRankSum(std::size_t a, std::size_t b) {
  return rankSumTest(growing(a, 0), growing(b, static_cast<double>(a)));
}

double typicalShift(const std::vector<double>& differences) {
  std::vector<double> d = finite(differences);
  if (d.size() > kMostPairs) d.resize(kMostPairs);
  std::vector<double> means;
  for (std::size_t i = 0; i < d.size(); ++i)
    for (std::size_t j = i; j < d.size(); ++j) means.push_back((d[i] + d[j]) / 2);
  return median(std::move(means));
}

double typicalShift(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> differences;
  for (const double x : a)
    for (const double y : b) differences.push_back(y - x);
  return median(std::move(differences));
}

std::vector<double> correctedForMany(const std::vector<double>& probabilities) {
  const std::size_t n = probabilities.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return probabilities[i]; });
  std::vector<double> corrected(n);
  double least = 0;
  for (std::size_t i = 0; i < n; ++i) {
    least = std::max(least, std::min(1.0, probabilities[order[i]] * static_cast<double>(n - i)));
    corrected[order[i]] = least;
  }
  return corrected;
}

}  // namespace stadion::regression
