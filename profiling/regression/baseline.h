#pragma once
/// The results of a suite when its baseline was written: stored beside the suite for later comparisons.
///
/// Units    times in multiples of the calibration kernel's (calibration.h), so that a faster or busier
///          machine changes little; instructions a frame.
/// Threads  plain values, any thread.
/// Errors   a file that is no baseline is refused with its name and the error. Version 2 is written; version
///          1, which keeps no frames, is read, too.

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
  std::string states;  ///< state hashes of frames, shortened; empty in older files
  std::map<std::uint64_t, std::string>
      fields;  ///< fields of nodes after some frames, by frame; absent in older files
  std::map<std::string, std::vector<double>> times;  ///< by stage, round by round
  KeptStages frames;  ///< times of all frames in these rounds; absent in files of version 1
  std::map<std::string, double> instructions;  ///< by stage
  std::string countedBy = "callgrind";         ///< the source of the instructions
  CostsByNode nodeTimes, nodeInstructions;     ///< to name the node that changed
};

using Baseline = std::map<std::string, BaselineCase>;  ///< by playedName

Result<Baseline> readBaseline(const std::string& path);
std::string toJson(const Baseline& baseline);

/// Adds the results of a run of the case. For a known case, metrics that are not in `asked` stay as they
/// were. Times and instructions are removed if they are in `asked` and the case no longer compares them.
void takeUp(const RunFacts& found, const Metrics& asked, const SuiteCase& played, const std::string& name,
            Baseline& baseline);
/// Returns cases that the suite lacks, or has with other settings, by playedName.
std::vector<std::string> othersThan(const Suite& suite, const Baseline& baseline);

/// SUITE.suite -> SUITE.baseline.json
std::string baselineBeside(const std::string& suiteFile);

}  // namespace stadion::regression
