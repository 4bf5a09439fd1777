#include "tests/dynamics/world/seams_scenes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

constexpr double kFriction = 0.4, kRolling = 0.3;

Pose turnedFrame() {
  return {{3, -2, 1}, Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()))};
}

Slid slideOver(Ground ground, Slider kind, bool single, double rate, const Pose& frame, const Vec3& v) {
  World w;
  const FieldId g = addGravity(w, frame.q * Vec3(0, 0, -kG));
  addFloorOf(w, ground, frame, {kFriction, 0.0, 0.0}, single);
  BodyDef d = slider(w, kind);
  d.v = frame.q * v;
  if (rolls(kind)) d.omega = frame.q * Vec3(Vec3::UnitZ().cross(v) / 0.25);
  d.pose = frame * d.pose;
  d.surface = {kFriction, 0.0, rolls(kind) ? kRolling : 0.0};
  return watchSlide(w, addSolid(w, g, d), frame, 0.9, rate);
}

class SeamsUnder : public testing::TestWithParam<Slider> {};

TEST_P(SeamsUnder, ItGoesAsFarAsOnOneSlab) {
  const Slider kind = GetParam();
  const Vec3 v(0, 3, 0);
  for (const Ground g : kGrounds) {
    SCOPED_TRACE(nameOf(g));
    const Slid slab = slideOver(g, kind, true, 60, {}, v), tiles = slideOver(g, kind, false, 60, {}, v);
    EXPECT_LT((tiles.end - slab.end).norm(), g == Ground::Mixed ? 2e-3 : 1e-5);
    EXPECT_LT(std::max(tiles.highest - 0.25, 0.25 - tiles.lowest), 1e-6);
    EXPECT_EQ(tiles.events, 0u);
    if (rolls(kind)) continue;
    EXPECT_NEAR(tiles.end.y(), v.squaredNorm() / (2 * kFriction * kG), 1e-5);
    EXPECT_LT(tiles.turned, 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, SeamsUnder, testing::ValuesIn(kSliders), [](const auto& kind) {
  std::string name = nameOf(kind.param);
  std::ranges::replace(name, ' ', '_');
  return name;
});

// Its corners enter tiles from all sides. In a turned frame rounding decides which faces of a tile look towards it.
TEST(Seams, ABoxThatSpinsIsCaughtByNone) {
  const Pose frame{{3, -2, 1}, Quat(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()))};
  for (int run = 0; run < 20; ++run) {
    SCOPED_TRACE(run);
    Chance chance(static_cast<unsigned>(run) + 17);
    const double width = chance.between(0.2, 1.3), length = chance.between(0.2, 0.9);
    const Vec3 v(chance.between(-1.5, 1.5), chance.between(1, 4), 0);
    const Surface surface{0.3, 0.0, 0.0};
    World w;
    const FieldId g = addGravity(w, frame.q * Vec3(0, 0, -kG));
    for (double x = -3; x < 3; x += width)
      for (double y = -1; y < 4; y += length)
        addPiece(w, Ground::Boxes, frame, x, x + width, y, y + length, 0, surface);
    BodyDef d = slider(w, Slider::Box);
    d.v = frame.q * v;
    d.omega = frame.q * Vec3(0, 0, chance.between(-4, 4));
    d.pose = frame * d.pose;
    d.surface = surface;
    const Slid slid = watchSlide(w, addSolid(w, g, d), frame, 1.2, 60);
    EXPECT_EQ(slid.events, 0u);
    EXPECT_LT(std::max(slid.highest - 0.25, 0.25 - slid.lowest), 1e-6);
  }
}

TEST(Seams, ObliquelyAcrossCornersOfFourTilesInATurnedFrame) {
  const Vec3 v(0.7, 2.5, 0);
  for (const Slider kind : {Slider::Box, Slider::Convex, Slider::Mesh, Slider::Disc, Slider::Ball})
    for (const Ground g : {Ground::Boxes, Ground::ClosedMeshes, Ground::Sheets, Ground::OneMesh}) {
      SCOPED_TRACE(std::string(nameOf(kind)) + " over " + nameOf(g));
      const Slid slab = slideOver(g, kind, true, 60, turnedFrame(), v),
                 tiles = slideOver(g, kind, false, 60, turnedFrame(), v);
      EXPECT_LT((tiles.end - slab.end).norm(), 1e-5);
      EXPECT_LT(std::max(tiles.highest - 0.25, 0.25 - tiles.lowest), 1e-6);
      EXPECT_EQ(tiles.events, 0u);
    }
}

TEST(Seams, TheSlideDoesNotDependOnTheFrameRate) {
  const Vec3 v(0.7, 2.5, 0);
  for (const Slider kind : {Slider::Box, Slider::Mesh, Slider::Ball, Slider::CapsuleAlong})
    for (const Ground g : {Ground::Boxes, Ground::Mixed}) {
      const Slid at60 = slideOver(g, kind, false, 60, {}, v);
      for (const double rate : {30.0, 150.0}) {
        const Slid other = slideOver(g, kind, false, rate, {}, v);
        EXPECT_LT((other.end - at60.end).norm(), 1e-9)
            << nameOf(kind) << " over " << nameOf(g) << " at " << rate;
        EXPECT_EQ(other.events, 0u);
      }
    }
}

/// A body on a floor, pulled against a wall of pieces that stand flush on it.
Slid slideAlongWall(Ground floor, Ground wall, Slider kind, bool single) {
  World w;
  const FieldId g = addGravity(w, {-2, 0, -kG});
  addFloorOf(w, floor, {}, {0.1, 0.0, 0.0}, single, 1.1, 0.35, 3, 20);
  // The wall's near side is x = 0.
  constexpr double kHeight = 1.5;
  for (int i = 0; i < (single ? 1 : 9); ++i) {
    const double y0 = single ? -1.3 : -1.3 + i, y1 = single ? 7.7 : y0 + 1;
    const Vec3 half(0.5, 0.5 * (y1 - y0), 0.5 * kHeight);
    Patchwork mesh;
    mesh.box(-half, half);
    w.addCollider({wall == Ground::ClosedMeshes ? w.addShape(mesh.shape()) : w.addShape(BoxShape{{}, half}),
                   {{-0.5, 0.5 * (y0 + y1), 0.5 * kHeight}, Quat::Identity()},
                   {0.1, 0.0, 0.0}});
  }
  BodyDef d = slider(w, kind);
  d.pose.p.x() = 0.25;
  d.v = {0, 4, 0};
  d.surface = {0.1, 0.0, 0.0};
  return watchSlide(w, addSolid(w, g, d), {}, 1, 60);
}

TEST(Seams, AlongAWallOfPiecesItGoesAsAlongOne) {
  for (const Slider kind : {Slider::Box, Slider::Convex, Slider::Ball, Slider::RodAlong, Slider::Mesh})
    for (const Ground wall : {Ground::Boxes, Ground::ClosedMeshes})
      for (const Ground floor : {Ground::Boxes, Ground::OpenMeshes}) {
        SCOPED_TRACE(std::string(nameOf(kind)) + " along " + nameOf(wall) + " on " + nameOf(floor));
        const Slid whole = slideAlongWall(floor, wall, kind, true),
                   pieces = slideAlongWall(floor, wall, kind, false);
        EXPECT_LT((pieces.end - whole.end).norm(), kind == Slider::Mesh ? 2e-4 : 1e-5);
        EXPECT_EQ(pieces.events, whole.events);
        if (kind != Slider::Ball) {
          EXPECT_LT(pieces.turned, 1e-5);
        }
      }
}

/// Slides a body for a second along a wall of rows of pieces that stands on a box, pulled against it.
Slid slideAlongFlushWall(Ground wall, Slider kind, const Pose& frame, double friction, double rate,
                         bool single) {
  constexpr double kHeight = 2, kLength = 0.78, kPull = 5;
  constexpr int kRows = 3;
  World w;
  const FieldId g = addGravity(w, frame.q * Vec3(-kPull, 0, -kG));
  const Surface surface{friction, 0.0, 0.0};
  addPiece(w, Ground::Boxes, frame, -3, 4, -3, 9, 0, surface);
  // The near side is x = 0. The rows of addFloorOf() lie above each other.
  const Pose upright{{0, 0, kHeight - 1.7}, Quat(Eigen::AngleAxisd(M_PI / 2, Vec3::UnitY()))};
  addFloorOf(w, wall, frame * upright, surface, single, kHeight / kRows, kLength, kRows, 11);
  BodyDef d = slider(w, kind);
  d.pose.p.x() = 0.25;
  d.v = frame.q * Vec3(0, 3.8, 0);
  d.pose = frame * d.pose;
  d.surface = surface;
  return watchSlide(w, addSolid(w, g, d), frame, 1, rate);
}

// A corner of the next sheet, in front of a mesh that slides along the wall, was an obstacle.
TEST(Seams, AlongAWallOfSheetsItGoesAsAlongOne) {
  for (const Slider kind : {Slider::Box, Slider::Convex, Slider::Mesh, Slider::RodAlong})
    for (const Ground wall : {Ground::Sheets, Ground::OpenMeshes, Ground::Mixed})
      for (const double friction : {0.0, 0.5})
        for (const double rate : {25.0, 60.0, 240.0}) {
          const Pose frame = rate == 60 ? turnedFrame() : Pose{};
          SCOPED_TRACE(std::string(nameOf(kind)) + " along " + nameOf(wall) + ", friction " +
                       std::to_string(friction) + ", " + std::to_string(rate) + " Hz");
          const Slid whole = slideAlongFlushWall(wall, kind, frame, friction, rate, true),
                     pieces = slideAlongFlushWall(wall, kind, frame, friction, rate, false);
          EXPECT_LT((pieces.end - whole.end).norm(), 3e-4);
          EXPECT_EQ(pieces.events, 0u);
          EXPECT_LT(pieces.turned, 1e-4);
        }
}

/// A body slides from a floor to one that is `step` higher.
Slid slideToStep(Ground ground, Slider kind, double step, double rolling = 0.2) {
  World w;
  const FieldId g = addGravity(w);
  addPiece(w, ground, {}, -2, 2, -2, 1, 0, {0.2, 0.0, 0.0});
  addPiece(w, ground, {}, -2, 2, 1, 6, step, {0.2, 0.0, 0.0});
  BodyDef d = slider(w, kind);
  d.v = {0, 3, 0};
  if (rolls(kind)) d.omega = {-12, 0, 0};
  d.surface = {0.2, 0.0, rolls(kind) ? rolling : 0.0};
  return watchSlide(w, addSolid(w, g, d), {}, 1.6, 60);
}

TEST(Seams, AStepOfAMillimetreIsARealEdge) {
  const double free = 9 / (2 * 0.2 * kG);
  for (const Slider kind : {Slider::Box, Slider::Convex, Slider::Mesh, Slider::Disc, Slider::RodAlong})
    for (const Ground g :
         {Ground::Boxes, Ground::Convexes, Ground::Sheets, Ground::ClosedMeshes, Ground::OpenMeshes}) {
      SCOPED_TRACE(std::string(nameOf(kind)) + " over " + nameOf(g));
      const Slid up = slideToStep(g, kind, 1e-3), down = slideToStep(g, kind, -1e-3);
      EXPECT_LT(up.end.y(), free - 0.5) << "it is caught or kicked";
      EXPECT_GT(up.turned, 0.1);
      EXPECT_NEAR(down.end.y(), free, 0.02);
      EXPECT_NEAR(down.end.z(), 0.249, 1e-4) << "it has come down";
    }
  for (const Slider kind : {Slider::Ball, Slider::CapsuleAcross}) {
    // Without rolling resistance, which it does not feel while the edge has thrown it up.
    const Slid up = slideToStep(Ground::Boxes, kind, 1e-3, 0), flush = slideToStep(Ground::Boxes, kind, 0, 0);
    EXPECT_NEAR(up.end.z(), 0.251, 1e-4);
    EXPECT_LT(up.end.y(), flush.end.y() - 0.005) << "the edge costs speed";
    EXPECT_EQ(flush.events, 0u);
  }
}

TEST(Seams, LevelsThatDifferByLessThanATenthOfAMillimetreAreFlush) {
  for (const Slider kind : {Slider::Box, Slider::Convex, Slider::Ball, Slider::CapsuleAcross})
    for (const double step : {-5e-5, 5e-5}) {
      SCOPED_TRACE(std::string(nameOf(kind)) + " over " + std::to_string(step));
      const Slid t = slideToStep(Ground::Boxes, kind, step), flush = slideToStep(Ground::Boxes, kind, 0);
      EXPECT_NEAR(t.end.y(), flush.end.y(), 0.02);
      EXPECT_NEAR(t.end.z(), 0.25 + step, 5e-5);
      EXPECT_EQ(t.events, 0u);
    }
}

TEST(Seams, EachPartOfTheWayHasItsOwnFriction) {
  for (const Slider kind : {Slider::Box, Slider::Ball}) {
    World w;
    const FieldId g = addGravity(w);
    addPiece(w, Ground::Boxes, {}, -2, 2, -2, 1, 0, {0.1, 0.0, 0.0});
    addPiece(w, Ground::Boxes, {}, -2, 2, 1, 6, 0, {0.4, 0.0, 0.0});
    BodyDef d = slider(w, kind);
    d.v = {0, 3, 0};
    d.surface = {};
    d.surface.restitution = 0.0, d.surface.rolling = 0.0;
    const Slid t = watchSlide(w, addSolid(w, g, d), {}, 1.2, 60);
    EXPECT_EQ(t.events, 0u);
    EXPECT_LT(t.highest, 0.25 + 1e-6);
    if (kind == Slider::Box) {
      EXPECT_NEAR(t.end.y(), 1 + (9 - 2 * 0.1 * kG) / (2 * 0.4 * kG), 0.15);
    }
  }
}

TEST(Seams, APieceThatIsGoneOrHasMovedIsNoLongerFlush) {
  for (const Slider kind : {Slider::Box, Slider::Ball, Slider::Convex})
    for (const bool gone : {true, false}) {
      SCOPED_TRACE(std::string(nameOf(kind)) + (gone ? " gone" : " raised"));
      World w;
      const FieldId g = addGravity(w);
      addPiece(w, Ground::Boxes, {}, -2, 2, -2, 1, 0, {0.1, 0.0, 0.0});
      const ColliderId next = addPiece(w, Ground::Boxes, {}, -2, 2, 1, 6, 0, {0.1, 0.0, 0.0});
      BodyDef d = slider(w, kind);
      d.v = {0, 3, 0};
      d.surface = {0.1, 0.0, 0.0};
      const BodyId b = addSolid(w, g, d);
      play(w, 0.1, 60);
      if (gone)
        EXPECT_TRUE(w.enableCollider(next, false));
      else
        EXPECT_TRUE(w.moveCollider(next, {{0, 3.5, -0.4}, Quat::Identity()}, true));
      play(w, 0.9, 60);
      if (gone) {
        EXPECT_LT(w.state(b).p.z(), 0.2) << "it falls";
      } else if (kind != Slider::Ball) {
        EXPECT_LT(w.state(b).p.y(), 0.9) << "it has met an edge";
      }
    }
}

TEST(Seams, ABodyThatLandsFlatOnASeamDoesNotTurn) {
  for (const Slider kind : {Slider::Box, Slider::Convex, Slider::Disc, Slider::RodAlong, Slider::RodAcross})
    for (const double restitution : {0.0, 0.5}) {
      SCOPED_TRACE(std::string(nameOf(kind)) + " " + std::to_string(restitution));
      World w;
      const FieldId g = addGravity(w);
      addPiece(w, Ground::Boxes, {}, -2, 2, -2, 0.1, 0, {0.3, restitution, 0.0});
      addPiece(w, Ground::Boxes, {}, -2, 2, 0.1, 2, 0, {0.3, restitution, 0.0});
      BodyDef d = slider(w, kind);
      d.pose.p.z() += 0.2;
      d.surface = {0.3, restitution, 0.0};
      const BodyId b = addSolid(w, g, d);
      std::size_t impacts = 0;
      double turned = 0;
      play(w, 0.5, 60, [&](double t) {
        turned = std::max(turned, 2 * (w.pose(b).q.coeffs() - d.pose.q.coeffs()).norm());
        if (t > 0.25) return;
        for (const ContactEvent& e : w.events()) impacts += e.kind == ContactEvent::Kind::Impact;
      });
      EXPECT_LT(turned, 1e-6);
      EXPECT_EQ(impacts, kind == Slider::RodAcross ? 1u : 2u) << "each piece that it meets is struck";
    }
}

}  // namespace
}  // namespace stadion
