#pragma once
/// The costs of each stage's nodes in a baseline: enough to name the node that changed when a stage did.
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

/// Part of its stage below which a node is not kept; a missing node counts as this much.
constexpr double kLeastKept = 0.001;

/// Returns the instructions of the rows of nodes.
CostsByNode nodeInstructions(const std::vector<SpanRow>& rows);

/// Returns the nodes with a noticeable part of their stage.
CostsByNode noticeableNodes(const CostsByNode& costs, const std::map<std::string, double>& stages);

/// For a stage that grew by `growth` from `before`: returns the node that grew most, as the rows name it, if
/// it explains half of the growth; else says so. Returns the stage's name if its nodes are unknown.
std::string culpritSince(const std::string& stage, double before, double growth,
                         const CostsByNode& nodesBefore, const CostsByNode& nodesNow,
                         const std::vector<SpanRow>& rows);

}  // namespace stadion::regression
