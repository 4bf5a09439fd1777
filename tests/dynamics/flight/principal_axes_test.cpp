/// Principal axes: exact over the surface, and what sampling vertices makes of them.

#include "dynamics/flight/principal_axes.h"

#include "bench/flight/bodies.h"
#include "engine/maths/functions.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

/// A box cut into two triangles a face.
Mesh box(const Vec3& half) {
  Mesh m;
  for (int i = 0; i < 8; ++i)
    m.positions.push_back({static_cast<float>(i & 1 ? half.x() : -half.x()),
                           static_cast<float>(i & 2 ? half.y() : -half.y()),
                           static_cast<float>(i & 4 ? half.z() : -half.z())});
  m.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
               2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return m;
}

void turn(Mesh& m, const Quat& q, const Vec3& p) {
  for (auto& v : m.positions) {
    const Vec3 x = q * Vec3(v[0], v[1], v[2]) + p;
    v = {static_cast<float>(x.x()), static_cast<float>(x.y()), static_cast<float>(x.z())};
  }
}

TEST(PrincipalAxes, OfABoxAreItsOwnWithTheExactVariances) {
  Mesh m = box({3, 2, 1});
  const Quat q = det::expRotation(Vec3(.3, -.5, .7));
  turn(m, q, Vec3(4, 5, 6));
  const PrincipalAxes a = surfaceAxes(m);
  // Faces square to x (area 8) lie at 3, the others (24, 12 and their like) are spread over 9/3.
  const double area = 2 * (8 + 12 + 24);
  EXPECT_NEAR(a.variance.x(), (2 * 8 * 9 + (area - 16) * 3) / area, 1e-5);
  EXPECT_NEAR(a.variance.z(), (2 * 24 * 1 + (area - 48) / 3) / area, 1e-5);
  EXPECT_LE((a.centre - Vec3(4, 5, 6)).norm(), 1e-5);
  EXPECT_NEAR(std::fabs((a.q_NP * Vec3::UnitX()).dot(q * Vec3::UnitX())), 1, 1e-9);
  EXPECT_NEAR(std::fabs((a.q_NP * Vec3::UnitZ()).dot(q * Vec3::UnitZ())), 1, 1e-9);
}

TEST(PrincipalAxes, DoNotDependOnHowTheSurfaceIsCut) {
  Mesh m = box({3, 2, 1}), fine = m;
  fine.indices.clear();
  for (std::size_t i = 0; i < m.indices.size(); i += 3) {  // each triangle in three
    std::array<float, 3> middle{};
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t c = 0; c < 3; ++c) middle[c] += m.positions[m.indices[i + k]][c] / 3;
    const auto n = static_cast<std::uint32_t>(fine.positions.size());
    fine.positions.push_back(middle);
    for (std::size_t k = 0; k < 3; ++k)
      fine.indices.insert(fine.indices.end(), {m.indices[i + k], m.indices[i + (k + 1) % 3], n});
  }
  EXPECT_LE((surfaceAxes(m).variance - surfaceAxes(fine).variance).norm(), 1e-6);
}

TEST(PrincipalAxes, OfABallAreNone) {
  const PrincipalAxes exact = surfaceAxes(bodies::ball(1, 64));
  EXPECT_TRUE(exact.round());
  EXPECT_NEAR(exact.variance.x(), 1.0 / 3, 5e-3);
  // Its vertices crowd at the poles: sampled, it is a rod.
  EXPECT_FALSE(sampledAxes(bodies::ball(1, 64), 4096).round());
}

TEST(PrincipalAxes, SampledVerticesMissASurfaceThatIsCutUnevenly) {
  const Mesh javelin = bodies::javelin();
  const PrincipalAxes exact = surfaceAxes(javelin), sampled = sampledAxes(javelin, 8192);
  EXPECT_GT(std::fabs(sampled.variance.x() / exact.variance.x() - 1), 0.2);
  EXPECT_EQ(sampledAxes(javelin, 100, 7).variance, sampledAxes(javelin, 100, 7).variance);
  EXPECT_NE(sampledAxes(javelin, 100, 7).variance, sampledAxes(javelin, 100, 8).variance);
}

TEST(PrincipalAxes, TheSkewnessPointsDownTheLongTail) {
  // A cone: more surface at its base, the tip is the tail.
  const Mesh cone = bodies::revolved({{0, .5}, {3, .001}}, 32, bodies::Along::X);
  const PrincipalAxes a = surfaceAxes(cone);
  EXPECT_GT(a.skewness.x() * (a.q_NP * Vec3::UnitX()).x(), 0);
}

TEST(PrincipalAxes, OfNothingAreNothing) {
  const PrincipalAxes a = surfaceAxes(Mesh{});
  EXPECT_EQ(a.variance, Vec3::Zero());
  EXPECT_TRUE(a.round());
  EXPECT_TRUE(sampledAxes(Mesh{}, 10).round());
}

}  // namespace
}  // namespace stadion
