#include "dynamics/motion/arc.h"

#include "dynamics/maths/double4.h"
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

/// Taylor coefficients of the orientation of a free body: w' = I^-1 (I w x w) in body axes, q' = q w / 2,
/// with quaternions as (w, x, y, z). `k` are the moments' differences over the third, `q` and `w` begin with
/// theirs.
struct SpinSeries {
  Double4 q[Spin::kOrder + 1], w[Spin::kOrder + 1], k;
};

/// In sums, what has just been found comes last: the rest does not wait for it.
[[gnu::always_inline]] inline void expandSeries(SpinSeries& s) {
  constexpr int n = Spin::kOrder;
  // The products of quaternions are sums of permutations of q; those of w' are of (y, z, x) and (z, x, y).
  Double4 byI[n], byJ[n], byK[n], next[n], last[n];
#pragma GCC unroll 16
  for (int i = 0; i < n; ++i) {
    const Double4 q = s.q[i], v = s.w[i];
    byI[i] = Double4{-1, 1, 1, -1} * __builtin_shufflevector(q, q, 1, 0, 3, 2);
    byJ[i] = Double4{-1, -1, 1, 1} * __builtin_shufflevector(q, q, 2, 3, 0, 1);
    byK[i] = Double4{-1, 1, -1, 1} * __builtin_shufflevector(q, q, 3, 2, 1, 0);
    next[i] = __builtin_shufflevector(v, v, 1, 2, 0, 3);
    last[i] = __builtin_shufflevector(v, v, 2, 0, 1, 3);
    Double4 dw{}, dq{};
#pragma GCC unroll 16
    for (int k = 1; k <= i + 1; ++k) {
      const int j = k % (i + 1);
      const Double4& u = s.w[i - j];
      dw += next[j] * last[i - j];
      dq += u[0] * byI[j] + u[1] * byJ[j] + u[2] * byK[j];
    }
    const double share = 1.0 / (i + 1);
    s.w[i + 1] = share * (s.k * dw);
    s.q[i + 1] = 0.5 * share * dq;
  }
}
[[gnu::target("avx2")]] void expandAvx2(SpinSeries& s) {
  expandSeries(s);
}
void expandPlain(SpinSeries& s) {
  expandSeries(s);
}

void expand(Spin& s, const Vec3& inertia) {
  constexpr std::size_t n = Spin::kOrder;
  SpinSeries terms;
  terms.q[0] = Double4{s.q0.w(), s.q0.x(), s.q0.y(), s.q0.z()};
  set(terms.w[0], s.inverse.cwiseProduct(s.q0.conjugate() * s.L));
  terms.k = Double4{(inertia.y() - inertia.z()) * s.inverse.x(), (inertia.z() - inertia.x()) * s.inverse.y(),
                    (inertia.x() - inertia.y()) * s.inverse.z(), 0};
  hasAvx2() ? expandAvx2(terms) : expandPlain(terms);
  for (std::size_t i = 0; i <= n; ++i)
    s.series[i] = {terms.q[i][0], terms.q[i][1], terms.q[i][2], terms.q[i][3]};
  // As far as the last two terms stay below the tolerance, of which what follows them is a tenth; they may
  // vanish, so the radius that bounds any free motion limits it as well.
  constexpr double tolerance = 1e-12;
  const double speed = s.L.norm() * s.inverse.maxCoeff();
  const double last = s.series[n].cwiseAbs().maxCoeff(), before = s.series[n - 1].cwiseAbs().maxCoeff();
  s.horizon = std::min(reachOfSeries(last, before, tolerance), 2.4 / speed);
}

