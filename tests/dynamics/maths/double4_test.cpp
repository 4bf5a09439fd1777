/// Series in four lanes give the bits of plain arithmetic, written here number by number: with AVX2 where the
/// machine has it, and without.

#include "dynamics/maths/double4.h"

#include "dynamics/motion/arc.h"
#include "dynamics/motion/drag_flight.h"
#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

constexpr std::size_t kOrder = 16;
using Four = std::array<double, 4>;

Four plus(const Four& a, const Four& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
}
Four times(const Four& a, const Four& b) {
  return {a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]};
}
Four times(double a, const Four& b) {
  return times(Four{a, a, a, a}, b);
}

/// Taylor coefficients of a free body's orientation, as (w, x, y, z).
std::array<Four, kOrder + 1> spinTerms(const Quat& q0, const Vec3& L, const Vec3& inertia) {
  const Vec3 inverse = inertia.cwiseInverse(), w0 = inverse.cwiseProduct(q0.conjugate() * L);
  const Four k{(inertia.y() - inertia.z()) * inverse.x(), (inertia.z() - inertia.x()) * inverse.y(),
               (inertia.x() - inertia.y()) * inverse.z(), 0};
  std::array<Four, kOrder + 1> q{}, w{};
  q[0] = {q0.w(), q0.x(), q0.y(), q0.z()}, w[0] = {w0.x(), w0.y(), w0.z(), 0};
  for (std::size_t i = 0; i < kOrder; ++i) {
    Four dw{}, dq{};
    for (std::size_t nth = 1; nth <= i + 1; ++nth) {  // the newest terms come last
      const std::size_t j = nth % (i + 1);
      const Four &a = w[j], &u = w[i - j], &p = q[j];
      dw = plus(dw, times(Four{a[1], a[2], a[0], 0}, Four{u[2], u[0], u[1], 0}));
      dq = plus(dq,
                plus(plus(times(u[0], {-p[1], p[0], p[3], -p[2]}), times(u[1], {-p[2], -p[3], p[0], p[1]})),
                     times(u[2], {-p[3], p[2], -p[1], p[0]})));
    }
    const double share = 1.0 / static_cast<double>(i + 1);
    w[i + 1] = times(share, times(k, dw));
    q[i + 1] = times(0.5 * share, dq);
  }
  return q;
}

/// A series of degree 16 (`lowest` 0) or its rate of change (1), in four chains.
double sumOf(const std::array<double, kOrder + 1>& c, double t, int lowest) {
  const double t2 = t * t, t4 = t2 * t2;
  double chain[4] = {};
  for (int k = 0; k < 4; ++k) {
    const int top = (16 - lowest - k) / 4 * 4 + lowest + k;
    for (int i = top; i >= lowest; i -= 4) {
      const double term = lowest ? c[static_cast<std::size_t>(i)] * i : c[static_cast<std::size_t>(i)];
      chain[k] = i == top ? term : chain[k] * t4 + term;
    }
  }
  return (chain[0] + t * chain[1]) + t2 * (chain[2] + t * chain[3]);
}

TEST(Double4, ASpinInFourLanesIsTheSpinNumberByNumber) {
  Chance chance(111);
  for (int i = 0; i < 200; ++i) {
    const Quat q = chance.turn();
    const Vec3 inertia(chance.scale(0.1, 1), chance.scale(1.1, 2), chance.scale(2.1, 3)),
        L = chance.scale(0.01, 100) * chance.direction();
    const Spin spin = Spin::free(q, L, inertia);
    ASSERT_EQ(spin.kind, Spin::Kind::Taylor);
    const auto terms = spinTerms(q, L, inertia);
    for (std::size_t n = 0; n <= kOrder; ++n)
      for (std::size_t k = 0; k < 4; ++k)
        ASSERT_EQ(spin.series[n][static_cast<int>(k)], terms[n][k]) << i << ' ' << n;
    const double t = chance.between(0, spin.horizon);
    Four sum{};
    for (std::size_t k = 0; k < 4; ++k) {
      std::array<double, kOrder + 1> c{};
      for (std::size_t n = 0; n <= kOrder; ++n) c[n] = terms[n][k];
      sum[k] = sumOf(c, t, 0);
    }
    const Quat at(sum[0], sum[1], sum[2], sum[3]);
    const double excess = at.squaredNorm() - 1;
    EXPECT_EQ(spin.orientation(t).coeffs(), Quat(at.coeffs() * (1 - 0.5 * excess)).coeffs()) << i;
  }
}

/// Taylor coefficients of a flight in a medium.
std::array<Four, kOrder> dragTerms(const Vec3& v, const Vec3& pull, const Drag& drag) {
  const Vec3 u0 = v - drag.wind;
  std::array<Four, kOrder> u{};
  std::array<double, kOrder> speed{}, rate{};
  u[0] = {u0.x(), u0.y(), u0.z(), 0}, speed[0] = u0.norm();
  rate[0] = drag.linear + drag.quadratic * speed[0];
  const double inverse = 1 / speed[0], share = drag.quadratic * inverse;
  for (std::size_t n = 0; n + 1 < kOrder; ++n) {
    if (n > 0) {
      Four products{};
      double others = 0;
      if (n % 2 == 0)
        products = times(times(0.5, u[n / 2]), u[n / 2]), others = 0.5 * speed[n / 2] * speed[n / 2];
      for (std::size_t i = (n + 1) / 2; i-- > 0;) {  // the newest terms come last
        products = plus(products, times(u[i], u[n - i]));
        if (i > 0) others += speed[i] * speed[n - i];
      }
      const double sum = (products[0] + products[1]) + (products[2] - others);
      speed[n] = sum * inverse, rate[n] = sum * share;
    }
    Four lost{};
    for (std::size_t i = 1; i <= n; ++i) lost = plus(lost, times(rate[n - i], u[i]));
    lost = plus(lost, times(rate[n], u[0]));
    const double part = -1.0 / static_cast<double>(n + 1);
    u[n + 1] = n > 0 ? times(part, lost) : plus({pull.x(), pull.y(), pull.z(), 0}, times(part, lost));
  }
  return u;
}

TEST(Double4, AFlightInFourLanesIsTheFlightNumberByNumber) {
  Chance chance(112);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = 10 * chance.vector(), v = 30 * chance.vector(), pull(0, 0, -kG);
    const Drag drag{i % 3 ? chance.between(0, 1) : 0, i % 4 ? chance.scale(1e-3, 0.3) : 0,
                    5 * chance.vector()};
    Path path;
    const double horizon = dragFlight(p, v, pull, drag, 1, 1e-10, path);
    ASSERT_GT(horizon, 0) << i;
    const auto u = dragTerms(v, pull, drag);
    for (int k = 0; k < 3; ++k) {
      std::array<double, kOrder + 1> c{p[k], v[k]};
      for (std::size_t n = 1; n < kOrder; ++n)
        c[n + 1] = 1.0 / static_cast<double>(n + 1) * u[n][static_cast<std::size_t>(k)];
      for (std::size_t n = 0; n <= kOrder; ++n) ASSERT_EQ(path.c[n][k], c[n]) << i << ' ' << n;
      const double t = chance.between(0, horizon);
      EXPECT_EQ(path.position(t)[k], sumOf(c, t, 0)) << i;
      EXPECT_EQ(path.velocity(t)[k], sumOf(c, t, 1)) << i;
    }
  }
}

}  // namespace
}  // namespace stadion
