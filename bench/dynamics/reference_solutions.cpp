#include "bench/dynamics/reference_solutions.h"

#include <algorithm>

namespace stadion::bench {
namespace {

using Real = long double;

struct Flight {
  Real s[6];  ///< position, velocity
};

Flight rateOf(const Flight& a, const Real g[3], Real k) {
  const Real speed = sqrtl(a.s[3] * a.s[3] + a.s[4] * a.s[4] + a.s[5] * a.s[5]);
  Flight d;
  for (int i = 0; i < 3; ++i) {
    d.s[i] = a.s[3 + i];
    d.s[3 + i] = g[i] - k * speed * a.s[3 + i];
  }
  return d;
}

Flight along(const Flight& a, Real h, const Flight& rate) {
  Flight r;
  for (int i = 0; i < 6; ++i) r.s[i] = a.s[i] + h * rate.s[i];
  return r;
}

void rungeKutta(Flight& s, Real h, const Real g[3], Real k) {
  const Flight a = rateOf(s, g, k), b = rateOf(along(s, h / 2, a), g, k),
               c = rateOf(along(s, h / 2, b), g, k), d = rateOf(along(s, h, c), g, k);
  for (int i = 0; i < 6; ++i) s.s[i] += h / 6 * (a.s[i] + 2 * b.s[i] + 2 * c.s[i] + d.s[i]);
}

constexpr int kOrder = 24;

struct Spinning {
  Real s[7];  ///< omega in the body's frame, quaternion w x y z
};

/// One step of Euler's equations and of the quaternion's, by the recurrence of their Taylor coefficients.
void taylorStep(Spinning& state, Real h, const Real c[3]) {
  Real a[7][kOrder + 1];
  for (int i = 0; i < 7; ++i) a[i][0] = state.s[i];
  for (int k = 0; k < kOrder; ++k) {
    Real d[7] = {0, 0, 0, 0, 0, 0, 0};
    for (int m = 0; m <= k; ++m) {
      const int n = k - m;
      const Real x = a[0][m], y = a[1][m], z = a[2][m];
      d[0] += c[0] * y * a[2][n];
      d[1] += c[1] * z * a[0][n];
      d[2] += c[2] * x * a[1][n];
      const Real W = a[3][n], X = a[4][n], Y = a[5][n], Z = a[6][n];
      d[3] += 0.5L * (-x * X - y * Y - z * Z);
      d[4] += 0.5L * (W * x + Y * z - Z * y);
      d[5] += 0.5L * (W * y - X * z + Z * x);
      d[6] += 0.5L * (W * z + X * y - Y * x);
    }
    for (int i = 0; i < 7; ++i) a[i][k + 1] = d[i] / static_cast<Real>(k + 1);
  }
  for (int i = 0; i < 7; ++i) {
    Real r = a[i][kOrder];
    for (int k = kOrder - 1; k >= 0; --k) r = r * h + a[i][k];
    state.s[i] = r;
  }
  Real length = 0;
  for (int i = 3; i < 7; ++i) length += state.s[i] * state.s[i];
  length = sqrtl(length);
  for (int i = 3; i < 7; ++i) state.s[i] /= length;
}

Tumbling after(Tumbling s, double t) {
  s.x += s.v * t;
  s.angle += s.omega * t;
  return s;
}

/// From the centre to the corner nearest to the wall.
struct Corner {
  double x, y;
};

Corner foremost(const TumblingDisc& d, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const double R = c < 0 ? -d.R : d.R, b = s > 0 ? -d.b : d.b;
  return {R * c - b * s, R * s + b * c};
}

double gap(const TumblingDisc& d, const Tumbling& s) {
  return d.wall - s.x - foremost(d, s.angle).x;
}

void hit(const TumblingDisc& d, Tumbling& s) {
  const double arm = foremost(d, s.angle).y, closing = s.v - s.omega * arm;
  const double impulse = (1 + d.restitution) * closing / (1 / d.mass + arm * arm / d.inertia);
  s.v -= impulse / d.mass;
  s.omega += arm * impulse / d.inertia;
}

double rounded(Real x) {
  return static_cast<double>(x);
}

}  // namespace

DragReference::DragReference(V3 p0, V3 v0, V3 gravity, double k, double dt, int frames, int stepsPerFrame) {
  Flight s{{p0.x, p0.y, p0.z, v0.x, v0.y, v0.z}};
  const Real g[3] = {gravity.x, gravity.y, gravity.z}, h = static_cast<Real>(dt) / stepsPerFrame;
  for (int frame = 0; frame <= frames; ++frame) {
    p.push_back({rounded(s.s[0]), rounded(s.s[1]), rounded(s.s[2])});
    v.push_back({rounded(s.s[3]), rounded(s.s[4]), rounded(s.s[5])});
    for (int j = 0; j < stepsPerFrame; ++j) rungeKutta(s, h, g, k);
  }
}

SpinReference::SpinReference(V3 I, V3 omega0, Q4 q0, double dt, int frames, int stepsPerFrame) {
  Spinning s{{omega0.x, omega0.y, omega0.z, q0.w, q0.x, q0.y, q0.z}};
  const Real x = I.x, y = I.y, z = I.z;
  const Real c[3] = {(y - z) / x, (z - x) / y, (x - y) / z}, h = static_cast<Real>(dt) / stepsPerFrame;
  for (int frame = 0; frame <= frames; ++frame) {
    q.push_back({rounded(s.s[3]), rounded(s.s[4]), rounded(s.s[5]), rounded(s.s[6])});
    omega.push_back(rotate(q.back(), {rounded(s.s[0]), rounded(s.s[1]), rounded(s.s[2])}));
    for (int j = 0; j < stepsPerFrame; ++j) taylorStep(s, h, c);
  }
}

double bounceHeight(double h0, double e, double g, double t, int* count) {
  const double fall = std::sqrt(2 * h0 / g);
  double v = g * fall;
  if (count) *count = 0;
  if (t < fall) return h0 - 0.5 * g * t * t;
  t -= fall;
  for (int k = 1; k < 10000; ++k) {
    v *= e;
    const double hop = 2 * v / g;
    if (count) *count = k;
    if (hop < 1e-9) return 0;
    if (t < hop) return v * t - 0.5 * g * t * t;
    t -= hop;
  }
  return 0;
}

double bounceTime(double h0, double e, double g, int k) {
  const double fall = std::sqrt(2 * h0 / g);
  double s = fall, v = g * fall;
  for (int i = 1; i < k; ++i) {
    v *= e;
    s += 2 * v / g;
  }
  return s;
}

Tumbling tumbleAgainstWall(const TumblingDisc& disc, Tumbling s, double seconds, double step) {
  double t = 0;
  while (t < seconds) {
    const double h = std::min(step, seconds - t);
    const Tumbling next = after(s, h);
    if (gap(disc, next) > 0) {
      s = next;
      t += h;
      continue;
    }
    double clear = 0, inside = h;
    for (int i = 0; i < 80; ++i) {
      const double middle = (clear + inside) / 2;
      (gap(disc, after(s, middle)) > 0 ? clear : inside) = middle;
    }
    s = after(s, clear);
    t += clear;
    hit(disc, s);
    // Away from the wall by a hair, so that the next look does not find the same touch.
    s = after(s, 1e-13);
    t += 1e-13;
  }
  return s;
}

}  // namespace stadion::bench