/// A series of degree 16, or its rate of change, in four chains of every fourth power: a single one would
/// wait for its own results.
template <bool kRate, int kStride>
[[gnu::always_inline]] inline void sumSeries(const double* c, double t, Double4& sum) {
  static_assert(Path::kMostDegree == 16 && Spin::kOrder == 16);
  constexpr int kLowest = kRate ? 1 : 0;
  const double t2 = t * t, t4 = t2 * t2;
  Double4 chain[4];  // of powers lowest + k, + 4, + 8 ...
#pragma GCC unroll 4
  for (int k = 0; k < 4; ++k) {
    const int top = (16 - kLowest - k) / 4 * 4 + kLowest + k;
#pragma GCC unroll 5
    for (int i = top; i >= kLowest; i -= 4) {
      Double4 term = *reinterpret_cast<const UnalignedDouble4*>(c + kStride * i);
      if (kRate) term *= static_cast<double>(i);
      chain[k] = i == top ? term : chain[k] * t4 + term;
    }
  }
  sum = (chain[0] + t * chain[1]) + t2 * (chain[2] + t * chain[3]);
}
template <bool kRate, int kStride>
[[gnu::target("avx2")]] void sumAvx2(const double* c, double t, Double4& sum) {
  sumSeries<kRate, kStride>(c, t, sum);
}
/// Of terms of three numbers (and one more behind the last) or of four.
template <bool kRate, int kStride>
void sum(const double* c, double t, Double4& sum) {
  hasAvx2() ? sumAvx2<kRate, kStride>(c, t, sum) : sumSeries<kRate, kStride>(c, t, sum);
}
template <bool kRate>
Vec3 sumOf(const Path& path, double t) {
  Double4 s;
  sum<kRate, 3>(path.c[0].data(), t, s);
  return firstThree(s);
}

/// Of unit length again: the root of 1 + e is 1 + e / 2 to the last place.
Quat renormalised(const Quat& q) {
  const double square = q.squaredNorm(), e = square - 1;
  return Quat(q.coeffs() * (std::fabs(e) < 1e-9 ? 1 - 0.5 * e : 1 / std::sqrt(square)));
}

}  // namespace

double reachOfSeries(double c16, double c15, double tolerance) {
  const auto root = [](double x) { return std::sqrt(std::sqrt(std::sqrt(std::sqrt(x)))); };
  const double t = root(tolerance / std::max(c16, 1e-290));
  const double t2 = t * t, t4 = t2 * t2, t8 = t4 * t4, other = c15 * t8 * t4 * t2 * t;
  return other > tolerance ? t * root(tolerance / other) : t;
}

Path& Path::operator=(const Path& o) {
  kind = o.kind;
  degree = o.degree;
  damping = o.damping;
  spare = o.spare;
  std::copy_n(o.c.begin(), std::max(3, degree + 1), c.begin());
  return *this;
}

void Path::boundAcceleration(double horizon) {
  Vec3 most = Vec3::Zero();
  double power = 1;
  for (int n = 2; n <= degree; ++n, power *= horizon)
    most += n * (n - 1) * power * c[static_cast<std::size_t>(n)].cwiseAbs();
  spare = most.norm();
}

Path Path::still(const Vec3& p) {
  Path path;
  path.c[0] = p;
  return path;
}

Path Path::parabola(const Vec3& p, const Vec3& v, const Vec3& a, double damping) {
  Path path;
  path.c[0] = p;
  path.c[1] = v;
  if (damping > 0) {
    path.kind = Kind::Damped;
    path.damping = damping;
    path.c[2] = a;
  } else {
    path.c[2] = 0.5 * a;
    path.degree = 2;
  }
  return path;
}

Path Path::hermite(const Vec3 (&s)[3], const Vec3 (&e)[3], double h) {
  Path path;
  path.degree = 5;
  path.c[0] = s[0];
  path.c[1] = s[1];
  path.c[2] = 0.5 * s[2];
  const Vec3 dp = (e[0] - s[0] - h * s[1] - 0.5 * h * h * s[2]) / (h * h * h);
  const Vec3 dv = (e[1] - s[1] - h * s[2]) / (h * h), da = (e[2] - s[2]) / h;
  path.c[3] = 10 * dp - 4 * dv + 0.5 * da;
  path.c[4] = (-15 * dp + 7 * dv - da) / h;
  path.c[5] = (6 * dp - 3 * dv + 0.5 * da) / (h * h);
  path.boundAcceleration(h);
  return path;
}

Vec3 Path::seriesPosition(double t) const {
  return sumOf<false>(*this, t);
}

Vec3 Path::curvedPosition(double t) const {
  return kind == Kind::Damped ? dampedPosition(t) : polynomialPosition(t);
}

Vec3 Path::dampedPosition(double t) const {
  double f, g;
  decay(damping * t, f, g);
  return c[0] + t * (f * c[1] + t * g * c[2]);
}

