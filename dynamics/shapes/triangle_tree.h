#pragma once
/// A flat hierarchy of bounding boxes over the triangles of a mesh, for the questions that dynamics asks.
///
/// Edges that two triangles share in one plane, or in a hollow, are merged: they have no normal of their own,
/// so that a ball does not trip over them. Degenerate, duplicate and non-finite triangles are left out.

#include "engine/asset/mesh.h"
#include "engine/maths/maths.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace stadion {

struct Triangle {
  std::array<Vec3, 3> v;
  Vec3 normal;                       ///< unit, outwards
  std::array<std::int32_t, 3> next;  ///< triangle across edge v[i] v[i+1], -1 at a border
  std::array<bool, 3> merged;        ///< the edge v[i] v[i+1] is flat or hollow
};

/// The point of a triangle that is closest to some other point.
struct ClosestPoint {
  Vec3 point = Vec3::Zero();
  int edge = -1;        ///< nearest on edge i; -1 in the face
  bool corner = false;  ///< at v[edge]
};

ClosestPoint closestPoint(const Triangle& t, const Vec3& p);

class TriangleTree {
public:
  TriangleTree() = default;
  explicit TriangleTree(const Mesh& mesh);
  explicit TriangleTree(const std::vector<std::array<Vec3, 3>>& triangles);

  bool empty() const { return triangles_.empty(); }
  /// True if the triangles enclose a volume, so that inside and outside are defined. A sheet encloses none.
  bool closed() const { return closed_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Corners of the triangles; equal ones are here once.
  const std::vector<Vec3>& corners() const { return corners_; }
  const Aabb& bounds() const { return bounds_; }
  std::size_t dropped() const { return dropped_; }  ///< triangles left out as useless

  /// Triangles whose boxes overlap `box`, in rising order.
  void overlapping(const Aabb& box, std::vector<std::uint32_t>& found) const;
  /// Calls f(i) with every triangle whose box overlaps `box`, in a fixed order, without allocating.
  template <class F>
  void eachOverlapping(const Aabb& box, F f) const {
    walk([&](const Aabb& b) { return b.overlaps(box); }, f);
  }
  /// Calls f for triangles within `within()` metres of p. f may shorten the distance that `within` returns.
  template <class W, class F>
  void eachWithin(const Vec3& p, W within, F f) const {
    walk(
        [&](const Aabb& b) {
          const double d = within();
          return (b.lo - p).cwiseMax(p - b.hi).cwiseMax(0.0).squaredNorm() <= d * d;
        },
        f);
  }
  /// Calls f(i, s, t) with every triangle that something comes near between the times s and t on its way,
  /// about in the order of time; more than once, it may be. `around(s, t)` is a box around the way from s to
  /// t. f returns the time up to which the way still matters.
  template <class B, class F>
  void eachOnWay(double from, double to, B around, F f) const {
    if (!nodes_.empty()) followWay(0, from, to, around(from, to), around, f, to);
  }
  /// The triangle nearest to p within `limit` [m], -1 if none; `at` is set then. Any that is nearer than
  /// `enough` will do; triangle `hint` is tried first.
  std::int32_t nearest(const Vec3& p, double limit, ClosestPoint& at, double enough = 0,
                       std::int32_t hint = -1) const;

  /// Direction out of the mesh at the point of a triangle that is nearest to something: there, a point is
  /// inside of a closed mesh if it lies against this. Not of unit length.
  /// Source   Baerentzen, Aanaes, Signed distance computation using the angle weighted pseudonormal, IEEE
  ///          TVCG 11 (2005) 243.
  Vec3 outwardsAt(std::int32_t triangle, const ClosestPoint& at) const;
  /// Returns true if p is inside of the mesh, however deep. An open mesh has no inside.
  bool encloses(const Vec3& p) const;

  struct Node {
    Aabb box;
    std::uint32_t first = 0;  ///< leaf: first triangle in order(); inner: right child (left is the next node)
    std::uint32_t count = 0;  ///< triangles of a leaf, 0 for an inner node
  };
  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<std::uint32_t>& order() const { return order_; }
  /// Around the triangles, in the order of order().
  const std::vector<Aabb>& boxes() const { return boxes_; }
  /// Where the triangle's corners are in corners().
  const std::array<std::uint32_t, 3>& cornersOf(std::uint32_t triangle) const { return cornersOf_[triangle]; }
  /// The triangles around a corner.
  std::span<const std::uint32_t> around(std::uint32_t corner) const {
    return std::span(around_).subspan(aroundFirst_[corner], aroundFirst_[corner + 1] - aroundFirst_[corner]);
  }

private:
  template <class T, class F>
  void walk(T test, F f) const {
    if (nodes_.empty()) return;
    std::uint32_t stack[64];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
      const std::uint32_t at = stack[--top];
      const Node& n = nodes_[at];
      if (!test(n.box)) continue;
      if (n.count == 0) {
        stack[top++] = n.first;
        stack[top++] = at + 1;
        continue;
      }
      for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
        if (test(boxes_[i])) f(order_[i]);
      }
    }
  }
  template <class B, class F>
  void followWay(std::uint32_t node, double from, double to, const Aabb& box, B& around, F& f,
                 double& end) const;
  void build(std::uint32_t first, std::uint32_t count);
  void prepare();
  void collectCorners();
  void connect();

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> order_;
  std::vector<Aabb> boxes_;
  std::vector<Node> nodes_;
  std::vector<Vec3> corners_;
  std::vector<std::array<std::uint32_t, 3>> cornersOf_;
  std::vector<std::uint32_t> around_, aroundFirst_;
  Aabb bounds_;
  std::size_t dropped_ = 0;
  bool closed_ = false;
};

/// Below a node, on the part of the way that is in `box`: in halves while that is wider than the node and
/// gains from it.
template <class B, class F>
void TriangleTree::followWay(std::uint32_t node, double from, double to, const Aabb& box, B& around, F& f,
                             double& end) const {
  const Node& n = nodes_[node];
  if (from > end || !n.box.overlaps(box)) return;
  const auto size = [](const Aabb& b) { return (b.hi - b.lo).maxCoeff(); };
  if (n.count > 0) {
    for (std::uint32_t i = n.first; i < n.first + n.count; ++i)
      end = std::min(end, f(order_[i], from, std::min(to, end)));
    return;
  }
  if (size(box) > size(n.box)) {
    const double middle = 0.5 * (from + to);
    const Aabb first = around(from, middle);
    // Where the ball itself is most of the box, halves are hardly smaller.
    if (size(first) < 0.75 * size(box)) {
      followWay(node, from, middle, first, around, f, end);
      followWay(node, middle, to, around(middle, to), around, f, end);
      return;
    }
  }
  followWay(node + 1, from, to, box, around, f, end);
  followWay(n.first, from, to, box, around, f, end);
}

}  // namespace stadion
