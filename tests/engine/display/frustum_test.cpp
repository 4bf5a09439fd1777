#include "engine/display/frustum.h"
#include "engine/display/wall_file.h"
#include "engine/maths/functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace stadion {
namespace {

std::vector<Wall> shipped(const char* name) {
  Diagnostics out;
  const auto file = loadWalls(name, std::string(STADION_SOURCE_DIR) + "/walls", out);
  std::vector<Wall> walls;
  if (file)
    for (const WallEntry& e : file->walls) walls.push_back(e.wall);
  return walls;
}

struct Random {
  std::mt19937_64 engine{20240611};
  double uniform(double lo, double hi) { return lo + (hi - lo) * std::uniform_real_distribution<>()(engine); }
  Vec3 vec(double lo, double hi) { return {uniform(lo, hi), uniform(lo, hi), uniform(lo, hi)}; }
  Quat rotation() { return det::expRotation(vec(-2, 2)); }
};

Wall randomWall(Random& random) {
  const Quat q = random.rotation();
  const Vec3 corner = random.vec(-3, 3);
  return {"w", corner, corner + q * Vec3(random.uniform(0.3, 5), 0, 0),
          corner + q * Vec3(0, random.uniform(0.3, 5), 0)};
}

/// Clip coordinates of a point in R.
Vec4 clip(const Wall& wall, const Vec3& eye, const Vec3& p, const DepthRange& depth = {}) {
  const EyeFrustum f = eyeFrustum(wall, eye, depth);
  const Vec4 h(p.x(), p.y(), p.z(), 1);
  return projectionMatrix(f) * (viewMatrix(f, Pose(), Vec3::Zero()) * h);
}

/// The generalised perspective projection from corner vectors and cross products, as one matrix.
Mat4 reference(const Wall& wall, const Vec3& eye, double n, double f) {
  const Vec3 pa = wall.lowerLeft, pb = wall.lowerRight, pc = wall.upperLeft;
  const Vec3 vr = (pb - pa).normalized(), vu = (pc - pa).normalized(), vn = vr.cross(vu).normalized();
  const Vec3 va = pa - eye, vb = pb - eye, vc = pc - eye;
  const double d = -va.dot(vn);
  const double l = vr.dot(va) * n / d, r = vr.dot(vb) * n / d, b = vu.dot(va) * n / d, t = vu.dot(vc) * n / d;
  Mat4 P, M = Mat4::Identity(), T = Mat4::Identity();
  P << 2 * n / (r - l), 0, (r + l) / (r - l), 0, 0, 2 * n / (t - b), (t + b) / (t - b), 0, 0, 0, n / (f - n),
      f * n / (f - n), 0, 0, -1, 0;
  M.row(0).head<3>() = vr.transpose();
  M.row(1).head<3>() = vu.transpose();
  M.row(2).head<3>() = vn.transpose();
  T.topRightCorner<3, 1>() = -eye;
  return P * M * T;
}

TEST(Frustum, MatchesTheIndependentFormulaForAnyWallAndEyeTo1e12) {
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const Wall wall = randomWall(random);
    const WallBasis b = basis(wall);
    const Vec3 eye = wall.lowerLeft + random.uniform(-2, 3) * b.right + random.uniform(-2, 3) * b.up +
                     random.uniform(0.3, 4) * b.normal;
    const DepthRange depth{0.1, 500};
    const EyeFrustum f = eyeFrustum(wall, eye, depth);
    const Mat4 got = projectionMatrix(f) * viewMatrix(f, Pose(), Vec3::Zero());
    const Mat4 want = reference(wall, eye, depth.near, depth.far);
    ASSERT_LE((got - want).cwiseAbs().maxCoeff(), 1e-12 * std::max(1.0, want.cwiseAbs().maxCoeff())) << i;
    ASSERT_FALSE(f.clamped);
  }
}

TEST(Frustum, SendsTheWallsCornersToTheCornersOfThePicture) {
  Random random;
  for (int i = 0; i < 500; ++i) {
    const Wall wall = randomWall(random);
    const Vec3 eye = wall.centre() + random.uniform(0.3, 3) * basis(wall).normal + random.vec(-0.2, 0.2);
    const struct {
      Vec3 corner;
      double x, y;
    } cases[] = {{wall.lowerLeft, -1, -1},
                 {wall.lowerRight, 1, -1},
                 {wall.upperLeft, -1, 1},
                 {wall.upperRight(), 1, 1}};
    for (const auto& c : cases) {
      const Vec4 h = clip(wall, eye, c.corner);
      ASSERT_NEAR(h.x() / h.w(), c.x, 1e-11);
      ASSERT_NEAR(h.y() / h.w(), c.y, 1e-11);
    }
  }
}

