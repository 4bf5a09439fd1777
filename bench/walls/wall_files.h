#pragma once
/// A scene of `stadion bench walls` as the files of a show.
///
/// Threads  plain functions.

#include "bench/walls/wall_scene.h"

namespace stadion::bench {

/// Writes show.evs, show.input, room.walls and the models to the folder. `grouped`: nodes are in square
/// cells, each with a group of its own. The visitor's path covers `frames` frames. Returns the error if it
/// fails.
std::string writeWallScene(const std::string& folder, const WallScene& scene, std::size_t walls, bool grouped,
                           std::size_t frames);

}  // namespace stadion::bench
