#pragma once
/// Permutation tests over runs: which runs are called "now", and how else they might have been called.
///
/// If two builds do not differ, the names "before" and "now" carry no information, and every way of giving
/// them is equally likely. The probability of a difference by chance is the share of the ways with at least
/// as large a difference. No distribution of the noise is assumed. The largest difference of many quantities
/// under each way answers for all of them at once (Westfall and Young, 1993).
///
/// Threads  free functions, any thread.

#include <bitset>
#include <cstddef>
#include <vector>

namespace stadion::regression {

constexpr std::size_t kMostRuns = 160;  ///< limit of the runs of both sides together
using RunSet = std::bitset<kMostRuns>;

/// The pairing of runs.
struct RunDesign {
  std::size_t before = 0, now = 0;  ///< runs of each side
  bool paired = false;              ///< run 2r is "before" and run 2r + 1 is "now" in round r

  std::size_t runs() const { return before + now; }
  /// Returns the true labelling. Unpaired runs of "before" come first.
  RunSet trueNow() const;
};

/// Returns the sets of runs called "now": the true one first, then the others. If there are too many, some
/// are drawn at random, the same ones each time.
std::vector<RunSet> labellingsOf(const RunDesign& design);

/// The share of the values that are at least `observed`.
double shareAtLeast(const std::vector<double>& values, double observed);

}  // namespace stadion::regression
