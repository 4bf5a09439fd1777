#include "dynamics/body/ball_motion.h"

#include <cmath>

namespace stadion {
namespace {

constexpr double kForever = std::numeric_limits<double>::infinity();
constexpr double kStill = 1e-9;            // [m/s] slower is standing
constexpr double kCurvedStep = 1.0 / 480;  // [s] of an arc whose friction turns

bool parallel(const Vec3& a, const Vec3& b) {
  return a.cross(b).norm() <= 1e-9 * a.norm() * b.norm() + 1e-14;
}

/// Spin about the normal wears off by rolling resistance; returns its rate and shortens the horizon to its
/// end.
Vec3 pivoting(const Vec3& omega, const Vec3& n, double rate, double& horizon) {
  const double w = omega.dot(n);
  if (std::fabs(w) < kStill || rate <= 0) return Vec3::Zero();
  horizon = std::min(horizon, std::fabs(w) / rate);
  return (w > 0 ? -rate : rate) * n;
}

}  // namespace

double timeToEdge(const Path& path, const Support& face) {
  double first = kForever;
  const Vec3 &p = path.c[0], &v = path.c[1];
  const Vec3 a = path.degree >= 2 ? Vec3(2 * path.c[2]) : Vec3::Zero();
  for (std::size_t i = 0; i < static_cast<std::size_t>(face.edges); ++i) {
    const double h = face.edgeNormal[i].dot(p) - face.edgeOffset[i], u = face.edgeNormal[i].dot(v),
                 b = face.edgeNormal[i].dot(a);
    if (h <= 0) {
      if (u < 0 || (u == 0 && b < 0)) return 0;
      if (u > 0 || b >= 0) {
        if (b < 0 && u > 0) first = std::min(first, -2 * u / b);
        continue;
      }
    }
    const double d = u * u - 2 * b * h;
    if (d < 0) continue;
    if (u < 0) {
      first = std::min(first, 2 * h / (std::sqrt(d) - u));
    } else if (b < 0) {
      first = std::min(first, (u + std::sqrt(d)) / -b);
    }
  }
  return first;
}

namespace {

/// A ball that a face carries, and what acts on it along the face.
struct CarriedBall {
  const BallStart& s;
  const Vec3& n;  ///< of the face
  double r, inertia;
  double k;     ///< inertia / (mass r^2)
  Vec3 pull;    ///< along the face [m/s2]
  Vec3 v;       ///< along the face [m/s]
  double grip;  ///< greatest acceleration by friction [m/s2]
  double drag;  ///< of rolling [m/s2]
  double turn;  ///< of the spin about the normal, by rolling resistance [rad/s2]

  BallArc roll(const Vec3& omega) const;
  /// The ball does not move on, but may spin about the normal.
  BallArc stand(const Vec3& omega) const;
  /// `slip` is the velocity of its lowest point, `speed` its length.
  BallArc slide(const Vec3& slip, double speed) const;
};

BallArc CarriedBall::stand(const Vec3& omega) const {
  BallArc arc;
  arc.horizon = kForever;
  arc.path = Path::still(s.p);
  if (omega.isZero(0)) {
    arc.mode = BodyMode::Rest;
    arc.spin = Spin::still(s.q);
    return arc;
  }
  arc.mode = BodyMode::Roll;
  const Vec3 alpha = pivoting(omega, n, turn, arc.horizon);
  arc.spin = Spin::driven(s.q, omega, alpha, inertia);
  return arc;
}

BallArc CarriedBall::roll(const Vec3& omega) const {
  BallArc arc;
  arc.horizon = kForever;
  arc.mode = BodyMode::Roll;
  const Vec3 along = v.norm() > 0 ? v.normalized() : pull.normalized();
  const Vec3 acceleration = pull / (1 + k) - drag * along;
  arc.path = Path::parabola(s.p, v, acceleration);
  const double change = acceleration.dot(along);
  if (v.norm() > 0 && change < 0) arc.horizon = std::min(arc.horizon, v.norm() / -change);
  if (!parallel(pull, along)) arc.horizon = std::min(arc.horizon, kCurvedStep);
  const Vec3 twist = pivoting(omega, n, turn, arc.horizon);
  arc.spin = Spin::driven(s.q, omega, n.cross(acceleration) / r + twist, inertia);
  return arc;
}

BallArc CarriedBall::slide(const Vec3& slip, double speed) const {
  BallArc arc;
  arc.horizon = kForever;
  arc.mode = BodyMode::Slide;
  const Vec3 along = speed > kStill ? Vec3(slip / speed) : pull.normalized();
  const Vec3 acceleration = pull - grip * along;
  arc.path = Path::parabola(s.p, v, acceleration);
  const double shrink = grip * (1 + 1 / k) - pull.dot(along);
  if (speed > kStill && shrink > 0) arc.horizon = speed / shrink;
  if (!parallel(pull, along) && grip > 0) arc.horizon = std::min(arc.horizon, kCurvedStep);
  const Vec3 twist = pivoting(s.omega, n, turn, arc.horizon);
  arc.spin = Spin::driven(s.q, s.omega, grip / (k * r) * n.cross(along) + twist, inertia);
  return arc;
}

}  // namespace

BallArc ballOnFace(const BallStart& s, const Support& face, const Vec3& a, double r, double m, double inertia,
                   bool gripped, bool stopped) {
  const Vec3& n = face.normal;
  const double gn = -a.dot(n), k = inertia / (m * r * r);
  if (!(gn > 0)) {
    BallArc arc;
    arc.leaves = true;
    return arc;
  }
  CarriedBall ball{s,
                   n,
                   r,
                   inertia,
                   k,
                   a + gn * n,
                   s.v - n * n.dot(s.v),
                   face.friction * gn,
                   face.rolling * gn / (1 + k),
                   face.rolling * gn / (k * r)};
  Vec3& v = ball.v;
  Vec3 slip = v - r * s.omega.cross(n);
  slip -= n * n.dot(slip);
  const double speed = slip.norm(), pull = ball.pull.norm();
  // Rolling needs this much friction; where there is less the ball slips from standing too.
  const bool canGrip = pull * k / (1 + k) <= ball.grip || (face.friction > 0 && pull <= kStill);
  BallArc arc;
  if ((gripped || speed <= kStill) && (canGrip || pull == 0)) {
    Vec3 omega = n.cross(v) / r + n * n.dot(s.omega);
    if (face.friction <= 0) omega = s.omega;
    if (stopped || v.norm() <= kStill) {
      v.setZero();
      omega = n * n.dot(s.omega);
      if (std::fabs(n.dot(s.omega)) <= kStill) omega.setZero();
      if (pull <= (1 + k) * ball.drag + 1e-12) return ball.stand(omega);
    }
    arc = ball.roll(omega);
  } else {
    arc = ball.slide(slip, speed);
  }
  arc.horizon = std::min(arc.horizon, timeToEdge(arc.path, face));
  return arc;
}

}  // namespace stadion
