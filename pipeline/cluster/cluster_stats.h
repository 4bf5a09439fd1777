#pragma once
/// What a host of a cluster has sent, and how long it has waited.
///
/// Threads  plain values.

#include "pipeline/frame/frame_times.h"

#include <cstdint>

namespace stadion::cluster {

struct ClusterStats {
  std::uint64_t orders = 0, orderBytes = 0, mostOrderBytes = 0;
  /// Waits of frames for which all others waited for this host: from the end of its drawing to the permission
  /// to show [ms].
  DurationSeries barrier;
  std::uint64_t leftOut = 0, joined = 0, compared = 0, differed = 0, stopped = 0;
};

}  // namespace stadion::cluster
