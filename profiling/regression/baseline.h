#pragma once
/// What a suite found when its baseline was written: to be kept beside the suite and compared with later.
///
/// Units    times in multiples of the calibration kernel's (calibration.h), so that a faster machine, or a
///          busier one, changes little; instructions a frame.
/// Threads  plain values, any thread.
/// Errors   a file that is none is refused with its name and what is wrong. Version 2 is written; version 1,
///          which keeps no frames, is read, too.

#include "engine/base/diagnostic.h"
#include "profiling/regression/spans/facts.h"
#include "profiling/regression/statistics/kept_frames.h"
#include "profiling/regression/statistics/node_cost_comparison.h"
#include "profiling/regression/suite.h"

#include <map>
#include <string>
#include <vector>

namespace stadion::regression {

struct BaselineCase {
  RunFacts facts;
  std::map<std::string, std::vector<double>> times;  ///< by stage, round by round
  KeptStages frames;                          ///< of these rounds; files of version 1 have none
  std::map<std::string, double> instructions;        ///< by stage
  std::string countedBy = "callgrind";               ///< the instructions
  CostsByNode nodeTimes, nodeInstructions;           ///< so that the node that moved can be named
};

using Baseline = std::map<std::string, BaselineCase>;  ///< by playedName

Result<Baseline> readBaseline(const std::string& path);
std::string toJson(const Baseline& baseline);

/// Takes up what a run of the case found. Of a case that is known already, metrics that are not `asked` for
/// stay as they were; times and instructions go if they are, and the case compares them no more.
void takeUp(const RunFacts& found, const Metrics& asked, const SuiteCase& played, const std::string& name,
            Baseline& baseline);
/// Cases that the suite has not, or not so, by playedName.
std::vector<std::string> othersThan(const Suite& suite, const Baseline& baseline);

/// SUITE.suite -> SUITE.baseline.json
std::string baselineBeside(const std::string& suiteFile);

}  // namespace stadion::regression
