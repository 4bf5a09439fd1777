#pragma once
/// Merging the traces of a cluster's hosts, for `stadion merge-traces` and `stadion cluster`.

#include "profiling/trace/trace_merge.h"

#include <string>
#include <vector>

namespace stadion {

/// False, with the reason on stderr, if there is no merged trace.
bool writeMergedTrace(const std::vector<TraceOfHost>& traces, const std::string& file);

}  // namespace stadion
