#pragma once
/// The scenes, the room and the visitor of `stadion bench walls`, as files that a show is made of.
///
/// They are those of the OpenSceneGraph program beside (osg/osg_walls.cpp), which is +Y up: its (x, y, z) is
/// (x, -z, y) here. Everything follows from the scene's letter, so that both programs draw the same pixels.
///
/// a   10 000 lumpy spheres of 100 triangles, standing still; seen as far as 75 m
/// b   the same, every fifth moving
/// c   100 000 tetrahedra, standing still; seen as far as 25 m
///
/// Units    metres, seconds, radians; World is +Z up.
/// Threads  plain functions.

#include "engine/maths/maths.h"

#include <cstdint>
#include <string>
#include <vector>

namespace stadion::bench {

struct WallScene {
  char letter = 'a';
  bool tiny() const { return letter == 'c'; }
  std::size_t nodes() const { return tiny() ? 100'000 : 10'000; }
  double far() const { return tiny() ? 25 : 75; }  ///< [m]
  bool moves(std::size_t node) const { return letter == 'b' && node % 5 == 0; }
};

/// Where a node is, and which of the meshes it is.
struct WallNode {
  Vec3 position;
  double heading = 0;  ///< about +Z
  std::uint32_t mesh = 0;
};

constexpr std::uint32_t kWallMeshes = 16;
constexpr double kWallSceneRate = 60;  ///< frames a second of show time

/// Of the scene at rest, in order.
std::vector<WallNode> wallNodes(const WallScene& scene);
/// Where a moving one is at time t.
WallNode movedNode(const WallNode& rest, std::size_t number, double t);

/// Corners as the meshes have them, +Y up as model files are.
struct WallVertex {
  std::array<double, 3> position, normal;
  std::array<std::uint8_t, 3> colour;  ///< sRGB
};
struct WallMesh {
  std::vector<WallVertex> vertices;
  std::vector<std::uint32_t> indices;
};
WallMesh wallMesh(const WallScene& scene, std::uint32_t number);

/// Writes show.evs, show.input, room.walls and the models to the folder. `grouped`: nodes stand in square
/// cells, each with a group of its own. The visitor's way is known for `frames` frames. Returns why it could
/// not.
std::string writeWallScene(const std::string& folder, const WallScene& scene, std::size_t walls, bool grouped,
                           std::size_t frames);

}  // namespace stadion::bench
