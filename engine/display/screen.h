#pragma once
/// Screens: the surfaces on which projectors throw their pictures.
///
/// Frames   R is the rig (+X right, +Y forward, +Z up, origin on the floor).
/// Units    metres and radians. An azimuth is 0 forward (+Y) and grows to the right, as on a compass.
/// Threads  plain values, any thread.

#include "engine/display/wall.h"

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace stadion {

/// A part of an upright cylinder, seen from inside.
struct CylinderScreen {
  Vec3 centre = Vec3::Zero();  ///< on the axis, in R [m]
  double radius = 0;           ///< [m]
  double left = 0, right = 0;  ///< azimuth of its left and right edge [rad]; left < right <= left + 2 pi
  double bottom = 0, top = 0;  ///< height of its edges above `centre` [m]
};

/// A part of a sphere, seen from inside. Azimuth and elevation are those of a point before the tilt.
struct SphereScreen {
  Vec3 centre = Vec3::Zero();      ///< in R [m]
  double radius = 0;               ///< [m]
  double left = 0, right = 0;      ///< azimuth of its edges [rad]; left < right <= left + 2 pi
  double lowest = 0, highest = 0;  ///< elevation of its edges above the horizon [rad], from -pi/2 to pi/2
  double tilt = 0;                 ///< turn about the rig's X axis: what is overhead comes forward [rad]
};

/// Triangles, seen from either side.
struct MeshScreen {
  std::string file;          ///< as the user named it
  std::vector<Vec3> points;  ///< in R [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

struct Screen {
  std::string name;
  std::variant<Wall, CylinderScreen, SphereScreen, MeshScreen> surface;
  std::uint32_t line = 0;    ///< in the file; 0 = made by a program
  std::uint32_t column = 0;  ///< column of its name
  std::string excerpt;       ///< the line, for messages
};

}  // namespace stadion
