#include "dynamics/drag_flight.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr int kOrder = Path::kMostDegree;
static_assert(kOrder == 16);

}  // namespace

double dragFlight(const Vec3& p, const Vec3& v, const Vec3& pull, const Drag& drag, double longest,
                  double tolerance, Path& path) {
  Vec3 u[kOrder];  // of v - wind
  double square[kOrder], speed[kOrder];
  u[0] = v - drag.wind;
  square[0] = u[0].squaredNorm(), speed[0] = std::sqrt(square[0]);
  if (drag.quadratic > 0 && !(speed[0] > 1e-6)) return 0;
  path.kind = Path::Kind::Polynomial, path.degree = kOrder;
  path.c[0] = p, path.c[1] = v;
  for (int n = 0; n + 1 < kOrder; ++n) {
    if (n > 0) {
      double a = 0;
      for (int i = 0; i <= n; ++i) a += u[i].dot(u[n - i]);
      square[n] = a;
      for (int i = 1; i < n; ++i) a -= speed[i] * speed[n - i];
      speed[n] = drag.quadratic > 0 ? a / (2 * speed[0]) : 0;
    }
    Vec3 resisted = Vec3::Zero();
    if (drag.quadratic > 0)
      for (int i = 0; i <= n; ++i) resisted += speed[i] * u[n - i];
    Vec3 a = -drag.linear * u[n] - drag.quadratic * resisted;
    if (n == 0) a += pull;
    u[n + 1] = a / (n + 1);
    path.c[static_cast<std::size_t>(n + 2)] = u[n + 1] / (n + 2);
  }
  double horizon =
      std::min(longest, 0.8 * reachOfSeries(path.c[kOrder].cwiseAbs().maxCoeff(),
                                            path.c[kOrder - 1].cwiseAbs().maxCoeff(), tolerance));
  // |u| must not reach zero: the series would go on with the root's other sign.
  const double most = pull.norm() + (drag.linear + drag.quadratic * speed[0]) * speed[0];
  if (drag.quadratic > 0 && most > 0) horizon = std::min(horizon, 0.95 * speed[0] / most);
  path.boundAcceleration(horizon);
  return horizon;
}

}  // namespace stadion
