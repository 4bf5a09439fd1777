/// Few bodies in contact, wedged or landing, never have more energy than at the start.

#include "tests/dynamics/world/watch.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace scenes;

TEST(IslandEnergy, AHeavyBoxThatFallsBetweenLightOnesBringsNone) {
  double most = 0;
  for (int n = 0; n < 12; ++n) {
    Chance chance(900 + static_cast<unsigned>(n));
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, 0.5, 0.2);
    std::vector<BodyId> all;
    for (const double side : {-1., 1.})
      all.push_back(addBox(w, g,
                           {.half = Vec3::Constant(0.2),
                            .mass = chance.scale(0.01, 0.3),
                            .pose = {{0.24 * side, 0.05 * chance.signedUnit(), 0.2}, Quat::Identity()},
                            .restitution = 0.3,
                            .friction = 0.6}));
    all.push_back(addBox(w, g,
                         {.half = Vec3(0.2, 0.3, 0.2),
                          .mass = chance.scale(3, 100),
                          .pose = {{0.03 * chance.signedUnit(), 0, 1}, chance.turn()},
                          .omega = chance.vector(),
                          .restitution = 0.3,
                          .friction = 0.6}));
    Watch watch(w, all);
    play(w, 3, watch);
    most = std::max(most, watch.greatestGain / watch.first);
    EXPECT_TRUE(watch.finite && watch.limited == 0) << n;
    EXPECT_LE(watch.greatestGain, 1e-3 * watch.first) << n;
  }
  std::printf("  most: %.1e\n", most);
}

TEST(IslandEnergy, ARoundSolidThatLandsBringsNone) {
  double most = 0;
  for (int n = 0; n < 40; ++n) {
    Chance chance(300 + static_cast<unsigned>(n));
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, 0.5, 0);
    BodyDef d = solidBody(w, n % 2 ? Solid::Capsule : Solid::Cylinder, 0.2, 1);
    d.pose = {{0, 0, 0.5}, chance.turn()}, d.omega = 3 * chance.vector();
    d.surface = {0.5, 0.0, 0.0};
    const BodyId b = addSolid(w, g, d);
    Watch watch(w, {b});
    play(w, 4, watch);
    // A capsule that meets the floor within a step has less in its middle than at its end.
    const double rise = n % 2 ? watch.greatestGain : watch.greatestRise;
    most = std::max(most, rise / watch.first);
    EXPECT_LE(rise, 1e-4 * watch.first) << n;
  }
  std::printf("  most: %.1e\n", most);
}

TEST(IslandEnergy, ADiscThatWobblesOnItsRimLiesDown) {
  // The rim sinks in a little in each step: what pushes it out again once made it climb, and spin for ever.
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    Chance chance(seed);
    World w;
    const FieldId g = addGravity(w);
    addFloor(w, 0.5, 0.2);
    BodyDef d = solidBody(w, Solid::Cylinder, 0.2, 1);
    d.pose = {{0, 0, 0.3}, Quat(Eigen::AngleAxisd(0.6, Vec3::UnitX()))}, d.omega = 6 * chance.direction();
    d.surface = {0.5, 0.2, 0.0};
    const BodyId b = addSolid(w, g, d);
    Watch watch(w, {b});
    double high = 0, risen = 0;
    play(w, 8, 60, [&](double t) {
      watch.look();
      high = t < 1 ? watch.last : std::min(high, watch.last);
      risen = std::max(risen, watch.last - high);
    });
    EXPECT_LE(risen, 1e-3 * watch.first) << seed;
  }
}

}  // namespace
}  // namespace stadion