TEST(Frustum, IsTheSymmetricOneWhenTheEyeFacesTheMiddle) {
  const Wall wall{"w", {-1, 2, -1}, {1, 2, -1}, {-1, 2, 1}};
  const EyeFrustum f = eyeFrustum(wall, Vec3::Zero(), {0.5, 10});
  EXPECT_EQ(f.right, 0.25);
  EXPECT_EQ(f.left, -0.25);
  EXPECT_EQ(f.top, 0.25);
  EXPECT_EQ(f.bottom, -0.25);
}

TEST(Frustum, MapsNearToOneAndFarToZero) {
  const Wall wall{"w", {-1, 2, 0}, {1, 2, 0}, {-1, 2, 2}};
  const Vec3 eye(0.3, 0.1, 1.2);
  const Vec4 n = clip(wall, eye, eye + Vec3(0, 0.1, 0), {0.1, 100});
  const Vec4 f = clip(wall, eye, eye + Vec3(0, 100, 0), {0.1, 100});
  EXPECT_NEAR(n.z() / n.w(), 1, 1e-12);
  EXPECT_NEAR(f.z() / f.w(), 0, 1e-12);
}

TEST(Frustum, FollowsTheRigThroughTheWorldAndStaysExactFarFromItsOrigin) {
  Random random;
  const Wall wall = shipped("cave4").at(1);
  for (int i = 0; i < 100; ++i) {
    const Pose X_WR{random.vec(-1e6, 1e6), random.rotation()};
    const Vec3 eye = Vec3(0, 0, 1.7) + random.vec(-0.5, 0.5), p_R = random.vec(-4, 4);
    const EyeFrustum f = eyeFrustum(wall, eye, {});
    const Vec3 relative = X_WR.q * p_R;  // to an origin at the rig, exactly
    const Vec4 got = viewMatrix(f, X_WR, X_WR.p) * Vec4(relative.x(), relative.y(), relative.z(), 1);
    const Vec3 want = f.X_ER * p_R;
    ASSERT_LE((got.head<3>() - want).norm(), 1e-12);
  }
}

TEST(Frustum, MovesAnEyeThatIsTooNearOrBehindAndSaysSo) {
  const Wall wall{"w", {-1, 2, 0}, {1, 2, 0}, {-1, 2, 2}};
  for (const Vec3& eye : {Vec3(0.2, 2, 1), Vec3(0.2, 5, 1), Vec3(0.2, 1.99, 1)}) {
    const EyeFrustum f = eyeFrustum(wall, eye, {});
    EXPECT_TRUE(f.clamped);
    EXPECT_LE((f.eye - Vec3(0.2, 2 - kMinEyeDistance, 1)).norm(), 1e-12);
    EXPECT_TRUE(projectionMatrix(f).allFinite());
  }
  EXPECT_FALSE(eyeFrustum(wall, {0.2, 1.9, 1}, {}).clamped);
  const EyeFrustum lost = eyeFrustum(wall, {NAN, 0, INFINITY}, {});
  EXPECT_TRUE(lost.clamped);
  EXPECT_LE((lost.eye - Vec3(0, 1, 1)).norm(), 1e-12);
  EXPECT_TRUE(viewMatrix(lost, Pose(), Vec3::Zero()).allFinite());
}

TEST(Eyes, AreOnTheHeadsXAxisHalfTheSeparationAway) {
  const Pose X_RH{{0.1, 0.2, 1.7}, det::fromEuler(0, 0, 1.5707963267948966)};  // looks to the left
  EXPECT_LE((eyePosition(X_RH, Eye::Left, 0.064) - Vec3(0.1, 0.2 - 0.032, 1.7)).norm(), 1e-12);
  EXPECT_LE((eyePosition(X_RH, Eye::Right, 0.064) - Vec3(0.1, 0.2 + 0.032, 1.7)).norm(), 1e-12);
  EXPECT_EQ(eyePosition(X_RH, Eye::Left, 0), X_RH.p);
}

/// Where a line from a to b crosses the picture's edge `ndc[axis] == side`, along the other axis of the
/// picture.
struct Crossing {
  double t = 0;       ///< on the line
  Vec2 ndc = {0, 0};  ///< in the picture
};

std::optional<Crossing> crossing(const Wall& wall, const Vec3& eye, const Vec3& a, const Vec3& b, int axis,
                                 double side) {
  const Vec4 ca = clip(wall, eye, a), cb = clip(wall, eye, b);
  const double fa = ca[axis] - side * ca.w(), fb = cb[axis] - side * cb.w();
  if (fa * fb > 0) return std::nullopt;
  const double t = fa / (fa - fb);
  const Vec4 c = ca + t * (cb - ca);
  if (c.w() <= 0) return std::nullopt;
  return Crossing{t, {c.x() / c.w(), c.y() / c.w()}};
}

