#include "dynamics/collision/convex_manifold.h"
#include "dynamics/collision/convex_touch.h"
#include "dynamics/collision/nearest_surface.h"
#include "engine/maths/functions.h"
#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>
#include <random>

namespace stadion {
namespace {

using namespace scenes;

struct Dice {
  std::mt19937 random;
  std::uniform_real_distribution<double> u{-1, 1};
  explicit Dice(unsigned seed) : random(seed) {}
  double operator()() { return u(random); }
  Vec3 vec(double s = 1) { return s * Vec3(u(random), u(random), u(random)); }
  Quat turn() { return det::fromEuler(3 * u(random), 3 * u(random), 3 * u(random)); }
};

ConvexShape randomHull(Dice& d, double size) {
  for (;;) {
    std::vector<Vec3> cloud;
    for (int i = 0; i < 14; ++i) cloud.push_back(d.vec(size));
    if (auto hull = convexHull(cloud)) return *hull;
  }
}

Shape randomShape(Dice& d, int kind) {
  const double s = std::pow(10, -1 + 0.7 * d());
  const auto part = [&] { return s * (0.55 + 0.45 * d()); };
  const Pose X{d.vec(0.3 * s), d.turn()};
  switch (kind % 6) {
  case 0: return BallShape{X.p, part()};
  case 1: return BoxShape{X, {part(), part(), part()}};
  case 2: return CapsuleShape{X, part(), part()};
  case 3: return CylinderShape{X, part(), part()};
  case 4: return Shape(randomHull(d, s));
  default: return CylinderShape{X, s, 0.02 * s};  // a disc
  }
}

/// How far x is outside of a shape: an answer that knows nothing of supports.
double outside(const Shape& shape, const Vec3& x) {
  return ballGap(x, 0, shape, Pose{}).distance;
}

TEST(ConvexGap, TheDistanceIsThatOfTwoPointsOnTheTwoAndOfTwoPlanesBetweenThem) {
  Dice d(11);
  double worst = 0, worstOn = 0;
  int apart = 0;
  for (int k = 0; k < 6000; ++k) {
    const Shape a = randomShape(d, k), b = randomShape(d, k / 6);
    const double far = boundingSphere(a).radius + boundingSphere(b).radius;
    const Pose XA{d.vec(far * (0.3 + 0.7 * std::fabs(d()))), d.turn()}, XB{{}, d.turn()};
    const Pose B{Vec3::Zero(), XB.q};
    ConvexCore ca, cb;
    coreOf(a, XA, ca), coreOf(b, B, cb);
    const ConvexGap g = convexGap(ca, cb, ca.middle() - cb.middle());
    EXPECT_NEAR(g.normal.norm(), 1, 1e-9);
    EXPECT_NEAR(g.distance, separationAlong(g.normal, ca, cb), 1e-12);
    if (g.distance <= 0) continue;
    ++apart;
    worst = std::max(worst, std::fabs((g.onA - g.onB).norm() - g.distance));
    worstOn = std::max({worstOn, outside(a, XA.inverse() * g.onA), outside(b, B.inverse() * g.onB)});
  }
  std::printf("  %d pairs apart: two bounds differ by %.1e m, points are outside by %.1e m\n", apart, worst,
              worstOn);
  EXPECT_GT(apart, 2000);
  EXPECT_LE(worst, 1e-9);
  EXPECT_LE(worstOn, 1e-6);
}

TEST(ConvexGap, OverlapIsWhatHasToBePulledOut) {
  Dice d(12);
  double worst = 0;
  int shallow = 0;
  for (int k = 0; k < 12000; ++k) {
    const Shape a = randomShape(d, k), b = randomShape(d, k / 6);
    const Pose XB{Vec3::Zero(), d.turn()};
    const double far = boundingSphere(a).radius + boundingSphere(b).radius;
    Pose XA{d.vec(0.6 * far), d.turn()};
    ConvexCore ca, cb;
    coreOf(b, XB, cb);
    coreOf(a, XA, ca);
    const ConvexGap g = convexGap(ca, cb, ca.middle() - cb.middle());
    // Deep ones may be led out by a longer way; what lasting contact leaves is shallow.
    const double size = std::min(boundingSphere(a).radius, boundingSphere(b).radius);
    if (g.distance >= 0 || g.distance < -0.02 * size) continue;
    ++shallow;
    XA.p -= g.distance * g.normal;  // out along the normal: now they touch
    coreOf(a, XA, ca);
    const ConvexGap after = convexGap(ca, cb, g.normal);
    worst = std::max(worst, std::fabs(after.distance));
  }
  std::printf("  %d pairs, after pulling out %.1e m\n", shallow, worst);
  EXPECT_GT(shallow, 50);
  EXPECT_LE(worst, 1e-6);
}

TEST(ConvexHull, HoldsAllItsPointsAndIsASphereToEuler) {
  Dice d(5);
  for (int k = 0; k < 60; ++k) {
    std::vector<Vec3> cloud;
    for (int i = 0; i < 5 + k * 4; ++i) cloud.push_back(k % 2 ? d.vec() : Vec3(d.vec().normalized()));
    const auto hull = convexHull(cloud);
    ASSERT_TRUE(hull);
    for (const Vec3& p : cloud)
      for (const auto& f : hull->faces) EXPECT_LE(f.normal.dot(p) - f.offset, 1e-6);
    EXPECT_EQ(hull->points.size() + hull->faces.size(), hull->edges.size() + 2);
  }
  std::vector<Vec3> cube;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z) cube.emplace_back(0.1 * x, 0.1 * y, 0.1 * z);
  const auto c = convexHull(cube);
  ASSERT_TRUE(c);
  EXPECT_EQ(c->faces.size(), 6u);
  EXPECT_EQ(c->edges.size(), 12u);
  EXPECT_EQ(c->points.size(), 8u);
  EXPECT_FALSE(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.2, 0}}));
  EXPECT_FALSE(convexHull({{0, 0, 0}, {1, 0, 0}}));
  EXPECT_FALSE(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::nan("")}}));
}

