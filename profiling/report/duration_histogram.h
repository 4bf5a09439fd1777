#pragma once
/// The distribution of durations: percentiles and a histogram.
///
/// Units    milliseconds.
/// Threads  plain values.

#include <vector>

namespace stadion {

struct DurationHistogram {
  double mean = 0, median = 0, p95 = 0, p99 = 0, most = 0;
  double from = 0, step = 0;      ///< bins are [from + i step, from + (i + 1) step)
  std::vector<std::size_t> bins;  ///< the last one also holds all larger values
  std::size_t count = 0;
};

/// Percentiles are by nearest rank. The bins end a little beyond p99, so that a few long durations do not
/// compress the others.
DurationHistogram durationHistogramOf(std::vector<float> durations);

}  // namespace stadion
