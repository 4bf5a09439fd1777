#include "dynamics/arc.h"

#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

/// (1 - e^-x) / x and (x - 1 + e^-x) / x^2 without cancellation.
void decay(double x, double& first, double& second) {
  if (x < 1e-2) {
    first = 1 - x / 2 * (1 - x / 3 * (1 - x / 4 * (1 - x / 5 * (1 - x / 6 * (1 - x / 7)))));
    second = 0.5 * (1 - x / 3 * (1 - x / 4 * (1 - x / 5 * (1 - x / 6 * (1 - x / 7)))));
    return;
  }
  first = -det::expm1(-x) / x;
  second = (1 - first) / x;
}

/// Taylor coefficients of the orientation of a free body: w' = I^-1 (I w x w) in body axes, q' = q w / 2.
void expand(Spin& s, const Vec3& inertia) {
  constexpr int n = Spin::kOrder;
  double wx[n + 1], wy[n + 1], wz[n + 1];
  const Vec3 w0 = s.inverse.cwiseProduct(s.q0.conjugate() * s.L);
  wx[0] = w0.x(), wy[0] = w0.y(), wz[0] = w0.z();
  s.series[0] = {s.q0.w(), s.q0.x(), s.q0.y(), s.q0.z()};
  const Vec3 k((inertia.y() - inertia.z()) * s.inverse.x(), (inertia.z() - inertia.x()) * s.inverse.y(),
               (inertia.x() - inertia.y()) * s.inverse.z());
  for (int i = 0; i < n; ++i) {
    double dx = 0, dy = 0, dz = 0;
    double a = 0, b = 0, c = 0, d = 0;
    for (int j = 0; j <= i; ++j) {
      const double x = wx[i - j], y = wy[i - j], z = wz[i - j];
      dx += wy[j] * z, dy += wz[j] * x, dz += wx[j] * y;
      const Eigen::Vector4d& q = s.series[static_cast<std::size_t>(j)];
      a -= q[1] * x + q[2] * y + q[3] * z;
      b += q[0] * x + q[2] * z - q[3] * y;
      c += q[0] * y + q[3] * x - q[1] * z;
      d += q[0] * z + q[1] * y - q[2] * x;
    }
    const double share = 1.0 / (i + 1);
    wx[i + 1] = k.x() * dx * share, wy[i + 1] = k.y() * dy * share, wz[i + 1] = k.z() * dz * share;
    s.series[static_cast<std::size_t>(i + 1)] = 0.5 * share * Eigen::Vector4d(a, b, c, d);
  }
  // As far as the last two terms stay below the tolerance; they may vanish, so the radius that bounds any
  // free motion limits it as well.
  constexpr double tolerance = 2e-15;
  const double speed = s.L.norm() * s.inverse.maxCoeff();
  const double last = std::max(s.series[n].cwiseAbs().maxCoeff(), 1e-300),
               before = std::max(s.series[n - 1].cwiseAbs().maxCoeff(), 1e-300);
  s.horizon = std::min(
      {det::pow(tolerance / last, 1.0 / n), det::pow(tolerance / before, 1.0 / (n - 1)), 1.2 / speed});
}

Quat renormalised(const Quat& q) {
  return Quat(q.coeffs() / std::sqrt(q.squaredNorm()));
}

}  // namespace

Path Path::still(const Vec3& p) {
  Path path;
  path.c[0] = p;
  return path;
}

Path Path::parabola(const Vec3& p, const Vec3& v, const Vec3& a, double damping) {
  Path path;
  path.c[0] = p, path.c[1] = v;
  if (damping > 0) {
    path.kind = Kind::Damped, path.damping = damping, path.c[2] = a;
  } else {
    path.c[2] = 0.5 * a, path.degree = 2;
  }
  return path;
}

Path Path::hermite(const Vec3 (&s)[3], const Vec3 (&e)[3], double h) {
  Path path;
  path.degree = 5;
  path.c[0] = s[0], path.c[1] = s[1], path.c[2] = 0.5 * s[2];
  const Vec3 dp = (e[0] - s[0] - h * s[1] - 0.5 * h * h * s[2]) / (h * h * h);
  const Vec3 dv = (e[1] - s[1] - h * s[2]) / (h * h), da = (e[2] - s[2]) / h;
  path.c[3] = 10 * dp - 4 * dv + 0.5 * da;
  path.c[4] = (-15 * dp + 7 * dv - da) / h;
  path.c[5] = (6 * dp - 3 * dv + 0.5 * da) / (h * h);
  path.spare = 2 * path.c[2].norm() + 6 * h * path.c[3].norm() + 12 * h * h * path.c[4].norm() +
               20 * h * h * h * path.c[5].norm();
  return path;
}

