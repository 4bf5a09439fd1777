#pragma once
/// The show's own models, in metres, +X right, +Y forward, +Z up, and the files they are written to.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace stadion::assets {

struct Point {
  double x, y, z;
};
inline Point operator+(Point a, Point b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Point operator-(Point a, Point b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Point operator*(double s, Point a) {
  return {s * a.x, s * a.y, s * a.z};
}

struct Paint {
  std::string name;                    ///< at most 16 characters
  std::array<std::uint8_t, 3> colour;  ///< sRGB
  std::string picture;                 ///< file beside the model, 8.3 characters; empty = none
  int gloss = 10;                      ///< [%] 0 matt .. 100 mirror
};

struct Triangle {
  std::array<std::uint32_t, 3> corner;  ///< counter-clockwise seen from outside
  std::uint32_t paint;
};

struct Model {
  std::string name;  ///< at most 10 characters
  std::vector<Point> points;
  std::vector<std::array<float, 2>> uvs;  ///< one a point, v upwards, or empty
  std::vector<Triangle> triangles;
  std::vector<Paint> paints;
};

/// A ball of radius 0.11 m that rests on the origin: a truncated icosahedron's twelve black pentagons and
/// twenty white hexagons with a seam between them. Closed; every vertex lies on the sphere.
Model football();

/// A field of 140 x 140 m at z = 0 with a marked pitch of 68 x 105 m, long side forward, centred on the
/// origin. One layer without overlaps: stripes and lines are triangles of their own.
Model pitch();

/// The grass that the pitch wears, 4 x 4 m, as a PNG file. It repeats without a seam.
std::string grassPicture();

/// A boot, a sock and a knee: closed, 0.28 m from heel to toe, toes forward, standing on z = 0.
Model crudeFoot();

/// The bytes of a 3D Studio file. Expects fewer than 65536 points and triangles.
std::string to3ds(const Model& model);

struct ObjFile {
  std::string obj, mtl;
};
/// Wavefront files with +Y up, as OBJ files are read unless a script says otherwise.
ObjFile toObj(const Model& model, const std::string& fileName);

}  // namespace stadion::assets
