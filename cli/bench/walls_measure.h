#pragma once
/// One setting of `stadion bench walls`, measured in this process.

#include "bench/walls/wall_scene.h"
#include "engine/base/diagnostic.h"
#include "pipeline/loop/frame_loop.h"
#include "show/player/show_renderer.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace stadion {

struct WallsSetting {
  std::string scene = "a";      ///< a, b or c (bench/walls/wall_scene.h)
  std::string kind = "STRICT";  ///< STRICT: a draw call a node; OPEN: anything that keeps the picture
  Mode mode = Mode::Pipelined;
  std::size_t mostInFlight = 1;    ///< limit of frames in flight (FrameLoopOptions)
  std::string drawnBy = "thread";  ///< or process
  std::string without;             ///< OPEN, SUBMIT: without this trick, "unseen" or "small"; empty: with all
  RendererSettings renderer{};
  std::string pace = "free";          ///< or lock: frames begin on ticks of 1/60 s
  std::size_t nodes = 0, moving = 0;  ///< for curves; 0: as the scene has them
  double far = 0;                     ///< [m]; 0: as the scene has it
  std::size_t walls = 4;
  bool flat = true;
  std::uint32_t width = 800, height = 600;
  std::uint64_t warm = 3, frames = 12;
  std::string pictures;  ///< beginning of the names of PPM files of the frame after the last; empty: none
};

bench::WallScene sceneOf(const WallsSetting& setting);

/// Why its pictures cannot be written, to be asked before anything is measured; empty: they can, or none are.
std::string unwritable(const WallsSetting& setting);

/// The show lies in `folder` (writeWallScene) and is long enough. The object has the fields that osg_walls
/// prints; times in milliseconds.
Result<nlohmann::json> measureWalls(const WallsSetting& setting, const std::string& folder);

/// How even the ticks of this machine are: a loop that only waits for each of `frames`.
nlohmann::json measureTicks(std::uint64_t frames);

}  // namespace stadion
