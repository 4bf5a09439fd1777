#pragma once
/// The room of `stadion bench walls`, its moving platform, and the visitor in it.
///
/// Frames   World and room +Z up; an eye looks along -Z, as in OpenGL.
/// Units    metres, seconds, radians.
/// Threads  plain functions.

#include "bench/walls/wall_scene.h"

namespace stadion::bench {

constexpr double kWallNear = 0.1;             ///< [m]
constexpr double kWallEyeSeparation = 0.065;  ///< [m]

struct RoomWall {
  const char* name;
  Vec3 lowerLeft, lowerRight, upperLeft;  ///< in the room
};
/// All six; a room of n walls has the first n.
const std::array<RoomWall, 6>& roomWalls();

Pose platformAt(double t);           ///< room to World
double platformHeadingAt(double t);  ///< about +Z
Vec3 headAt(double t);               ///< in the room
double headHeadingAt(double t);

/// The view of an eye on a wall.
struct WallView {
  Mat4 projection;  ///< eye to clip coordinates
  Mat4 view;        ///< World to eye
};
/// `eye`: 0 left, 1 right.
WallView wallView(const WallScene& scene, std::size_t wall, int eye, double t);

}  // namespace stadion::bench
