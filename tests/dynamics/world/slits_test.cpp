/// Tiles whose sizes are rounded to single precision, as those of models are: their edges are some nanometres
/// apart, or overlap by as much. Such a slit is no edge.

#include "tests/dynamics/world/seams_scenes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

constexpr std::array kTiles{Ground::Boxes, Ground::Convexes, Ground::ClosedMeshes};

/// A convex ball of flat faces with a corner below.
Shape facetedBall(double radius) {
  std::vector<Vec3> corners{{0, 0, radius}, {0, 0, -radius}};
  for (int ring = 1; ring < 16; ++ring)
    for (int i = 0; i < 24; ++i) {
      const double down = M_PI * ring / 16, around = 2 * M_PI * i / 24;
      corners.push_back(radius * Vec3(std::sin(down) * std::cos(around), std::sin(down) * std::sin(around),
                                      std::cos(down)));
    }
  return *convexHull(corners);
}

/// A pyramid with its corner below.
Shape pyramid() {
  return *convexHull(std::vector<Vec3>{{0, 0, -0.25}, {0.1, 0, 0.1}, {-0.1, 0.05, 0.1}, {-0.02, -0.12, 0.1}});
}

BodyDef smooth(ShapeId shape) {
  BodyDef d;
  d.shape = shape;
  d.pose.p = {0, 0, 0.25};
  d.mass = massOfSphere(Vec3::Zero(), 0.25, 1).withMass(10);
  d.surface = {0.0, 0.0, 0.0};
  return d;
}

/// Square tiles about the origin, `slit` apart; the origin is where four of them meet.
void addTiles(World& w, Ground kind, double size, double slit, const Surface& surface, int n = 4) {
  for (int i = -n; i < n; ++i)
    for (int j = -n; j < n; ++j)
      addPiece(w, kind, {}, i * size + slit / 2, (i + 1) * size - slit / 2, j * size + slit / 2,
               (j + 1) * size - slit / 2, 0, surface);
}

TEST(Slits, ACornerThatIsAboveASlitAtATickSlidesOn) {
  const Vec3 v(1.5, 2.5, 0);
  for (const Ground kind : kTiles)
    for (const double slit : {1.2e-8, -1.2e-8, 1e-6})
      for (const double rate : {25.0, 60.0, 240.0}) {
        SCOPED_TRACE(std::string(nameOf(kind)) + " " + std::to_string(slit * 1e9) + " nm apart, " +
                     std::to_string(rate) + " Hz");
        World w;
        const FieldId g = addGravity(w);
        addTiles(w, kind, 0.7, slit, {0.0, 0.0, 0.0});
        BodyDef d = smooth(w.addShape(facetedBall(0.25)));
        d.pose.p -= 0.1 * v + Vec3(0.3, 0, 0);  // over the slit y = 0 after 0.1 s
        d.v = v;
        const BodyId b = addSolid(w, g, d);
        std::size_t events = 0;
        play(w, 0.2, rate, [&](double) { events += w.events().size(); });
        EXPECT_LT((w.state(b).v - v).norm(), 1e-4);
        EXPECT_NEAR(w.state(b).p.z(), 0.25, 1e-5);
        EXPECT_EQ(events, 0u);
      }
}

TEST(Slits, WhatLandsOnOneReboundsStraight) {
  for (const Ground kind : {Ground::Boxes, Ground::Convexes, Ground::ClosedMeshes, Ground::OpenMeshes})
    for (const double slit : {0.0, 1.2e-8, -1.2e-8, 1e-6})
      for (const double restitution : {0.0, 0.5})
        for (const int body : {0, 1, 2})
          for (const bool corner : {false, true}) {
            if (corner && body != 1) continue;  // a point that comes down where four slits meet may tip
            SCOPED_TRACE(std::string(nameOf(kind)) + " " + std::to_string(slit * 1e9) + " nm apart, body " +
                         std::to_string(body) + (corner ? " on four" : " on two"));
            World w;
            const FieldId g = addGravity(w);
            addTiles(w, kind, 2, slit, {0.0, restitution, 0.0}, 1);
            BodyDef d = smooth(w.addShape(body == 0   ? facetedBall(0.25)
                                          : body == 1 ? Shape(BallShape{Vec3::Zero(), 0.25})
                                                      : pyramid()));
            d.pose.p = {corner ? 0 : 1.1, 0, 0.45};
            d.surface.restitution = restitution;
            const BodyId b = addSolid(w, g, d);
            double aside = 0, turning = 0, lowest = 1;
            std::size_t impacts = 0;
            play(w, 0.3, 60, [&](double) {
              const BodyState s = w.state(b);
              aside = std::max(aside, s.v.head<2>().norm()), turning = std::max(turning, s.omega.norm());
              lowest = std::min(lowest, s.p.z());
              for (const ContactEvent& e : w.events()) impacts += e.kind == ContactEvent::Kind::Impact;
            });
            EXPECT_LT(aside, 1e-5);
            EXPECT_LT(turning, 2e-4) << "by half a slit of a micrometre";
            EXPECT_GT(lowest, 0.2499);
            EXPECT_GT(impacts, 0u);
          }
}

