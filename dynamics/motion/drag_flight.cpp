#include "dynamics/motion/drag_flight.h"

#include "dynamics/maths/double4.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stadion {
namespace {

constexpr int kOrder = Path::kMostDegree;
static_assert(kOrder == 16);

constexpr auto kInverse = [] {
  std::array<double, kOrder + 1> inverse{};
  for (int n = 1; n <= kOrder; ++n) inverse[static_cast<std::size_t>(n)] = 1.0 / n;
  return inverse;
}();

/// u of v - wind (and 0), |u|, and the rate of loss c + k |u|; the first of each are given.
struct DragSeries {
  Double4 u[kOrder];
  double speed[kOrder], rate[kOrder];
  double quadratic;
  Double4 pull;
};

/// In sums, what has just been found comes last: the rest does not wait for it.
[[gnu::always_inline]] inline void expandSeries(DragSeries& s) {
  const double inverse = s.speed[0] > 0 ? 1 / s.speed[0] : 0, share = s.quadratic * inverse;
#pragma GCC unroll 16
  for (int n = 0; n + 1 < kOrder; ++n) {
    if (n > 0) {
      // |u|_0 |u|_n = half the sum of u_i u_(n-i), less that of |u|_i |u|_(n-i) but for its ends.
      const int middle = n / 2;
      Double4 products{};
      double others = 0;
      if (n % 2 == 0) {
        products = 0.5 * s.u[middle] * s.u[middle];
        others = 0.5 * s.speed[middle] * s.speed[middle];
      }
#pragma GCC unroll 16
      for (int i = (n - 1) / 2; i >= 0; --i) {
        products += s.u[i] * s.u[n - i];
        if (i > 0) others += s.speed[i] * s.speed[n - i];
      }
      const double sum = (products[0] + products[1]) + (products[2] - others);
      s.speed[n] = sum * inverse;
      s.rate[n] = sum * share;
    }
    Double4 lost{};
#pragma GCC unroll 16
    for (int i = 1; i <= n; ++i) lost += s.rate[n - i] * s.u[i];
    lost += s.rate[n] * s.u[0];
    s.u[n + 1] = n == 0 ? s.pull - lost : -kInverse[n + 1] * lost;
  }
}
[[gnu::target("avx2")]] void expandAvx2(DragSeries& s) {
  expandSeries(s);
}
void expandPlain(DragSeries& s) {
  expandSeries(s);
}

}  // namespace

Vec3 EvenPull::accelerationBound(const Vec3& v, double seconds) const {
  const Vec3 u = v - drag.wind;
  const double rate = drag.linear + drag.quadratic * (u.norm() + pull.norm() * seconds);
  return pull.cwiseAbs() + rate * (u.cwiseAbs() + seconds * pull.cwiseAbs());
}

double dragFlight(const Vec3& p, const Vec3& v, const Vec3& pull, const Drag& drag, double longest,
                  double tolerance, Path& path) {
  DragSeries s;
  const Vec3 u0 = v - drag.wind;
  const double speed = u0.norm();
  if (drag.quadratic > 0 && !(speed > 1e-6)) return 0;
  set(s.u[0], u0);
  set(s.pull, pull);
  s.speed[0] = speed;
  s.rate[0] = drag.linear + drag.quadratic * speed;
  s.quadratic = drag.quadratic;
  hasAvx2() ? expandAvx2(s) : expandPlain(s);
  path.kind = Path::Kind::Polynomial;
  path.degree = kOrder;
  path.c[0] = p;
  path.c[1] = v;
  for (int n = 1; n < kOrder; ++n)
    path.c[static_cast<std::size_t>(n + 1)] = kInverse[n + 1] * firstThree(s.u[n]);
  double horizon =
      std::min(longest, 0.8 * reachOfSeries(path.c[kOrder].cwiseAbs().maxCoeff(),
                                            path.c[kOrder - 1].cwiseAbs().maxCoeff(), tolerance));
  // |u| must not reach zero: the series would go on with the root's other sign.
  const double most = pull.norm() + (drag.linear + drag.quadratic * speed) * speed;
  if (drag.quadratic > 0 && most > 0) horizon = std::min(horizon, 0.95 * speed / most);
  const double fastest = speed + pull.norm() * horizon;  // drag only slows it
  path.spare = pull.norm() + (drag.linear + drag.quadratic * fastest) * fastest;
  return horizon;
}

}  // namespace stadion
