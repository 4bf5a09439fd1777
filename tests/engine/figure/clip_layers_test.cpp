#include "engine/figure/clip_player.h"

#include <gtest/gtest.h>

#include <string>

namespace stadion::test {
namespace {

constexpr Nanoseconds operator""_ms(unsigned long long v) {
  return static_cast<Nanoseconds>(v) * 1'000'000;
}

ClipPlayer::Start layerStart(std::uint32_t clip, double length, Nanoseconds fade = 0, double weight = 1) {
  ClipPlayer::Start s;
  s.clip = clip;
  s.length = length;
  s.fade = fade;
  s.weight = weight;
  return s;
}

TEST(ClipLayers, ALayerFadesInToItsWeightAndOutAgain) {
  ClipPlayer player;
  player.play(layerStart(0, 1), 0);
  player.addLayer(layerStart(1, 1, 400_ms, 0.5), 1000_ms);
  const FigureRecord half = player.at(1200_ms);
  ASSERT_EQ(half.addedCount, 1u);
  EXPECT_EQ(half.layerCount, 1u);
  EXPECT_EQ(half.added[0].clip, 1u);
  EXPECT_FLOAT_EQ(half.added[0].weight, 0.25f);
  EXPECT_NEAR(half.added[0].time, 0.2, 1e-12);
  EXPECT_FLOAT_EQ(player.at(1500_ms).added[0].weight, 0.5f);
  player.removeLayers(1u, 200_ms, 2000_ms);
  EXPECT_FLOAT_EQ(player.at(2100_ms).added[0].weight, 0.25f);
  EXPECT_EQ(player.at(2200_ms).addedCount, 0u);
  player.forget(2200_ms);
  EXPECT_EQ(player.at(2100_ms).addedCount, 0u);
}

TEST(ClipLayers, TheyStayWhateverIsPlayedBelowAndGoWithStop) {
  ClipPlayer player;
  player.addLayer(layerStart(1, 1), 0);
  player.play(layerStart(0, 1), 100_ms);
  player.play(layerStart(2, 1), 200_ms);
  EXPECT_EQ(player.at(300_ms).addedCount, 1u);
  player.stop();
  EXPECT_EQ(player.at(300_ms).addedCount, 0u);
  EXPECT_FALSE(player.moves(300_ms));
}

TEST(ClipLayers, TheSameClipAgainReplacesItsLayer) {
  ClipPlayer player;
  player.addLayer(layerStart(1, 1), 0);
  player.addLayer(layerStart(1, 1, 400_ms), 500_ms);
  const FigureRecord both = player.at(600_ms);
  ASSERT_EQ(both.addedCount, 2u);
  EXPECT_FLOAT_EQ(both.added[0].weight, 0.75f);
  EXPECT_FLOAT_EQ(both.added[1].weight, 0.25f);
  EXPECT_EQ(player.at(900_ms).addedCount, 1u);
}

TEST(ClipLayers, TheOldestOfTooManyGivesWay) {
  ClipPlayer player;
  for (std::uint32_t clip = 0; clip < 6; ++clip) player.addLayer(layerStart(clip, 1), clip * 10_ms);
  const FigureRecord r = player.at(100_ms);
  ASSERT_EQ(r.addedCount, FigureRecord::kMostAdded);
  EXPECT_EQ(r.added[0].clip, 2u);
  EXPECT_EQ(r.added[3].clip, 5u);
}

TEST(ClipLayers, APauseStopsThemAndWhatIsAddedWithinItWaits) {
  ClipPlayer player;
  player.addLayer(layerStart(1, 1), 0);
  player.pause(300_ms);
  EXPECT_NEAR(player.at(900_ms).added[0].time, 0.3, 1e-12);
  player.addLayer(layerStart(2, 1, 100_ms), 900_ms);
  player.removeLayers(1u, 100_ms, 900_ms);
  EXPECT_FLOAT_EQ(player.at(1000_ms).added[0].weight, 1);
  EXPECT_FLOAT_EQ(player.at(1000_ms).added[1].weight, 0);
  EXPECT_FALSE(player.moves(1000_ms));
  player.resume(2000_ms);
  EXPECT_TRUE(player.moves(2000_ms));
  EXPECT_FLOAT_EQ(player.at(2050_ms).added[0].weight, 0.5f);
  EXPECT_NEAR(player.at(2050_ms).added[0].time, 0.35, 1e-12);
  EXPECT_FLOAT_EQ(player.at(2050_ms).added[1].weight, 0.5f);
  EXPECT_NEAR(player.at(2050_ms).added[1].time, 0.05, 1e-12);
}

TEST(ClipLayers, AFigureWithALayerMovesUntilItHasEnded) {
  ClipPlayer player;
  ClipPlayer::Start once = layerStart(1, 0.5);
  once.loop = false;
  player.addLayer(once, 0);
  EXPECT_TRUE(player.moves(400_ms));
  EXPECT_FALSE(player.moves(500_ms));
  EXPECT_EQ(player.at(700_ms).added[0].time, 0.5);
  EXPECT_FALSE(player.takeEnd(1000_ms));
}

/// "7@120 ...": which marker, and when [ms]; "end@750": an end.
std::string happenings(ClipPlayer& player, const ClipMarkers& markers, Nanoseconds until) {
  std::string all;
  while (true) {
    if (const auto passed = player.takeMarker(markers, until))
      all += std::to_string(passed->marker) + "@" + std::to_string(passed->when / 1'000'000) + " ";
    else if (const auto end = player.takeEnd(until))
      all += "end@" + std::to_string(end->when / 1'000'000) + " ";
    else
      return all;
  }
}

TEST(ClipMarkers, EachPassPassesThemAgainInOrder) {
  const ClipMarkers markers({{0, 0.75}, {0, 0.25}, {1, 0.1}, {0, 0.25}, {0, 0}, {0, 0.5}});
  ClipPlayer player;
  player.play(layerStart(0, 0.75), 1000_ms);
  EXPECT_EQ(happenings(player, markers, 1600_ms), "4@1000 1@1250 3@1250 5@1500 ");
  EXPECT_EQ(happenings(player, markers, 2300_ms), "0@1750 end@1750 4@1750 1@2000 3@2000 5@2250 ");
  EXPECT_EQ(happenings(player, markers, 2300_ms), "");
}

TEST(ClipMarkers, BackwardsTheLastComesFirst) {
  const ClipMarkers markers({{0, 0}, {0, 0.2}, {0, 0.4}, {0, 0.4}, {0, 1}});
  ClipPlayer player;
  ClipPlayer::Start s = layerStart(0, 1);
  s.speed = -2;
  player.play(s, 0);
  EXPECT_EQ(happenings(player, markers, 999_ms),
            "4@0 2@300 3@300 1@400 0@500 end@500 4@500 2@800 3@800 1@900 ");
}

TEST(ClipMarkers, APhaseLeavesOutThoseBeforeIt) {
  const ClipMarkers markers({{0, 0.2}, {0, 0.8}});
  ClipPlayer player;
  ClipPlayer::Start s = layerStart(0, 1);
  s.at = 0.5;
  player.play(s, 0);
  EXPECT_EQ(happenings(player, markers, 1000_ms), "1@300 end@500 0@700 ");
}

TEST(ClipMarkers, OnceMeansOnce) {
  const ClipMarkers markers({{0, 0}, {0, 1}, {0, 0.5}});
  ClipPlayer player;
  ClipPlayer::Start s = layerStart(0, 1);
  s.loop = false;
  player.play(s, 0);
  EXPECT_EQ(happenings(player, markers, 9000_ms), "0@0 2@500 1@1000 end@1000 ");
}

TEST(ClipMarkers, APauseDelaysThemAndRepeatsNone) {
  const ClipMarkers markers({{0, 0.3}, {0, 0.6}});
  ClipPlayer player;
  player.play(layerStart(0, 1), 0);
  EXPECT_EQ(happenings(player, markers, 300_ms), "0@300 ");
  player.pause(300_ms);
  EXPECT_EQ(happenings(player, markers, 900_ms), "");
  player.resume(1300_ms);
  EXPECT_EQ(happenings(player, markers, 1700_ms), "1@1600 ");
}

/// From the beginning of a cross-fade on, the new clip posts.
TEST(ClipMarkers, AReplacedClipAndAStillPosePostNone) {
  const ClipMarkers markers({{0, 0.5}, {1, 0.2}, {2, 0.3}});
  ClipPlayer player;
  player.play(layerStart(0, 1), 0);
  player.play(layerStart(1, 1, 800_ms), 400_ms);
  EXPECT_EQ(happenings(player, markers, 1200_ms), "1@600 ");
  ClipPlayer::Start still = layerStart(2, 1);
  still.speed = 0, still.at = 0.3, still.loop = false;
  player.play(still, 1200_ms);
  EXPECT_EQ(happenings(player, markers, 3000_ms), "");
}

TEST(ClipMarkers, ALayerPostsItsOwnUntilItFadesOut) {
  const ClipMarkers markers({{0, 0.5}, {1, 0.25}, {1, 0.5}});
  ClipPlayer player;
  player.play(layerStart(0, 1), 0);
  player.addLayer(layerStart(1, 0.6), 0);
  EXPECT_EQ(happenings(player, markers, 1000_ms), "1@250 0@500 2@500 1@850 end@1000 ");
  player.removeLayers({}, 500_ms, 1000_ms);
  EXPECT_EQ(happenings(player, markers, 1600_ms), "0@1500 ");
}

/// The time of the n-th pass is computed, not added up.
TEST(ClipMarkers, TheyComeAtTheSameTimesHoweverOftenOneAsks) {
  const ClipMarkers markers({{0, 0.1}, {0, 0.7}, {0, 0}});
  const auto times = [&](Nanoseconds step) {
    ClipPlayer player;
    ClipPlayer::Start s = layerStart(0, 0.7);
    s.speed = 1.3, s.at = 0.31;
    player.play(s, 123'456'789);
    std::vector<Nanoseconds> all;
    for (Nanoseconds now = 0; now <= 60'000_ms; now += step) {
      while (true) {
        if (const auto passed = player.takeMarker(markers, now))
          all.push_back(passed->when);
        else if (!player.takeEnd(now))
          break;
      }
    }
    return all;
  };
  const std::vector<Nanoseconds> fine = times(1'000'000);
  EXPECT_GT(fine.size(), 300u);
  EXPECT_EQ(fine, times(100'000'000));
  EXPECT_TRUE(std::is_sorted(fine.begin(), fine.end()));
}

}  // namespace
}  // namespace stadion::test