TEST(Slits, RodsThatLieAcrossManyTilesGoAsOnOneSlab) {
  const Quat yaw(Eigen::AngleAxisd(0.3, Vec3::UnitZ()));
  for (const Slider kind : {Slider::RodAlong, Slider::CapsuleAlong, Slider::RodAcross, Slider::CapsuleAcross})
    for (const double turn : {0.0, 0.54, 0.785}) {
      const auto slide = [&](Ground ground, bool whole) {
        World w;
        const FieldId g = addGravity(w);
        const Pose frame{Vec3::Zero(), Quat(Eigen::AngleAxisd(turn, Vec3::UnitZ()))};
        const int n = whole ? 1 : 8;
        const double size = whole ? 6.4 : 0.8;
        for (int i = -n; i < n; ++i)
          for (int j = -n; j < n; ++j)
            addPiece(w, ground, frame, i * size, (i + 1) * size, j * size, (j + 1) * size, 0,
                     {0.2, 0.0, 0.0});
        BodyDef d = slider(w, kind);
        d.pose.q = yaw * d.pose.q;
        d.pose.p.x() += 0.4;  // the slab has seams at the origin, too
        d.v = {0.2, 2.5, 0};
        d.surface = {0.2, 0.0, 0.0};
        return watchSlide(w, addSolid(w, g, d), {}, 2, 60);
      };
      const Slid slab = slide(Ground::Boxes, true);
      for (const Ground ground : kTiles) {
        SCOPED_TRACE(std::string(nameOf(kind)) + " over " + nameOf(ground) + " turned by " +
                     std::to_string(turn));
        const Slid tiles = slide(ground, false);
        EXPECT_LT((tiles.end - slab.end).norm(), ground == Ground::ClosedMeshes ? 1e-5 : 1e-7);
        EXPECT_EQ(tiles.events, 0u);
      }
    }
}

TEST(Slits, ABallKeepsItsSpinFromOneKindOfPieceToAnother) {
  const double friction = 0.2, radius = 0.25;
  for (const Ground first : kTiles)
    for (const Ground second : kTiles)
      for (const double rate : {60.0, 500.0, 1000.0}) {
        SCOPED_TRACE(std::string(nameOf(first)) + " to " + nameOf(second) + " at " + std::to_string(rate));
        World w;
        const FieldId g = addGravity(w);
        addPiece(w, first, {}, -5, 5, -3.75, 0.25, 0, {friction, 0.0, 0.0});
        addPiece(w, second, {}, -5, 5, 0.25, 4.25, 0, {friction, 0.0, 0.0});
        BallSpec spec;
        spec.radius = radius, spec.friction = friction;
        spec.p = {0, 0, radius}, spec.v = {0, 2.5, 0};
        const BodyId b = addBall(w, g, spec);
        const double gain = 2.5 * friction * kG / radius / rate;  // per frame, as for a ball that slides
        double before = 0;
        play(w, 0.25, rate, [&](double) {
          const double now = w.state(b).omega.x();
          EXPECT_NEAR(before - now, gain, 1e-7);
          before = now;
        });
      }
}

/// A cube on two slabs that meet at x = 0, the second one `step` higher.
struct TwoSlabs {
  World w;
  BodyId body = 0;
  Vec3 v{1, 0, 0};
  std::size_t impacts = 0;
  double first = 0;  ///< impact [s]

