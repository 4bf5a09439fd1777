#pragma once
/// The nearest points of segments and triangles.
///
/// Source   clamped closest points of two lines; a pair of triangles is nearest at two edges or at a corner
///          and a face.

#include "dynamics/shapes/triangle_tree.h"

namespace stadion {

struct NearestPoints {
  double distance = 1e300;  ///< 0 where they cross
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();
};

/// Segments p p+d and q q+e.
NearestPoints nearestOfSegments(const Vec3& p, const Vec3& d, const Vec3& q, const Vec3& e);
NearestPoints nearestOfTriangles(const Triangle& a, const Triangle& b);

}  // namespace stadion
