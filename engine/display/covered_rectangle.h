#pragma once
/// Rectangles that stand for projectors where walls are drawn flat: floor plans, overviews, the room unfolded.
///
/// Frames   rig space. Units: metres.
/// Threads  pure functions.

#include "engine/display/screen_surface.h"
#include "engine/display/wall_file.h"

namespace stadion {

/// Returns a rectangle about as large as the part of the screen that the projector lights. On a plane screen
/// it bounds that part exactly and stands as the screen does. Otherwise it stands as the picture does and
/// faces `eye`. Nothing if no light falls on the screen.
std::optional<Wall> coveredRectangle(const Projector& projector, const ScreenSurface& surface,
                                     const Vec3& eye);

/// Gives each projector and panorama of the hall its rectangle. A projector without one, or whose screen or warp is
/// not loaded, gets a square metre before the visitor; a panorama a rectangle of its shape there.
void placeRectangles(WallFile& hall);

/// Returns true if the screen has what its kind needs: a plane has an area, a mesh is loaded.
bool isComplete(const Screen& screen);
/// Returns true if the warp is loaded, or the image needs none.
bool isComplete(const Projector& projector);

}  // namespace stadion
