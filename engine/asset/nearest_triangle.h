#pragma once
/// Finds the nearest triangle of a surface.
///
/// Threads  constant once made.

#include "engine/asset/mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace stadion {

inline Vec3 placeOf(const Mesh& mesh, std::uint32_t vertex) {
  const auto& p = mesh.positions[vertex];
  return {double{p[0]}, double{p[1]}, double{p[2]}};
}

/// The weights of a triangle's corners in its point nearest to p, by the regions of its corners and edges
/// (Ericson, Real-Time Collision Detection, 5.1.5).
inline Vec3 nearestOn(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double t = d1 - d3 > 0 ? d1 / (d1 - d3) : 0;
    return {1 - t, t, 0};
  }
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double t = d2 - d6 > 0 ? d2 / (d2 - d6) : 0;
    return {1 - t, 0, t};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double t = (d4 - d3) + (d5 - d6) > 0 ? (d4 - d3) / ((d4 - d3) + (d5 - d6)) : 0;
    return {0, 1 - t, t};
  }
  const double sum = va + vb + vc;
  return sum > 0 ? Vec3(va / sum, vb / sum, vc / sum) : Vec3(1, 0, 0);
}

/// A binary tree of boxes over the triangles of a surface. Each box is split at the median along its longest
/// axis.
class NearestTriangle {
public:
  NearestTriangle(const Mesh& mesh, std::span<const std::uint32_t> indices) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
      triangles_.push_back(
          {{placeOf(mesh, indices[i]), placeOf(mesh, indices[i + 1]), placeOf(mesh, indices[i + 2])},
           {indices[i], indices[i + 1], indices[i + 2]}});
    if (!triangles_.empty()) build(0, triangles_.size());
  }

  struct Point {
    double distance = std::numeric_limits<double>::infinity();  ///< [m]
    std::array<std::uint32_t, 3> corners{};                     ///< corners of the triangle
    Vec3 weights = Vec3(1, 0, 0);                               ///< weights of the corners
  };
  /// The nearest point, or any that is no farther than `enough` [m]. Expects triangles.
  Point nearest(const Vec3& p, double enough) const {
    double best = std::numeric_limits<double>::infinity();
    Point point;
    std::array<std::uint32_t, 2 * kDeepest> open;
    std::size_t waiting = 0;
    open[waiting++] = 0;
    while (waiting > 0 && best > enough * enough) {
      const Part& part = parts_[open[--waiting]];
      if (part.box.squaredExteriorDistance(p) >= best) continue;
      if (part.left == 0) {
        for (std::uint32_t i = part.first; i < part.first + part.count; ++i) {
          const auto& [a, b, c] = triangles_[i].places;
          const Vec3 w = nearestOn(p, a, b, c);
          const double squared = (w[0] * a + w[1] * b + w[2] * c - p).squaredNorm();
          if (squared < best) {
            best = squared;
            point.corners = triangles_[i].corners;
            point.weights = w;
          }
        }
        continue;
      }
      const bool leftFirst = parts_[part.left].box.squaredExteriorDistance(p) <
                             parts_[part.right].box.squaredExteriorDistance(p);
      open[waiting++] = leftFirst ? part.right : part.left;
      open[waiting++] = leftFirst ? part.left : part.right;
    }
    point.distance = std::sqrt(best);
    return point;
  }

private:
  struct Triangle {
    std::array<Vec3, 3> places;
    std::array<std::uint32_t, 3> corners;
  };
  struct Part {
    Eigen::AlignedBox3d box;
    std::uint32_t first = 0, count = 0, left = 0, right = 0;
  };
  static constexpr std::size_t kMostInPart = 8;
  static constexpr std::size_t kDeepest = 40;  ///< halvings of as many triangles as memory holds

  std::uint32_t build(std::size_t first, std::size_t count) {
    const auto self = static_cast<std::uint32_t>(parts_.size());
    Part part;
    part.first = static_cast<std::uint32_t>(first);
    part.count = static_cast<std::uint32_t>(count);
    for (std::size_t i = first; i < first + count; ++i)
      for (const Vec3& corner : triangles_[i].places) part.box.extend(corner);
    parts_.push_back(part);
    if (count <= kMostInPart) return self;
    Eigen::Index axis = 0;
    part.box.sizes().maxCoeff(&axis);
    const auto begin = triangles_.begin() + static_cast<std::ptrdiff_t>(first);
    const std::size_t half = count / 2;
    const auto middle = [axis](const Triangle& t) {
      return t.places[0][axis] + t.places[1][axis] + t.places[2][axis];
    };
    std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(half),
                     begin + static_cast<std::ptrdiff_t>(count),
                     [&](const Triangle& x, const Triangle& y) { return middle(x) < middle(y); });
    const std::uint32_t left = build(first, half), right = build(first + half, count - half);
    parts_[self].left = left;
    parts_[self].right = right;
    return self;
  }

  std::vector<Triangle> triangles_;
  std::vector<Part> parts_;
};

}  // namespace stadion
