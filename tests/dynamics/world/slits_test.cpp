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

}  // namespace
}  // namespace stadion
