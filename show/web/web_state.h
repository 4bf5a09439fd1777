#pragma once
/// The state of a show as the page's script reads it.
///
/// Threads  plain values and pure functions.

#include "show/web/frame_meter.h"
#include "show/web/show_board.h"
#include "show/web/web_log.h"

#include <string>
#include <vector>

namespace stadion {

struct WebState {
  BoardStatus status;
  MeteredFrames frames;
  std::vector<std::vector<std::uint64_t>>
      pictures;                              ///< by wall and view: number of its newest picture; 0: none
  std::uint64_t lastLine = 0, lastLate = 0;  ///< numbers of the newest lines
  double uptime = 0;                         ///< [s]
};

/// How a wall does, from what was measured: "well", "late" if its Draw takes longer than a frame may, "silent" if it
/// has drawn nothing for two seconds, "unknown" if nothing is measured.
std::string healthOf(std::uint32_t wall, double rate, const MeteredFrames& frames);

/// "waiting", "paused", "playing", "opening" or "over".
std::string phaseName(const BoardStatus& status);

std::string toJson(const WebState& state);
std::string linesJson(const std::vector<WebLogLine>& lines);

}  // namespace stadion
