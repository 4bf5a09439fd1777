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
/// on another and that edges which nearly meet do meet. Then it calls lintHall.
void lintWalls(const WallFile& walls, Diagnostics& out);

/// Checks screens and projectors. Expects plane screens with an area. Meshes and warps that are not loaded are
/// not checked.
///
/// Errors    a projector that lights no point of its screen.
/// Warnings  a screen without projectors, or with projectors for one eye only; a part of a screen that no
///           projector lights; projectors of one screen with different whites; a visitor outside of a screen
///           or behind it.
/// Checks the loudspeakers as well (lintLoudspeakers).
void lintHall(const WallFile& hall, Diagnostics& out);

/// The walls and screens from above (+Y is up on the page), with the visitor's eye, a scale and a list of the
/// walls, projectors and their outputs, in the words of the file. A projector is its number, or its letter,
/// where its lens is.
std::string floorPlan(const WallFile& walls, std::uint32_t columns = 60);

}  // namespace stadion