struct Flier {
  Shape shape;
  RigidBody body;
  Flier(BodyId id, Shape s, const Pose& X, const Vec3& v, const Vec3& omega, const Vec3& g)
      : shape(std::move(s)) {
    body.id = id, body.shape = &shape, body.bound = boundingSphere(shape);
    body.X_NC.p = body.bound.centre, body.X_CN = body.X_NC.inverse(), body.reach = body.bound.radius;
    body.inertia = {1, 1.2, 1.5};
    body.path = Path::parabola(X.p, v, g);
    body.spin = Spin::free(X.q, X.q * body.inertia.cwiseProduct(X.q.conjugate() * omega), body.inertia);
  }
};

/// Of round hulls, boxes with many points on their sides, and flat lenses.
TEST(ConvexHull, TheFarthestCornerOfManyIsFoundGoingUphill) {
  Dice d(8);
  for (int shape = 0; shape < 30; ++shape) {
    std::vector<Vec3> cloud;
    for (int i = 0; i < 600; ++i) {
      Vec3 x = d.vec();
      if (shape % 3 == 1) x[i % 3] = i % 2 ? 1 : -1;
      if (shape % 3 != 1) x.normalize();
      if (shape % 3 == 2) x.z() *= 0.05;
      cloud.push_back(x);
    }
    const auto hull = convexHull(cloud);
    ASSERT_TRUE(hull);
    ASSERT_GT(hull->points.size(), 24u);
    for (int i = 0; i < 300; ++i) {
      const Vec3 along = i < 6 ? Vec3(Vec3::Unit(i % 3) * (i < 3 ? 1 : -1)) : d.vec();
      double far = -1e300;
      for (const Vec3& x : hull->points) far = std::max(far, along.dot(x));
      EXPECT_GE(along.dot(hull->points[hull->farthest(along)]), far - 1e-12) << shape;
    }
  }
}

