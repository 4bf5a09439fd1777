#include "engine/figure/root_motion.h"
#include "tests/engine/figure/figures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stadion::test {
namespace {

constexpr Nanoseconds kWalkSecond = 1'000'000'000;

/// Clips of the bone 1, which is 1 m above the root of the chain:
/// 0 "walk": 1.5 m along y in 1 s, with a bob and a sway. 1 "stand". 2 "turn": a quarter turn to the left, 0.5 m to
/// the side, in 0.8 s. 3 "run": 4 m along y in 0.5 s.
Skeleton striderSkeleton() {
  const auto q = [](double angle) { return static_cast<float>(std::sin(angle / 2)); };
  const auto w = [](double angle) { return static_cast<float>(std::cos(angle / 2)); };
  const Interpolation linear = Interpolation::Linear;
  const ChannelTarget place = ChannelTarget::Translation, turn = ChannelTarget::Rotation;
  Skeleton s = chain(3);
  s.clips.push_back(
      {"walk", 1, {channel(1, place, linear, {0, 0.5f, 1}, {0, 0, 1, 0.1f, 0.9f, 1.2f, 0, 1.5f, 1})}});
  s.clips.push_back({"stand", 1, {channel(1, place, linear, {0}, {0, 0, 1})}});
  s.clips.push_back({"turn",
                     0.8f,
                     {channel(1, turn, linear, {0, 0.8f}, {0, 0, 0, 1, 0, 0, q(M_PI_2), w(M_PI_2)}),
                      channel(1, place, linear, {0, 0.8f}, {0, 0, 1, 0.5f, 0, 1})}});
  s.clips.push_back({"run", 0.5f, {channel(1, place, linear, {0, 0.5f}, {0, 3, 1, 0, 7, 1})}});
  return s;
}

struct Walk {
  Skeleton skeleton = striderSkeleton();
  RootPath path{skeleton, 1};
  ClipPlayer player;
  RootMotion root;

