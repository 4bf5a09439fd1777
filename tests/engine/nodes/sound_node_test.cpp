#include "engine/nodes/sound_node.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

constexpr Nanoseconds kLength = 430'000'000;

struct HeardShow : ShowFixture {
  explicit HeardShow(bool loop = false, bool on = false, std::vector<Nanoseconds> told = {},
                     CommandId command = CommandId::Enable) {
    loader.files["show"] = [=, this](LoadedScene& load) {
      SoundNode::Attributes a;
      a.file = "cheer.wav", a.length = kLength, a.loop = loop, a.gain = 0.5, a.range = 20;
      PlaceAttributes place;
      place.X_PN.translation() = Vec3(1, 2, 3);
      addNode<SoundNode>(load, "cheer", place, a, on)
          .addNotification(notify(Event("finished"), "listener", CommandId::Enable, 1));
      addNode<SpeakingNode>(load, "speaker", told)
          .addNotification(notify(Event("timesup"), "cheer", command, 0.1));
      listener = &addNode<ListeningNode>(load, "listener");
    };
    scene.open("show");
  }
  SoundScape heard() {
    SoundScape scape;
    scene.collectSounds(input, scape);
    return scape;
  }
  /// When it was finished.
  std::vector<Nanoseconds> finished() const {
    std::vector<Nanoseconds> times;
    for (const auto& h : listener->heard) times.push_back(h.effective - fromSeconds(1));
    return times;
  }
  ListeningNode* listener = nullptr;
};

TEST(SoundNode, ItIsFinishedAtTheFilesExactLengthAfterItsStart) {
  for (const double rate : {24.0, 60.0, 144.0}) {
    HeardShow show(false, false, {fromSeconds(0.5)});
    show.rate = rate;
    show.frames(static_cast<std::uint64_t>(3 * rate));
    EXPECT_EQ(show.finished(), std::vector<Nanoseconds>{fromSeconds(0.6) + kLength}) << rate;
  }
}

TEST(SoundNode, ItIsHeardFromItsPlaceWhileItPlaysAndNoLonger) {
  HeardShow show(false, false, {fromSeconds(0.5)});
  show.frames(30);
  EXPECT_TRUE(show.heard().sounds.empty());
  show.frames(10);
  const SoundScape scape = show.heard();
  ASSERT_EQ(scape.sounds.size(), 1u);
  EXPECT_EQ(scape.sounds[0].position, Vec3(1, 2, 3));
  EXPECT_EQ(scape.sounds[0].since, fromSeconds(0.6));
  EXPECT_EQ(scape.sounds[0].file, "cheer.wav");
  EXPECT_EQ(scape.sounds[0].gain, 0.5);
  show.frames(60);
  EXPECT_TRUE(show.heard().sounds.empty());
}

TEST(SoundNode, ASoundOfTheStartPlaysFromTimeZero) {
  HeardShow show(false, true);
  show.frames(180);
  EXPECT_EQ(show.finished(), std::vector<Nanoseconds>{kLength});
}

TEST(SoundNode, EnabledAgainItPlaysFromItsStartAndEndsLater) {
  HeardShow show(false, false, {fromSeconds(0.5), fromSeconds(0.8)});
  show.frames(180);
  EXPECT_EQ(show.finished(), std::vector<Nanoseconds>{fromSeconds(0.9) + kLength});
}

TEST(SoundNode, StoppedItIsNeverFinished) {
  HeardShow show(false, true, {fromSeconds(0.1)}, CommandId::Disable);
  show.frames(180);
  EXPECT_TRUE(show.finished().empty());
  EXPECT_TRUE(show.heard().sounds.empty());
}

TEST(SoundNode, ALoopTellsTheEndOfEachPassAndGoesOn) {
  HeardShow show(true, true);
  show.rate = 7;
  show.frames(8);
  show.frames(14);
  const auto times = show.finished();
  ASSERT_GE(times.size(), 4u);
  for (std::size_t i = 0; i < times.size(); ++i)
    EXPECT_EQ(times[i], static_cast<Nanoseconds>(i + 1) * kLength);
  EXPECT_EQ(show.heard().sounds.size(), 1u);
}

TEST(SoundNode, SinceWhenItPlaysIsInTheStateHash) {
  HeardShow early(false, false, {fromSeconds(0.5)}), late(false, false, {fromSeconds(0.51)});
  early.frames(50), late.frames(50);
  EXPECT_NE(early.scene.stateHash(), late.scene.stateHash());
}

TEST(SoundNode, WhileItPlaysItIsNotVisited) {
  HeardShow show(false, true);
  show.frames(5);
  show.frame();
  EXPECT_EQ(show.scene.counters().nodesVisited, 0u);
}

}  // namespace
}  // namespace stadion
