#pragma once
/// One view of everything convex: the points within `radius` of a core, placed.
///
/// Ball = point, capsule = segment, box, cylinder, hull and bounded sheet are their own core with radius 0.

#include "dynamics/shapes/shape.h"

#include <array>
#include <cstdint>

namespace stadion {

struct ConvexCore {
  enum class Kind : std::uint8_t { Point, Segment, Box, Cylinder, Hull, Triangle };
  Kind kind = Kind::Point;
  Mat3 R = Mat3::Identity();  ///< axes
  Vec3 p = Vec3::Zero();      ///< centre; of a hull the node's origin
  Vec3 half = Vec3::Zero();   ///< Box; Segment: z; Cylinder: x the radius, z the half height
  double radius = 0;          ///< rounding [m]
  double shrink = 1;          ///< Hull: scaled about its centre
  const ConvexShape* hull = nullptr;
  std::array<Vec3, 3> v{Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(0, 0, 0)};  ///< Triangle
  Vec3 normal = Vec3::UnitZ();                                         ///< Triangle

  /// The farthest point of the core along d.
  Vec3 support(const Vec3& d) const;
  /// The greatest n . x over the rounded body.
  double extent(const Vec3& n) const { return n.dot(support(n)) + radius; }
  /// Returns true if x is in the core, give or take `margin`.
  bool holds(const Vec3& x, double margin) const;
  Vec3 middle() const;
  ConvexCore moved(const Vec3& by) const;
  /// The core with everything thinner by up to `depth`, but not turned inside out.
  ConvexCore eroded(double depth) const;
  /// Greatest sensible erosion [m].
  double thickness() const;
};

/// False for meshes and unbounded planes. X_RN places the node in a frame of reference.
bool coreOf(const Shape& shape, const Pose& X_RN, ConvexCore& core);
ConvexCore coreOf(const Triangle& t, const Pose& X_RN);
bool isConvex(const Shape& shape);

/// A flat or straight part of a core: what it touches with, seen along d.
struct Feature {
  static constexpr int kMost = 16;
  std::array<Vec3, kMost> points;
  int count = 0;
  Vec3 normal = Vec3::Zero();  ///< normal of a flat feature, outwards; zero for lines and points
  void add(const Vec3& x) {
    if (count < kMost) points[static_cast<std::size_t>(count++)] = x;
  }
};
/// `around`: a round face as a circumscribed polygon, to clip against; else as points on its rim, the one
/// farthest along d first.
Feature featureTowards(const ConvexCore& core, const Vec3& d, bool around);

/// Returns true if the core reaches farthest along n, or against it, with a single point, the others staying
/// back by more than `even` [m]. False if that is not known at once.
bool pointed(const ConvexCore& core, const Vec3& n, double even);

/// Directions that separating planes can have near a contact.
struct Directions {
  static constexpr int kMost = 12;
  std::array<Vec3, kMost> faces, edges;
  int faceCount = 0, edgeCount = 0;
  void face(const Vec3& n) {
    if (faceCount < kMost) faces[static_cast<std::size_t>(faceCount++)] = n;
  }
  void edge(const Vec3& e) {
    if (edgeCount < kMost) edges[static_cast<std::size_t>(edgeCount++)] = e;
  }
};
/// Returns the directions of the faces and edges of the core that look along d, near x.
Directions directionsNear(const ConvexCore& core, const Vec3& d, const Vec3& x);

}  // namespace stadion