  TwoSlabs(Ground from, Ground onto, double step, Solid kind, double half) {
    const FieldId g = addGravity(w);
    addPiece(w, from, {}, -2, 0, -2, 2, 0, {0.0, 0.0, 0.0});
    addPiece(w, onto, {}, 0, 2, -2, 2, step, {0.0, 0.0, 0.0});
    BodyDef d = solidBody(w, kind, half, 10);
    const Vec3 size = Vec3::Constant(half);
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i)
      corners.emplace_back((i & 1 ? 1 : -1) * half, (i & 2 ? 1 : -1) * half, (i & 4 ? 1 : -1) * half);
    d.shape = kind == Solid::Box      ? w.addShape(BoxShape{{}, size})
              : kind == Solid::Convex ? w.addShape(*convexHull(corners))
                                      : w.addShape(MeshShape(TriangleTree(boxMesh(size))));
    d.mass = massOfBox({}, size, 1).withMass(10);
    d.pose.p = {-0.35 - half, -0.437, half};
    d.v = v, d.surface = {0.0, 0.0, 0.0};
    body = addSolid(w, g, d);
  }
  void slide(double seconds, double rate) {
    play(w, seconds, rate, [&](double) {
      for (const ContactEvent& e : w.events())
        if (e.kind == ContactEvent::Kind::Impact && ++impacts == 1) first = toSeconds(e.time);
    });
  }
};

TEST(Slits, ASolidKeepsItsSpeedFromOneKindOfSlabToAnother) {
  for (const Ground from : {Ground::Boxes, Ground::Convexes, Ground::ClosedMeshes, Ground::OpenMeshes})
    for (const Ground onto : {Ground::Boxes, Ground::Convexes, Ground::ClosedMeshes, Ground::Sheets})
      for (const Solid kind : {Solid::Box, Solid::Convex, Solid::Mesh}) {
        SCOPED_TRACE(std::string(nameOf(kind)) + " from " + nameOf(from) + " onto " + nameOf(onto));
        TwoSlabs scene(from, onto, 0, kind, 0.1);
        scene.slide(1, 60);
        EXPECT_LT((scene.w.state(scene.body).v - scene.v).norm(), 1e-7);
        EXPECT_EQ(scene.impacts, 0u);
      }
}

TEST(Slits, LevelsThatDifferByAFewHundredthsOfAMillimetreCostNoSpeed) {
  for (const Ground onto : kTiles)
    for (const Solid kind : {Solid::Box, Solid::Convex})
      for (const double step : {2e-5, 5e-5, 9e-5, -5e-5}) {
        SCOPED_TRACE(std::string(nameOf(kind)) + " onto " + nameOf(onto) + " " + std::to_string(step));
        TwoSlabs scene(Ground::Boxes, onto, step, kind, 0.15);
        scene.slide(1.2, 240);
        EXPECT_NEAR(scene.w.state(scene.body).v.x(), 1, 1e-3);
      }
}

TEST(Slits, AWallThatASlidingSolidRunsAgainstIsAnImpact) {
  for (const Ground onto : kTiles)
    for (const Solid kind : {Solid::Box, Solid::Convex, Solid::Mesh})
      for (const double rate : {25.0, 60.0, 240.0}) {
        SCOPED_TRACE(std::string(nameOf(kind)) + " against " + nameOf(onto) + " " + std::to_string(rate));
        TwoSlabs scene(Ground::Boxes, onto, 0.3, kind, 0.15);
        scene.slide(1, rate);
        EXPECT_EQ(scene.impacts, 1u);
        EXPECT_NEAR(scene.first, 0.35, 1e-6);
        EXPECT_NEAR(scene.w.state(scene.body).p.x(), -0.15, 1e-5);
      }
}

TEST(Slits, ABallRollsAlongTheLineWhereTwoTilesMeetAsBesideIt) {
  const auto roll = [](double aside) {
    World w;
    const FieldId g = addGravity(w);
    addPiece(w, Ground::Boxes, {}, -1, 0, -5, 5, 0, {0.2, 0.0, 0.01});
    addPiece(w, Ground::Boxes, {}, 0, 1, -5, 5, 0, {0.2, 0.0, 0.01});
    BallSpec spec;
    spec.radius = 0.25, spec.friction = 0.2, spec.rolling = 0.01;
    spec.p = {aside, -2, 0.25}, spec.v = {0, 3, 0};
    const BodyId b = addBall(w, g, spec);
    play(w, 1, 60);
    return w.state(b);
  };
  const BodyState on = roll(0), beside = roll(0.2);
  EXPECT_NEAR(on.p.y(), beside.p.y(), 5e-4);
  EXPECT_NEAR(on.v.y(), beside.v.y(), 1e-3);
  EXPECT_NEAR(on.omega.x(), beside.omega.x(), 4e-3);
}

}  // namespace
}  // namespace stadion
