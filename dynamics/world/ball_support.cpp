#include "dynamics/world/ball_support.h"

#include <cmath>

namespace stadion {

/// Returns true if what a ball has met there can carry it in closed form: a flat face of a still collider.
bool carries(const RigidBody& ball, const Collider& c, const Gap& gap) {
  if (!gap.face || c.motion.moving || !ball.centred) return false;
  return std::holds_alternative<PlaneShape>(*c.shape) || std::holds_alternative<BoxShape>(*c.shape) ||
         (std::holds_alternative<MeshShape>(*c.shape) && gap.triangle >= 0);
}

/// That face.
bool supportFor(const RigidBody& ball, const Collider& c, const Gap& gap, Support& s) {
  if (!carries(ball, c, gap)) return false;
  const Pose& X = c.motion.end;
  s = {};
  s.on = {false, c.id};
  s.normal = gap.normal;
  s.triangle = gap.triangle;
  s.point = gap.point;
  const PairSurface pair = combine(ball.surface, c.surface);
  s.friction = pair.friction;
  s.rolling = pair.rolling;
  s.restitution = pair.restitution;
  const auto edge = [&](const Vec3& inward, const Vec3& on) {
    const auto i = static_cast<std::size_t>(s.edges++);
    s.edgeNormal[i] = inward;
    s.edgeOffset[i] = inward.dot(on);
  };
  const auto rectangle = [&](const Pose& F, const Vec3& half, int up) {
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == up) continue;
      const Vec3 out = F.q * Vec3::Unit(axis);
      edge(out, F.p - half[axis] * out);
      edge(-out, F.p + half[axis] * out);
    }
  };
  if (const auto* plane = std::get_if<PlaneShape>(c.shape)) {
    if (plane->bounded()) rectangle(X * plane->pose, {plane->half.x(), plane->half.y(), 0}, 2);
    return true;
  }
  if (const auto* box = std::get_if<BoxShape>(c.shape)) {
    const Pose F = X * box->pose;
    const Vec3 n = F.q.conjugate() * gap.normal;
    int up = 0;
    n.cwiseAbs().maxCoeff(&up);
    rectangle(F, box->half, up);
    return true;
  }
  if (const auto* mesh = std::get_if<MeshShape>(c.shape); mesh && gap.triangle >= 0) {
    const Triangle& t = mesh->tree.triangles()[static_cast<std::size_t>(gap.triangle)];
    const double facing = (X.q * t.normal).dot(gap.normal) < 0 ? -1 : 1;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 inward = t.normal.cross(t.v[(i + 1) % 3] - t.v[i]).normalized();
      edge(X.q * inward, X * t.v[i]);
      s.edgeOffset[i] -= 1e-6;  // a micron of overlap, so that no ball balances on the seam of two triangles
    }
    s.normal = facing * (X.q * t.normal);
    return true;
  }
  return false;
}

}  // namespace stadion
