#pragma once
/// The test patterns of a place: as files, or on its outputs until somebody presses Escape.

#include "engine/display/wall_file.h"
#include "pipeline/projection/hall_patterns.h"
#include "show/display/show_windows.h"

#include <atomic>
#include <string>

namespace stadion {

struct PatternOptions {
  HallPattern pattern = HallPattern::Room;
  std::string out;     ///< folder for files; empty = on the outputs
  bool stereo = true;  ///< of files: a picture for each eye
  WindowStereo windowStereo = WindowStereo::Mono;
  std::uint32_t width = 800, height = 600;  ///< of walls for which nothing is stated
};

/// Returns the exit code.
int showPattern(const WallFile& walls, const PatternOptions& options, const std::atomic<bool>& stop);

}  // namespace stadion
