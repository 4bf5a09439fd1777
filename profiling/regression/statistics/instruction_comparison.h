#pragma once
/// Compares instructions of two builds, or of one and its baseline. They are almost equal in every run, so
/// one run of each is enough, even on a busy machine.
///
/// Threads  free functions, any thread.

#include "profiling/regression/spans/result.h"
#include "profiling/regression/spans/span_record.h"
#include "profiling/regression/statistics/node_cost_comparison.h"

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace stadion::regression {

constexpr double kFewest = 20'000;  ///< instructions a frame: a stage with fewer is not judged

struct InstructionShift {
  std::string name;            ///< name of the stage
  double before = 0, now = 0;  ///< a frame
  bool more = false, fewer = false;
  std::string culprit{};  ///< if there are more: the node in the stage that changed, or that none did

  /// Infinite if there were none before.
  double shift() const { return now == before ? 0 : before > 0 ? now / before - 1 : HUGE_VAL; }
};

/// The stages' instructions a frame, by name.
std::map<std::string, double> stageInstructions(const std::vector<SpanRow>& rows);

/// The earlier counts: of stages by name, and of their nodes if known.
struct InstructionCounts {
  std::map<std::string, double> stages;
  CostsByNode nodes;
};
InstructionCounts instructionCounts(const std::vector<SpanRow>& rows);

/// `tolerance`: [1].
std::vector<InstructionShift> compareInstructions(const InstructionCounts& before,
                                                  const std::vector<SpanRow>& now, double tolerance);
std::vector<Check> checksOf(const std::vector<InstructionShift>& shifts, const std::string& with,
                            double tolerance);

}  // namespace stadion::regression
