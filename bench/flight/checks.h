#pragma once
/// Conditions that must hold, and their results.

#include <limits>
#include <string>
#include <vector>

namespace stadion::bench {

struct Check {
  std::string what;
  double value = 0;
  double most = std::numeric_limits<double>::infinity();
  double least = -std::numeric_limits<double>::infinity();
  std::string unit;

  bool met() const { return value >= least && value <= most; }
};

using Checks = std::vector<Check>;

}  // namespace stadion::bench
