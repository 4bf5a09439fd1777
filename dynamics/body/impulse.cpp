#include "dynamics/body/impulse.h"

#include <algorithm>
#include <cmath>

namespace stadion {

SolverBody solverBodyOf(const RigidBody& b, double tau) {
  if (!b.movable()) {
    const Kinematics k = b.at(tau);
    return {0, Mat3::Zero(), k.p, k.v, k.omega, k.pose.q * b.X_NC.q};
  }
  const Quat q = b.orientation(tau);
  SolverBody m{b.inverseMass, Mat3::Zero(), b.position(tau), b.velocity(tau), b.angularVelocity(tau, q), q};
  const Vec3 inverse = b.inertia.cwiseInverse();
  if (inverse.x() == inverse.y() && inverse.y() == inverse.z()) {
    m.inverseInertia = inverse.x() * Mat3::Identity();
  } else {
    const Mat3 R = q.toRotationMatrix();
    m.inverseInertia = R * inverse.asDiagonal() * R.transpose();
  }
  return m;
}

SolverBody solverBodyOf(const Collider& c, double tau) {
  const Kinematics k = c.motion.at(tau);
  return {0, Mat3::Zero(), k.p, k.v, k.omega, k.pose.q};
}

Mat3 response(const SolverBody& m, const Vec3& x) {
  if (m.inverseMass == 0) return Mat3::Zero();
  const Mat3 r = skew(x - m.p);
  return m.inverseMass * Mat3::Identity() - r * m.inverseInertia * r;
}

namespace {

/// The same along n alone.
double responseAlong(const SolverBody& m, const Vec3& x, const Vec3& n) {
  if (m.inverseMass == 0) return 0;
  const Vec3 turn = (x - m.p).cross(n);
  return m.inverseMass + turn.dot(m.inverseInertia * turn);
}

/// The impulse on a that makes the approach, u at x, a parting at `restitution` times its speed.
Vec3 impulseAgainst(const Vec3& u, const Mat3& K, const Vec3& n, double restitution, double friction) {
  const double closing = -u.dot(n), along = n.dot(K * n);
  const Vec3 slip = u + closing * n;
  const Vec3 stick = K.inverse() * ((1 + restitution) * closing * n - slip);
  const double normal = stick.dot(n);
  if (normal > 0 && (stick - normal * n).norm() <= friction * normal) return stick;
  if (slip.norm() > 0) {
    const Vec3 t = slip.normalized();
    const double resist = n.dot(K * (n - friction * t));
    if (resist > 0.1 * along) {
      const double j = (1 + restitution) * closing / resist;
      // Friction stops the slip at most.
      const double most = slip.norm() / std::max(t.dot(K * t), 1e-300);
      return j * n - std::min(friction * j, most) * t;
    }
  }
  return (restitution + 1) * closing / along * n;
}

/// Where friction turns slip into approach, Newton's restitution would give more energy than there was (Kane,
/// A Dynamics Puzzle, 1984): it is then the greatest that gives none.
Vec3 withoutGain(const Vec3& u, const Mat3& K, const Vec3& n, double restitution, double friction,
                 const Vec3& impulse) {
  const auto gain = [&](const Vec3& p) { return p.dot(u + 0.5 * (K * p)); };
  if (!(gain(impulse) > 1e-13 * u.squaredNorm() / n.dot(K * n))) return impulse;
  const Vec3 stop = impulseAgainst(u, K, n, 0, friction), more = impulse - stop;
  const double c = gain(stop), a = 0.5 * more.dot(K * more), b = more.dot(u + K * stop);
  if (!(c <= 0) || !(a > 0)) return -(1 + restitution) * u.dot(n) / n.dot(K * n) * n;
  return stop + std::clamp((std::sqrt(b * b - 4 * a * c) - b) / (2 * a), 0.0, 1.0) * more;
}

}  // namespace

Vec3 collide(SolverBody& a, SolverBody& b, const Vec3& x, const Vec3& n, double restitution,
             double friction) {
  const Vec3 u = a.velocityAt(x) - b.velocityAt(x);
  const double closing = -u.dot(n);
  if (!(closing > 0)) return Vec3::Zero();
  if (friction == 0 && b.inverseMass == 0 && (x - a.p).cross(n).isZero(0)) {  // a ball on a smooth wall
    const Vec3 change = (restitution + 1) * closing * n;
    if (!change.allFinite()) return Vec3::Zero();
    a.v += change;
    return change / a.inverseMass;
  }
  Vec3 impulse;
  if (friction > 0) {
    const Mat3 K = response(a, x) + response(b, x);
    impulse = withoutGain(u, K, n, restitution, friction, impulseAgainst(u, K, n, restitution, friction));
  } else {
    impulse = (restitution + 1) * closing / (responseAlong(a, x, n) + responseAlong(b, x, n)) * n;
  }
  if (!impulse.allFinite()) return Vec3::Zero();
  a.apply(impulse, x);
  b.apply(-impulse, x);
  return impulse;
}

}  // namespace stadion
