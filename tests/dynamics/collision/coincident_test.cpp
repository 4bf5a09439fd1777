/// Bodies put into one place part without bursting.

#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

double deepest(const World& w, const std::vector<BodyId>& bodies) {
  double gap = 1e300;
  for (const BodyId a : bodies)
    for (const BodyId b : bodies)
      if (a < b) gap = std::min(gap, w.separation({true, a}, {true, b}));
  return gap;
}

struct Case {
  Solid kind;
  int count;
  bool turned;
};

std::vector<BodyId> addTogether(World& w, FieldId g, const Case& c, const Vec3& at, const Surface& surface) {
  std::vector<BodyId> all;
  Chance chance(71);
  const Quat q = c.turned ? chance.turn() : Quat::Identity();
  for (int k = 0; k < c.count; ++k) {
    BodyDef d = solidBody(w, c.kind, 0.2, 1 + k);
    d.pose = {at, q}, d.surface = surface;
    all.push_back(addSolid(w, g, d));
  }
  return all;
}

TEST(Coincident, OfAnyKindTheyPartOnTheGroundWithoutBursting) {
  for (const Solid kind : kSolids)
    for (const int count : {2, 4})
      for (const bool turned : {false, true}) {
        World w;
        const FieldId g = addGravity(w);
        addFloor(w, 0.5);
        const auto all = addTogether(w, g, {kind, count, turned}, {0, 0, 0.6}, {0.5, 0.2, 0.02});
        Watch watch(w, all);
        play(w, 3, watch, 30);
        const std::string what =
            std::to_string(count) + " of " + nameOf(kind) + (turned ? ", turned" : ", upright");
        EXPECT_TRUE(watch.finite) << what;
        EXPECT_EQ(watch.limited, 0u) << what;
        EXPECT_LE(watch.fastest, 8) << what << ": what falls from there has 3.4 m/s";
        EXPECT_GE(deepest(w, all), -5e-3) << what;
        for (const BodyId b : all) EXPECT_GE(w.separation({true, b}, {false, 1}), -2e-3) << what;
      }
}

TEST(Coincident, InSpaceTheyStayFiniteAndSlow) {
  for (const Solid kind : kSolids) {
    World w;
    const auto all = addTogether(w, 0, {kind, 2, true}, {0, 0, 0}, {0.5, 1.0, 0.0});
    Watch watch(w, all, Vec3::Zero());
    play(w, 5, watch);
    EXPECT_TRUE(watch.finite) << nameOf(kind);
    EXPECT_EQ(watch.limited, 0u) << nameOf(kind);
    EXPECT_LE(watch.fastest, 1) << nameOf(kind);
  }
}

TEST(Coincident, ABodyPutExactlyIntoARestingOneIsPartedFromIt) {
  for (const Solid kind : kSolids) {
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, 0.5);
    const auto one = addTogether(w, g, {kind, 1, false}, {0, 0, 0.25}, {0.5, 0.0, 0.05});
    BodyDef d = solidBody(w, kind, 0.2, 1);
    d.pose.p = {5, 0, 0.25}, d.surface = {0.5, 0.0, 0.05};
    const BodyId other = addSolid(w, g, d);
    play(w, 3);
    w.placeBody(other, w.pose(one[0]), Vec3::Zero(), Vec3::Zero());
    Watch watch(w, {one[0], other});
    for (std::uint64_t n = 181; n <= 480; ++n) {
      const TimeSignature s = signatureAt(n, 60);
      w.advance(s.time - s.step, s.time);
      watch.look();
    }
    EXPECT_TRUE(watch.finite) << nameOf(kind);
    EXPECT_EQ(watch.limited, 0u) << nameOf(kind);
    EXPECT_LE(watch.fastest, 6) << nameOf(kind);
    EXPECT_GE(w.separation({true, one[0]}, {true, other}), -2e-3) << nameOf(kind);
  }
}

TEST(Coincident, ABodyInsideAColliderOfTheSameShapeComesOut) {
  for (const Solid kind : kSolids) {
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, 0.5);
    BodyDef d = solidBody(w, kind, 0.2, 1);
    d.pose.p = {0, 0, 0.3}, d.surface = {0.5, 0.2, 0.02};
    const ColliderId c = w.addCollider({d.shape, d.pose, d.surface});
    const BodyId b = addSolid(w, g, d);
    Watch watch(w, {b});
    play(w, 5, watch, 30);
    EXPECT_TRUE(watch.finite) << nameOf(kind);
    EXPECT_EQ(watch.limited, 0u) << nameOf(kind);
    EXPECT_LE(watch.fastest, 6) << nameOf(kind);
    EXPECT_GE(w.separation({true, b}, {false, c}), -2e-3) << nameOf(kind);
  }
}

}  // namespace
}  // namespace stadion
