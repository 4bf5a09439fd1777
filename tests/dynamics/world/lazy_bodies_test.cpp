/// Many bodies far from each other: what they cost, and that nothing is missed for it.

#include "dynamics/world/world.h"
#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

/// Spinning boxes in air, `apart` metres from each other, thrown up.
struct FarApartBodies {
  World w;
  std::vector<BodyId> all;

  FarApartBodies(int many, double apart) {
    const FieldId g = addGravity(w);
    ForceField air;
    air.law = MediumField{1.0, 0.0, Vec3::Zero()};
    const FieldId medium = w.addField(air, true);
    const Vec3 half(0.15, 0.1, 0.025);
    const ShapeId box = w.addShape(BoxShape{{}, half});
    Chance chance(5);
    for (int i = 0; i < many; ++i) {
      BodyDef d;
      d.shape = box;
      d.mass = massOfBox({}, half, 1).withMass(1);
      d.pose.p = {apart * (i % 20), apart * (i / 20), 300};
      d.v = Vec3(0, 0, 10) + 0.5 * chance.vector(), d.omega = 3 * chance.vector();
      d.dragArea = 0.0264;
      all.push_back(addSolid(w, g, d));
      w.hook(all.back(), medium, 0);
    }
  }
  /// On to so many milliseconds, in frames of `step` milliseconds.
  void playTo(int milliseconds, int step) {
    for (; at < milliseconds; at += step) {
      w.advance(at * 1'000'000LL, (at + step) * 1'000'000LL);
      pairs += w.counters().pairTests, impacts += w.counters().impacts;
    }
  }
  int at = 0;
  std::uint64_t pairs = 0, impacts = 0;
};

void expectSame(const BodyState& a, const BodyState& b) {
  EXPECT_EQ(a.p, b.p);
  EXPECT_EQ(a.v, b.v);
  EXPECT_EQ(a.q.coeffs(), b.q.coeffs());
  EXPECT_EQ(a.L, b.L);
  EXPECT_EQ(a.clock, b.clock);
  EXPECT_EQ(a.arcs, b.arcs);
}

TEST(LazyBodies, WhereNoBodiesMeetNoPairIsLookedAt) {
  FarApartBodies swarm(400, 4);
  swarm.playTo(2000, 10);
  EXPECT_EQ(swarm.pairs, 0);
  for (const BodyId id : swarm.all) EXPECT_GT(swarm.w.state(id).arcs, 5);
}

TEST(LazyBodies, ArcsWithoutAnObserverAreTheSameToTheBitAtEveryFrameRate) {
  FarApartBodies first(80, 4);
  first.playTo(2000, 500);
  for (const int step : {1, 8, 20, 100}) {
    FarApartBodies other(80, 4);
    other.playTo(2000, step);
    for (const BodyId id : first.all) expectSame(first.w.state(id), other.w.state(id));
  }
}

TEST(LazyBodies, ABodyPutIntoAnothersWayIsMet) {
  std::vector<BodyState> first;
  for (const int step : {250, 5, 10, 50}) {
    FarApartBodies swarm(80, 4);
    swarm.playTo(500, step);
    const BodyState s = swarm.w.state(swarm.all[7]);
    swarm.w.placeBody(swarm.all[0], {s.p + 0.3 * s.v, Quat::Identity()}, Vec3::Zero(), Vec3::Zero());
    swarm.playTo(1000, step);
    EXPECT_GT(swarm.impacts, 0);
    std::vector<BodyState> states;
    for (const BodyId id : {swarm.all[0], swarm.all[7], swarm.all[40]}) states.push_back(swarm.w.state(id));
    if (first.empty()) first = states;
    for (std::size_t i = 0; i < states.size(); ++i) expectSame(first[i], states[i]);
  }
}

TEST(LazyBodies, BodiesThatCrossMeet) {
  for (const double apart : {0.5, 0.7}) {
    FarApartBodies coarse(100, apart), fine(100, apart);
    coarse.playTo(1000, 100);
    fine.playTo(1000, 5);
    EXPECT_GT(coarse.impacts, 0);
    EXPECT_EQ(coarse.impacts, fine.impacts);
    for (const BodyId id : coarse.all) expectSame(coarse.w.state(id), fine.w.state(id));
  }
}

}  // namespace
}  // namespace stadion
