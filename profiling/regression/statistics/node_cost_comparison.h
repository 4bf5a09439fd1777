#pragma once
/// What the nodes of each stage cost, as a baseline keeps it: enough to name the node that moved when a stage
/// did.
///
/// Units    instructions a frame, or the typical frame's time in multiples of the calibration kernel's.
/// Threads  free functions, any thread.

#include "profiling/regression/spans/span_record.h"

#include <map>
#include <string>
#include <vector>

namespace stadion::regression {

/// By the stage's name ("app"), then by SpanRow::node().
using CostsByNode = std::map<std::string, std::map<std::string, double>>;

/// Of its stage: what costs less is not kept, and counts as so much when it is asked for.
constexpr double kLeastKept = 0.001;

/// The instructions of the rows that are of nodes.
CostsByNode nodeInstructions(const std::vector<SpanRow>& rows);

/// Those of nodes that make some of their stage.
CostsByNode dearOf(const CostsByNode& costs, const std::map<std::string, double>& stages);

/// Where a stage was dearer by `growth` than its `before`: the node in it that grew most, as the rows name
/// it, if that explains half; else says so. The stage's name if nothing is known of its nodes.
std::string culpritSince(const std::string& stage, double before, double growth,
                         const CostsByNode& nodesBefore, const CostsByNode& nodesNow,
                         const std::vector<SpanRow>& rows);

}  // namespace stadion::regression
