/// Figures that post markers, add layers and walk by their root bone.

#include "engine/nodes/bone_node.h"
#include "engine/nodes/figure_node.h"
#include "engine/scene/scene_snapshot.h"
#include "tests/engine/figure/figures.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>

namespace stadion::test {
namespace {

/// "walk": the bone 1 goes 1.2 m along y within 0.8 s, and up and down. "nod": the bone 2 turns. "turn": the bone
/// 1 turns to the left.
std::shared_ptr<const Skeleton> striding() {
  Skeleton s = chain(3);
  const Interpolation linear = Interpolation::Linear;
  s.clips = {
      {"walk",
       double{0.8f},
       {channel(1, ChannelTarget::Translation, linear, {0, 0.4f, 0.8f},
                {0, 0, 1, 0, 0.6f, 1.2f, 0, 1.2f, 1})}},
      {"nod", 0.5, {channel(2, ChannelTarget::Rotation, linear, {0, 0.5f}, {0, 0, 0, 1, 0.6f, 0, 0, 0.8f})}},
      {"turn",
       double{0.7f},
       {channel(1, ChannelTarget::Rotation, linear, {0, 0.7f}, {0, 0, 0, 1, 0, 0, 0.6f, 0.8f}),
        channel(1, ChannelTarget::Translation, linear, {0, 0.7f}, {0, 0, 1, 0.3f, 0.1f, 1})}}};
  s.reach = {Vec3::Zero(), 5}, s.addedReach = {Vec3::Zero(), 9};
  return std::make_shared<const Skeleton>(std::move(s));
}

struct Told {
  double when = 0;
  const char* command = "";
  std::string words{};
};

struct MotionShow : ShowFixture {
  std::vector<Told> told;
  double begins = -1;  ///< later than what is told up to then
  std::vector<FigureRecord> records;
  InstanceRecord drawn{};
  FigureNode* figure = nullptr;
  BoneNode* hand = nullptr;
  MovingNode* follower = nullptr;
  ListeningNode* listener = nullptr;