TEST(ConvexTouch, NothingTouchesBeforeItIsSaidToAndThenItDoes) {
  Dice d(21);
  double worst = 0, early = 0;
  int touched = 0, inexact = 0;
  std::uint64_t looks = 0;
  for (int k = 0; k < 3000; ++k) {
    const double v = std::pow(10, 1 + d()), spin = std::pow(10, 1 + 1.4 * d());
    Flier a(1, randomShape(d, 1 + k % 5), {Vec3(-1, 0, 0) + d.vec(0.2), d.turn()}, {v, 0, 0}, d.vec(spin),
            {0, 0, -9.81});
    Flier b(2, randomShape(d, 1 + (k / 5) % 5), {d.vec(0.2), d.turn()}, d.vec(0.2 * v), d.vec(spin),
            {0, 0, -9.81});
    const double to = std::min({2 / v, a.body.spin.horizon, b.body.spin.horizon, 0.128});
    const auto touch = firstTouch(Side::of(a.body), Side::of(b.body), 0, to, looks);
    const auto gapAt = [&](double tau) {
      return gapBetween(Side::of(a.body), Side::of(b.body), tau).distance;
    };
    if (gapAt(0) <= 0) continue;
    const double end = touch ? touch->tau : to;
    for (int i = 1; i < 50; ++i) early = std::min(early, gapAt(end * i / 50));
    if (!touch) continue;
    ++touched;
    worst = std::max(worst, std::fabs(gapAt(touch->tau)));
    inexact += std::fabs(gapAt(touch->tau)) > 1e-10;
    // The point belongs to both.
    EXPECT_LE(std::fabs(outside(b.shape, b.body.poseAt(touch->tau).inverse() * touch->gap.point)), 5e-4);
    EXPECT_LE(std::fabs(outside(a.shape, a.body.poseAt(touch->tau).inverse() * touch->gap.point)), 5e-4);
  }
  std::printf("  %d touches, gap then %.1e m, before at least %.1e m, %.1f looks a pair\n", touched, worst,
              early, double(looks) / 3000);
  EXPECT_GT(touched, 400);
  // Where a rim crosses an edge or a rim at a small angle the normal stays uncertain, and the time with it.
  std::printf("  %d of them not to 1e-10 m\n", inexact);
  EXPECT_LE(worst, 1e-6);
  EXPECT_LE(inexact, touched / 20);
  EXPECT_GE(early, -1e-10);
}

/// A plate's face against the edge of a beam, crossed edges, both all but steady while the plate's corners
/// swing down beside the beam.
TEST(ConvexTouch, ThatHardlyChangesTakesFewLooksHoweverFastCornersSwingBeside) {
  const BoxShape beam{{}, {0.25, 2, 0.25}};
  const auto about = [](double angle, const Vec3& axis) { return Quat(Eigen::AngleAxisd(angle, axis)); };
  for (const double slant : {0.0, 0.6})
    for (const double spin : {1.0, 30.0})
      for (const double rate : {0.01, -0.01}) {
        const double start = rate > 0 ? 1e-10 : 1e-4;
        // Slanted, an edge of the plate crosses the beam's; else its face lies on it.
        const Quat q = slant > 0 ? about(-slant, Vec3::UnitX()) : Quat::Identity();
        const BoxShape plate{{}, {0.2, 0.3, 0.05}};
        const Vec3 turn(0, spin, 0);
        const Vec3 lowest = q * Vec3(slant > 0 ? 0 : 0.1, slant > 0 ? 0.3 : 0, -0.05);
        const Vec3 X = Vec3(0, 0, start) - lowest;
        Flier a(1, plate, {X, q}, Vec3(0, 0, rate) - turn.cross(lowest), q.conjugate() * turn, Vec3::Zero());
        a.body.inertia = {1, 1, 1};
        a.body.spin = Spin::free(q, turn, a.body.inertia);
        Flier b(2, beam, {{0, 0, -0.25 * M_SQRT2}, about(M_PI / 4, Vec3::UnitY())}, Vec3::Zero(),
                Vec3::Zero(), Vec3::Zero());
        const auto gapAt = [&](double tau) {
          return gapBetween(Side::of(a.body), Side::of(b.body), tau).distance;
        };
        const double to = 0.02 / spin;
        std::uint64_t looks = 0;
        const auto touch = firstTouch(Side::of(a.body), Side::of(b.body), 0, to, looks);
        EXPECT_NEAR(gapAt(0), start, 1e-10);
        const double end = touch ? touch->tau : to;
        double least = 1e300;
        for (int i = 0; i <= 200; ++i) least = std::min(least, gapAt(end * i / 200));
        EXPECT_GE(least, -1e-10);
        EXPECT_LE(touch ? std::fabs(gapAt(touch->tau)) : 0, 1e-10);
        std::printf("  slant %.1f spin %4.0f rate %5.2f: %3llu looks, %s, least gap %.1e m\n", slant, spin,
                    rate, static_cast<unsigned long long>(looks), touch ? "touch" : "none", least);
        EXPECT_LE(looks, 40u);
      }
}

