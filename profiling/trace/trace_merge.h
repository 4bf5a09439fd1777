#pragma once
/// Merges the traces of the hosts of a cluster into one, in which each host is a process.
///
/// The hosts' clocks differ. All hosts show a frame together, so their clocks are aligned by the ends of
/// their swaps: by the median over all common frames. A constant lag of one host's swap is thus not visible.
///
/// Memory   the time of each frame of each host; the files are read line by line.
/// Threads  plain functions.
/// Errors   a file that is no trace of Stadion, or cannot be read or written.

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace stadion {

struct TraceOfHost {
  std::string host, file;
};

struct AlignedHost {
  std::string host;
  double shiftUs = 0;            ///< added to its times, relative to the first host [us]
  std::size_t commonFrames = 0;  ///< frames by which the host is aligned; 0: not aligned
};

/// Writes the merged trace into `file`. Expects at least one trace.
Result<std::vector<AlignedHost>> mergeTraces(std::span<const TraceOfHost> traces, const std::string& file);

/// "trace-front.json", "trace-left.json": the hosts front and left.
std::vector<TraceOfHost> tracesOf(const std::vector<std::string>& files);

}  // namespace stadion
