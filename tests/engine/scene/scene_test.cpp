#include "engine/nodes/object_node.h"
#include "engine/nodes/scene_node.h"
#include "engine/scene/scene.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

TEST(Scene, VisitsOnlyTheNodesThatHaveSomethingToDo) {
  ShowFixture show;
  const MeshId mesh = show.meshes.add(unitMesh());
  std::vector<InstanceRecord> records(100000);
  show.loader.files["show"] = [&](LoadedScene& load) {
    load.nodes.resize(100000);
    load.chunk = 1;
    load.chunkRecords = records;
    load.staticType = &kObjectType;
    for (std::uint32_t i = 0; i < 100000; ++i) load.statics.push_back({i, {}});
    for (int i = 0; i < 10; ++i) addNode<MovingNode>(load, "", PlaceAttributes{}, true, mesh);
    for (int i = 0; i < 500; ++i) addNode<MovingNode>(load, "", PlaceAttributes{}, false, mesh);
  };
  ASSERT_TRUE(show.scene.open("show"));
  show.frame();
  for (int n = 0; n < 5; ++n) {
    show.frame();
    EXPECT_EQ(show.scene.counters().nodesVisited, 10u);
    EXPECT_EQ(show.scene.counters().changesPublished, 10u);
    EXPECT_EQ(show.changes.instances.size(), 10u);
  }
}

TEST(Scene, DeliversMessagesInTheReceiversNextCycleAndNotBefore) {
  ShowFixture show;
  ListeningNode* listener = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    // The listener stands behind the speaker: in the same frame it would hear it too early.
    addNode<SpeakingNode>(load, "speaker", std::vector<Nanoseconds>{fromSeconds(0.040)})
        .addNotification(notify(Event("timesup"), "listener", CommandId::Enable));
    listener = &addNode<ListeningNode>(load, "listener");
  };
  show.scene.open("show");
  show.frames(12);
  ASSERT_EQ(listener->heard.size(), 1u);
  EXPECT_EQ(listener->heard[0].frame, 4u) << "the event of 0.040 s is raised in frame 3 (0.050 s)";
  EXPECT_EQ(listener->heard[0].effective, signatureAt(3, 60).time) << "not before the next frame's start";
  EXPECT_EQ(listener->visits, 1u);
}

TEST(Scene, ADelayCountsFromTheEventItselfWhateverTheFrameRate) {
  for (const double rate : {30.0, 60.0, 144.0, 240.0}) {
    ShowFixture show;
    show.rate = rate;
    ListeningNode* listener = nullptr;
    show.loader.files["show"] = [&](LoadedScene& load) {
      addNode<SpeakingNode>(load, "speaker", std::vector<Nanoseconds>{fromSeconds(0.0411)})
          .addNotification(notify(Event("timesup"), "listener", CommandId::Enable, 0.2));
      listener = &addNode<ListeningNode>(load, "listener");
    };
    show.scene.open("show");
    show.frames(static_cast<std::uint64_t>(rate));
    ASSERT_EQ(listener->heard.size(), 1u);
    EXPECT_EQ(listener->heard[0].effective, fromSeconds(0.2411));
  }
}

TEST(Scene, OrdersMessagesByTimeThenSenderThenSequence) {
  ShowFixture show;
  ListeningNode* listener = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    listener = &addNode<ListeningNode>(load, "listener");
    auto& late = addNode<SpeakingNode>(load, "late", std::vector<Nanoseconds>{fromSeconds(0.012)});
    late.addNotification(notify(Event("timesup"), "listener", CommandId::Hide));
    late.addNotification(notify(Event("timesup"), "listener", CommandId::Show));
    addNode<SpeakingNode>(load, "early", std::vector<Nanoseconds>{fromSeconds(0.011)})
        .addNotification(notify(Event("timesup"), "listener", CommandId::Enable));
    addNode<SpeakingNode>(load, "same", std::vector<Nanoseconds>{fromSeconds(0.012)})
        .addNotification(notify(Event("timesup"), "listener", CommandId::Disable));
  };
  show.scene.open("show");
  show.frames(4);
  ASSERT_EQ(listener->heard.size(), 4u);
  EXPECT_EQ(listener->heard[0].command, CommandId::Enable);
  EXPECT_EQ(listener->heard[1].command, CommandId::Hide);
  EXPECT_EQ(listener->heard[2].command, CommandId::Show);
  EXPECT_EQ(listener->heard[3].command, CommandId::Disable);
}