  explicit MotionShow(std::vector<Told> commands, double framesPerSecond = 60, bool walks = true,
                      bool opens = true)
      : told(std::move(commands)) {
    rate = framesPerSecond;
    loader.files["show"] = [=, this](LoadedScene& load) { fill(load, walks); };
    if (opens) scene.open("show");
  }
  void fill(LoadedScene& load, bool walks) {
    auto mesh = unitMesh();
    mesh->skeleton = striding();
    Appearance look;
    look.mesh = meshes.add(std::move(mesh));
    load.meshes.push_back(look.mesh);
    PlaceAttributes place;
    place.X_PN = moved(5, 0, 0);
    ClipPlayer::Start start;
    start.length = striding()->clips[0].length;
    FigureExtras extras;
    extras.markers = ClipMarkers({{0, 0.3}, {1, 0.25}, {0, 0.6}});
    for (const char* name : {"left", "nodded", "right"})
      extras.markerEvents.push_back(Event("marker").with(name));
    if (walks)
      extras.root = 1, extras.rootReach = {Vec3::Zero(), 3}, extras.rootAddedReach = {Vec3::Zero(), 4};
    ClipPlayer::Start standard;
    standard.fade = fromSeconds(0.2);
    figure = &addNode<FigureNode>(load, "figure", place, look, striding(), standard, start, extras);
    figure->addNotification(notify(Event("marker").with("left"), "listener", CommandId::Enable, 1));
    figure->addNotification(notify(Event("marker").with("right"), "listener", CommandId::Disable, 1));
    figure->addNotification(notify(Event("marker").with("nodded"), "listener", CommandId::Toggle, 1));
    PlaceAttributes below;
    below.parent = figure->self();
    hand = &addNode<BoneNode>(load, "hand", below, 2u);
    follower = &addNode<MovingNode>(load, "follower", below, false);
    listener = &addNode<ListeningNode>(load, "listener");
    for (std::size_t i = 0; i < told.size(); ++i) {
      auto say = notify(Event("timesup"), "figure", commandNamed(told[i].command), 0.1);
      if (!told[i].words.empty()) say.arguments = {told[i].words};
      // A speaker has no state: a restored show has what was told before in its state.
      std::vector<Nanoseconds> when;
      if (told[i].when - 0.1 > begins) when.push_back(fromSeconds(told[i].when - 0.1));
      addNode<SpeakingNode>(load, "speaker" + std::to_string(i), when).addNotification(std::move(say));
    }
  }
  void play(double seconds) {
    while (signatureAt(next, rate).time <= fromSeconds(seconds)) {
      frame();
      if (changes.figuresChanged) records = changes.figures;
      for (const ChangeSet::Instance& i : changes.instances)
        if (i.record.owner == figure->self()) drawn = i.record;
    }
  }
  Vec3 at(const PlacedNode* node) const { return scene.placements().world(node->placement()).translation(); }
  Affine placeOf(const PlacedNode* node) const { return scene.placements().world(node->placement()); }
};

TEST(FigureMarkers, EachIsAMessageAtItsExactTimeInEachPass) {
  for (const double rate : {30.0, 60.0, 90.0}) {
    MotionShow show({}, rate);
    show.play(3);
    std::string heard;
    for (const auto& h : show.listener->heard)
      heard += (h.command == CommandId::Enable ? "left " : "right ") +
               std::to_string((h.effective - fromSeconds(1)) / 1'000'000) + " ";
    EXPECT_EQ(heard, "left 300 right 600 left 1100 right 1400 left 1900 ") << rate;
  }
}

TEST(FigureMarkers, ALayerPostsItsOwn) {
  MotionShow show({{0.5, "layer", "nod once"}});
  show.play(2);
  std::size_t nods = 0;
  for (const auto& h : show.listener->heard)
    if (h.command == CommandId::Toggle) {
      ++nods;
      EXPECT_EQ(h.effective - fromSeconds(1), fromSeconds(0.75));
    }
  EXPECT_EQ(nods, 1u);
}

TEST(FigureLayers, CommandsTakeTheirWords) {
  MotionShow show({{0.5, "layer", "nod weight 0.5 fade 0 speed 0.5"}, {1.5, "unlayer", "nod fade 0.4"}}, 60,
                  false);
  show.play(1);
  ASSERT_EQ(show.records[0].addedCount, 1u);
  EXPECT_EQ(show.records[0].added[0].clip, 1u);
  EXPECT_EQ(show.records[0].added[0].weight, 0.5f);
  EXPECT_NEAR(show.records[0].added[0].time, 0.25, 1e-9);
  EXPECT_EQ(show.drawn.radius, static_cast<float>(9 * (1 + 1e-6))) << "the sphere for layers";
  show.play(1.7);
  EXPECT_NEAR(show.records[0].added[0].weight, 0.25, 1e-6);
  show.play(2);
  EXPECT_EQ(show.records[0].addedCount, 0u);
  EXPECT_EQ(show.drawn.radius, static_cast<float>(1 + 1e-6)) << "that of the mesh again";
}

TEST(FigureLayers, WrongWordsAreToldAndChangeNothing) {
  const std::pair<const char*, const char*> wrong[] = {
      {"layer", "dance"},      {"layer", "nod weight 2"}, {"layer", "nod weight"},   {"unlayer", "dance"},
      {"unlayer", "nod fade"}, {"unlayer", "nod 0.3"},    {"play", "nod weight 0.5"}};
  for (const auto& [command, words] : wrong) {
    MotionShow show({{0.3, command, words}});
    show.play(0.5);
    ASSERT_EQ(show.loader.reported.size(), 1u) << words;
    EXPECT_NE(show.loader.reported[0].message.find(std::string(command) + ": "), std::string::npos);
    EXPECT_EQ(show.records[0].addedCount, 0u);
    EXPECT_EQ(show.records[0].layerCount, 1u);
  }
}

TEST(FigureRoot, TheNodeWalksAndTheBoneStays) {
  MotionShow show({});
  show.play(2.0);
  EXPECT_LT((show.at(show.figure) - Vec3(5, 3.0, 0)).norm(), 1e-6);
  EXPECT_LT((show.at(show.follower) - Vec3(5, 3.0, 0)).norm(), 1e-6);
  EXPECT_LT((show.at(show.hand) - Vec3(5, 3.0, 2.2)).norm(), 1e-6) << "0.4 s of the third pass";
  EXPECT_EQ(show.drawn.radius, static_cast<float>(3 * (1 + 1e-6)));
  MotionShow off({}, 60, false);
  off.play(2.0);
  EXPECT_EQ(off.at(off.figure), Vec3(5, 0, 0));
  EXPECT_LT((off.at(off.hand) - Vec3(5, 0.6, 2.2)).norm(), 1e-6);
}

TEST(FigureRoot, AResetBringsItBackAtItsTime) {
  MotionShow show({{0.5, "reset"}});
  show.play(1.3);
  EXPECT_LT((show.at(show.figure) - Vec3(5, 1.2, 0)).norm(), 1e-6);
  MotionShow stopped({{0.5, "stop"}});
  stopped.play(1.3);
  EXPECT_LT((stopped.at(stopped.figure) - Vec3(5, 0.75, 0)).norm(), 1e-6);
  EXPECT_FALSE(stopped.figure->busy());
}

TEST(FigureRoot, ATrackerTakesItAndItGoesOnFromThere) {
  MotionShow show({});
  show.tracker("foot", Vec3(1, 2, 3));
  show.play(0.5);
  show.scene.command("figure", CommandId::Attach, {"all"}, show.scene.now());
  show.play(1.0);
  EXPECT_LT((show.at(show.figure) - Vec3(1, 2, 3)).norm(), 1e-9);
  show.scene.command("figure", CommandId::Detach, {}, show.scene.now());
  const double from = toSeconds(show.scene.now());
  show.play(1.5);
  const Vec3 way = show.at(show.figure) - Vec3(1, 2, 3);
  EXPECT_LT((way - Vec3(0, 1.5 * (toSeconds(show.scene.now()) - from), 0)).norm(), 1e-6);
}

const std::vector<Told> kMuch{{0.2, "layer", "nod weight 0.7 fade 0.3"},
                              {0.456, "play", "turn fade 0.4"},
                              {0.7, "play", "walk fade 0.333 speed 1.7"},
                              {1.2, "pause"},
                              {1.234, "layer", "turn"},
                              {1.4, "play"},
                              {1.5, "unlayer", "nod fade 0.35"},
                              {2.1, "play", "turn fade 0"},
                              {2.55, "pose", "walk 0.3"},
                              {2.6, "play", "walk"},
                              {3.2, "unlayer"}};

TEST(FigureRoot, EverythingIsTheSameToTheBitAtEveryRate) {
  for (const double seconds : {0.6, 1.0, 1.3, 2.0, 2.6, 3.3, 4.0, 17.0}) {
    std::vector<std::string> states;
    for (const double rate : {30.0, 60.0, 90.0}) {
      MotionShow show(kMuch, rate);
      show.play(seconds);
      ASSERT_EQ(show.scene.now(), fromSeconds(seconds));
      std::string state;
      for (const PlacedNode* node :
           {static_cast<const PlacedNode*>(show.figure), static_cast<const PlacedNode*>(show.hand)})
        state.append(reinterpret_cast<const char*>(show.placeOf(node).data()), 12 * sizeof(double));
      state.append(reinterpret_cast<const char*>(&show.records[0]), sizeof(FigureRecord));
      StateHash hash;
      show.figure->hash(hash);
      states.push_back(state + std::to_string(hash.value()));
    }
    EXPECT_EQ(states[0], states[1]) << seconds;
    EXPECT_EQ(states[0], states[2]) << seconds;
  }
}

TEST(FigureRoot, ASnapshotGoesOnAsTheShowDoes) {
  for (const double seconds : {0.6, 1.3, 1.6, 2.7}) {
    MotionShow show(kMuch), other(kMuch, 60, true, false);
    show.play(seconds);
    const auto state = SceneSnapshot(show.scene).save();
    other.begins = seconds;
    ASSERT_EQ(SceneSnapshot(other.scene).restore(state, "show"), std::nullopt) << seconds;
    other.next = show.next;
    for (int i = 0; i < 150; ++i) {
      show.frame(), other.frame();
      ASSERT_EQ(show.scene.stateHash(), other.scene.stateHash()) << seconds << " " << i;
      EXPECT_EQ(show.placeOf(show.hand).matrix(), other.placeOf(other.hand).matrix());
    }
    EXPECT_FALSE(SceneSnapshot(other.scene).difference(SceneSnapshot(show.scene).save()));
  }
}

/// The way within a frame, for those that watch: at a low rate and over the end of a pass.
TEST(FigureRoot, ItsWayWithinAFrameIsKnownToWatchers) {
  MotionShow show({{0.53, "reset"}}, 10);
  for (const PlacedNode* node :
       {static_cast<const PlacedNode*>(show.follower), static_cast<const PlacedNode*>(show.hand)})
    show.scene.placements().watch(node->placement());
  const auto poseAt = [&](const PlacedNode* node, double seconds) {
    return show.scene.poseTracks().at(node->placement(), fromSeconds(seconds), show.scene.placements()).p;
  };
  show.play(0.3);
  EXPECT_LT((poseAt(show.figure, 0.27) - Vec3(5, 0.405, 0)).norm(), 1e-6);
  show.play(0.6);
  EXPECT_LT((poseAt(show.figure, 0.52) - Vec3(5, 0.78, 0)).norm(), 1e-6);
  EXPECT_LT((poseAt(show.figure, 0.57) - Vec3(5, 0.06, 0)).norm(), 1e-6);
  EXPECT_LT((poseAt(show.hand, 0.57) - Vec3(5, 0.06, 2.02)).norm(), 1e-6);
}

}  // namespace
}  // namespace stadion::test