/// Even and odd powers apart: two short chains instead of a long one.
Vec3 Path::polynomialPosition(double t) const {
  const double square = t * t;
  int i = degree & ~1;
  Vec3 even = c[static_cast<std::size_t>(i)];
  for (i -= 2; i >= 0; i -= 2) even = even * square + c[static_cast<std::size_t>(i)];
  i = (degree - 1) | 1;
  Vec3 odd = c[static_cast<std::size_t>(i)];
  for (i -= 2; i >= 1; i -= 2) odd = odd * square + c[static_cast<std::size_t>(i)];
  return even + t * odd;
}

Vec3 Path::curvedVelocity(double t) const {
  if (kind == Kind::Damped) {
    double f, g;
    decay(damping * t, f, g);
    return c[1] * (1 - damping * t * f) + t * f * c[2];
  }
  if (isSeries()) return sumOf<true>(*this, t);
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
  s.q0 = q;
  s.L = L;
  s.inverse = inertia.cwiseInverse();
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
  s.q0 = q;
  s.omega = omega;
  s.alpha = alpha;
  s.inverse.setConstant(1 / inertia);
  s.L = inertia * omega;
  return s;
}

Vec3 rateOfTurn(const Vec3& w, const Vec3& omega) {
  const Vec3 a = w.cross(omega);
  return omega - 0.5 * a + 1.0 / 12 * w.cross(a);
}

Spin Spin::unsteered(const Quat& q, const Vec3& L, const Vec3& inertia) {
  const double size = inertia.maxCoeff();
  const auto equal = [&](int i, int j) { return std::fabs(inertia[i] - inertia[j]) <= 1e-12 * size; };
  if (equal(0, 1) || equal(1, 2) || equal(0, 2) || L.squaredNorm() == 0) return free(q, L, inertia);
  Spin s;
  s.kind = Kind::Uniform;
  s.q0 = q;
  s.L = L;
  s.inverse = inertia.cwiseInverse();
  s.omega = q * s.inverse.cwiseProduct(q.conjugate() * L);
  return s;
}

namespace {

/// a t^2 + b t^3 + c t^4, t in [0, h]: greatest of |d/dt| and of |d2/dt2|.
std::pair<double, double> boundsOf(const Vec3& a, const Vec3& b, const Vec3& c, double h) {
  const double A = a.norm(), B = b.norm(), C = c.norm();
  return {h * (2 * A + h * (3 * B + h * 4 * C)), 2 * A + h * (6 * B + h * 12 * C)};
}

Vec3 firstThree(const Eigen::Vector4d& x) {
  return x.head<3>();
}
Eigen::Vector4d padded(const Vec3& x) {
  return {x.x(), x.y(), x.z(), 0};
}

}  // namespace

Spin Spin::steered(const End& start, const End& end, double h, const Vec3& inertia) {
  const Spin base = unsteered(start.q, start.L, inertia);
  const auto turned = [&](const Quat& q, const Vec3& L) -> Vec3 {
    return q * base.inverse.cwiseProduct(q.conjugate() * L);
  };
  const Quat q1 = base.orientation(h);
  const Vec3 w = det::logRotation(end.q * q1.conjugate());
  const Vec3 rate = rateOfTurn(w, turned(end.q, end.L) - det::expRotation(w) * base.angularVelocity(h, q1));
  // The torque's own share of how the angular velocity changes, and what an even base motion leaves out.
  Vec3 second = turned(start.q, start.torque);
  if (base.kind == Kind::Uniform) second += turned(start.q, start.L.cross(base.omega));

  Spin s;
  static_cast<SpinTerms&>(s) = base;
  s.kind = Kind::Steered;
  s.omega = turned(start.q, start.L);
  s.alpha.setZero();
  s.axis = base.kind == Kind::Symmetric ? base.axis : base.kind == Kind::Uniform ? kEven : kStanding;
  const Vec3 a = 0.5 * second, u = (w - h * h * a) / (h * h * h), v = (rate - 2 * h * a) / (h * h);
  const Vec3 b = 4 * u - v, c = (v - 3 * u) / h;
  s.series[0] = padded(a);
  s.series[1] = padded(b);
  s.series[2] = padded(c);
  const Vec3 gained = (end.L - start.L - h * start.torque) / (h * h), more = (end.torque - start.torque) / h;
  s.series[3] = padded(start.torque);
  s.series[4] = padded(3 * gained - more);
  s.series[5] = padded((more - 2 * gained) / h);
  const auto [speed, change] = boundsOf(a, b, c, h);
  const double own = base.speedBound(h);
  s.series[6] = {own + 1.1 * speed, own * own + 2 * own * speed + 1.1 * change, 0, 0};
  return s;
}