TEST(Scene, LoadsAndUnloadsASubSceneAtAFixedShowTime) {
  ShowFixture show;
  show.loader.files["game"] = [](LoadedScene& load) { addNode<MovingNode>(load, "ball"); };
  show.loader.files["show"] = [](LoadedScene& load) {
    addNode<SceneNode>(load, "game", PlaceAttributes{}, "game", fromSeconds(0.1), false);
  };
  show.scene.open("show");
  show.frames(2);
  show.scene.command("game", CommandId::Load, {}, signatureAt(2, 60).time);
  std::uint64_t arrived = 0;
  for (int n = 0; n < 12; ++n) {
    show.frame();
    if (show.scene.tree().loads().size() == 2 && arrived == 0) arrived = show.next - 1;
  }
  EXPECT_EQ(arrived, 8u) << "frame 2's end (33.3 ms) + 100 ms = 133.3 ms, the end of frame 8";
  EXPECT_TRUE(show.scene.tree().resolve("game/ball", {1, 0}).valid());
  show.scene.command("game", CommandId::Unload, {}, show.input.time);
  show.frames(12);
  EXPECT_EQ(show.scene.tree().loads().size(), 1u);
  EXPECT_EQ(show.loader.disposed, 1u);
  EXPECT_FALSE(show.scene.tree().resolve("game/ball", {1, 0}).valid());
}

TEST(Scene, AFileThatComesLateTakesEffectAndIsToldWhenItWasDecided) {
  ShowFixture show;
  show.loader.files["game"] = [](LoadedScene& load) { addNode<MovingNode>(load, "ball"); };
  show.loader.files["show"] = [](LoadedScene& load) {
    auto& game = addNode<SceneNode>(load, "game", PlaceAttributes{}, "game", fromSeconds(0.1), false);
    game.addNotification(notify(Event("loaded"), "ear", CommandId::Enable));
    addNode<ListeningNode>(load, "ear");
  };
  show.loader.late[2] = fromSeconds(0.2);
  show.scene.open("show");
  show.frames(1);
  show.scene.command("game", CommandId::Load, {}, signatureAt(1, 60).time);
  show.frames(11);
  EXPECT_EQ(show.scene.tree().loads().size(), 1u) << "due at 0.117 s; frame 11 is at 0.183 s";
  EXPECT_TRUE(show.scene.requests().awaits(2));
  show.frames(1);
  EXPECT_EQ(show.scene.tree().loads().size(), 2u) << "frame 12 is at 0.2 s";
  EXPECT_FALSE(show.scene.requests().awaits(2));
  show.frames(2);
  const auto& ear =
      dynamic_cast<const ListeningNode&>(*show.scene.find(show.scene.tree().resolve("ear", {1, 0})));
  ASSERT_EQ(ear.heard.size(), 1u);
  EXPECT_EQ(ear.heard[0].frame, 13u);
}

TEST(Scene, WithoutMemoryToDisposeOfItsFilesItGoesAllTheSame) {
  TestLoader loader;
  MeshStore meshes;
  loader.files["game"] = [](LoadedScene& load) { addNode<MovingNode>(load, "ball"); };
  loader.files["show"] = [](LoadedScene& load) {
    addNode<SceneNode>(load, "game", PlaceAttributes{}, "game", fromSeconds(0.1), true);
  };
  {
    Scene scene(loader, meshes, 1);
    ASSERT_TRUE(scene.open("show"));
    ASSERT_EQ(scene.tree().loads().size(), 2u);
    loader.lacksMemory = true;
  }
  EXPECT_EQ(loader.disposed, 2u);
}

TEST(Scene, AFileThatIsUnloadedBeforeItComesDoesNotStay) {
  ShowFixture show;
  show.loader.files["game"] = [](LoadedScene& load) { addNode<MovingNode>(load, "ball"); };
  show.loader.files["show"] = [](LoadedScene& load) {
    addNode<SceneNode>(load, "game", PlaceAttributes{}, "game", fromSeconds(0.1), false);
  };
  show.loader.late[2] = fromSeconds(0.5);
  show.scene.open("show");
  show.frames(1);
  show.scene.command("game", CommandId::Load, {}, signatureAt(1, 60).time);
  show.frames(2);
  show.scene.command("game", CommandId::Unload, {}, show.input.time);
  show.frames(40);
  EXPECT_EQ(show.scene.tree().loads().size(), 1u);
  EXPECT_EQ(show.loader.disposed, 1u);
  EXPECT_FALSE(show.scene.requests().awaits(2));
}

