#pragma once
/// How durations are distributed: marks and a histogram that shows them.
///
/// Units  milliseconds. Threads  plain values.

#include <vector>

namespace stadion {

struct Distribution {
  double mean = 0, median = 0, p95 = 0, p99 = 0, most = 0;
  double from = 0, step = 0;      ///< bins are [from + i step, from + (i + 1) step)
  std::vector<std::size_t> bins;  ///< the last one holds what is beyond as well
  std::size_t count = 0;
};

/// Percentiles are by nearest rank. The bins end a little beyond p99, so that a few that took long do not
/// press the others together.
Distribution distributionOf(std::vector<float> durations);

}  // namespace stadion
