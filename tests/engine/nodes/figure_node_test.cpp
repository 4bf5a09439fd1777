#include "engine/nodes/bone_node.h"
#include "engine/nodes/figure_node.h"
#include "tests/engine/figure/figures.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>

namespace stadion::test {
namespace {

std::shared_ptr<const Skeleton> walker() {
  Skeleton s = chain(2);
  const auto moves = [](const char* name, float length) {
    return Clip{
        name,
        double{length},
        {channel(1, ChannelTarget::Translation, Interpolation::Linear, {0, length}, {0, 0, 1, 0, 0, 2})}};
  };
  s.clips = {moves("walk", 0.8f), moves("wave both hands", 0.5f)};
  return std::make_shared<const Skeleton>(std::move(s));
}

struct FigureShow : ShowFixture {
  /// At these times a speaker gives the figure the command, 0.1 s later.
  explicit FigureShow(std::vector<Nanoseconds> told = {}, std::string words = "",
                      const char* command = "play", bool loop = true) {
    loader.files["show"] = [=, this](LoadedScene& load) {
      auto mesh = unitMesh();
      mesh->skeleton = walker();
      Appearance look;
      look.mesh = meshes.add(std::move(mesh));
      ClipPlayer::Start start;
      start.length = 0.8;
      start.loop = loop;
      figure =
          &addNode<FigureNode>(load, "figure", PlaceAttributes(), look, walker(), ClipPlayer::Start(), start);
      figure->addNotification(notify(Event("looped"), "listener", CommandId::Enable, 1));
      figure->addNotification(notify(Event("finished"), "listener", CommandId::Disable, 1));
      auto say = notify(Event("timesup"), "figure", commandNamed(command), 0.1);
      if (!words.empty()) say.arguments = {words};
      addNode<SpeakingNode>(load, "speaker", told).addNotification(std::move(say));
      listener = &addNode<ListeningNode>(load, "listener");
    };
    scene.open("show");
  }
  const FigureRecord& record() const { return records.at(0); }
  void run(std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) {
      frames(1);
      if (changes.figuresChanged) records = changes.figures;
    }
  }
  std::vector<FigureRecord> records;
  FigureNode* figure = nullptr;
  ListeningNode* listener = nullptr;
};

TEST(FigureNode, ItPlaysFromTheStartAndTellsEachPass) {
  FigureShow show;
  show.run(180);
  EXPECT_NEAR(show.record().layers[0].time, std::fmod(toSeconds(show.scene.now()), 0.8), 1e-9);
  std::vector<Nanoseconds> looped;
  for (const auto& h : show.listener->heard) looped.push_back(h.effective - fromSeconds(1));
  EXPECT_EQ(looped, (std::vector<Nanoseconds>{fromSeconds(0.8), fromSeconds(1.6)}));
}

TEST(FigureNode, ItsPoseAtAShowTimeIsTheSameAtEveryRate) {
  std::vector<FigureRecord> records;
  for (const double rate : {30.0, 60.0, 90.0}) {
    FigureShow show({fromSeconds(0.33)}, "wave both hands fade 0.5 speed 0.7");
    show.rate = rate;
    show.run(static_cast<std::uint64_t>(rate * 2 / 3) + 1);
    ASSERT_EQ(show.scene.now(), fromSeconds(2.0 / 3)) << rate;
    records.push_back(show.record());
  }
  EXPECT_EQ(records[0].layerCount, 2u);
  EXPECT_EQ(records[0], records[1]);
  EXPECT_EQ(records[0], records[2]);
}

TEST(FigureNode, ACommandTakesEffectAtItsExactTime) {
  FigureShow show({fromSeconds(0.5)}, "wave both hands fade 0 once");
  show.run(50);
  const double since = toSeconds(show.scene.now()) - 0.6;
  EXPECT_EQ(show.record().layers[0].clip, 1u);
  EXPECT_NEAR(show.record().layers[0].time, since, 1e-9);
  show.run(100);
  ASSERT_EQ(show.listener->heard.size(), 1u);
  EXPECT_EQ(show.listener->heard[0].command, CommandId::Disable);
  EXPECT_EQ(show.listener->heard[0].effective - fromSeconds(1), fromSeconds(1.1));
  EXPECT_FALSE(show.figure->busy());
}

TEST(FigureNode, PauseStopAndPose) {
  FigureShow paused({fromSeconds(0.2)}, "", "pause");
  paused.run(100);
  EXPECT_NEAR(paused.record().layers[0].time, 0.3, 1e-9);
  EXPECT_FALSE(paused.figure->busy());
  FigureShow stopped({fromSeconds(0.2)}, "", "stop");
  stopped.run(60);
  EXPECT_EQ(stopped.record().layerCount, 0u);
  FigureShow posed({fromSeconds(0.2)}, "wave both hands 0.25", "pose");
  posed.run(60);
  EXPECT_EQ(posed.record().layers[0].clip, 1u);
  EXPECT_EQ(posed.record().layers[0].time, 0.25);
}

TEST(FigureNode, WrongWordsAreToldAndChangeNothing) {
  for (const char* words : {"run", "walk fade", "walk speed fast", "walk from 9", "walk quickly"}) {
    FigureShow show({fromSeconds(0.2)}, words);
    show.run(60);
    ASSERT_EQ(show.loader.reported.size(), 1u) << words;
    EXPECT_NE(show.loader.reported[0].message.find("play: "), std::string::npos);
    EXPECT_EQ(show.record().layers[0].clip, 0u);
  }
}

/// A bone of the figure with an object that hangs from it.
struct CarryingShow : ShowFixture {
  explicit CarryingShow(double rate_) {
    rate = rate_;
    loader.files["show"] = [=, this](LoadedScene& load) {
      auto mesh = unitMesh();
      mesh->skeleton = walker();
      Appearance look;
      look.mesh = meshes.add(std::move(mesh));
      PlaceAttributes place;
      place.X_PN = moved(5, 0, 0);
      ClipPlayer::Start start;
      start.length = 0.8;
      const auto& figure =
          addNode<FigureNode>(load, "figure", place, look, walker(), ClipPlayer::Start(), start);
      PlaceAttributes grip;
      grip.parent = figure.self();
      grip.X_PN = moved(0, 0.5, 0);
      bone = &addNode<BoneNode>(load, "hand", grip, 1u);
      PlaceAttributes held;
      held.parent = bone->self();
      held.X_PN = moved(0, 0, 0.25);
      discus = &addNode<MovingNode>(load, "discus", held, false);
    };
    scene.open("show");
  }
  Vec3 at(const PlacedNode* node) const { return scene.placements().world(node->placement()).translation(); }
  BoneNode* bone = nullptr;
  MovingNode* discus = nullptr;
};

TEST(BoneNode, WhatHangsFromABoneGoesWithIt) {
  for (const double rate : {30.0, 60.0, 90.0}) {
    CarryingShow show(rate);
    EXPECT_EQ(show.at(show.bone), Vec3(5, 0.5, 1));
    show.frames(static_cast<std::uint64_t>(rate / 3) + 1);  // 1/3 s: the bone is 1 + 1/3 / 0.8 m high
    const double height = 1 + toSeconds(show.scene.now()) / double{0.8f};
    EXPECT_LT((show.at(show.bone) - Vec3(5, 0.5, height)).norm(), 1e-9) << rate;
    EXPECT_LT((show.at(show.discus) - Vec3(5, 0.5, height + 0.25)).norm(), 1e-9) << rate;
  }
}

TEST(BoneNode, ItsWayWithinAFrameIsKnownToWatchers) {
  CarryingShow show(10);
  show.scene.placements().watch(show.discus->placement());
  show.frames(3);
  const Pose middle =
      show.scene.poseTracks().at(show.bone->placement(), fromSeconds(0.15), show.scene.placements());
  EXPECT_NEAR(middle.p.z(), 1 + 0.15 / double{0.8f}, 1e-9);
}

TEST(BoneNode, DetachedAndResetItReturnsToTheBone) {
  CarryingShow show(60);
  show.tracker("foot", Vec3(1, 2, 3));
  show.frames(10);
  show.scene.command("hand", CommandId::Attach, {"all"}, show.scene.now());
  show.frames(5);
  EXPECT_LT((show.at(show.bone) - Vec3(1, 2, 3)).norm(), 1e-9);
  show.scene.command("figure", commandNamed("pause"), {}, show.scene.now());
  show.scene.command("hand", CommandId::Reset, {}, show.scene.now());
  show.frames(5);
  EXPECT_EQ(show.at(show.bone).x(), 5);
  EXPECT_EQ(show.at(show.bone).y(), 0.5);
  EXPECT_GT(show.at(show.bone).z(), 1);
}

}  // namespace
}  // namespace stadion::test
