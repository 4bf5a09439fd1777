#include "dynamics/collision/shape_choice.h"
#include "engine/maths/functions.h"
#include "tests/dynamics/world/scenes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

Mesh flipped(Mesh m) {
  for (std::size_t i = 0; i + 2 < m.indices.size(); i += 3) std::swap(m.indices[i], m.indices[i + 1]);
  return m;
}

TEST(MassProperties, ABoxMeshHasTheMassOfABox) {
  const auto m = massOfMesh(boxMesh({0.5, 0.25, 0.125}), 500);
  ASSERT_TRUE(m);
  EXPECT_NEAR(m.value().mass, 500 * 0.125, 1e-12);
  const double k = m.value().mass / 3;
  EXPECT_NEAR(m.value().inertia[0], k * (0.0625 + 0.015625), 1e-12);
  EXPECT_NEAR(m.value().inertia[1], k * (0.25 + 0.015625), 1e-12);
  EXPECT_NEAR(m.value().inertia[2], k * (0.25 + 0.0625), 1e-12);
}

TEST(MassProperties, AMeshFarFromItsOriginKeepsItsDigits) {
  Mesh m = boxMesh({0.5, 0.25, 0.125});
  for (auto& p : m.positions) p[0] += 1024, p[2] -= 512;
  const auto v = integrateVolume(m);
  ASSERT_TRUE(v);
  EXPECT_NEAR(v.value().volume, 0.125, 1e-12);
  EXPECT_NEAR((v.value().centre - Vec3(1024, 0, -512)).norm(), 0, 1e-9);
}

TEST(MassProperties, AFineBallMeshApproachesTheBall) {
  const auto fine = massOfMesh(ballMesh(0.11, 96, 192), 1000);
  const MassProperties ball = massOfSphere(Vec3::Zero(), 0.11, 1000);
  ASSERT_TRUE(fine);
  EXPECT_NEAR(fine.value().mass / ball.mass, 1, 2e-3);
  EXPECT_NEAR(fine.value().inertia.x() / ball.inertia.x(), 1, 4e-3);
}

