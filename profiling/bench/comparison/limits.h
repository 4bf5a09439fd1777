#pragma once
/// What has to hold on every case: how far off Stadion may be, and what it may cost beside the best other
/// engine.

#include <string>
#include <vector>

namespace stadion::bench {

/// |metric| is at most that. A metric that is missing or not a number is too great.
struct MetricLimit {
  std::string metric;
  double most = 0;
};

struct CostLimit {
  enum class At { Never, Steps, EqualError };
  At at = At::Never;
  double ratio = 1;       ///< of Stadion's cost to the cheapest peer's
  int steps = 1;          ///< At::Steps: the peers' steps a frame
  std::string peers;      ///< only those whose names begin so; empty: all
  double worstFrame = 0;  ///< like `ratio`, of the dearest frame; 0: no limit
};

struct CaseLimits {
  std::string name;                 ///< the case's, or how the names of several begin
  std::vector<MetricLimit> errors;  ///< of every setting of Stadion's
  std::vector<MetricLimit> finest;  ///< of at least one
  CostLimit cost;
  std::vector<MetricLimit> finished;  ///< a peer has played the case to the end only if it keeps these
};

/// The row with the longest name that `caseName` begins with; null if there is none.
const CaseLimits* limitsFor(const std::string& caseName);

}  // namespace stadion::bench
