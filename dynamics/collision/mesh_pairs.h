#pragma once
/// Walks two triangle trees at once. Internal to dynamics/.

#include "dynamics/shapes/triangle_tree.h"

#include <array>

namespace stadion {

/// The triangle as it lies at X.
inline Triangle moved(const Triangle& t, const Pose& X) {
  Triangle m = t;
  for (Vec3& v : m.v) v = X * v;
  m.normal = X.q * t.normal;
  return m;
}

class MeshPairs {
public:
  /// `X_BA` is where a lies in the frame of b.
  MeshPairs(const TriangleTree& a, const TriangleTree& b, const Pose& X_BA)
      : a_(a), b_(b), X_(X_BA), R_(X_BA.q.toRotationMatrix()), size_(R_.cwiseAbs()) {}

  /// Calls f(i, j, triangle i of a in the frame of b) with pairs of triangles whose boxes are within
  /// `within()` metres, nearer parts first; f may shorten what `within` says as it learns. In a fixed order.
  template <class W, class F>
  void each(W within, F f) const {
    each(
        within, [this](std::uint32_t i) { return moved(a_.triangles()[i], X_); }, f);
  }
  /// Calls f for near pairs, as above. `place(i)` returns triangle i of a in the frame of b, or the part of
  /// it that f needs. `v` are its corners.
  template <class W, class P, class F>
  void each(W within, P place, F f) const {
    if (!a_.empty() && !b_.empty()) follow(0, 0, within, place, f);
  }

private:
  using Node = TriangleTree::Node;
  static double squaredGap(const Aabb& a, const Aabb& b) {
    return (a.lo - b.hi).cwiseMax(b.lo - a.hi).cwiseMax(0.0).squaredNorm();
  }
  Aabb placed(const Aabb& box) const {
    const Vec3 c = R_ * (0.5 * (box.lo + box.hi)) + X_.p, h = size_ * (0.5 * (box.hi - box.lo));
    return {c - h, c + h};
  }
  double squaredGap(std::uint32_t i, std::uint32_t j) const {
    return squaredGap(placed(a_.nodes()[i].box), b_.nodes()[j].box);
  }

  template <class W, class P, class F>
  void follow(std::uint32_t i, std::uint32_t j, W& within, P& place, F& f) const {
    const Node &m = a_.nodes()[i], &n = b_.nodes()[j];
    if (m.count > 0 && n.count > 0) return leaves(m, n, within, place, f);
    const bool splitA = n.count > 0 || (m.count == 0 && (m.box.hi - m.box.lo).squaredNorm() >
                                                            (n.box.hi - n.box.lo).squaredNorm());
    std::array<std::pair<std::uint32_t, std::uint32_t>, 2> next;
    if (splitA)
      next = {{{i + 1, j}, {m.first, j}}};
    else
      next = {{{i, j + 1}, {i, n.first}}};
    std::array<double, 2> gap = {squaredGap(next[0].first, next[0].second),
                                 squaredGap(next[1].first, next[1].second)};
    if (gap[1] < gap[0]) {
      std::swap(gap[0], gap[1]);
      std::swap(next[0], next[1]);
    }
    for (std::size_t k = 0; k < 2; ++k) {
      const double d = within();
      if (gap[k] <= d * d) follow(next[k].first, next[k].second, within, place, f);
    }
  }

  template <class W, class P, class F>
  void leaves(const Node& m, const Node& n, W& within, P& place, F& f) const {
    for (std::uint32_t x = m.first; x < m.first + m.count; ++x) {
      const std::uint32_t i = a_.order()[x];
      const auto t = place(i);
      const Aabb box = boxOf(t.v);
      if (const double d = within(); squaredGap(box, n.box) > d * d) continue;
      for (std::uint32_t y = n.first; y < n.first + n.count; ++y) {
        if (const double d = within(); squaredGap(box, b_.boxes()[y]) <= d * d) f(i, b_.order()[y], t);
      }
    }
  }
  static Aabb boxOf(const std::array<Vec3, 3>& v) {
    return {v[0].cwiseMin(v[1]).cwiseMin(v[2]), v[0].cwiseMax(v[1]).cwiseMax(v[2])};
  }

  const TriangleTree &a_, &b_;
  Pose X_;
  Mat3 R_, size_;
};

}  // namespace stadion
