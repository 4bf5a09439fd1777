#pragma once
/// The limits for every case: Stadion's errors, and its cost relative to the best other engine.

#include <string>
#include <vector>

namespace stadion::bench {

/// |metric| is at most this value. A metric that is missing or not a number is too great.
struct MetricLimit {
  std::string metric;
  double most = 0;
};

struct CostLimit {
  enum class At { Never, Steps, EqualError };
  At at = At::Never;
  double ratio = 1;       ///< limit of Stadion's cost, relative to the cheapest peer's
  int steps = 1;          ///< At::Steps: the peers' steps a frame
  std::string peers;      ///< only peers with names that begin so; empty: all
  double worstFrame = 0;  ///< like `ratio`, for the most expensive frame; 0: no limit
};

struct CaseLimits {
  std::string name;                 ///< the case's name, or the common beginning of several names
  std::vector<MetricLimit> errors;  ///< limits for every Stadion setting
  std::vector<MetricLimit> finest;  ///< limits for at least one Stadion setting
  CostLimit cost;
  std::vector<MetricLimit> finished;  ///< a peer counts as finished only if it keeps these
};

/// Returns the row with the longest name that `caseName` begins with; null if there is none.
const CaseLimits* limitsFor(const std::string& caseName);

}  // namespace stadion::bench