TEST(ThinWall, NothingThatFliesAndTumblesGetsThroughABoxASheetOrAMesh) {
  Dice d(31);
  int through = 0;
  for (int k = 0; k < 600; ++k) {
    World w;
    const int kind = k % 3;
    const double v = std::pow(10, 1.8 + 1.2 * d());
    ShapeId wall = 0;
    if (kind == 0) wall = w.addShape(BoxShape{{}, {0.0005, 10, 10}});
    if (kind == 1)
      wall = w.addShape(
          PlaneShape{{Vec3::Zero(), Quat::FromTwoVectors(Vec3::UnitZ(), -Vec3::UnitX())}, {10, 10}});
    if (kind == 2)
      wall = w.addShape(MeshShape(TriangleTree(
          meshOf({{0, -10, -10}, {0, 10, -10}, {0, 10, 10}, {0, -10, 10}}, {{0, 2, 1}, {0, 3, 2}}))));
    w.addCollider({wall, {}, {0.3, 0.5, 0.0}});
    BodyDef def;
    def.shape = w.addShape(randomShape(d, k / 3));
    const Sphere bound = boundingSphere(*w.shape(def.shape));
    def.mass.centre = bound.centre, def.mass.inertia = bound.radius * bound.radius * Vec3(0.3, 0.35, 0.4);
    def.pose = {Vec3(-bound.radius - 0.5 + 0.4 * d(), d(), d()), d.turn()};
    def.pose.p -= def.pose.q * bound.centre;
    def.v = {v, 0.1 * v * d(), 0.1 * v * d()}, def.omega = d.vec(60);
    def.surface = {0.3, 0.5, 0.0};
    const BodyId b = w.addBody(def);
    play(w, std::min(3 / v + 0.1, 0.5), 60);
    if (w.state(b).p.x() > 0)
      ++through, std::printf("  through: case %d, %.0f m/s, %s\n", k, v, w.quarantineReason(b).c_str());
    EXPECT_GE(w.separation({true, b}, {false, 1}), -1e-4) << k;
  }
  EXPECT_EQ(through, 0);
}

BodyId addConvex(World& w, FieldId g, Shape shape, const MassProperties& mass, const Pose& X,
                 const Vec3& v = Vec3::Zero(), const Vec3& omega = Vec3::Zero(), double friction = 0.5,
                 double restitution = 0) {
  BodyDef d;
  d.shape = w.addShape(std::move(shape)), d.mass = mass, d.pose = X, d.v = v, d.omega = omega;
  d.surface = {friction, restitution, 0.0};
  const BodyId b = w.addBody(d);
  if (g) w.hook(b, g, 0);
  return b;
}

