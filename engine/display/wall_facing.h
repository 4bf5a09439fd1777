#pragma once
/// Which walls of a room face away from it.
///
/// A point in front of every wall shows that all walls face the room: the standing visitor's eye, or a point
/// between the walls' corners. The mean of the walls' centres shows nothing: one wall can stand before
/// another. Without such a point, each group of walls that meet at their edges is a room of its own.
///
/// Frames   rig space (+X right, +Y forward, +Z up).
/// Units    metres.
/// Threads  pure functions.

#include "engine/display/wall_file.h"

#include <vector>

namespace stadion {

enum class Facing {
  Room,   ///< faces the room, or nothing shows that it does not
  Away,   ///< mirroring such walls makes a room
  Unsure  ///< no point is in front of every wall, and this one is a reason
};

/// Returns the facing of each wall. Expects walls with an area.
std::vector<Facing> facingOf(const std::vector<WallEntry>& walls, const Vec3& standingEye);

}  // namespace stadion