TEST(Scene, NamesResolveInTheFileThenOutwards) {
  ShowFixture show;
  show.loader.files["game"] = [](LoadedScene& load) {
    addNode<MovingNode>(load, "ball");
    addNode<MovingNode>(load, "own");
  };
  show.loader.files["show"] = [](LoadedScene& load) {
    addNode<MovingNode>(load, "ball");
    addNode<MovingNode>(load, "field");
    addNode<SceneNode>(load, "game", PlaceAttributes{}, "game", 0, true);
  };
  show.scene.open("show");
  show.frame();
  EXPECT_EQ(show.scene.tree().resolve("ball", {2, 0}), (NodeRef{2, 0}));
  EXPECT_EQ(show.scene.tree().resolve("field", {2, 0}), (NodeRef{1, 1}));
  EXPECT_EQ(show.scene.tree().resolve("game/own", {1, 0}), (NodeRef{2, 1}));
  EXPECT_FALSE(show.scene.tree().resolve("own", {1, 0}).valid());
  EXPECT_FALSE(show.scene.tree().resolve("game/field", {1, 0}).valid());
}

TEST(Scene, MessagesToAnUnloadedNodeAreCountedAndHarmless) {
  ShowFixture show;
  show.loader.files["show"] = [](LoadedScene& load) {
    addNode<SpeakingNode>(load, "speaker", std::vector<Nanoseconds>{1})
        .addNotification(notify(Event("timesup"), "missing/node", CommandId::Enable));
  };
  show.scene.open("show");
  show.frame();
  show.frame();
  EXPECT_EQ(show.scene.counters().messagesLost, 1u);
}

TEST(Scene, AStaticObjectBecomesANodeWhenItIsAddressed) {
  ShowFixture show;
  const MeshId mesh = show.meshes.add(unitMesh());
  Affine X = Affine::Identity();
  X.translation() = Vec3(1, 2, 3);
  const std::vector<InstanceRecord> records{makeInstance(X, *show.meshes.find(mesh), mesh, true, NodeRef{})};
  show.loader.files["show"] = [&](LoadedScene& load) {
    load.nodes.resize(1);
    load.chunk = 5;
    load.chunkRecords = records;
    load.staticType = &kObjectType;
    load.statics = {{0, {}}};
    load.names["stone"] = 0;
  };
  show.scene.open("show");
  show.frame();
  EXPECT_TRUE(show.changes.instances.empty());
  show.scene.command("stone", CommandId::Hide, {}, 0);
  show.frame();
  ASSERT_EQ(show.changes.statics.size(), 1u);
  EXPECT_TRUE(show.changes.statics[0].hidden);
  ASSERT_EQ(show.changes.instances.size(), 1u);
  EXPECT_EQ(show.changes.instances[0].record.model[7], 2);
  EXPECT_EQ(show.changes.instances[0].record.flags & InstanceRecord::kShown, 0u);
}

TEST(Scene, TheStateHashTellsStatesApartAndAgreesOnEqualOnes) {
  const auto run = [](double x, int frames) {
    ShowFixture show;
    show.loader.files["show"] = [&](LoadedScene& load) {
      PlaceAttributes place;
      place.X_PN.translation().x() = x;
      addNode<MovingNode>(load, "a", place, false);
      addNode<MovingNode>(load, "b");
    };
    show.scene.open("show");
    show.frames(static_cast<std::uint64_t>(frames));
    return show.scene.stateHash();
  };
  EXPECT_EQ(run(1, 10), run(1, 10));
  EXPECT_NE(run(1, 10), run(1, 11));
  EXPECT_NE(run(1, 10), run(1.0000000000000002, 10)) << "one bit in a node that is never visited";
}

TEST(Scene, ANodeAttachedToATrackerFollowsItThroughTheRig) {
  ShowFixture show;
  PlacedNode* leg = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    leg = &addNode<MovingNode>(load, "leg", PlaceAttributes{}, false);
  };
  show.scene.open("show");
  show.tracker("foot", {1, 2, 0.5});
  show.scene.moveRig({Vec3(10, 0, 0), Quat::Identity()});
  show.scene.command("leg", CommandId::Attach, {"all"}, 0);
  show.frames(2);
  EXPECT_EQ(show.scene.placements().world(leg->placement()).translation(), Vec3(11, 2, 0.5));
  show.scene.command("leg", CommandId::Detach, {}, show.input.time);
  show.frame();
  show.tracker("foot", {5, 5, 5});
  show.frame();
  EXPECT_EQ(show.scene.placements().world(leg->placement()).translation(), Vec3(11, 2, 0.5));
  show.scene.command("leg", CommandId::Reset, {}, show.input.time);
  show.frame();
  EXPECT_EQ(show.scene.placements().world(leg->placement()).translation(), Vec3(0, 0, 0));
}

}  // namespace
}  // namespace stadion
