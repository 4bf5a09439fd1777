#include "dynamics/impulse.h"

#include <cmath>

namespace stadion {

Mobile mobileOf(const RigidBody& b, double tau) {
  if (!b.movable()) {
    const Kinematics k = b.at(tau);
    return {0, Mat3::Zero(), k.p, k.v, k.omega};
  }
  const Quat q = b.orientation(tau);
  Mobile m{b.inverseMass, Mat3::Zero(), b.position(tau), b.velocity(tau),
           b.spin.angularVelocity(b.spinAge(tau), q)};
  const Vec3 inverse = b.inertia.cwiseInverse();
  if (inverse.x() == inverse.y() && inverse.y() == inverse.z()) {
    m.inverseInertia = inverse.x() * Mat3::Identity();
  } else {
    const Mat3 R = q.toRotationMatrix();
    m.inverseInertia = R * inverse.asDiagonal() * R.transpose();
  }
  return m;
}

Mobile mobileOf(const Collider& c, double tau) {
  const Kinematics k = c.motion.at(tau);
  return {0, Mat3::Zero(), k.p, k.v, k.omega};
}

Mat3 response(const Mobile& m, const Vec3& x) {
  if (m.inverseMass == 0) return Mat3::Zero();
  const Mat3 r = skew(x - m.p);
  return m.inverseMass * Mat3::Identity() - r * m.inverseInertia * r;
}

namespace {

/// The same along n alone.
double responseAlong(const Mobile& m, const Vec3& x, const Vec3& n) {
  if (m.inverseMass == 0) return 0;
  const Vec3 turn = (x - m.p).cross(n);
  return m.inverseMass + turn.dot(m.inverseInertia * turn);
}

}  // namespace

Vec3 collide(Mobile& a, Mobile& b, const Vec3& x, const Vec3& n, double restitution, double friction) {
  const Vec3 u = a.velocityAt(x) - b.velocityAt(x);
  const double closing = -u.dot(n);
  if (!(closing > 0)) return Vec3::Zero();
  if (friction == 0 && b.inverseMass == 0 && (x - a.p).cross(n).isZero(0)) {  // a ball on a smooth wall
    const Vec3 change = (restitution + 1) * closing * n;
    if (!change.allFinite()) return Vec3::Zero();
    a.v += change;
    return change / a.inverseMass;
  }
  const double along = responseAlong(a, x, n) + responseAlong(b, x, n);
  Vec3 impulse = (restitution + 1) * closing / along * n;
  if (friction > 0) {
    const Mat3 K = response(a, x) + response(b, x);
    const Vec3 slip = u + closing * n;
    const Vec3 stick = K.inverse() * ((1 + restitution) * closing * n - slip);
    const double normal = stick.dot(n);
    if (normal > 0 && (stick - normal * n).norm() <= friction * normal) {
      impulse = stick;
    } else if (slip.norm() > 0) {
      const Vec3 t = slip.normalized();
      const double resist = n.dot(K * (n - friction * t));
      if (resist > 0.1 * along) {
        const double j = (1 + restitution) * closing / resist;
        // Friction stops the slip at most.
        const double most = slip.norm() / std::max(t.dot(K * t), 1e-300);
        impulse = j * n - std::min(friction * j, most) * t;
      }
    }
  }
  if (!impulse.allFinite()) return Vec3::Zero();
  a.apply(impulse, x), b.apply(-impulse, x);
  return impulse;
}

}  // namespace stadion
