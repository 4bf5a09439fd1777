#include "dynamics/world/arc_ends.h"

#include "dynamics/world/ball_support.h"

namespace stadion {

/// Looks for the face beyond the edge that the ball has reached: true if it rolls on in the same plane, or in
/// one that is `lift` higher.
bool ArcEnds::crossEdge(RigidBody& b, double tau, double& lift) {
  return crossFold(b, tau) || surfaces_.crossSeam(b, tau, lift);
}

/// Takes the ball over a fold of the mesh that carries it. False if it meets none.
bool ArcEnds::crossFold(RigidBody& b, double tau) const {
  if (b.support.triangle < 0) return false;
  const Collider* c = objects_.collider(b.support.on.id);
  if (!c) return false;
  const auto& tree = std::get<MeshShape>(*c->shape).tree;
  const Vec3 n = b.support.normal, foot = b.position(tau) - b.radius() * n;
  const Vec3 local = c->motion.end.inverse() * foot;
  std::vector<std::uint32_t> near;
  Aabb box;
  box.include(local);
  box.lo.array() -= 1e-5;
  box.hi.array() += 1e-5;
  tree.overlapping(box, near);
  for (const std::uint32_t i : near) {
    if (static_cast<std::int32_t>(i) == b.support.triangle) continue;
    const Triangle& t = tree.triangles()[i];
    const Vec3 up = c->motion.end.q * t.normal;
    if (up.dot(n) < 1 - 1e-7) continue;
    const ClosestPoint q = closestPoint(t, local);
    if ((q.point - local).norm() > 5e-7) continue;
    Gap gap;
    gap.triangle = static_cast<std::int32_t>(i);
    gap.face = true;
    gap.normal = up;
    gap.point = c->motion.end * q.point;
    Support next;
    if (!supportFor(b, *c, gap, next)) continue;
    next.point = b.support.point;
    next.normal = n;  // the same plane: no step of rounding from face to face
    b.support = next;
    return true;
  }
  return false;
}

void ArcEnds::reachHorizon(RigidBody& b, double tau) {
  if (b.mode == BodyMode::Held) {
    ++b.grip.held.part;
    ++b.version;
    waking_.wakeOnto({true, b.id}, tau);
    foresight_.predict(b, tau);
    return;
  }
  if (b.mode == BodyMode::Flight) {
    // The motion is the same, but its arc ended here.
    if (arcs_.flyOn(b, tau))
      foresight_.predict(b, tau);
    else
      foresight_.predictSpin(b, tau);
    return;
  }
  const bool rested = b.mode == BodyMode::Rest;
  const Vec3 p = b.position(tau), v = b.velocity(tau);
  const Quat q = b.orientation(tau);
  BallStart s{p, v, b.spin.angularVelocity(b.spinAge(tau)), q};
  const Vec3 n = b.support.normal;
  double lift = 0;
  if (b.support.ends(p, v) && !crossEdge(b, tau, lift)) {
    arcs_.startFlight(b, tau, p, v, q, b.inertia.x() * s.omega);
  } else {
    s.p += lift * n;
    Vec3 slip = v - b.radius() * s.omega.cross(n);
    slip -= n * n.dot(slip);
    const bool gripped = slip.norm() < 1e-7 * (1 + v.norm()), stopped = gripped && v.norm() < 1e-7;
    arcs_.startOnFace(b, tau, s, gripped, stopped);
  }
  if (rested && b.mode != BodyMode::Rest) waking_.wakeOnto({true, b.id}, tau);
  foresight_.predict(b, tau);
}

void ArcEnds::reachHorizon(Collider& c, double tau) {
  ++c.motion.part;
  ++c.version;
  waking_.wakeOnto({false, c.id}, tau);
  foresight_.predict(c, tau);
}

}  // namespace stadion
