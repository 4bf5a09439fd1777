#pragma once
/// `stadion walls FILE --adjust`: moves corner pins and edges of ramps while the pattern shows.

#include "engine/display/wall_file.h"
#include "pipeline/projection/hall_patterns.h"
#include "show/display/show_windows.h"

#include <atomic>
#include <string>

namespace stadion {

struct AdjustOptions {
  HallPattern pattern = HallPattern::Room;
  std::string out;        ///< folder for what `show` writes; empty: none
  bool commands = false;  ///< no windows: commands come from standard input alone
  WindowStereo windowStereo = WindowStereo::Mono;
  std::uint32_t width = 800, height = 600;  ///< of walls for which nothing is stated
};

/// Returns the exit code.
int adjustWalls(const WallFile& walls, const AdjustOptions& options, const std::atomic<bool>& stop);

}  // namespace stadion
