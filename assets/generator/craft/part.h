#pragma once
/// Coloured surfaces, from which the models of Olympia are built, and the file format of the models.
///
/// Frames   +X right, +Y forward, +Z up. Triangles are counter-clockwise seen from outside.
/// Units    metres; colours are sRGB from 0 to 1.

#include "assets/generator/craft/geometry.h"

#include <functional>

namespace stadion::assets {

using Rgb = Point;  ///< red, green, blue

struct Vertex {
  Point p;
  Rgb colour{1, 1, 1};         ///< multiplies the picture
  std::array<double, 2> uv{};  ///< in pictures' widths
  Point n{0, 0, 0};            ///< unit; zero = the reader of the file makes smooth normals
};

/// The material of a part.
struct Finish {
  std::string name;
  std::string picture;      ///< file beside the model; empty = none
  double roughness = 0.95;  ///< 0 mirror .. 1 matt
  double metallic = 0;
};

struct Part {
  Finish finish;
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

using Parts = std::vector<Part>;

/// Stretches, then turns about Z, then moves.
struct Placement {
  Point at{0, 0, 0};
  double yaw = 0;  ///< [rad]
  Point size{1, 1, 1};
};

/// Appends `from` to `to`, which keeps its finish.
void add(Part& to, const Part& from, const Placement& place = {});
/// Appends a quadrilateral, counter-clockwise, with corners of its own.
void addQuad(Part& to, const std::array<Vertex, 4>& corners);
/// Removes triangles without area.
void dropFlat(Part& part);
/// Sets every vertex's colour to a function of the vertex.
void paint(Part& part, const std::function<Rgb(const Vertex&)>& colour);
/// Projects the picture from the sides that the triangles face, `metres` a width.
void layPicture(Part& part, double metres);

/// A box; every face has corners of its own.
Part box(Point low, Point high);

struct Turning {
  double r, z;  ///< [m] a point of the outline
};
/// A body of revolution about Z. The outline goes from the bottom upwards; ends with r = 0 are closed.
Part lathe(const std::vector<Turning>& outline, int sides);

/// A level ellipse.
struct Slice {
  Point at;       ///< its middle
  double rx, ry;  ///< [m]
};
/// A closed body with these cross sections, from the lowest upwards.
Part loft(const std::vector<Slice>& slices, int sides);
/// A closed tube from a to b.
Part limb(Point a, Point b, double ra, double rb, int sides);

/// A sphere of radius 1 of 20 * 4^divisions triangles.
Part sphere(int divisions);

/// A flat grid from `low` to `high`, facing up.
Part grid(std::array<double, 2> low, std::array<double, 2> high, int columns, int rows);

/// Binary glTF 2.0: one mesh of all parts. Parts of one finish share a material.
std::string toGlb(const Parts& parts);

}  // namespace stadion::assets
