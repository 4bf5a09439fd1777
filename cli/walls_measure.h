#pragma once
/// One setting of `stadion bench walls`, measured in this process.

#include "engine/diagnostic.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace stadion {

struct WallsSetting {
  std::string scene = "a";      ///< a, b or c (profiling/bench/walls/wall_scene.h)
  std::string kind = "STRICT";  ///< STRICT: a draw call a node; OPEN: anything that keeps the picture
  std::string mode = "pipelined";
  std::string workers = "thread";  ///< or process
  std::string gl = "osmesa";
  std::size_t walls = 4;
  bool flat = true;
  std::uint32_t width = 800, height = 600;
  std::uint64_t warm = 3, frames = 12;
  std::string pictures;  ///< beginning of the names of PPM files of the frame after the last; empty: none
};

/// The show lies in `folder` (writeWallScene) and is long enough. The object has the fields that osg_walls
/// prints; times in milliseconds.
Result<nlohmann::json> measureWalls(const WallsSetting& setting, const std::string& folder);

}  // namespace stadion
