#include "engine/display/mesh_ray_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace stadion {
namespace {

constexpr std::uint32_t kLeaf = 4;
constexpr double kSeam = 1e-9;  ///< triangles reach this far beyond their edges, so that no ray slips through

/// Möller and Trumbore, for both sides.
std::optional<double> meets(const MeshScreen& mesh, std::uint32_t triangle, const Vec3& origin,
                            const Vec3& direction) {
  const auto& corner = mesh.triangles[triangle];
  const Vec3 &a = mesh.points[corner[0]], e1 = mesh.points[corner[1]] - a, e2 = mesh.points[corner[2]] - a;
  const Vec3 p = direction.cross(e2);
  const double determinant = e1.dot(p);
  if (determinant == 0) return std::nullopt;
  const Vec3 from = origin - a, q = from.cross(e1);
  const double u = from.dot(p) / determinant, v = direction.dot(q) / determinant;
  if (!(u >= -kSeam && v >= -kSeam && u + v <= 1 + kSeam)) return std::nullopt;
  const double t = e2.dot(q) / determinant;
  return t > 0 ? std::optional(t) : std::nullopt;
}

/// Returns true if the ray passes the box before `limit`.
bool passes(const Aabb& box, const Vec3& origin, const Vec3& inverse, double limit) {
  double in = 0, out = limit;
  for (int axis = 0; axis < 3; ++axis) {
    const double one = (box.lo[axis] - origin[axis]) * inverse[axis];
    const double two = (box.hi[axis] - origin[axis]) * inverse[axis];
    if (std::isnan(one) || std::isnan(two)) continue;  // along a face of the box
    in = std::max(in, std::min(one, two));
    out = std::min(out, std::max(one, two));
  }
  return in <= out;
}

}  // namespace

MeshRayTree::MeshRayTree(const MeshScreen& mesh) : order_(mesh.triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0U);
  if (!order_.empty()) build(mesh, 0, static_cast<std::uint32_t>(order_.size()));
}

void MeshRayTree::build(const MeshScreen& mesh, std::uint32_t begin, std::uint32_t end) {
  const std::size_t at = boxes_.size();
  boxes_.emplace_back();
  const auto middle = [&](std::uint32_t triangle) -> Vec3 {
    const auto& corner = mesh.triangles[triangle];
    return mesh.points[corner[0]] + mesh.points[corner[1]] + mesh.points[corner[2]];
  };
  Aabb bounds, middles;
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const std::uint32_t corner : mesh.triangles[order_[i]]) bounds.include(mesh.points[corner]);
    middles.include(middle(order_[i]));
  }
  const Vec3 margin = Vec3::Constant(1e-9 + 1e-9 * (bounds.hi - bounds.lo).norm());
  boxes_[at].bounds = {bounds.lo - margin, bounds.hi + margin};
  if (end - begin <= kLeaf) {
    boxes_[at].first = begin;
    boxes_[at].count = end - begin;
    return;
  }
  int axis = 0;
  (middles.hi - middles.lo).maxCoeff(&axis);
  const std::uint32_t half = begin + (end - begin) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                   [&](std::uint32_t a, std::uint32_t b) { return middle(a)[axis] < middle(b)[axis]; });
  build(mesh, begin, half);
  boxes_[at].first = static_cast<std::uint32_t>(boxes_.size());
  build(mesh, half, end);
}

std::optional<double> MeshRayTree::firstHit(const MeshScreen& mesh, const Vec3& origin,
                                            const Vec3& direction) const {
  if (boxes_.empty()) return std::nullopt;
  const Vec3 inverse = direction.cwiseInverse();
  double nearest = HUGE_VAL;
  std::array<std::uint32_t, 64> waiting;  // halves stay balanced: the tree is at most 32 deep
  std::size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const std::uint32_t at = waiting[--count];
    const Box& box = boxes_[at];
    if (!passes(box.bounds, origin, inverse, nearest)) continue;
    for (std::uint32_t i = box.first; i < box.first + box.count; ++i)
      if (const auto t = meets(mesh, order_[i], origin, direction)) nearest = std::min(nearest, *t);
    if (box.count > 0) continue;
    waiting[count++] = box.first;
    waiting[count++] = at + 1;
  }
  return nearest < HUGE_VAL ? std::optional(nearest) : std::nullopt;
}

}  // namespace stadion
