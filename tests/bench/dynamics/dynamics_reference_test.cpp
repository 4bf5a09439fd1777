/// The solutions that engines are measured against hold to 1e-12: halving their steps changes nothing, and
/// they keep what nature keeps.

#include "bench/dynamics/reference_solutions.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace stadion::bench {
namespace {

constexpr double kFrame = 1.0 / 60;
constexpr V3 kGravity{0, -9.81, 0};

V3 boxInertia(double m, V3 half) {
  return {m / 3 * (half.y * half.y + half.z * half.z), m / 3 * (half.x * half.x + half.z * half.z),
          m / 3 * (half.x * half.x + half.y * half.y)};
}

double farthestApart(const std::vector<V3>& a, const std::vector<V3>& b) {
  double most = a.size() == b.size() ? 0 : 1e300;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) most = std::max(most, norm(a[i] - b[i]));
  return most;
}

class Drag : public testing::TestWithParam<double> {};

TEST_P(Drag, OfFootballAndBeachBallIsExactTo1em12) {
  const V3 p0{0, 1.5, 0}, v0{25, 12, 3};
  const DragReference used(p0, v0, kGravity, GetParam(), kFrame, 150),
      finer(p0, v0, kGravity, GetParam(), kFrame, 150, 1000);
  EXPECT_LE(farthestApart(used.p, finer.p), 1e-12);
  EXPECT_LE(farthestApart(used.v, finer.v), 1e-12);
}

TEST_P(Drag, OfTheSwarmIsExactTo1em12) {
  const V3 p0{0, 300, 0}, v0{0.5, 10.5, -0.5};
  const DragReference used(p0, v0, kGravity, GetParam(), kFrame, 120, 50),
      finer(p0, v0, kGravity, GetParam(), kFrame, 120, 100);
  EXPECT_LE(farthestApart(used.p, finer.p), GetParam() > 0.1 ? 1e-11 : 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Coefficients, Drag, testing::Values(0.0, 0.0132, 0.354));

TEST(References, WithoutDragABodyFliesAParabola) {
  const DragReference r({0, 1.5, 0}, {20, 15, 3}, kGravity, 0, kFrame, 150);
  for (std::size_t i = 0; i < r.p.size(); ++i) {
    const double t = static_cast<double>(i) * kFrame;
    EXPECT_LE(norm(r.p[i] - V3{20 * t, 1.5 + 15 * t - 9.81 / 2 * t * t, 3 * t}), 1e-12);
  }
}

struct Top {
  const char* name;
  V3 inertia, omega;
  int frames, steps;
};

class Spin : public testing::TestWithParam<Top> {};

TEST_P(Spin, IsExactTo1em12) {
  const Top& top = GetParam();
  const SpinReference used(top.inertia, top.omega, {}, kFrame, top.frames, top.steps),
      finer(top.inertia, top.omega, {}, kFrame, top.frames, 2 * top.steps);
  double most = 0;
  for (std::size_t i = 0; i < used.q.size(); ++i) most = std::max(most, angleBetween(used.q[i], finer.q[i]));
  EXPECT_LE(most, 1e-12);
  EXPECT_LE(farthestApart(used.omega, finer.omega), 1e-12 * norm(top.omega));
}

TEST_P(Spin, KeepsAngularMomentum) {
  const Top& top = GetParam();
  const auto momentum = [&top](Q4 q, V3 omega) {
    const V3 w = rotate(conj(q), omega);
    return rotate(q, {top.inertia.x * w.x, top.inertia.y * w.y, top.inertia.z * w.z});
  };
  const SpinReference r(top.inertia, top.omega, {}, kFrame, top.frames, top.steps);
  const V3 L = momentum({}, top.omega);
  for (std::size_t i = 0; i < r.q.size(); ++i)
    EXPECT_LE(norm(momentum(r.q[i], r.omega[i]) - L), 1e-12 * norm(L));
}

const V3 kDisc{2 * (3 * 0.0121 + 4 * 0.000529) / 12, 0.0121, 2 * (3 * 0.0121 + 4 * 0.000529) / 12};

// The first ten seconds of Dzhanibekov's nut are what limits speak of.
INSTANTIATE_TEST_SUITE_P(
    Tops, Spin,
    testing::Values(Top{"Nut", boxInertia(1, {0.15, 0.10, 0.025}), {0.01, 5, 0.01}, 600, 8},
                    Top{"SlowDisc", kDisc, {2, 40, 0}, 600, 8}, Top{"FastDisc", kDisc, {30, 300, 0}, 600, 8},
                    Top{"Box", boxInertia(1, {0.15, 0.1, 0.025}), {3, -3, 3}, 120, 2}),
    [](const auto& top) { return std::string(top.param.name); });

TEST(References, BouncesFollowEachOtherWithoutAGap) {
  for (const double e : {1.0, 0.8, 0.5})
    for (int k = 1; k <= 8; ++k) {
      const double t = bounceTime(1, e, 9.81, k);
      EXPECT_NEAR(bounceHeight(1, e, 9.81, t - 1e-13), 0, 1e-12);
      EXPECT_NEAR(bounceHeight(1, e, 9.81, t + 1e-13), 0, 1e-12);
      int count = 0;
      bounceHeight(1, e, 9.81, t + 1e-6, &count);
      EXPECT_EQ(count, k);
    }
}

const TumblingDisc kThrown{0.11, 0.012, 2, 2 * (3 * 0.0121 + 4 * 0.000144) / 12, 0.5, -0.0005};

TEST(References, TheTumblingDiscDoesNotHangOnItsSteps) {
  for (int phase = 0; phase < 8; ++phase) {
    const Tumbling start{-1 - 0.5 * phase / 8, 30, 0, 40};
    const Tumbling used = tumbleAgainstWall(kThrown, start, 0.16),
                   finer = tumbleAgainstWall(kThrown, start, 0.16, 2.5e-6);
    EXPECT_NEAR(used.x, finer.x, 1e-9) << phase;
    EXPECT_LT(used.x, kThrown.wall);
  }
}

TEST(References, NoPartOfTheDiscIsEverBehindTheWall) {
  for (int phase = 0; phase < 8; ++phase)
    for (int i = 0; i <= 160; ++i) {
      const Tumbling s = tumbleAgainstWall(kThrown, {-1 - 0.5 * phase / 8, 30, 0, 40}, 1e-3 * i, 1e-4);
      const double front =
          kThrown.R * std::fabs(std::cos(s.angle)) + kThrown.b * std::fabs(std::sin(s.angle));
      EXPECT_LE(s.x + front, kThrown.wall + 1e-9) << phase << ", after " << i << " ms";
    }
}

TEST(References, AnElasticDiscKeepsItsEnergy) {
  TumblingDisc elastic = kThrown;
  elastic.restitution = 1;
  const Tumbling start{-1, 30, 0, 40}, end = tumbleAgainstWall(elastic, start, 0.16);
  const auto energy = [&elastic](const Tumbling& s) {
    return elastic.mass * s.v * s.v + elastic.inertia * s.omega * s.omega;
  };
  EXPECT_NE(start.v, end.v);
  EXPECT_NEAR(energy(end) / energy(start), 1, 1e-12);
}

}  // namespace
}  // namespace stadion::bench
