#include "bench/dynamics/cases.h"

namespace stadion::bench {

const std::vector<int>& everyStep() {
  static const std::vector<int> steps{1, 2, 4, 8, 16};
  return steps;
}

const std::vector<int>& threeSteps() {
  static const std::vector<int> steps{1, 4, 16};
  return steps;
}

const std::vector<int>& oneStep() {
  static const std::vector<int> steps{1};
  return steps;
}

CaseList allCases() {
  CaseList list;
  addFlightCases(list);
  addSpinCases(list);
  addBounceCases(list);
  addSlideCases(list);
  addThinWallCases(list);
  addStackCases(list);
  addRollCases(list);
  addChainCases(list);
  addHostileCases(list);
  addCrowdCases(list);
  return list;
}

}  // namespace stadion::bench
