#pragma once
/// Whether figures differ by more than chance, asked of their ranks alone: one figure that a busy machine
/// has spoilt counts no more than its place in the order. Probabilities are exact, with ties, for as many
/// figures as a suite takes.
///
/// Sources  F. Wilcoxon, Individual comparisons by ranking methods (1945); H. B. Mann and D. R. Whitney
///          (1947); J. L. Hodges and E. L. Lehmann (1963); S. Holm (1979).
/// Threads  free functions, any thread.
/// Errors   none; figures that are not finite are left out.

#include "profiling/regression/spans/median.h"

#include <cstddef>
#include <vector>

namespace stadion::regression {

/// The probability, if the differences of pairs lay evenly about 0, that their signed ranks were at least as
/// lopsided (Wilcoxon, both sides). Differences of 0 say nothing. 1 of none.
double signedRankTest(const std::vector<double>& differences);

/// The probability, if a and b came from the same source, that their ranks were at least as far apart (Mann
/// and Whitney, both sides). Exact up to 80 figures in all, beyond by the normal distribution. 1 where one is
/// empty.
double rankSumTest(const std::vector<double>& a, const std::vector<double>& b);

/// The least that these tests can ever say of so many figures, however far apart.
double leastSignedRank(std::size_t differences);
double leastRankSum(std::size_t a, std::size_t b);

/// By how much paired figures differ: the median of the means of all pairs of differences (Hodges and
/// Lehmann).
double typicalShift(const std::vector<double>& differences);
/// By how much b exceeds a: the median of all differences b - a.
double typicalShift(const std::vector<double>& a, const std::vector<double>& b);

/// The same probabilities, raised so that asking several questions at once gives false alarms no more often
/// than asking one (Holm). In the given order, at most 1.
std::vector<double> correctedForMany(const std::vector<double>& probabilities);

}  // namespace stadion::regression
