#pragma once
/// What is wrong with the geometry of a wall file, and a picture of it in letters.
///
/// Frames   rig space (+X right, +Y forward, +Z up).
/// Units    metres.
/// Threads  pure functions.
/// Errors   findings go to the Diagnostics, each at its wall's line and with the way to mend it. Errors would
///          give wrong pictures; warnings may be meant (frames between the screens of a display wall).

#include "engine/display/wall_file.h"

namespace stadion {

/// A visitor of average height in the middle of the room.
inline const Vec3 kStandingEye{0, 0, 1.7};

/// Checks, per wall: that it has an area, a size of metres rather than millimetres, a right angle between its
/// edges, that it faces the room and that the standing eye is in front of it; between walls: that none lies
/// on another and that edges which nearly meet do meet.
void lintWalls(const WallFile& walls, Diagnostics& out);

/// The walls from above (+Y is up on the page), with the standing eye, a scale and a list of the walls and
/// their outputs, in the words of the file.
std::string floorPlan(const WallFile& walls, std::uint32_t columns = 60);

}  // namespace stadion