TEST(MassProperties, OpenFlippedAndFlatMeshesAreRefusedWithTheReason) {
  Mesh open = boxMesh({1, 1, 1});
  open.indices.resize(30);
  EXPECT_NE(massOfMesh(open, 1).error().message.find("open"), std::string::npos);
  EXPECT_NE(massOfMesh(flipped(boxMesh({1, 1, 1})), 1).error().message.find("inside out"), std::string::npos);
  EXPECT_FALSE(massOfMesh(gridMesh(0, 1, 0, 1, 2, 2), 1));
  EXPECT_FALSE(massOfMesh(Mesh{}, 1));
  EXPECT_FALSE(massOfMesh(boxMesh({1, 1, 1}), -3));
  Mesh bad = boxMesh({1, 1, 1});
  bad.positions[0][0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(massOfMesh(bad, 1));
}

TEST(MassProperties, PrincipalAxesDiagonaliseATurnedInertia) {
  const Mat3 R = det::fromEuler(0.3, -1.1, 2.0).toRotationMatrix();
  const Mat3 J = R * Vec3(3, 1, 2).asDiagonal() * R.transpose();
  Vec3 moments;
  Quat axes;
  principalAxes(J, moments, axes);
  EXPECT_LE((moments - Vec3(1, 2, 3)).norm(), 1e-14);
  const Mat3 A = axes.toRotationMatrix();
  EXPECT_LE((A * moments.asDiagonal() * A.transpose() - J).norm(), 1e-14);
}

TEST(ChooseShape, AFacetedBallIsABallABoxIsABoxASheetIsAPlane) {
  const auto ball = chooseShape(ballMesh(0.11, 16, 32, {0, 0, 0.11}));
  ASSERT_TRUE(ball);
  ASSERT_EQ(ball.value().kind, ShapeKind::Ball) << ball.value().remark;
  const auto& b = std::get<BallShape>(ball.value().shape);
  EXPECT_NEAR(b.radius, 0.11, 1e-7);
  EXPECT_LE((b.centre - Vec3(0, 0, 0.11)).norm(), 1e-7);

  const auto box = chooseShape(boxMesh({0.5, 0.25, 0.125}));
  ASSERT_EQ(box.value().kind, ShapeKind::Box) << box.value().remark;
  EXPECT_LE((std::get<BoxShape>(box.value().shape).half - Vec3(0.5, 0.25, 0.125)).norm(), 1e-9);

  const auto sheet = chooseShape(gridMesh(-60, 60, -60, 60, 4, 4));
  ASSERT_EQ(sheet.value().kind, ShapeKind::Plane) << sheet.value().remark;
  EXPECT_EQ(std::get<PlaneShape>(sheet.value().shape).half, Vec2(60, 60));
  EXPECT_EQ(std::get<PlaneShape>(sheet.value().shape).normal(), Vec3::UnitZ());
}

TEST(ChooseShape, ATurnedBoxIsFoundAWedgeIsConvexAndAnAngleStaysAMesh) {
  Mesh turned = boxMesh({0.5, 0.25, 0.125});
  const Quat q = det::fromEuler(0.4, 0.3, 1.0);
  for (auto& p : turned.positions) {
    const Vec3 x = q * Vec3(p[0], p[1], p[2]);
    p = {static_cast<float>(x.x()), static_cast<float>(x.y()), static_cast<float>(x.z())};
  }
  EXPECT_EQ(chooseShape(turned).value().kind, ShapeKind::Box);
  Mesh wedge = boxMesh({0.5, 0.25, 0.125});
  for (auto& p : wedge.positions)
    if (p[0] > 0 && p[2] > 0) p[2] = -0.1f;
  const auto w = chooseShape(wedge);
  EXPECT_EQ(w.value().kind, ShapeKind::Convex) << w.value().remark;
  EXPECT_FALSE(w.value().remark.empty());
  // Two boxes that overlap like an L.
  Mesh angle = boxMesh({0.5, 0.1, 0.1});
  const Mesh other = boxMesh({0.1, 0.1, 0.5});
  for (const std::uint32_t i : other.indices)
    angle.indices.push_back(i + static_cast<std::uint32_t>(angle.positions.size()));
  for (auto p : other.positions) p[0] -= 0.4f, p[2] += 0.4f, angle.positions.push_back(p);
  EXPECT_EQ(chooseShape(angle).value().kind, ShapeKind::Mesh);
  EXPECT_EQ(chooseShape(wedge, ShapeKind::Box).value().kind, ShapeKind::Box);
  EXPECT_FALSE(chooseShape(Mesh{}));
}

/// A rod about z: `rings` of radius and height, closed at both ends.
Mesh latheMesh(const std::vector<std::pair<double, double>>& rings, int sectors, const Pose& X) {
  std::vector<Vec3> p;
  std::vector<std::array<std::uint32_t, 3>> t;
  for (const auto& [r, z] : rings)
    for (int j = 0; j < sectors; ++j) {
      const double a = 2 * M_PI * j / sectors;
      p.push_back(X * Vec3(r * std::cos(a), r * std::sin(a), z));
    }
  const auto n = static_cast<std::uint32_t>(sectors), last = static_cast<std::uint32_t>(rings.size() - 1);
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i * n + j % n; };
  for (std::uint32_t i = 0; i < last; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      t.push_back({at(i, j), at(i, j + 1), at(i + 1, j)});
      t.push_back({at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
    }
  for (std::uint32_t j = 1; j + 1 < n; ++j) {
    t.push_back({at(0, 0), at(0, j + 1), at(0, j)});
    t.push_back({at(last, 0), at(last, j), at(last, j + 1)});
  }
  return meshOf(p, t);
}

TEST(ChooseShape, RodsAreCylindersOrCapsulesWhicheverWayTheyPoint) {
  for (const Vec3& turn : {Vec3(0, 0, 0), Vec3(90, 0, 0), Vec3(0, 90, 0), Vec3(31, -47, 12)}) {
    const Pose X{{1, 2, 3}, det::fromEuler(turn.x() / 57.3, turn.y() / 57.3, turn.z() / 57.3)};
    const auto c = chooseShape(latheMesh({{0.11, -0.012}, {0.11, 0.012}}, 48, X));
    ASSERT_EQ(c.value().kind, ShapeKind::Cylinder) << c.value().remark;
    const auto& s = std::get<CylinderShape>(c.value().shape);
    EXPECT_NEAR(s.radius, 0.11, 1e-6);
    EXPECT_NEAR(s.half, 0.012, 1e-6);
    EXPECT_LE((s.pose.p - X.p).norm(), 1e-6);

    std::vector<std::pair<double, double>> rings;
    for (int i = 0; i <= 24; ++i) {
      const double a = -M_PI / 2 + M_PI * i / 24 * 0.999 + 0.0005 * M_PI;
      rings.push_back({0.1 * std::cos(a), 0.1 * std::sin(a) + (i < 12 ? -0.3 : 0.3)});
      if (i == 12) rings.insert(rings.end() - 1, {0.1 * std::cos(a), 0.1 * std::sin(a) - 0.3});
    }
    const auto k = chooseShape(latheMesh(rings, 48, X));
    ASSERT_EQ(k.value().kind, ShapeKind::Capsule) << k.value().remark;
    EXPECT_NEAR(std::get<CapsuleShape>(k.value().shape).half, 0.3, 1e-3);
    EXPECT_NEAR(std::get<CapsuleShape>(k.value().shape).radius, 0.1, 1e-3);
  }
  // Eight corners are not round enough; asked for, they are.
  const Mesh column = latheMesh({{0.2, -1}, {0.2, 1}}, 8, Pose{});
  EXPECT_EQ(chooseShape(column).value().kind, ShapeKind::Convex);
  EXPECT_EQ(chooseShape(column, ShapeKind::Cylinder).value().kind, ShapeKind::Cylinder);
  EXPECT_EQ(chooseShape(column, ShapeKind::Auto, 0.0).value().kind, ShapeKind::Convex);
}

TEST(TriangleTree, UselessTrianglesAreLeftOutAndFlatSeamsMerged) {
  Mesh m = gridMesh(-5, 5, -5, 5, 10, 10);
  const std::size_t good = m.indices.size() / 3;
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    m.indices.insert(m.indices.end(), {a, b, c});
  };
  add(0, 0, 1), add(m.indices[0], m.indices[1], m.indices[2]),
      add(0, 1, 2);  // degenerate, duplicate, on a line
  add(0, 1, 100000);
  const TriangleTree tree(m);
  EXPECT_EQ(tree.triangles().size(), good);
  EXPECT_EQ(tree.dropped(), 4u);
  EXPECT_FALSE(tree.closed());
  EXPECT_TRUE(TriangleTree(boxMesh({1, 1, 1})).closed());
  ClosestPoint at;
  const auto i = tree.nearest({0.3, 0.2, 2}, 1e9, at);
  ASSERT_GE(i, 0);
  EXPECT_LE((at.point - Vec3(0.3, 0.2, 0)).norm(), 1e-12);
}

TEST(TriangleTree, TheNearestTriangleIsTheOneThatASearchOfAllFinds) {
  const TriangleTree tree(ballMesh(1, 20, 30));
  unsigned seed = 5;
  const auto random = [&] {
    return static_cast<double>((seed = seed * 1664525u + 1013904223u) >> 8) / (1 << 23) - 1;
  };
  for (int n = 0; n < 300; ++n) {
    const Vec3 p(2 * random(), 2 * random(), 2 * random());
    double best = 1e300;
    for (const Triangle& t : tree.triangles()) best = std::min(best, (closestPoint(t, p).point - p).norm());
    ClosestPoint at;
    ASSERT_GE(tree.nearest(p, 1e9, at), 0);
    EXPECT_NEAR((at.point - p).norm(), best, 1e-14);
  }
}

}  // namespace
}  // namespace stadion