Vec3 Path::position(double t) const {
  if (kind == Kind::Damped) {
    double f, g;
    decay(damping * t, f, g);
    return c[0] + t * (f * c[1] + t * g * c[2]);
  }
  Vec3 p = c[static_cast<std::size_t>(degree)];
  for (int i = degree - 1; i >= 0; --i) p = p * t + c[static_cast<std::size_t>(i)];
  return p;
}

Vec3 Path::velocity(double t) const {
  if (kind == Kind::Damped) {
    double f, g;
    decay(damping * t, f, g);
    return c[1] * (1 - damping * t * f) + t * f * c[2];
  }
  Vec3 v = Vec3::Zero();
  for (int i = degree; i >= 1; --i) v = v * t + i * c[static_cast<std::size_t>(i)];
  return v;
}

double Path::accelerationBound() const {
  if (kind == Kind::Damped) return (c[2] - damping * c[1]).norm();
  return degree <= 2 ? (degree == 2 ? 2 * c[2].norm() : 0) : spare;
}

Spin Spin::still(const Quat& q) {
  Spin s;
  s.q0 = q;
  return s;
}

Spin Spin::free(const Quat& q, const Vec3& L, const Vec3& inertia) {
  Spin s;
  s.q0 = q, s.L = L, s.inverse = inertia.cwiseInverse();
  if (L.squaredNorm() == 0) return s;
  const double size = inertia.maxCoeff();
  const auto equal = [&](int i, int j) { return std::fabs(inertia[i] - inertia[j]) <= 1e-12 * size; };
  const bool xy = equal(0, 1), yz = equal(1, 2), xz = equal(0, 2);
  if (xy && yz) {
    s.kind = Kind::Uniform;
    s.omega = s.inverse.x() * L;
  } else if (xy || yz || xz) {
    s.kind = Kind::Symmetric;
    s.axis = xy ? 2 : yz ? 0 : 1;
  } else {
    s.kind = Kind::Taylor;
    expand(s, inertia);
  }
  return s;
}

Spin Spin::driven(const Quat& q, const Vec3& omega, const Vec3& alpha, double inertia) {
  Spin s;
  s.kind = Kind::Driven;
  s.q0 = q, s.omega = omega, s.alpha = alpha;
  s.inverse.setConstant(1 / inertia);
  s.L = inertia * omega;
  return s;
}

Quat Spin::orientation(double t) const {
  switch (kind) {
  case Kind::Still: return q0;
  case Kind::Uniform: return renormalised(det::expRotation(t * omega) * q0);
  case Kind::Symmetric: {
    // Precession about L at L / I_transverse, then rotation about the body's own axis by what remains.
    const int across = (axis + 1) % 3;
    const double own = (q0.conjugate() * L)[axis];
    Vec3 w = Vec3::Zero();
    w[axis] = t * own * (inverse[axis] - inverse[across]);
    return renormalised(det::expRotation(t * inverse[across] * L) * q0 * det::expRotation(w));
  }
  case Kind::Taylor: {
    Eigen::Vector4d q = series[kOrder];
    for (int i = kOrder - 1; i >= 0; --i) q = q * t + series[static_cast<std::size_t>(i)];
    return renormalised(Quat(q[0], q[1], q[2], q[3]));
  }
  case Kind::Driven: {
    // Magnus expansion to fourth order for an angular velocity linear in time, in pieces short enough for
    // 1e-8.
    const Vec3 turn = alpha.cross(omega);
    const int pieces = turn.squaredNorm() < 1e-20 ? 1 : std::clamp(static_cast<int>(t / 0.01) + 1, 1, 100);
    const double h = t / pieces;
    Quat q = q0;
    for (int i = 0; i < pieces; ++i)
      q = det::expRotation(h * (omega + (i + 0.5) * h * alpha) + h * h * h / 12 * turn) * q;
    return renormalised(q);
  }
  }
  return q0;
}

Vec3 Spin::angularMomentum(double t) const {
  return kind == Kind::Driven ? Vec3((omega + t * alpha) / inverse.x()) : L;
}

Vec3 Spin::angularVelocity(double t) const {
  switch (kind) {
  case Kind::Still: return Vec3::Zero();
  case Kind::Uniform: return omega;
  case Kind::Driven: return omega + t * alpha;
  default: {
    const Quat q = orientation(t);
    return q * inverse.cwiseProduct(q.conjugate() * L);
  }
  }
}

double Spin::speedBound(double t) const {
  switch (kind) {
  case Kind::Still: return 0;
  case Kind::Uniform: return omega.norm();
  case Kind::Driven: return omega.norm() + t * alpha.norm();
  default: return L.norm() * inverse.maxCoeff();
  }
}

}  // namespace stadion
