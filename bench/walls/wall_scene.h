#pragma once
/// The scenes of `stadion bench walls`: their nodes and meshes.
///
/// They match the OpenSceneGraph program (osg/osg_walls.cpp), which is +Y up: its (x, y, z) is (x, -z, y)
/// here. Everything follows from the scene's letter, so that all programs draw the same pixels.
///
/// a   10 000 lumpy spheres of 100 triangles, standing still; viewing distance 75 m
/// b   the same, every fifth moving
/// c   100 000 tetrahedra, standing still; viewing distance 25 m
///
/// Units    metres, seconds, radians; World is +Z up.
/// Threads  plain functions.

#include "engine/maths/maths.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace stadion::bench {

struct WallScene {
  char letter = 'a';
  // For curves over the number of nodes; 0: given by the letter.
  std::size_t count = 0, moving = 0;
  double reach = 0;  ///< [m]

  bool tiny() const { return letter == 'c'; }
  std::size_t nodes() const { return count ? count : tiny() ? 100'000 : 10'000; }
  double far() const { return reach > 0 ? reach : tiny() ? 25 : 75; }  ///< [m]
  bool moves(std::size_t node) const {
    if (moving) return node % std::max<std::size_t>(1, nodes() / moving) == 0;
    return letter == 'b' && node % 5 == 0;
  }
};

/// A node's place and mesh.
struct WallNode {
  Vec3 position;
  double heading = 0;  ///< about +Z
  std::uint32_t mesh = 0;
};

constexpr std::uint32_t kWallMeshes = 16;
constexpr double kWallSceneRate = 60;  ///< frames a second of show time

/// Returns the nodes of the scene at rest, in order.
std::vector<WallNode> wallNodes(const WallScene& scene);
/// Returns the place of a moving node at time t.
WallNode movedNode(const WallNode& rest, std::size_t number, double t);
/// From +Y up to +Z up.
inline Vec3 raised(double x, double y, double z) {
  return {x, -z, y};
}

/// Vertices as in the meshes, +Y up as in model files.
struct WallVertex {
  std::array<double, 3> position, normal;
  std::array<std::uint8_t, 3> colour;  ///< sRGB
};
struct WallMesh {
  std::vector<WallVertex> vertices;
  std::vector<std::uint32_t> indices;
  double radius() const;  ///< radius of the sphere about the origin that holds the mesh [m]
};
WallMesh wallMesh(const WallScene& scene, std::uint32_t number);

}  // namespace stadion::bench
