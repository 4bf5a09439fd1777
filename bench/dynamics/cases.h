#pragma once
/// The cases C01 to C15, exactly defined. Each family has a file of its own.

#include "bench/dynamics/case_run.h"

namespace stadion::bench {

struct Case {
  std::string name;
  std::function<void(Outcome&)> play;
  std::vector<int> steps;  ///< steps a frame to measure at
  int repetitions = 1;     ///< in one measurement; the median cost counts
};

using CaseList = std::vector<Case>;

const std::vector<int>& everyStep();   ///< 1 2 4 8 16
const std::vector<int>& threeSteps();  ///< 1 4 16
const std::vector<int>& oneStep();     ///< 1

void addFlightCases(CaseList& list);    ///< C01 ballistic, C02 quadratic drag
void addSpinCases(CaseList& list);      ///< C03 Dzhanibekov, C04 fast spinners
void addBounceCases(CaseList& list);    ///< C05 on a plane, C06 on a mesh
void addSlideCases(CaseList& list);     ///< C07 sliding box, C08 tipping block
void addThinWallCases(CaseList& list);  ///< C09 fast bodies against a thin wall
void addStackCases(CaseList& list);     ///< C10 stacks and mass ratios
void addRollCases(CaseList& list);      ///< C11 from slipping to rolling
void addChainCases(CaseList& list);     ///< C12 cradles, balls in a box
void addHostileCases(CaseList& list);   ///< C13 degenerate and hostile input
void addCrowdCases(CaseList& list);     ///< C14 a pile, C15 a swarm

/// Returns all cases in order.
CaseList allCases();

}  // namespace stadion::bench
