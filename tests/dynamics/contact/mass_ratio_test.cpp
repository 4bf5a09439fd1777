/// Bodies of very different mass, up to a million to one.

#include "engine/maths/functions.h"
#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

TEST(MassRatio, ABallBetweenAWallAndAHeavyOneHitsAsOftenAsTheDigitsOfPiSay) {
  // Galperin, Playing Pool with Pi, 2003: with a ratio of 100^k, the impacts are the first k + 1 digits of
  // pi.
  for (const auto& [ratio, digits] : {std::pair(1e2, 31u), std::pair(1e4, 314u), std::pair(1e6, 3141u)}) {
    World w;
    w.addCollider({w.addShape(BoxShape{{}, {1, 9, 9}}), {{-1, 0, 0}, Quat::Identity()}, {0.0, 1.0, 0.0}});
    const BodyId light = addBall(w, 0, {.radius = 0.1, .p = {100, 0, 0}, .restitution = 1});
    const BodyId heavy =
        addBall(w, 0, {.radius = 0.1, .mass = ratio, .p = {200, 0, 0}, .v = {-1, 0, 0}, .restitution = 1});
    Watch watch(w, {light, heavy}, Vec3::Zero());
    std::uint64_t impacts = 0;
    play(w, 4000, 2, [&](double) {
      watch.look();
      impacts += w.counters().impacts;
    });
    EXPECT_EQ(impacts, digits) << ratio;
    EXPECT_EQ(watch.limited, 0u);
    EXPECT_NEAR(watch.last / watch.first, 1, 1e-10) << ratio;
    EXPECT_GT(w.state(heavy).v.x(), w.state(light).v.x()) << "nothing is left to hit";
  }
}

TEST(MassRatio, AnyPairOfSolidsInSpaceKeepsItsMomentumAndNeverGainsEnergy) {
  Chance chance(41);
  int met = 0;
  for (int i = 0; i < 72; ++i) {
    const Solid kinds[2] = {kSolids[static_cast<std::size_t>(i) % 6],
                            kSolids[static_cast<std::size_t>(i / 6) % 6]};
    const double ratio = chance.scale(1, 1e6), e = i % 3 * 0.5;
    World w;
    std::vector<BodyId> both;
    for (int k = 0; k < 2; ++k) {
      BodyDef d = solidBody(w, kinds[k], 0.2, k == 0 ? 1 : ratio);
      d.pose = {Vec3(k == 0 ? -1 : 0.5, 0, 0) + 0.05 * chance.vector(), chance.turn()};
      d.v = Vec3(k == 0 ? 5 : -1, 0, 0) + 0.2 * chance.vector(), d.omega = 5 * chance.vector();
      d.surface = {0.4, e, 0.0};
      both.push_back(w.addBody(d));
    }
    const Balance before = balanceOf(w, both, Vec3::Zero());
    Watch watch(w, both, Vec3::Zero());
    std::uint64_t impacts = 0, steps = 0;
    play(w, 1, 60, [&](double) {
      watch.look();
      impacts += w.counters().impacts, steps += w.counters().contactSteps;
    });
    met += impacts > 0;
    const Balance after = balanceOf(w, both, Vec3::Zero());
    const std::string what = std::string(nameOf(kinds[0])) + " of 1 kg, " + nameOf(kinds[1]) + " of " +
                             std::to_string(ratio) + " kg, case " + std::to_string(i);
    EXPECT_TRUE(watch.finite) << what;
    EXPECT_EQ(watch.limited, 0u) << what;
    // Relative to what the two bring along.
    const double size = ratio * 1.5 + 6;
    EXPECT_LE((after.momentum - before.momentum).norm(), 1e-13 * size) << what;
    EXPECT_LE((after.angular - before.angular).norm(), (steps > 0 ? 1e-6 : 1e-12) * size) << what;
    EXPECT_LE(watch.greatestGain, 1e-12 * watch.first) << what;
    EXPECT_GE(w.separation({true, both[0]}, {true, both[1]}), -1e-6) << what;
  }
  EXPECT_GE(met, 65);
}