Quat Spin::steeredOrientation(double t) const {
  const Vec3 w = t * t * (firstThree(series[0]) + t * (firstThree(series[1]) + t * firstThree(series[2])));
  Quat own = q0;
  if (axis == kEven) own = det::expRotation(t * omega) * q0;
  if (axis < kEven) own = precession(t);
  return renormalised(det::expRotation(w) * own);
}

/// Precession about L at L / I_transverse, then rotation about the body's own axis by what remains.
Quat Spin::precession(double t) const {
  const int across = (axis + 1) % 3;
  const double own = (q0.conjugate() * L)[axis];
  Vec3 w = Vec3::Zero();
  w[axis] = t * own * (inverse[axis] - inverse[across]);
  return det::expRotation(t * inverse[across] * L) * q0 * det::expRotation(w);
}

Quat Spin::seriesOrientation(double t) const {
  Double4 q;
  sum<false, 4>(series[0].data(), t, q);
  return renormalised(Quat(q[0], q[1], q[2], q[3]));
}

Quat Spin::turnedOrientation(double t) const {
  switch (kind) {
  case Kind::Still: return q0;
  case Kind::Uniform: return renormalised(det::expRotation(t * omega) * q0);
  case Kind::Symmetric: return renormalised(precession(t));
  case Kind::Steered: return steeredOrientation(t);
  case Kind::Taylor: return seriesOrientation(t);
  case Kind::Driven: {
    // Magnus expansion to fourth order for an angular velocity linear in time, in pieces short enough for
    // about 1e-6.
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
  if (kind == Kind::Steered)
    return L + t * (firstThree(series[3]) + t * (firstThree(series[4]) + t * firstThree(series[5])));
  return kind == Kind::Driven ? Vec3((omega + t * alpha) / inverse.x()) : L;
}

Vec3 Spin::angularVelocity(double t) const {
  return angularVelocity(
      t, kind == Kind::Still || kind == Kind::Uniform || kind == Kind::Driven ? q0 : orientation(t));
}

Vec3 Spin::angularVelocity(double t, const Quat& q) const {
  switch (kind) {
  case Kind::Still: return Vec3::Zero();
  case Kind::Uniform: return omega;
  case Kind::Driven: return omega + t * alpha;
  case Kind::Steered: return q * inverse.cwiseProduct(q.conjugate() * angularMomentum(t));
  default: return q * inverse.cwiseProduct(q.conjugate() * L);
  }
}

namespace {

/// The greatest angular speed of a free body whose angular momentum is l in its principal axes now. Its
/// square is linear in the l_i^2, which |l|^2 and the energy constrain, each linearly, too: the greatest is
/// where one of them is zero, (a_i + a_j) 2T - a_i a_j |l|^2 with a the inverse moments.
double freeSpeedBound(const Vec3& l, const Vec3& a) {
  const double l2 = l.squaredNorm(), twiceT = a.dot(l.cwiseAbs2());
  double most = a.cwiseProduct(l).squaredNorm();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double least = std::min(a[i], a[j]) * l2, greatest = std::max(a[i], a[j]) * l2,
                 slack = 1e-12 * greatest;
    if (twiceT < least - slack || twiceT > greatest + slack) continue;
    most = std::max(most, (a[i] + a[j]) * twiceT - a[i] * a[j] * l2);
  }
  return (1 + 1e-9) * std::sqrt(most);
}

}  // namespace

double Spin::speedBound(double t) const {
  switch (kind) {
  case Kind::Still: return 0;
  case Kind::Uniform: return omega.norm();
  case Kind::Driven: return omega.norm() + t * alpha.norm();
  case Kind::Steered: return series[6][0];
  case Kind::Symmetric: return angularVelocity(0, q0).norm();
  case Kind::Taylor: return freeSpeedBound(q0.conjugate() * L, inverse);
  }
  return 0;
}

}  // namespace stadion
