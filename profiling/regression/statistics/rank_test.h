#pragma once
/// Tests for differences beyond chance by ranks alone: a figure that a busy machine has spoilt counts only by
/// its place in the order. Probabilities are exact, with ties, for the sizes of suites.
///
/// Sources  F. Wilcoxon, Individual comparisons by ranking methods (1945); H. B. Mann and D. R. Whitney
///          (1947); J. L. Hodges and E. L. Lehmann (1963); S. Holm (1979).
/// Threads  free functions, any thread.
/// Errors   none; figures that are not finite are left out.

#include "engine/maths/median.h"

#include <cstddef>
#include <vector>

namespace stadion::regression {

/// The probability, if the differences of pairs lay evenly about 0, that their signed ranks were at least as
/// lopsided (Wilcoxon, both sides). Differences of 0 say nothing. 1 of none.
double signedRankTest(const std::vector<double>& differences);

/// Returns the probability of ranks at least as far apart, if a and b have the same source (Mann and Whitney,
/// both sides). Exact up to 80 figures in all, beyond by the normal distribution. 1 if one is empty.
double rankSumTest(const std::vector<double>& a, const std::vector<double>& b);

/// Returns the least probability that these tests can give for so many figures.
double leastSignedRank(std::size_t differences);
double leastRankSum(std::size_t a, std::size_t b);

/// Returns the difference of paired figures: the median of the means of all pairs of differences (Hodges and
/// Lehmann).
double typicalShift(const std::vector<double>& differences);
/// Returns the excess of b over a: the median of all differences b - a.
double typicalShift(const std::vector<double>& a, const std::vector<double>& b);

/// Raises the probabilities so that several questions together give false alarms no more often than one
/// (Holm). In the given order, at most 1.
std::vector<double> correctedForMany(const std::vector<double>& probabilities);

}  // namespace stadion::regression