TEST(MassRatio, ARowOfBallsOfAnyMassesPassesABlowOnInTheRightOrder) {
  Chance chance(42);
  int exact = 0;
  for (int i = 0; i < 40; ++i) {
    World w;
    std::vector<BodyId> row;
    std::vector<double> mass, v;
    const int count = 3 + i % 4;
    for (int k = 0; k < count; ++k) {
      mass.push_back(chance.scale(1e-3, 1e3)), v.push_back(k == 0 ? 2 : 0);
      row.push_back(addBall(
          w, 0, {.mass = mass.back(), .p = {0.3 * k, 0, 0}, .v = {v.back(), 0, 0}, .restitution = 1}));
    }
    Watch watch(w, row, Vec3::Zero());
    std::uint64_t tired = 0;
    play(w, 1.5, 60, [&](double) {
      watch.look();
      tired += w.counters().dampedBounces;
    });
    EXPECT_TRUE(watch.finite);
    EXPECT_LE(watch.greatestGain, 1e-10 * watch.first) << i;
    if (tired > 0)
      continue;  // several light ones between two heavy ones: hundreds of impacts in a millisecond
    ++exact;
    // The same on a line: the next pair to meet, one after the other.
    std::vector<double> x(v.size());
    for (std::size_t k = 0; k < x.size(); ++k) x[k] = 0.3 * static_cast<double>(k);
    for (double left = toSeconds(signatureAt(90, 60).time); left > 0;) {
      double first = left;
      std::size_t ball = x.size();
      for (std::size_t k = 0; k + 1 < x.size(); ++k) {
        const double gap = x[k + 1] - x[k] - 0.2, closing = v[k] - v[k + 1];
        if (closing > 0 && gap / closing < first) first = std::max(0.0, gap / closing), ball = k;
      }
      for (std::size_t k = 0; k < x.size(); ++k) x[k] += first * v[k];
      left -= first;
      if (ball == x.size()) break;
      const double a = mass[ball], b = mass[ball + 1], u = v[ball] - v[ball + 1];
      v[ball] -= 2 * b / (a + b) * u, v[ball + 1] += 2 * a / (a + b) * u;
    }
    for (std::size_t k = 0; k < x.size(); ++k) {
      EXPECT_NEAR(w.state(row[k]).p.x(), x[k], 1e-9 * (1 + std::fabs(x[k]))) << i << ' ' << k;
      EXPECT_NEAR(w.state(row[k]).v.x(), v[k], 1e-9 * (1 + std::fabs(v[k]))) << i << ' ' << k;
    }
    EXPECT_NEAR(watch.last / watch.first, 1, 1e-11) << i;
  }
  EXPECT_GE(exact, 35);
}

TEST(MassRatio, ATowerOfAnyMassesStandsWhereItWasBuilt) {
  // Boxes and upright cylinders, each on the middle of the one below; up to a million times heavier.
  Chance chance(43);
  for (int i = 0; i < 40; ++i) {
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, 0.5);
    std::vector<BodyId> tower;
    double z = 0;
    for (int k = 0; k < 2 + i % 5; ++k) {
      const double half = chance.between(0.05, 0.2), mass = chance.scale(1e-3, 1e3);
      BodyDef d;
      if ((i + k) % 3 == 0) {
        d.shape = w.addShape(CylinderShape{{}, 0.2, half}), d.mass = massOfRound(0.2, half, mass);
      } else {
        d.shape = w.addShape(BoxShape{{}, {0.2, 0.2, half}});
        d.mass = massOfBox({}, {0.2, 0.2, half}, 1).withMass(mass);
      }
      d.pose = {{0.02 * chance.signedUnit(), 0.02 * chance.signedUnit(), z + half},
                det::fromEuler(0, 0, 3 * chance.signedUnit())};
      d.surface = {0.5, 0.0, 0.0};
      tower.push_back(addSolid(w, g, d));
      z += 2 * half;
    }
    std::vector<Vec3> built;
    for (const BodyId b : tower) built.push_back(w.state(b).p);
    Watch watch(w, tower);
    play(w, 5, watch);
    EXPECT_TRUE(watch.finite) << i;
    EXPECT_EQ(watch.limited, 0u) << i;
    for (std::size_t k = 0; k < tower.size(); ++k)
      EXPECT_LE((w.state(tower[k]).p - built[k]).norm(), 1e-6) << "tower " << i << ", storey " << k;
  }
}

/// The light one is wedged between the heavy one's edge and the floor: steps of 2 ms leave overlaps of
/// millimetres, of centimetres at worst, but nothing bursts.
TEST(MassRatio, AHeavyBoxDroppedOnALightOneStaysAboveTheFloorAndGainsNoEnergy) {
  Chance chance(44);
  for (int i = 0; i < 8; ++i) {
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, 0.5, 0.3);
    const double ratio = chance.scale(10, 1e6);
    const BodyId low = addBox(w, g,
                              {.half = {0.3, 0.3, 0.1},
                               .pose = {{0, 0, 0.1}, Quat::Identity()},
                               .restitution = 0.3,
                               .friction = 0.5});
    const BodyId high = addBox(w, g,
                               {.half = {0.15, 0.15, 0.1},
                                .mass = ratio,
                                .pose = {Vec3(0, 0, 0.8) + 0.1 * chance.vector(), chance.turn()},
                                .restitution = 0.3,
                                .friction = 0.5});
    Watch watch(w, {low, high});
    double deepest = 0;
    play(w, 2, 60, [&](double) {
      watch.look();
      deepest = std::min(deepest, w.separation({true, low}, {true, high}));
      deepest = std::min(deepest, w.separation({true, low}, {false, 1}));
    });
    EXPECT_TRUE(watch.finite) << i;
    EXPECT_EQ(watch.limited, 0u) << i;
    EXPECT_LE(watch.greatestGain, 1e-6 * watch.first) << i << " ratio " << ratio;
    EXPECT_GE(deepest, -0.05) << i << " ratio " << ratio;
    EXPECT_LE(watch.fastest, 300) << i << " ratio " << ratio;
    EXPECT_GE(w.state(high).p.z(), 0.1 - 0.01) << i;
  }
}

}  // namespace
}  // namespace stadion
