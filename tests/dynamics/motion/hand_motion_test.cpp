#include "dynamics/motion/hand_motion.h"

#include "engine/maths/functions.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

constexpr Nanoseconds kMs = 1'000'000;

TEST(HandMotion, GivesTheVelocityOfAStraightEvenWayHoweverItIsCut) {
  for (const Nanoseconds step : {1 * kMs, 7 * kMs, 33 * kMs, 200 * kMs}) {
    HandMotion hand;
    const Vec3 v(1, -2, 3), w(0.5, 2, -1);
    const auto at = [&](Nanoseconds t) {
      return Pose{v * toSeconds(t), det::expRotation(w * toSeconds(t)) * det::expRotation({0.3, 0.2, 0.1})};
    };
    hand.put(0, at(0));
    for (Nanoseconds t = step; t <= 400 * kMs; t += step) hand.go(t, at(t));
    EXPECT_LE((hand.velocity().v - v).norm(), 1e-12) << step;
    EXPECT_LE((hand.velocity().omega - w).norm(), 1e-12) << step;
  }
}

TEST(HandMotion, IsTheLeastSquaresLineOfTheLast80Milliseconds) {
  // Still until 40 ms before the end, then 1 m/s: the line's slope is 12 / W^3 times the integral of
  // x y about the window's middle, which is 0.5 for a corner there.
  HandMotion hand;
  hand.put(0, {});
  hand.go(1000 * kMs, {});
  hand.go(1040 * kMs, {{0.04, 0, 0}, Quat::Identity()});
  EXPECT_NEAR(hand.velocity().v.x(), 0.5, 1e-12);
  EXPECT_LE(hand.way().size(), 3u);
  hand.go(1080 * kMs, {{0.08, 0, 0}, Quat::Identity()});
  EXPECT_NEAR(hand.velocity().v.x(), 1, 1e-12);
  EXPECT_EQ(hand.way().size(), 3u) << "older ways are forgotten";
}

TEST(HandMotion, OfAFastSpinIsThatSpinHoweverItIsCut) {
  for (const Vec3& w : {Vec3(0, 0, 50), Vec3(-80, 20, 0), Vec3(0, 150, 30)})
    for (const Nanoseconds step : {1 * kMs, 5 * kMs, 16 * kMs}) {
      HandMotion hand;
      const auto at = [&](Nanoseconds t) { return Pose{{}, det::expRotation(w * toSeconds(t))}; };
      hand.put(0, at(0));
      for (Nanoseconds t = step; t <= 200 * kMs; t += step) hand.go(t, at(t));
      EXPECT_LE((hand.velocity().omega - w).norm(), 1e-9) << w.transpose() << " every " << step;
    }
}

TEST(HandMotion, OfATumblingHandDoesNotDependOnKnotsBetweenItsOwn) {
  const auto at = [](int i) {
    return Pose{{0.07 * i, 0, 0}, det::fromEuler(0.7 * i, 0.44 * i, 0.1 * i * i)};
  };
  HandMotion whole, cut;
  whole.put(0, at(0)), cut.put(0, at(0));
  for (int i = 1; i <= 20; ++i) {
    for (const double part : {0.2, 0.55})
      cut.go((i - 1) * 5 * kMs + fromSeconds(0.005 * part),
             {(at(i - 1).p + part * (at(i).p - at(i - 1).p)), det::interpolate(at(i - 1), at(i), part).q});
    whole.go(i * 5 * kMs, at(i)), cut.go(i * 5 * kMs, at(i));
  }
  EXPECT_GT(whole.velocity().omega.norm(), 100);
  EXPECT_LE((whole.velocity().omega - cut.velocity().omega).norm(), 1e-6);
}

TEST(HandMotion, OfAHandThatHasJustBeenPutSomewhereIsNothing) {
  HandMotion hand;
  hand.put(5, {{1, 2, 3}, Quat::Identity()});
  EXPECT_EQ(hand.velocity().v, Vec3::Zero());
  hand.go(10 * kMs, {{2, 2, 3}, Quat::Identity()});
  hand.put(10 * kMs, {{9, 2, 3}, Quat::Identity()});
  EXPECT_EQ(hand.velocity().v, Vec3::Zero()) << "a jump is no motion";
}

}  // namespace
}  // namespace stadion