struct Side {
  const char* name;
  int axis;
  double side;
};
constexpr Side kSides[] = {{"left", 0, -1}, {"right", 0, 1}, {"lower", 1, -1}, {"upper", 1, 1}};

/// The two ends of a side of a wall, in the order in which the other axis of the picture grows.
std::pair<Vec3, Vec3> ends(const Wall& w, const Side& s) {
  if (s.axis == 0)
    return s.side < 0 ? std::pair(w.lowerLeft, w.upperLeft) : std::pair(w.lowerRight, w.upperRight());
  return s.side < 0 ? std::pair(w.lowerLeft, w.lowerRight) : std::pair(w.upperLeft, w.upperRight());
}

TEST(Frustum, LetsALineCrossTheEdgeBetweenAnyTwoWallsOfCave6AtTheSamePointForBothEyes) {
  const std::vector<Wall> walls = shipped("cave6");
  ASSERT_EQ(walls.size(), 6u);
  Random random;
  double worst = 0;
  int edges = 0, compared = 0;
  for (std::size_t i = 0; i < walls.size(); ++i)
    for (std::size_t j = i + 1; j < walls.size(); ++j)
      for (const Side& s : kSides)
        for (const Side& u : kSides) {
          const auto [a1, b1] = ends(walls[i], s);
          const auto [a2, b2] = ends(walls[j], u);
          const bool same = (a1 - a2).norm() + (b1 - b2).norm() < 1e-9;
          const bool turned = (a1 - b2).norm() + (b1 - a2).norm() < 1e-9;
          if (!same && !turned) continue;
          ++edges;
          for (int k = 0; k < 100; ++k) {
            const Pose X_RH{{random.uniform(-1.2, 1.2), random.uniform(-1.2, 1.2), random.uniform(0.3, 2.7)},
                            random.rotation()};
            // A line in the world, behind the edge and across it as the visitor sees it.
            const Vec3 onEdge = a1 + random.uniform(0.05, 0.95) * (b1 - a1);
            const Vec3 seen = X_RH.p + random.uniform(1.5, 20) * (onEdge - X_RH.p);
            const Vec3 way = (walls[i].centre() - walls[j].centre()).normalized() + random.vec(-0.3, 0.3);
            for (const Eye eye : kEyes) {
              const Vec3 e = eyePosition(X_RH, eye, 0.064);
              const auto one = crossing(walls[i], e, seen - 2 * way, seen + 2 * way, s.axis, s.side);
              const auto two = crossing(walls[j], e, seen - 2 * way, seen + 2 * way, u.axis, u.side);
              ASSERT_TRUE(one && two)
                  << walls[i].name << " " << s.name << " " << walls[j].name << " " << u.name;
              const double size1 = s.axis == 0 ? 600 : 800, size2 = u.axis == 0 ? 600 : 800;
              const double at1 = (one->ndc[1 - s.axis] + 1) / 2;
              const double at2 =
                  (turned ? 1 - (two->ndc[1 - u.axis] + 1) / 2 : (two->ndc[1 - u.axis] + 1) / 2);
              worst = std::max(worst, std::fabs(at1 - at2) * std::max(size1, size2));
              ++compared;
            }
          }
        }
  EXPECT_EQ(edges, 12);  // a cube has twelve
  EXPECT_EQ(compared, 12 * 100 * 2);
  EXPECT_LE(worst, 0.5);
  EXPECT_LE(worst, 1e-6);  // what double precision should give; 0.5 pixel is the promise
}

bool inside(const Vec4& c) {
  return c.w() > 0 && std::fabs(c.x()) <= c.w() && std::fabs(c.y()) <= c.w() && std::fabs(c.z()) <= c.w();
}

TEST(UnionFrustum, OfOneEyeIsThatEyesFrustum) {
  Random random;
  const DepthRange depth{0.2, 30};
  int in = 0;
  for (int i = 0; i < 200; ++i) {
    const Wall wall = randomWall(random);
    const WallBasis b = basis(wall);
    const Vec3 eye = wall.centre() + random.uniform(0.3, 3) * b.normal + random.uniform(-2, 2) * b.right;
    const Vec3 eyes[] = {eye};
    const ConvexVolume volume = unionFrustum(wall, eyes, depth);
    for (int k = 0; k < 100; ++k) {
      const Vec3 onWall =
          wall.centre() + random.uniform(-1, 1) * b.width * b.right + random.uniform(-1, 1) * b.height * b.up;
      const Vec3 p = eye + random.uniform(0, 6) * (onWall - eye);
      double slack = 1e300;
      for (const Plane& plane : volume.all()) slack = std::min(slack, std::fabs(plane.distance(p)));
      if (slack < 1e-9) continue;
      ASSERT_EQ(volume.contains(p), inside(clip(wall, eye, p, depth)));
      in += volume.contains(p);
    }
  }
  EXPECT_GT(in, 1000);
}

