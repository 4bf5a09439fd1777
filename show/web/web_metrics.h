#pragma once
/// Figures of a running show in the text format of Prometheus.
///
/// Units    seconds, as Prometheus recommends.
/// Threads  plain values and pure functions.
/// Sources  "Exposition formats" in the documentation of Prometheus, version 0.0.4.

#include "show/web/frame_meter.h"
#include "show/web/request_gate.h"
#include "show/web/show_board.h"

#include <string>

namespace stadion {

struct WebMetrics {
  BoardStatus status;
  MeteredFrames frames;
  GateCounts gate;
  std::uint64_t commands = 0, unauthorized = 0;
  double uptime = 0;  ///< [s]
};

std::string metricsText(const WebMetrics& metrics);

}  // namespace stadion