  void play(std::uint32_t clip, Nanoseconds when, Nanoseconds fade = 0, bool loop = true, double speed = 1) {
    ClipPlayer::Start s;
    s.clip = clip;
    s.length = skeleton.clips[clip].length;
    s.fade = fade, s.loop = loop, s.speed = speed;
    root.settle(when, player, path, Vec3::Ones());
    player.play(s, when);
  }
  Pose at(Nanoseconds time) const { return root.at(time, player, path, Vec3::Ones()); }
  Vec3 p(double seconds) const { return at(static_cast<Nanoseconds>(seconds * 1e9)).p; }
  /// What a node does at the end of a frame.
  void endFrame(Nanoseconds now) {
    root.forget(now, player, path, Vec3::Ones());
    player.forget(now);
  }
};

TEST(RootMotion, ItGoesOnFromPassToPass) {
  Walk w;
  w.play(0, 0);
  EXPECT_LT((w.p(0.25) - Vec3(0.05, 0.45, 0)).norm(), 1e-6);
  EXPECT_LT((w.p(0.999999999) - Vec3(0, 1.5, 0)).norm(), 1e-6);
  EXPECT_LT((w.p(1) - Vec3(0, 1.5, 0)).norm(), 1e-6);
  EXPECT_LT((w.p(2.5) - Vec3(0.1, 3.9, 0)).norm(), 1e-6);
  // Without drift: after 10 000 passes it is where 10 000 times the way of a pass ends.
  EXPECT_NEAR(w.p(10000).y(), 15000, 1e-7);
}

TEST(RootMotion, ATurningClipWalksInACircle) {
  Walk w;
  w.play(2, 0);
  const double pass = double{0.8f};
  const Pose quarter = w.at(std::llround(pass * 1e9));
  EXPECT_LT((quarter.p - Vec3(0.5, 0, 0)).norm(), 1e-6);
  EXPECT_NEAR(Eigen::AngleAxisd(quarter.q).angle(), M_PI_2, 1e-6);
  const Pose round = w.at(std::llround(4 * pass * 1e9));
  EXPECT_LT(round.p.norm(), 1e-6);
  EXPECT_NEAR(std::fabs(round.q.w()), 1, 1e-9);
  EXPECT_LT((w.at(std::llround(4001 * pass * 1e9)).p - quarter.p).norm(), 1e-3);
}

TEST(RootMotion, BackwardsItReturns) {
  Walk w;
  w.play(0, 0, 0, true, -2);
  EXPECT_LT((w.p(1) - Vec3(0, -3, 0)).norm(), 1e-6);
  w.play(0, 2 * kWalkSecond);
  EXPECT_LT((w.p(6) - Vec3(0, 0, 0)).norm(), 1e-6);
}

TEST(RootMotion, AClipThatHasEndedAndAPauseMoveNothing) {
  Walk w;
  w.play(0, 0, 0, false);
  EXPECT_LT((w.p(7) - Vec3(0, 1.5, 0)).norm(), 1e-6);
  w.play(0, 10 * kWalkSecond);
  w.root.settle(10 * kWalkSecond + kWalkSecond / 2, w.player, w.path, Vec3::Ones());
  w.player.pause(10 * kWalkSecond + kWalkSecond / 2);
  EXPECT_LT((w.p(20) - Vec3(0.1, 2.4, 0)).norm(), 1e-6);
  w.root.settle(20 * kWalkSecond, w.player, w.path, Vec3::Ones());
  w.player.resume(20 * kWalkSecond);
  EXPECT_LT((w.p(20.5) - Vec3(0, 3, 0)).norm(), 1e-6);
}

/// Speeds are blended, not places: a runner that stops does not slide back.
TEST(RootMotion, AFadeToAStandSlowsDownEvenly) {
  Walk w;
  w.play(3, 0);
  w.play(1, kWalkSecond, kWalkSecond / 2);
  double before = w.p(1).y();
  EXPECT_NEAR(before, 8, 1e-6);
  for (int ms = 1010; ms <= 1600; ms += 10) {
    const double y = w.p(ms / 1000.0).y();
    EXPECT_GE(y, before - 1e-12) << ms;
    before = y;
  }
  // 8 m/s that fall to 0 within half a second.
  EXPECT_NEAR(before, 8 + 8 * 0.5 / 2, 1e-6);
  EXPECT_NEAR(w.p(1.25).y(), 8 + 8 * (0.25 - 0.25 * 0.25), 1e-6);
}

/// Some frames at a rate, with commands at exact times and forgetting at the ends of frames.
Pose walkedAt(double rate, Nanoseconds end) {
  Walk w;
  w.root.begin({Vec3(1, 2, 3), Quat(Eigen::AngleAxisd(0.3, Vec3::UnitZ()))}, 0);
  struct Command {
    Nanoseconds when;
    std::uint32_t clip;
    Nanoseconds fade;
    double speed;
  };
  const Command commands[] = {{0, 0, 0, 1},
                              {1'234'567'891, 2, 700'000'000, 1.3},
                              {1'500'000'001, 3, 905'000'007, 0.9},
                              {1'700'000'003, 0, 200'000'000, -0.4},
                              {3'300'000'000, 3, 50'000'000, 1},
                              {3'310'000'000, 2, 3'000'000, 1},
                              {5'000'000'000, 0, 400'000'000, 1}};
  std::size_t next = 0;
  for (int frame = 0;; ++frame) {
    const auto now = static_cast<Nanoseconds>(std::llround(frame * 1e9 / rate));
    for (; next < std::size(commands) && commands[next].when <= now; ++next)
      w.play(commands[next].clip, commands[next].when, commands[next].fade, true, commands[next].speed);
    (void)w.at(now);
    w.endFrame(now);
    if (now >= end) return w.at(now);
  }
}

TEST(RootMotion, ThePlaceAtAShowTimeIsTheSameToTheBitAtEveryRate) {
  for (const int seconds : {1, 2, 3, 4, 5, 6, 30}) {
    const Pose slow = walkedAt(30, seconds * kWalkSecond);
    for (const double rate : {60.0, 90.0, 7.0, 1000.0}) {
      const Pose fast = walkedAt(rate, seconds * kWalkSecond);
      EXPECT_EQ(slow.p, fast.p) << rate << " Hz, " << seconds << " s";
      EXPECT_EQ(slow.q.coeffs(), fast.q.coeffs()) << rate;
    }
  }
}

/// The steps of a cross-fade that are kept from frame to frame are those that a restored figure makes again.
TEST(RootMotion, ItDoesNotDependOnWhatWasAskedBefore) {
  Walk w;
  w.play(0, 0);
  w.play(2, kWalkSecond, 2 * kWalkSecond);
  const Walk fresh = w;
  for (Nanoseconds t = kWalkSecond; t < 2 * kWalkSecond; t += 1'234'567) (void)w.at(t);
  EXPECT_EQ(w.at(2'222'222'222).p, fresh.at(2'222'222'222).p);
  EXPECT_EQ(w.at(1'111'111'111).p, Walk(fresh).at(1'111'111'111).p);
}

TEST(RootMotion, TheScaleOfTheNodeScalesTheWay) {
  Walk w;
  w.play(0, 0);
  const Pose X = w.root.at(kWalkSecond, w.player, w.path, Vec3(1, 2, 1));
  EXPECT_LT((X.p - Vec3(0, 3, 0)).norm(), 1e-6);
}

}  // namespace
}  // namespace stadion::test
