#pragma once
/// Cost of one step of one body on each rung, measured in turns, so that other load affects all alike.

#include "bench/flight/checks.h"

#include <string>
#include <vector>

namespace stadion::bench {

struct StepCost {
  std::string rung;
  double ns = 0;          ///< cost for one body, median over the rounds [ns]
  double batch = 0;       ///< cost for a body in a swarm of 1000 [ns]; 0 without a swarm
  double ofFree = 0;      ///< ratio to the force-free step's time in the same round, median over the rounds
  double ofBias = 0;      ///< ratio to the paper's bias step
  double batchOfOne = 0;  ///< ratio of `batch` to the paper's bias step
};

struct Costs {
  std::vector<StepCost> steps;
  Checks checks;
};
/// Measures `rounds` of some 20 microseconds for each; at least 1.
Costs measureCosts(int rounds);

}  // namespace stadion::bench
