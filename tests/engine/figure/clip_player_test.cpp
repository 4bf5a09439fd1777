#include "engine/figure/clip_player.h"

#include <gtest/gtest.h>

namespace stadion::test {
namespace {

constexpr Nanoseconds operator""_s(long double v) {
  return static_cast<Nanoseconds>(v * 1e9L + 0.5L);
}

ClipPlayer::Start clip(std::uint32_t number, double length) {
  ClipPlayer::Start s;
  s.clip = number;
  s.length = length;
  return s;
}

TEST(ClipPlayer, AClipRepeatsAndTellsEachPassAtItsExactTime) {
  ClipPlayer player;
  player.play(clip(3, 0.75), 1.0_s);
  EXPECT_EQ(player.at(1.0_s).layers[0].clip, 3u);
  EXPECT_DOUBLE_EQ(player.at(1.25_s).layers[0].time, 0.25);
  EXPECT_NEAR(player.at(2.0_s).layers[0].time, 0.25, 1e-12);
  EXPECT_FALSE(player.takeEnd(1.7_s));
  std::vector<Nanoseconds> ends;
  while (const auto end = player.takeEnd(3.3_s)) {
    EXPECT_TRUE(end->loops);
    ends.push_back(end->when);
  }
  EXPECT_EQ(ends, (std::vector<Nanoseconds>{1.75_s, 2.5_s, 3.25_s}));
}

TEST(ClipPlayer, AClipThatDoesNotRepeatStaysInItsLastPose) {
  ClipPlayer player;
  ClipPlayer::Start s = clip(0, 2);
  s.loop = false;
  s.speed = 0.5;
  player.play(s, 0);
  EXPECT_TRUE(player.moves(1.0_s));
  const auto end = player.takeEnd(10.0_s);
  ASSERT_TRUE(end);
  EXPECT_EQ(end->when, 4.0_s);
  EXPECT_FALSE(end->loops);
  EXPECT_FALSE(player.takeEnd(100.0_s));
  EXPECT_EQ(player.at(50.0_s).layers[0].time, 2);
  EXPECT_FALSE(player.moves(50.0_s));
}

TEST(ClipPlayer, BackwardsItBeginsAtTheEnd) {
  ClipPlayer player;
  ClipPlayer::Start s = clip(0, 2);
  s.speed = -1;
  player.play(s, 0);
  EXPECT_DOUBLE_EQ(player.at(0).layers[0].time, 2);
  EXPECT_DOUBLE_EQ(player.at(0.5_s).layers[0].time, 1.5);
  EXPECT_DOUBLE_EQ(player.at(2.0_s).layers[0].time, 2);
  EXPECT_EQ(player.takeEnd(5.0_s)->when, 2.0_s);
  EXPECT_EQ(player.takeEnd(5.0_s)->when, 4.0_s);
}

TEST(ClipPlayer, APhaseShortensTheFirstPass) {
  ClipPlayer player;
  ClipPlayer::Start s = clip(0, 2);
  s.at = 1.5;
  player.play(s, 0);
  EXPECT_EQ(player.takeEnd(5.0_s)->when, 0.5_s);
  EXPECT_EQ(player.takeEnd(5.0_s)->when, 2.5_s);
}

TEST(ClipPlayer, AFadeBlendsOverWhatWasPlayed) {
  ClipPlayer player;
  player.play(clip(0, 1), 0);
  ClipPlayer::Start s = clip(1, 1);
  s.fade = 0.4_s;
  player.play(s, 2.0_s);
  const FigureRecord half = player.at(2.2_s);
  ASSERT_EQ(half.layerCount, 2u);
  EXPECT_EQ(half.layers[0].clip, 0u);
  EXPECT_EQ(half.layers[0].weight, 1);
  EXPECT_EQ(half.layers[1].clip, 1u);
  EXPECT_FLOAT_EQ(half.layers[1].weight, 0.5f);
  EXPECT_EQ(player.at(2.4_s).layerCount, 1u);
  player.forget(3.0_s);
  EXPECT_EQ(player.at(2.2_s).layerCount, 1u);
}

TEST(ClipPlayer, APauseMovesAllThatComesAfterIt) {
  ClipPlayer player;
  player.play(clip(0, 1), 0);
  player.pause(0.3_s);
  EXPECT_DOUBLE_EQ(player.at(5.0_s).layers[0].time, 0.3);
  EXPECT_FALSE(player.moves(5.0_s));
  EXPECT_FALSE(player.takeEnd(5.0_s));
  player.resume(10.3_s);
  EXPECT_DOUBLE_EQ(player.at(10.8_s).layers[0].time, 0.8);
  EXPECT_EQ(player.takeEnd(20.0_s)->when, 11.0_s);
}

/// For equal commands at equal times the pose depends on show time alone, so the frame rate cannot matter.
TEST(ClipPlayer, TheTimeOfAClipDoesNotDependOnTheFramesBefore) {
  const auto timeAt = [](double rate) {
    ClipPlayer player;
    player.play(clip(0, 0.7), 0.1_s);
    for (int frame = 0; static_cast<Nanoseconds>(frame * 1e9 / rate) < 7.0_s; ++frame) {
      const auto now = static_cast<Nanoseconds>(frame * 1e9 / rate);
      while (player.takeEnd(now)) {
      }
      player.forget(now);
    }
    return player.at(7.0_s).layers[0].time;
  };
  EXPECT_EQ(timeAt(30), timeAt(60));
  EXPECT_EQ(timeAt(30), timeAt(90));
}

TEST(ClipPlayer, AtMostFourClipsFadeAtATime) {
  ClipPlayer player;
  for (std::uint32_t i = 0; i < 7; ++i) {
    ClipPlayer::Start s = clip(i, 1);
    s.fade = i == 0 ? 0 : 10.0_s;
    player.play(s, static_cast<Nanoseconds>(i) * 1'000'000);
  }
  const FigureRecord r = player.at(0.1_s);
  ASSERT_EQ(r.layerCount, FigureRecord::kMostLayers);
  EXPECT_EQ(r.layers[0].clip, 0u) << "the others are blended over it";
  EXPECT_EQ(r.layers[3].clip, 6u);
}

TEST(ClipPlayer, PassesThatWouldBeTooShortDoNotRepeat) {
  for (const double speed : {1000.0, -1000.0}) {
    ClipPlayer player;
    ClipPlayer::Start s = clip(0, 0.25);
    s.speed = speed;
    player.play(s, 0);
    const auto end = player.takeEnd(1.0_s);
    ASSERT_TRUE(end);
    EXPECT_FALSE(end->loops);
    EXPECT_FALSE(player.takeEnd(100.0_s));
  }
}

TEST(ClipPlayer, ShortClipsDoNotRepeat) {
  ClipPlayer player;
  player.play(clip(0, 0), 0);
  EXPECT_EQ(player.takeEnd(1.0_s)->when, 0);
  EXPECT_FALSE(player.takeEnd(1.0_s));
  EXPECT_EQ(player.at(1.0_s).layers[0].time, 0);
}

}  // namespace
}  // namespace stadion::test