MassProperties rodMass(double m, double r, double half) {
  MassProperties p;
  p.mass = m;
  const double across = m * (3 * r * r + 4 * half * half) / 12;
  p.inertia = {across, across, 0.5 * m * r * r};
  return p;
}

TEST(SolidShapes, ACylinderStandsAndACylinderRollsAndACapsuleLiesDown) {
  for (const bool mesh : {false, true}) {
    World w;
    const FieldId g = addGravity(w);
    const Surface s{0.5, 0.0, 0.0};
    if (mesh) {
      w.addCollider({w.addShape(MeshShape(TriangleTree(gridMesh(-5, 5, -5, 5, 23, 17)))), {}, s});
    } else {
      w.addCollider({w.addShape(PlaneShape{}), {}, s});
    }
    const Quat lying = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitY());
    const BodyId standing = addConvex(w, g, CylinderShape{Pose{}, 0.2, 0.3}, rodMass(1, 0.2, 0.3),
                                      {{0.11, 0.07, 0.3}, Quat::Identity()});
    const BodyId rolling = addConvex(w, g, CylinderShape{Pose{}, 0.1, 0.2}, rodMass(1, 0.1, 0.2),
                                     {{-3, -2, 0.1}, lying}, {1, 0, 0}, {0, 10, 0});
    const BodyId capsule = addConvex(w, g, CapsuleShape{Pose{}, 0.1, 0.2}, rodMass(1, 0.1, 0.3),
                                     {{2, 2, 0.5}, det::fromEuler(0.3, 1.0, 0.4)});
    play(w, 3);
    const BodyState a = w.state(standing), b = w.state(rolling), c = w.state(capsule);
    std::printf("  %s: standing %.1e m off, rolling %.3e m off course, speed %.6f, height %.1e; capsule "
                "height %.5f\n",
                mesh ? "mesh" : "plane", (a.p - Vec3(0.11, 0.07, 0.3)).norm(), b.p.y() + 2, b.v.x(),
                b.p.z() - 0.1, c.p.z());
    EXPECT_LE((a.p - Vec3(0.11, 0.07, 0.3)).norm(), 1e-4);
    EXPECT_TRUE(a.asleep());
    EXPECT_NEAR(b.v.x(), 1, mesh ? 2e-3 : 1e-9);
    EXPECT_NEAR(b.p.y(), -2, 1e-3);
    EXPECT_NEAR(b.p.z(), 0.1, 1e-4);
    EXPECT_NEAR(c.p.z(), 0.1, 1e-3);
  }
}

TEST(SolidShapes, RollingResistanceStopsARodWhereItShouldAndHoldsItAgainstASmallPull) {
  World w;
  const double c = 0.02, r = 0.1, half = 0.2, v0 = 1;
  w.addCollider({w.addShape(PlaneShape{}), {}, {0.5, 0.0, c}});
  const FieldId down = addGravity(w);
  ForceField sideways;
  sideways.law = LinearField{{0, 0.1, 0}};
  const FieldId aside = w.addField(sideways, true);
  const Quat lying = Quat::FromTwoVectors(Vec3::UnitZ(), Vec3::UnitX());
  const BodyId rolls = addConvex(w, down, CylinderShape{Pose{}, r, half}, rodMass(1, r, half),
                                 {{0, 0, r}, lying}, {0, v0, 0}, {-v0 / r, 0, 0});
  const BodyId held =
      addConvex(w, down, CylinderShape{Pose{}, r, half}, rodMass(1, r, half), {{3, 0, r}, lying});
  w.hook(held, aside, 0);
  play(w, 12);
  // (I + m r^2) alpha = c r m g about the line that it rolls on.
  const double way = v0 * v0 / (2 * c * kG / 1.5);
  std::printf("  rolled %.5f m, %.5f expected; the other crept %.1e m\n", w.state(rolls).p.y(), way,
              w.state(held).p.y());
  EXPECT_NEAR(w.state(rolls).p.y(), way, 2e-3 * way);
  EXPECT_TRUE(w.state(rolls).asleep());
  EXPECT_EQ(w.state(held).v.norm(), 0);
  EXPECT_LE(std::fabs(w.state(held).p.y()), 1e-5);
  EXPECT_TRUE(w.state(held).asleep());
}

