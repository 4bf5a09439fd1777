#include "dynamics/shapes/shape.h"

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

Aabb boundingBox(const Shape& shape, const Pose& X) {
  const auto turned = [&](const Pose& F, const Vec3& half) {
    const Pose whole = X * F;
    const Vec3 reach = whole.q.toRotationMatrix().cwiseAbs() * half;
    return Aabb{whole.p - reach, whole.p + reach};
  };
  if (const auto* box = std::get_if<BoxShape>(&shape)) return turned(box->pose, box->half);
  if (const auto* plane = std::get_if<PlaneShape>(&shape); plane && plane->bounded())
    return turned(plane->pose, {plane->half.x(), plane->half.y(), plane->half.minCoeff()});
  if (const auto* mesh = std::get_if<MeshShape>(&shape)) {
    const Aabb& b = mesh->tree.bounds();
    return turned({b.centre(), Quat::Identity()}, 0.5 * (b.hi - b.lo));
  }
  const Sphere s = boundingSphere(shape);
  if (!std::isfinite(s.radius)) return {Vec3::Constant(-1e300), Vec3::Constant(1e300)};
  const Vec3 c = X * s.centre;
  return {c.array() - s.radius, c.array() + s.radius};
}

}  // namespace stadion
