#include "dynamics/body/body_axes.h"

#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kNoAxis = 1e-6;    ///< moments as near to each other, relatively, are the same
constexpr double kTipShare = 0.05;  ///< how much of its length belongs to the tip

/// How far the mesh reaches along a direction, least and most [m].
struct Extent {
  double back = 1e300, front = -1e300;
};
Extent extentAlong(const Vec3& direction, const Mesh& mesh) {
  Extent e;
  for (const auto& p : mesh.positions) {
    const double x = direction.dot(Vec3(p[0], p[1], p[2]));
    e.back = std::min(e.back, x);
    e.front = std::max(e.front, x);
  }
  return e;
}

}  // namespace

Vec3 symmetryAxis(const MassProperties& mass) {
  const Vec3& I = mass.inertia;
  const auto apart = [&](int i) { return std::fabs(I[i] - 0.5 * (I[(i + 1) % 3] + I[(i + 2) % 3])); };
  int best = 2;
  for (const int i : {0, 1})
    if (apart(i) > apart(best)) best = i;
  if (apart(best) <= kNoAxis * I.maxCoeff()) return Vec3::UnitZ();
  const Vec3 axis = mass.axes * Vec3::Unit(best);
  int largest = 0;
  axis.cwiseAbs().maxCoeff(&largest);
  return axis[largest] < 0 ? Vec3(-axis) : axis;
}

TipEmbedding tipEmbeddingAlong(const Vec3& nose, double angle, double depth, const Mesh& mesh) {
  const Extent e = extentAlong(nose, mesh);
  return {nose, e.front, kTipShare * (e.front - e.back), det::cos(angle), depth};
}

}  // namespace stadion
