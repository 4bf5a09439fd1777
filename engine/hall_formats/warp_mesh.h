#pragma once
/// Warp meshes: triangles of an output, each with the part of a source picture that it shows.
///
/// Units    shares of the output's, or of the source's, width and height from the upper left corner.
/// Threads  plain values and pure functions.

#include "engine/display/projector.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

struct WarpMesh {
  static constexpr std::size_t kMostVertices = 4U << 20;
  static constexpr std::size_t kMostTriangles = 8U << 20;

  struct Vertex {
    Vec2 at = Vec2::Zero();      ///< in the output
    Vec2 source = Vec2::Zero();  ///< in the source picture
    double light = 1;            ///< share of the light, from 0 to 1
  };
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< numbers of vertices
};

/// A view that a warp file states for its source picture.
struct WarpView {
  Quat q_RP = Quat::Identity();                  ///< axes as in projector.h
  double left = 0, right = 0, up = 0, down = 0;  ///< angles from the axis [rad]; left and down below 0
  Vec3 eye = Vec3::Zero();                       ///< in R [m]
  bool hasEye = false;
};

/// Where a uniform grid over the output shows what: point (c, r) belongs to the share
/// ((c + 0.5) / columns, (r + 0.5) / rows) of the output.
struct SourceGrid {
  std::uint32_t columns = 0, rows = 0;
  std::vector<Vec2> source;   ///< (rows x columns), from the upper left; NaN: nothing is shown
  std::vector<double> light;  ///< (rows x columns), from 0 to 1
};

/// Makes triangles between neighbours of a grid of `columns` x `rows` vertices that are in row order.
void addGridTriangles(WarpMesh& mesh, std::size_t columns, std::size_t rows);

/// Interpolates the mesh linearly at the points of a grid. Of triangles that overlap, the last one counts.
/// Nothing if the triangles overlap so much that this takes too long.
std::optional<SourceGrid> sampleWarp(const WarpMesh& mesh, std::uint32_t columns, std::uint32_t rows);

/// Returns the light of the grid as a map; nothing if it is 1 everywhere that something is shown.
std::optional<LightMap> lightOf(const SourceGrid& grid);

/// Returns how fine a grid has to be for an output of so many pixels.
std::array<std::uint32_t, 2> gridSizeFor(std::uint32_t width, std::uint32_t height);

}  // namespace stadion
