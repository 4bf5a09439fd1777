#include "engine/asset/simplify.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace stadion {
namespace {

/// A level is worth its memory if it has at most this part of the triangles of the one before.
constexpr double kWorthwhile = 0.8;
constexpr std::size_t kFewTriangles = 32;  ///< what has no more is drawn as it is

Vec3 at(const Mesh& mesh, std::uint32_t vertex) {
  const auto& p = mesh.positions[vertex];
  return {double{p[0]}, double{p[1]}, double{p[2]}};
}

/// The nearest point of a triangle, by the regions of its corners and edges (Ericson, Real-Time Collision
/// Detection, 5.1.5).
double squaredDistance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return ap.squaredNorm();
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return bp.squaredNorm();
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return (ap - d1 / (d1 - d3) * ab).squaredNorm();
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return cp.squaredNorm();
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return (ap - d2 / (d2 - d6) * ac).squaredNorm();
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return (bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)).squaredNorm();
  const double sum = va + vb + vc;
  if (!(sum > 0)) return ap.squaredNorm();
  return (ap - vb / sum * ab - vc / sum * ac).squaredNorm();
}

/// The triangles of a surface, halved again and again by the middles of their boxes, to find the nearest.
class NearestTriangle {
public:
  NearestTriangle(const Mesh& mesh, std::span<const std::uint32_t> indices) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
      triangles_.push_back({at(mesh, indices[i]), at(mesh, indices[i + 1]), at(mesh, indices[i + 2])});
    if (!triangles_.empty()) build(0, triangles_.size());
  }

  /// How far it is from the point [m].
  double distance(const Vec3& p) const {
    double best = std::numeric_limits<double>::infinity();
    std::vector<std::uint32_t> open{0};
    while (!open.empty()) {
      const Part& part = parts_[open.back()];
      open.pop_back();
      if (part.box.squaredExteriorDistance(p) >= best) continue;
      if (part.left == 0) {
        for (std::uint32_t i = part.first; i < part.first + part.count; ++i)
          best = std::min(best, squaredDistance(p, triangles_[i][0], triangles_[i][1], triangles_[i][2]));
        continue;
      }
      const bool leftFirst = parts_[part.left].box.squaredExteriorDistance(p) <
                             parts_[part.right].box.squaredExteriorDistance(p);
      open.push_back(leftFirst ? part.right : part.left);
      open.push_back(leftFirst ? part.left : part.right);
    }
    return std::sqrt(best);
  }

private:
  using Triangle = std::array<Vec3, 3>;
  struct Part {
    Eigen::AlignedBox3d box;
    std::uint32_t first = 0, count = 0, left = 0, right = 0;
  };
  static constexpr std::size_t kMostInPart = 8;

  std::uint32_t build(std::size_t first, std::size_t count) {
    const auto self = static_cast<std::uint32_t>(parts_.size());
    Part part;
    part.first = static_cast<std::uint32_t>(first), part.count = static_cast<std::uint32_t>(count);
    for (std::size_t i = first; i < first + count; ++i)
      for (const Vec3& corner : triangles_[i]) part.box.extend(corner);
    parts_.push_back(part);
    if (count <= kMostInPart) return self;
    Eigen::Index axis = 0;
    part.box.sizes().maxCoeff(&axis);
    const auto begin = triangles_.begin() + static_cast<std::ptrdiff_t>(first);
    const std::size_t half = count / 2;
    const auto middle = [axis](const Triangle& t) { return t[0][axis] + t[1][axis] + t[2][axis]; };
    std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(half),
                     begin + static_cast<std::ptrdiff_t>(count),
                     [&](const Triangle& x, const Triangle& y) { return middle(x) < middle(y); });
    const std::uint32_t left = build(first, half), right = build(first + half, count - half);
    parts_[self].left = left, parts_[self].right = right;
    return self;
  }

  std::vector<Triangle> triangles_;
  std::vector<Part> parts_;
};

/// From the corners and the middle of each triangle, and the middles of its edges.
double farthestFrom(const Mesh& mesh, std::span<const std::uint32_t> from, const NearestTriangle& to) {
  double farthest = 0;
  for (std::size_t i = 0; i + 2 < from.size(); i += 3) {
    const Vec3 a = at(mesh, from[i]), b = at(mesh, from[i + 1]), c = at(mesh, from[i + 2]);
    const Vec3 samples[] = {a, b, c, (a + b) / 2, (b + c) / 2, (c + a) / 2, (a + b + c) / 3};
    for (const Vec3& p : samples) farthest = std::max(farthest, to.distance(p));
  }
  return farthest;
}

/// About half as many triangles.
MeshLevel halved(const Mesh& mesh, std::span<const std::uint32_t> indices, std::span<const Submesh> parts) {
  MeshLevel level;
  for (const Submesh& part : parts) {
    const std::span<const std::uint32_t> from = indices.subspan(part.firstIndex, part.indexCount);
    const std::size_t wanted = from.size() / 6 * 3;
    std::vector<std::uint32_t> simplified(from.size());
    simplified.resize(meshopt_simplify(simplified.data(), from.data(), from.size(),
                                       mesh.positions.data()->data(), mesh.positions.size(),
                                       sizeof mesh.positions[0], wanted, 1.0F, 0, nullptr));
    if (simplified.empty()) simplified.assign(from.begin(), from.end());
    const auto first = static_cast<std::uint32_t>(level.indices.size());
    level.indices.insert(level.indices.end(), simplified.begin(), simplified.end());
    level.submeshes.push_back({first, static_cast<std::uint32_t>(simplified.size()), part.material});
  }
  return level;
}

}  // namespace

double surfaceDistance(const Mesh& mesh, const std::vector<std::uint32_t>& a,
                       const std::vector<std::uint32_t>& b) {
  if (a.empty() || b.empty()) return a.empty() == b.empty() ? 0 : std::numeric_limits<double>::infinity();
  const NearestTriangle ofA(mesh, a), ofB(mesh, b);
  return std::max(farthestFrom(mesh, a, ofB), farthestFrom(mesh, b, ofA));
}

void addLevels(Mesh& mesh, std::size_t count) {
  std::optional<NearestTriangle> full;
  std::vector<std::uint32_t> indices = mesh.indices;
  std::vector<Submesh> parts = mesh.submeshes;
  mesh.levels.clear();
  while (mesh.levels.size() < count && indices.size() > 3 * kFewTriangles) {
    MeshLevel level = halved(mesh, indices, parts);
    if (static_cast<double>(level.indices.size()) > kWorthwhile * static_cast<double>(indices.size())) break;
    if (!full) full.emplace(mesh, mesh.indices);
    const NearestTriangle simplified(mesh, level.indices);
    level.error =
        std::max(farthestFrom(mesh, mesh.indices, simplified), farthestFrom(mesh, level.indices, *full));
    const double before = mesh.levels.empty() ? 0 : mesh.levels.back().error;
    level.error = std::max(level.error, before);
    indices = level.indices, parts = level.submeshes;
    mesh.levels.push_back(std::move(level));
  }
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15;  // 2^64 by the golden ratio
  mesh.hash ^= kOdd * (mesh.levels.size() + 1);
}

}  // namespace stadion
