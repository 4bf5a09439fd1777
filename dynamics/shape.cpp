#include "dynamics/shape.h"

#include <algorithm>
#include <cmath>

namespace stadion {

const char* nameOf(ShapeKind kind) {
  switch (kind) {
  case ShapeKind::Auto: return "auto";
  case ShapeKind::Ball: return "sphere";
  case ShapeKind::Box: return "box";
  case ShapeKind::Capsule: return "capsule";
  case ShapeKind::Cylinder: return "cylinder";
  case ShapeKind::Convex: return "convex";
  case ShapeKind::Plane: return "plane";
  case ShapeKind::Mesh: return "mesh";
  }
  return "";
}

Sphere boundingSphere(const Shape& shape) {
  struct Visitor {
    Sphere operator()(const BallShape& s) const { return {s.centre, s.radius}; }
    Sphere operator()(const BoxShape& s) const { return {s.pose.p, s.half.norm()}; }
    Sphere operator()(const CapsuleShape& s) const { return {s.pose.p, s.half + s.radius}; }
    Sphere operator()(const CylinderShape& s) const {
      return {s.pose.p, std::sqrt(s.half * s.half + s.radius * s.radius)};
    }
    Sphere operator()(const ConvexShape& s) const { return {s.centre, s.reach}; }
    Sphere operator()(const PlaneShape& s) const {
      return {s.pose.p, s.bounded() ? s.half.norm() : std::numeric_limits<double>::infinity()};
    }
    Sphere operator()(const MeshShape& s) const {
      const Vec3 c = s.tree.bounds().centre();
      double r = 0;
      for (const Triangle& t : s.tree.triangles())
        for (const Vec3& v : t.v) r = std::max(r, (v - c).norm());
      return {c, r};
    }
  };
  return std::visit(Visitor{}, shape);
}

}  // namespace stadion