TEST(UnionFrustum, ContainsWhateverAnyEyeWithinTheMarginSees) {
  Random random;
  const DepthRange depth{0.1, 50};
  for (int i = 0; i < 300; ++i) {
    const Wall wall = randomWall(random);
    const WallBasis b = basis(wall);
    const Pose head{wall.centre() + random.uniform(0.02, 3) * b.normal + random.uniform(-3, 3) * b.right +
                        random.uniform(-3, 3) * b.up,
                    random.rotation()};
    const Vec3 eyes[] = {eyePosition(head, Eye::Left, 0.064), eyePosition(head, Eye::Right, 0.064)};
    const double margin = i % 3 == 0 ? 0 : random.uniform(0, 0.3);
    const ConvexVolume volume = unionFrustum(wall, eyes, depth, margin);
    for (int k = 0; k < 60; ++k) {
      const Vec3 moved = eyes[k % 2] + margin * random.vec(-1, 1) / std::sqrt(3.0);
      const EyeFrustum f = eyeFrustum(wall, moved, depth);
      // Any point of the frustum: a point of the wall, seen from the eye, at some depth.
      const Vec3 onWall =
          wall.lowerLeft + random.uniform(0, 1) * b.width * b.right + random.uniform(0, 1) * b.height * b.up;
      const double z = -(f.X_ER * onWall).z();
      const Vec3 p = f.eye + (onWall - f.eye) * (random.uniform(depth.near, k % 4 == 0 ? depth.far : 3) / z);
      for (const Plane& plane : volume.all()) ASSERT_GE(plane.distance(p), -1e-9);
      ASSERT_TRUE(volume.mayTouch(Sphere{p, 1e-6}));
    }
  }
}

TEST(UnionFrustum, IsLittleLargerThanWhatTheTwoEyesSee) {
  // Random small spheres around the room: how many pass the union that neither eye's own frustum would pass.
  Random random;
  int exact = 0, passed = 0;
  const Pose head{{0.2, -0.3, 1.6}, det::fromEuler(0, 0, 0.4)};
  const Vec3 eyes[] = {eyePosition(head, Eye::Left, 0.064), eyePosition(head, Eye::Right, 0.064)};
  const DepthRange depth{0.1, 75};
  for (const Wall& wall : shipped("cave4")) {
    const ConvexVolume both = unionFrustum(wall, eyes, depth);
    const ConvexVolume left = unionFrustum(wall, {eyes, 1}, depth),
                       right = unionFrustum(wall, {eyes + 1, 1}, depth);
    for (int i = 0; i < 20000; ++i) {
      const Sphere sphere{random.vec(-60, 60), 0.8};
      passed += both.mayTouch(sphere);
      exact += left.mayTouch(sphere) || right.mayTouch(sphere);
    }
  }
  EXPECT_GE(passed, exact);
  EXPECT_LE(passed, exact * 1.02);
  RecordProperty("excess_permille", 1000 * (passed - exact) / std::max(exact, 1));
}

TEST(ConvexVolume, KeepsItsInsideWhenItMovesWithTheRig) {
  Random random;
  const Wall wall = shipped("cave4").at(0);
  const Vec3 eyes[] = {{0, 0, 1.7}};
  const ConvexVolume volume = unionFrustum(wall, eyes, {0.1, 50});
  const Pose X_WR{{1000, -2000, 30}, random.rotation()};
  const Vec3 origin(990, -1990, 33);
  const ConvexVolume moved = volume.transformed(X_WR, origin);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = random.vec(-20, 20), q = X_WR * p - origin;
    for (std::uint32_t k = 0; k < volume.count; ++k)
      ASSERT_NEAR(volume.planes[k].distance(p), moved.planes[k].distance(q), 1e-9);
  }
}

TEST(ConvexVolume, TakesBoxesThatCrossItAndLeavesThoseOutside) {
  const Wall wall = shipped("cave4").at(0);
  const Vec3 eyes[] = {{0, 0, 1.7}};
  const ConvexVolume volume = unionFrustum(wall, eyes, {0.1, 50});
  EXPECT_TRUE(volume.mayTouch(Aabb{{-100, 5, -100}, {100, 6, 100}}));
  EXPECT_FALSE(volume.mayTouch(Aabb{{-1, -6, 0}, {1, -5, 2}}));
  EXPECT_FALSE(volume.mayTouch(Aabb{}));
  EXPECT_FALSE(volume.mayTouch(Sphere{}));
}

}  // namespace
}  // namespace stadion
