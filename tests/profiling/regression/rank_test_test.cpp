/// Against tables that can be looked up, and against plain counting of all cases.

#include "profiling/regression/statistics/rank_test.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace stadion::regression {
namespace {

std::vector<double> sums(std::size_t n, const std::vector<bool>& positive) {
  std::vector<double> d(n);
  for (std::size_t i = 0; i < n; ++i) d[i] = positive[i] ? double(i + 1) : -double(i + 1);
  return d;
}

/// Differences 1 ... n, of which these are negative.
std::vector<double> withNegative(std::size_t n, std::initializer_list<std::size_t> negative) {
  std::vector<bool> positive(n, true);
  for (const std::size_t i : negative) positive[i - 1] = false;
  return sums(n, positive);
}

TEST(RankTest, OfSignedRanksIsThatOfTheTables) {
  EXPECT_DOUBLE_EQ(signedRankTest(withNegative(5, {})), 2.0 / 32);
  EXPECT_DOUBLE_EQ(signedRankTest(withNegative(6, {})), 2.0 / 64);
  EXPECT_DOUBLE_EQ(signedRankTest(withNegative(8, {3})), 2 * 5.0 / 256);      // W = 3: 0.0391
  EXPECT_DOUBLE_EQ(signedRankTest(withNegative(10, {8})), 2 * 25.0 / 1024);   // W = 8, the 5 % limit
  EXPECT_DOUBLE_EQ(signedRankTest(withNegative(10, {3})), 2 * 5.0 / 1024);    // W = 3, the 1 % limit
  EXPECT_NEAR(signedRankTest(withNegative(20, {20, 18, 14})), 0.0484, 5e-5);  // W = 52, the 5 % limit
}

TEST(RankTest, OfSignedRanksIsTheSameOnBothSidesAndBlindToScaleAndZeros) {
  std::vector<double> d = withNegative(9, {2, 5}), other;
  const double p = signedRankTest(d);
  for (const double x : d) other.push_back(-17 * x);
  EXPECT_DOUBLE_EQ(signedRankTest(other), p);
  d.insert(d.end(), {0, 0, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_DOUBLE_EQ(signedRankTest(d), p);
}

TEST(RankTest, OfSignedRanksWithTiesCountsEverySignOnce) {
  const std::vector<double> d{1, 1, -1, 2, 2, 3, -3, 4};
  const std::vector<double> ranks{2, 2, 2, 4.5, 4.5, 6.5, 6.5, 8};
  double positive = 0, below = 0, above = 0;
  for (std::size_t i = 0; i < d.size(); ++i) positive += d[i] > 0 ? ranks[i] : 0;
  for (unsigned signs = 0; signs < 256; ++signs) {
    double sum = 0;
    for (std::size_t i = 0; i < d.size(); ++i) sum += signs >> i & 1 ? ranks[i] : 0;
    below += sum <= positive, above += sum >= positive;
  }
  EXPECT_DOUBLE_EQ(signedRankTest(d), 2 * std::min(below, above) / 256);
}

TEST(RankTest, OfRankSumsIsThatOfTheTables) {
  EXPECT_DOUBLE_EQ(rankSumTest({1, 2, 3, 4}, {5, 6, 7, 8}), 2.0 / 70);              // U = 0
  EXPECT_DOUBLE_EQ(rankSumTest({1, 2, 4}, {3, 5, 6, 7}), 2 * 2.0 / 35);             // U = 1
  EXPECT_DOUBLE_EQ(rankSumTest({1, 2, 3, 4, 7}, {5, 6, 8, 9, 10}), 2 * 4.0 / 252);  // U = 2, the 5 % limit
  EXPECT_DOUBLE_EQ(rankSumTest({5, 6, 7, 8}, {1, 2, 3, 4}), 2.0 / 70) << "the other way round";
}

TEST(RankTest, OfRankSumsWithTiesCountsEveryChoiceOnce) {
  const std::vector<double> all{1, 2, 2, 3, 3, 3, 5, 8}, ranks{1, 2.5, 2.5, 5, 5, 5, 7, 8};
  const std::vector<double> a{1, 2, 3, 2}, b{3, 5, 3, 8};
  const double sum = 1 + 2.5 + 5 + 2.5;
  double below = 0, above = 0, ways = 0;
  for (unsigned chosen = 0; chosen < 256; ++chosen) {
    if (__builtin_popcount(chosen) != 4) continue;
    double s = 0;
    for (std::size_t i = 0; i < 8; ++i) s += chosen >> i & 1 ? ranks[i] : 0;
    ++ways, below += s <= sum, above += s >= sum;
  }
  EXPECT_DOUBLE_EQ(rankSumTest(a, b), 2 * std::min(below, above) / ways);
}

TEST(RankTest, OfManyFiguresGoesOverIntoTheNormalDistribution) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise;
  std::vector<double> a, b;
  for (int i = 0; i < 40; ++i) a.push_back(noise(random)), b.push_back(noise(random) + 0.5);
  const double exact = rankSumTest(a, b);
  a.push_back(noise(random));
  EXPECT_NEAR(rankSumTest(a, b), exact, 0.02);
  EXPECT_LT(exact, 0.2);
}

TEST(RankTest, OfNothingSaysNothing) {
  EXPECT_EQ(signedRankTest({}), 1);
  EXPECT_EQ(signedRankTest({0, 0}), 1);
  EXPECT_EQ(rankSumTest({}, {1, 2}), 1);
  EXPECT_EQ(rankSumTest({2, 2, 2}, {2, 2, 2}), 1);
  EXPECT_EQ(median({}), 0);
}

TEST(RankTest, GivesFalseAlarmsAsOftenAsItSays) {
  std::mt19937_64 random(2);
  std::normal_distribution<double> noise;
  int signedAlarms = 0, sumAlarms = 0;
  constexpr int kTrials = 4000;
  for (int t = 0; t < kTrials; ++t) {
    std::vector<double> d(12), a(8), b(8);
    for (double& x : d) x = noise(random);
    for (double& x : a) x = noise(random);
    for (double& x : b) x = noise(random);
    signedAlarms += signedRankTest(d) <= 0.05, sumAlarms += rankSumTest(a, b) <= 0.05;
  }
  // At most 5 %, and not much less: 4 standard deviations below what the discrete distributions allow.
  EXPECT_LE(signedAlarms, 0.064 * kTrials);
  EXPECT_GE(signedAlarms, 0.030 * kTrials);
  EXPECT_LE(sumAlarms, 0.064 * kTrials);
  EXPECT_GE(sumAlarms, 0.025 * kTrials);
}

TEST(RankTest, ShiftsAreMediansThatOneSpoiltFigureDoesNotMove) {
  EXPECT_DOUBLE_EQ(median({3, 1, 2}), 2);
  EXPECT_DOUBLE_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_DOUBLE_EQ(typicalShift({1, 2, 3}), 2);
  EXPECT_NEAR(typicalShift({1, 1.1, 0.9, 1, 1.05, 0.95, 500}), 1, 0.1);
  EXPECT_DOUBLE_EQ(typicalShift({1, 2, 3}, {11, 12, 13}), 10);
}

TEST(RankTest, SeveralQuestionsAtOnceAreCorrectedFor) {
  const std::vector<double> p = correctedForMany({0.01, 0.04, 0.03, 0.005});
  EXPECT_DOUBLE_EQ(p[3], 0.02);
  EXPECT_DOUBLE_EQ(p[0], 0.03);
  EXPECT_DOUBLE_EQ(p[2], 0.06);
  EXPECT_DOUBLE_EQ(p[1], 0.06) << "never less than that of a smaller one";
  EXPECT_EQ(correctedForMany({0.9, 0.8}), (std::vector<double>{1, 1}));
}

}  // namespace
}  // namespace stadion::regression
