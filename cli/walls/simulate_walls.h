#pragma once
/// `stadion walls FILE --simulate`: what a visitor sees in a hall.

#include "engine/display/wall_file.h"

#include <cstdint>
#include <string>
#include <vector>

namespace stadion {

struct SimulateOptions {
  std::string out;  ///< folder for pictures; empty: none
  bool json = false;
  std::uint64_t heads = 1, every = 4;
  std::vector<std::string> moved;       ///< NAME X Y Z, in the unit of the file
  std::vector<std::string> wrongGamma;  ///< NAME G
};

/// Returns the exit code.
int simulateWalls(const WallFile& walls, const SimulateOptions& options);

}  // namespace stadion
