#pragma once
/// What one step of one body costs each rung: measured in turns, so that what else the machine does falls on
/// all alike.

#include "profiling/bench/flight/checks.h"

#include <string>
#include <vector>

namespace stadion::bench {

struct StepCost {
  std::string rung;
  double ns = 0;          ///< one body, median over the rounds [ns]
  double batch = 0;       ///< the same in a swarm of 1000; 0 if there are no swarms of it
  double ofFree = 0;      ///< median over the rounds of its time to the force-free step's in the same round
  double ofBias = 0;      ///< the same to the paper's bias step's
  double batchOfOne = 0;  ///< the same of the swarm's to its own
};

struct Costs {
  std::vector<StepCost> steps;
  Checks checks;
};
/// `rounds` of some 20 microseconds for each; at least 1.
Costs measureCosts(int rounds);

}  // namespace stadion::bench
