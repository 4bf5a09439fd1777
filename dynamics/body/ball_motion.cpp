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

BallArc ballOnFace(const BallStart& s, const Support& face, const Vec3& a, double r, double m, double inertia,
                   bool gripped, bool stopped) {
  BallArc arc;
  const Vec3& n = face.normal;
  const double gn = -a.dot(n), k = inertia / (m * r * r);
  if (!(gn > 0)) {
    arc.leaves = true;
    return arc;
  }
  const Vec3 pull = a + gn * n;
  Vec3 v = s.v - n * n.dot(s.v);
  const double grip = face.friction * gn, drag = face.rolling * gn / (1 + k);
  const double turn = face.rolling * gn / (k * r);  // of the spin about the normal
  arc.horizon = kForever;
  Vec3 slip = v - r * s.omega.cross(n);
  slip -= n * n.dot(slip);
  const double speed = slip.norm();
  // Rolling needs this much friction; where there is less the ball slips from standing too.
  const bool canGrip = pull.norm() * k / (1 + k) <= grip || (face.friction > 0 && pull.norm() <= kStill);
  if ((gripped || speed <= kStill) && (canGrip || pull.norm() == 0)) {
    Vec3 omega = n.cross(v) / r + n * n.dot(s.omega);
    if (face.friction <= 0) omega = s.omega;
    if (stopped || v.norm() <= kStill) {
      v.setZero();
      omega = n * n.dot(s.omega);
      if (std::fabs(n.dot(s.omega)) <= kStill) omega.setZero();
      if (pull.norm() <= (1 + k) * drag + 1e-12) {
        arc.path = Path::still(s.p);
        if (omega.isZero(0)) {
          arc.mode = BodyMode::Rest, arc.spin = Spin::still(s.q);
          return arc;
        }
        arc.mode = BodyMode::Roll;
        const Vec3 alpha = pivoting(omega, n, turn, arc.horizon);
        arc.spin = Spin::driven(s.q, omega, alpha, inertia);
        return arc;
      }
    }
    arc.mode = BodyMode::Roll;
    const Vec3 along = v.norm() > 0 ? v.normalized() : pull.normalized();
    const Vec3 acceleration = pull / (1 + k) - drag * along;
    arc.path = Path::parabola(s.p, v, acceleration);
    const double change = acceleration.dot(along);
    if (v.norm() > 0 && change < 0) arc.horizon = std::min(arc.horizon, v.norm() / -change);
    if (!parallel(pull, along)) arc.horizon = std::min(arc.horizon, kCurvedStep);
    const Vec3 twist = pivoting(omega, n, turn, arc.horizon);
    arc.spin = Spin::driven(s.q, omega, n.cross(acceleration) / r + twist, inertia);
  } else {
    arc.mode = BodyMode::Slide;
    const Vec3 along = speed > kStill ? Vec3(slip / speed) : pull.normalized();
    const Vec3 acceleration = pull - grip * along;
    arc.path = Path::parabola(s.p, v, acceleration);
    const double shrink = grip * (1 + 1 / k) - pull.dot(along);
    if (speed > kStill && shrink > 0) arc.horizon = speed / shrink;
    if (!parallel(pull, along) && grip > 0) arc.horizon = std::min(arc.horizon, kCurvedStep);
    const Vec3 twist = pivoting(s.omega, n, turn, arc.horizon);
    arc.spin = Spin::driven(s.q, s.omega, grip / (k * r) * n.cross(along) + twist, inertia);
  }
  arc.horizon = std::min(arc.horizon, timeToEdge(arc.path, face));
  return arc;
}

}  // namespace stadion
