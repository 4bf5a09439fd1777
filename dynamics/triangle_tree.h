#pragma once
/// A flat hierarchy of bounding boxes over the triangles of a mesh, for the questions that dynamics asks.
///
/// Edges that two triangles share in one plane, or in a hollow, are merged: they have no normal of their own,
/// so that a ball does not trip over them. Degenerate, duplicate and non-finite triangles are left out.

#include "engine/asset/mesh.h"
#include "engine/maths/maths.h"

#include <array>
#include <cstdint>
#include <vector>

namespace stadion {

struct Triangle {
  std::array<Vec3, 3> v;
  Vec3 normal;                       ///< unit, outwards
  std::array<std::int32_t, 3> next;  ///< triangle across edge v[i] v[i+1], -1 at a border
  std::array<bool, 3> merged;        ///< that edge is flat or hollow
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

  bool empty() const { return triangles_.empty(); }
  bool closed() const { return closed_; }  ///< encloses a volume: inside and outside are defined
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<Vec3>& corners() const { return corners_; }  ///< each place once
  const Aabb& bounds() const { return bounds_; }
  std::size_t dropped() const { return dropped_; }  ///< triangles left out as useless

  /// Triangles whose boxes overlap `box`, in rising order.
  void overlapping(const Aabb& box, std::vector<std::uint32_t>& found) const;
  /// The triangle nearest to p within `limit` [m], -1 if none; `at` is set then.
  std::int32_t nearest(const Vec3& p, double limit, ClosestPoint& at) const;

private:
  struct Node {
    Aabb box;
    std::uint32_t first = 0;  ///< leaf: first triangle in order_; inner: right child (left is the next node)
    std::uint32_t count = 0;  ///< triangles of a leaf, 0 for an inner node
  };
  void build(std::uint32_t first, std::uint32_t count);
  void connect();

  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
  std::vector<Vec3> corners_;
  Aabb bounds_;
  std::size_t dropped_ = 0;
  bool closed_ = false;
};

}  // namespace stadion
