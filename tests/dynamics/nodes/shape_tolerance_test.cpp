/// What `shape=auto tolerance=...` takes for a model that comes with the program.

#include "dynamics/collision/shape_choice.h"
#include "dynamics/nodes/shape_store.h"
#include "tests/dynamics/world/scenes.h"

#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace stadion {
namespace {

/// Corners and faces of a plain OBJ file.
Mesh modelOf(const std::string& name) {
  std::ifstream file(std::string(STADION_SOURCE_DIR) + "/assets/" + name);
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::string line; std::getline(file, line);) {
    std::istringstream in(line);
    std::string word;
    in >> word;
    if (word == "v") {
      Vec3 p = Vec3::Zero();
      in >> p.x() >> p.y() >> p.z();
      points.push_back(p);
    } else if (word == "f") {
      std::vector<std::uint32_t> loop;
      for (std::string corner; in >> corner;)
        loop.push_back(static_cast<std::uint32_t>(std::stoul(corner.substr(0, corner.find('/')))) - 1);
      for (std::size_t i = 2; i < loop.size(); ++i) triangles.push_back({loop[0], loop[i - 1], loop[i]});
    }
  }
  Mesh m = scenes::meshOf(points, triangles);
  for (const Vec3& p : points) m.bounds.include(p);
  m.sphere = {m.bounds.centre(), (m.bounds.hi - m.bounds.centre()).norm()};
  return m;
}

TEST(ShapeTolerance, OfTheFootMoreToleranceTakesASimplerShapeAndSaysHowFarOffItIs) {
  const Mesh foot = modelOf("crude_foot.obj");
  ASSERT_GT(foot.positions.size(), 20u);
  const Vec3 size = foot.bounds.hi - foot.bounds.lo;
  ShapeStore store;
  int simplest = 100;
  ShapeKind strict = ShapeKind::Auto, loose = ShapeKind::Auto;
  for (const double tolerance : {0.0, 0.001, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0}) {
    const auto fit = store.fit(foot, {1, true, "auto", tolerance}, Vec3::Ones());
    ASSERT_TRUE(fit) << tolerance;
    const ShapeChoice& choice = fit.value()->choice;
    EXPECT_LE(choice.deviation, tolerance * size.maxCoeff() + 1e-6) << choice.remark;
    EXPECT_NE(choice.remark.find(nameOf(choice.kind)), std::string::npos) << choice.remark;
    // The order in which they are tried.
    static constexpr std::array order{ShapeKind::Plane,   ShapeKind::Ball,     ShapeKind::Box,
                                      ShapeKind::Capsule, ShapeKind::Cylinder, ShapeKind::Convex,
                                      ShapeKind::Mesh};
    const int rank = static_cast<int>(std::find(order.begin(), order.end(), choice.kind) - order.begin());
    EXPECT_LE(rank, simplest) << "more tolerance takes nothing that is dearer: " << choice.remark;
    simplest = rank;
    if (tolerance == 0) strict = choice.kind;
    loose = choice.kind;
  }
  EXPECT_NE(strict, loose) << "the tolerance decides something";
}

TEST(ShapeTolerance, FitsOfOneModelWithDifferentTolerancesAreDifferentFits) {
  const Mesh foot = modelOf("crude_foot.obj");
  ShapeStore store;
  const auto a = store.fit(foot, {1, true, "auto", 0.0}, Vec3::Ones()),
             b = store.fit(foot, {1, true, "auto", 1.0}, Vec3::Ones()),
             c = store.fit(foot, {1, true, "auto", 1.0}, Vec3::Ones());
  EXPECT_NE(a.value(), b.value());
  EXPECT_EQ(b.value(), c.value());
}

}  // namespace
}  // namespace stadion
