#pragma once
/// A projection surface and the eyes that look at it.
///
/// Frames   R is the rig (+X right, +Y forward, +Z up, origin on the floor). H is the head: its origin midway
///          between the eyes, +X to the right ear, +Y where the face points. S is a wall's screen: origin in
///          the lower left corner, +X along the lower edge, +Y up the left edge, +Z out into the room.
/// Units    metres.
/// Threads  plain values, any thread.

#include "engine/maths/maths.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace stadion {

enum class Eye : std::uint32_t { Left = 0, Right = 1 };
constexpr std::array<Eye, 2> kEyes{Eye::Left, Eye::Right};
constexpr const char* eyeName(Eye eye) {
  return eye == Eye::Left ? "left" : "right";
}

/// The name of a wall's picture in files and reports, by number: left, right, view-3.
std::string pictureName(std::size_t number);

/// A rectangle seen from the room: three corners say where it is and which way its picture stands.
struct Wall {
  std::string name;
  Vec3 lowerLeft = Vec3::Zero();   ///< in R [m]
  Vec3 lowerRight = Vec3::Zero();  ///< in R [m]
  Vec3 upperLeft = Vec3::Zero();   ///< in R [m]

  Vec3 upperRight() const { return lowerRight + upperLeft - lowerLeft; }
  Vec3 centre() const { return 0.5 * (lowerRight + upperLeft); }
};

/// A wall's unit axes and size. Where the corners are not quite square, the lower edge counts and the left
/// one is turned until it is.
struct WallBasis {
  Vec3 right, up, normal;  ///< in R, unit; the normal points into the room
  double width = 0;        ///< [m]
  double height = 0;       ///< [m]
};

/// Expects corners that are not all on one line.
WallBasis basis(const Wall& wall);

/// X_SR: rig coordinates to the wall's screen coordinates.
Affine rigToWall(const Wall& wall);

/// Where an eye is, in R [m]. `separation` is the distance between the two [m]; 0 puts both between them.
Vec3 eyePosition(const Pose& X_RH, Eye eye, double separation);

}  // namespace stadion
