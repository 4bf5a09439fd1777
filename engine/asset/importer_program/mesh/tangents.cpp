#include "engine/asset/importer_program/mesh/tangents.h"

#include "engine/asset/importer_program/mesh/vertex_set.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stadion::importer {
namespace {

Vec3 vectorOf(const std::array<float, 3>& v) {
  return {double{v[0]}, double{v[1]}, double{v[2]}};
}

bool lacksTangent(const FlatVertex& v) {
  return v.tangent[0] == 0 && v.tangent[1] == 0 && v.tangent[2] == 0;
}

/// How a triangle's picture lies on it: where u and v (downwards) grow, not of unit length; zero if it has no area.
struct PictureAxes {
  Vec3 along = Vec3::Zero(), down = Vec3::Zero();
};

class TangentMaker {
public:
  TangentMaker(const std::vector<Material>& materials, Flat& flat)
      : materials_(materials), flat_(flat), set_(flat.vertices.size()) {}

  void make() {
    for (std::uint32_t t = 0; t < flat_.triangles.size(); ++t)
      if (const MaterialMap* map = mapOf(flat_.triangles[t])) addTriangle(t, *map);
    if (corners_.empty()) return;
    flat_.hasTangents |= std::ranges::any_of(sums_, [](const Vec3& sum) { return sum.norm() > kLeastSum; });
    vertices_.assign(sums_.size(), kNone);
    for (const Corner& corner : corners_)
      flat_.triangles[corner.triangle].corner[corner.number] = vertexOf(corner);
  }

private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  static constexpr double kLeastSum = 1e-9;  ///< less is no direction
  struct Corner {
    std::uint32_t triangle, number, group;
  };

  const MaterialMap* mapOf(const FlatTriangle& t) const {
    if (t.material >= materials_.size()) return nullptr;
    const MaterialMap& map = materials_[t.material].maps[kNormalMap];
    return map.given() ? &map : nullptr;
  }

  std::array<double, 2> coordinatesAt(const FlatVertex& v, const MaterialMap& map) const {
    const auto& uv = map.secondUvs ? v.secondUv : v.uv;
    const auto& m = map.uvTransform;
    const double a = double{uv[0]}, b = double{uv[1]};
    return {double{m[0]} * a + double{m[1]} * b, double{m[3]} * a + double{m[4]} * b};
  }

  PictureAxes axesOf(const FlatTriangle& t, const MaterialMap& map) const {
    std::array<Vec3, 3> p;
    std::array<std::array<double, 2>, 3> uv;
    for (std::size_t k = 0; k < 3; ++k) {
      const FlatVertex& v = flat_.vertices[t.corner[k]];
      p[k] = vectorOf(v.position);
      uv[k] = coordinatesAt(v, map);
    }
    const double u1 = uv[1][0] - uv[0][0], u2 = uv[2][0] - uv[0][0];
    const double v1 = uv[1][1] - uv[0][1], v2 = uv[2][1] - uv[0][1];
    const double area = u1 * v2 - u2 * v1;
    if (area == 0 || !std::isfinite(area)) return {};
    const double turns = area < 0 ? -1 : 1;
    const Vec3 a = p[1] - p[0], b = p[2] - p[0];
    return {turns * (a * v2 - b * v1), turns * (b * u1 - a * u2)};
  }

  void addTriangle(std::uint32_t number, const MaterialMap& map) {
    const FlatTriangle& t = flat_.triangles[number];
    if (std::ranges::none_of(t.corner, [&](std::uint32_t c) { return lacksTangent(flat_.vertices[c]); }))
      return;
    const PictureAxes axes = axesOf(t, map);
    for (std::uint32_t k = 0; k < 3; ++k) {
      FlatVertex v = flat_.vertices[t.corner[k]];
      if (!lacksTangent(v)) continue;
      const Vec3 n = vectorOf(v.normal);
      const Vec3 flat = axes.along - n * n.dot(axes.along);
      const double length = flat.norm();
      const bool serves = std::isfinite(length) && length > 1e-30;
      v.tangent = {0, 0, 0, n.cross(axes.along).dot(axes.down) > 0 ? -1.0f : 1.0f};
      const std::uint32_t group = set_.add(v);
      if (group == sums_.size()) sums_.push_back(Vec3::Zero());
      if (serves) sums_[group] += flat / length * angleAt(t, k);
      corners_.push_back({number, k, group});
    }
  }

  double angleAt(const FlatTriangle& t, std::uint32_t k) const {
    const auto at = [&](std::uint32_t i) { return vectorOf(flat_.vertices[t.corner[i % 3]].position); };
    const Vec3 a = at(k + 1) - at(k), b = at(k + 2) - at(k);
    return det::atan2(a.cross(b).norm(), a.dot(b));
  }

  /// One vertex for each group. The old vertices that no triangle uses any more do not reach the mesh.
  std::uint32_t vertexOf(const Corner& corner) {
    std::uint32_t& vertex = vertices_[corner.group];
    if (vertex != kNone) return vertex;
    FlatVertex v = set_.vertices[corner.group];
    const double length = sums_[corner.group].norm();
    if (length > kLeastSum)
      for (int k = 0; k < 3; ++k)
        v.tangent[static_cast<std::size_t>(k)] = static_cast<float>(sums_[corner.group][k] / length) + 0.0f;
    else
      v.tangent = {0, 0, 0, 1};
    vertex = static_cast<std::uint32_t>(flat_.vertices.size());
    flat_.vertices.push_back(v);
    return vertex;
  }

  const std::vector<Material>& materials_;
  Flat& flat_;
  VertexSet set_;
  std::vector<Vec3> sums_;  ///< by group: a vertex, and the side of its bitangent
  std::vector<Corner> corners_;
  std::vector<std::uint32_t> vertices_;  ///< by group
};

}  // namespace

void makeTangents(const std::vector<Material>& materials, Flat& flat) {
  const auto isBumpy = [](const Material& m) { return m.maps[kNormalMap].given(); };
  if (std::ranges::any_of(materials, isBumpy)) TangentMaker(materials, flat).make();
}

}  // namespace stadion::importer