TEST(SolidShapes, ABoxAndADiscSlideOverTheSeamsOfAFlatFloorAsOverAPlane) {
  for (const bool disc : {false, true}) {
    Vec3 end[2];
    for (const bool mesh : {false, true}) {
      World w;
      const FieldId g = addGravity(w);
      const Surface s{0.3, 0.0, 0.0};
      if (mesh) {
        w.addCollider({w.addShape(MeshShape(TriangleTree(gridMesh(-5, 5, -5, 5, 61, 47)))), {}, s});
      } else {
        w.addCollider({w.addShape(PlaneShape{}), {}, s});
      }
      const Vec3 v(3, 1, 0);
      const BodyId b = disc ? addConvex(w, g, CylinderShape{Pose{}, 0.3, 0.05}, rodMass(1, 0.3, 0.05),
                                        {{-3, -1, 0.05}, Quat::Identity()}, v, Vec3::Zero(), 0.3)
                            : addConvex(w, g, BoxShape{Pose{}, {0.3, 0.2, 0.05}},
                                        massOfBox(Pose{}, {0.3, 0.2, 0.05}, 1).withMass(1),
                                        {{-3, -1, 0.05}, Quat::Identity()}, v, Vec3::Zero(), 0.3);
      play(w, 2);
      end[mesh] = w.state(b).p;
    }
    const double way = 10 / (2 * 0.3 * kG);
    std::printf("  %s: plane %.6f, mesh %.6f, should %.6f m; side %.1e m, height %.1e\n",
                disc ? "disc" : "box", (end[0] - Vec3(-3, -1, 0.05)).norm(),
                (end[1] - Vec3(-3, -1, 0.05)).norm(), way, (end[1] - end[0]).norm(), end[1].z() - 0.05);
    EXPECT_NEAR((end[1] - Vec3(-3, -1, 0.05)).norm(), way, 1e-3);
    EXPECT_NEAR(end[1].z(), 0.05, 1e-4);
  }
}

TEST(SolidShapes, SeparationTellsHowDeepNewShapesStickAtTheStart) {
  World w;
  w.addCollider({w.addShape(PlaneShape{}), {}, {}});
  w.addCollider({w.addShape(MeshShape(TriangleTree(gridMesh(-5, 5, -5, 5, 9, 9, 0)))), {}, {}});
  w.addCollider({w.addShape(BoxShape{{{0, 0, -0.5}, Quat::Identity()}, {5, 5, 0.5}}), {}, {}});
  Dice d(8);
  const BodyId capsule = addConvex(w, 0, CapsuleShape{Pose{}, 0.1, 0.2}, rodMass(1, 0.1, 0.3),
                                   {{0.3, 0.2, 0.298}, Quat::Identity()});
  const BodyId cylinder = addConvex(w, 0, CylinderShape{Pose{}, 0.1, 0.2}, rodMass(1, 0.1, 0.2),
                                    {{2, 0.2, 0.198}, Quat::Identity()});
  for (const BodyId b : {capsule, cylinder})
    for (const std::uint32_t c : {1u, 2u, 3u})
      EXPECT_NEAR(w.separation({true, b}, {false, c}), -0.002, 1e-9) << b << c;
  EXPECT_NEAR(w.separation({true, cylinder}, {true, capsule}), 1.5, 1e-9);
  // Put somewhere else, they are measured and collide there.
  EXPECT_TRUE(w.placeBody(cylinder, {{2, 0.2, 1.2}, Quat::Identity()}, {0, 0, -1}, Vec3::Zero()));
  play(w, 0.5);
  EXPECT_NEAR(w.separation({true, cylinder}, {false, 1}), 0.5, 1e-9);
}

}  // namespace
}  // namespace stadion
