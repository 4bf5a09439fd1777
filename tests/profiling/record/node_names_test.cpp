/// Nodes whose file goes and comes again are the same nodes, in names and in sums.

#include "profiling/record/node_names.h"

#include "engine/nodes/scene_node.h"
#include "profiling/report/show_profile.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

/// A show with an annex that may come and go, and in it a cabin that comes with it.
struct Annexed : ShowFixture {
  NodeNames names;
  std::string guest = "guest";

  Annexed() {
    loader.files["show"] = [](LoadedScene& load) {
      load.lines.assign(1, 1);
      addNode<SceneNode>(load, "annex", PlaceAttributes{}, "annex", Nanoseconds{0}, false);
    };
    loader.files["annex"] = [this](LoadedScene& load) {
      load.lines.assign(2, 7);
      addNode<ListeningNode>(load, guest);
      addNode<SceneNode>(load, "cabin", PlaceAttributes{}, "cabin", Nanoseconds{0}, true);
    };
    loader.files["cabin"] = [](LoadedScene& load) {
      load.lines.assign(1, 3);
      addNode<ListeningNode>(load, "bed");
    };
    EXPECT_TRUE(scene.open("show"));
    names.see(scene);
  }
  void annex(CommandId command) {
    scene.command("annex", command, {}, 0);
    frames(4);
    names.see(scene);
  }
  /// Of the load that has that file now; 0 = it is not there.
  std::uint32_t loadOf(const std::string& file) {
    std::uint32_t number = 0;
    scene.tree().forEachLoad([&](const LoadedScene& load) {
      if (load.file == file) number = load.number;
    });
    return number;
  }
};

TEST(NodeNames, AFileThatComesAgainBringsTheSameNodes) {
  Annexed show;
  show.annex(CommandId::Load);
  const std::uint32_t annex = show.loadOf("annex"), cabin = show.loadOf("cabin");
  ASSERT_NE(annex, 0U);
  ASSERT_NE(cabin, 0U);
  show.annex(CommandId::Unload);
  EXPECT_TRUE(show.names.find({cabin, 0})->unloaded);
  show.annex(CommandId::Load);
  const std::uint32_t annexAgain = show.loadOf("annex"), cabinAgain = show.loadOf("cabin");
  ASSERT_NE(annexAgain, annex);
  ASSERT_NE(cabinAgain, cabin);
  EXPECT_EQ(show.names.firstLoad(annexAgain), annex);
  EXPECT_EQ(show.names.firstLoad(cabinAgain), cabin) << "the node that asked for it is the same, too";
  EXPECT_EQ(show.names.find({cabinAgain, 0})->path, "annex/cabin/bed");
  EXPECT_FALSE(show.names.find({cabin, 0})->unloaded) << "it is there again";
  EXPECT_EQ(show.names.find({cabinAgain, 0})->parent.load, annex);
}

TEST(NodeNames, AFileWhoseNodesHaveChangedBringsOthers) {
  Annexed show;
  show.annex(CommandId::Load);
  const std::uint32_t annex = show.loadOf("annex");
  show.annex(CommandId::Unload);
  show.guest = "stranger";
  show.annex(CommandId::Load);
  const std::uint32_t changed = show.loadOf("annex");
  EXPECT_EQ(show.names.firstLoad(changed), changed);
  EXPECT_EQ(show.names.find({changed, 0})->path, "annex/stranger");
  EXPECT_EQ(show.names.find({annex, 0})->path, "annex/guest");
}

TEST(NodeNames, ThoseOfLongAgoAreForgottenByNumberButNotByName) {
  Annexed show;
  show.annex(CommandId::Load);
  const std::uint32_t first = show.loadOf("annex");
  std::uint32_t second = 0;
  for (int i = 0; i < 100; ++i) {
    show.annex(CommandId::Unload);
    show.annex(CommandId::Load);
    if (i == 0) second = show.loadOf("annex");
  }
  EXPECT_EQ(show.names.firstLoad(second), std::nullopt);
  EXPECT_EQ(show.names.firstLoad(show.loadOf("annex")), first);
  EXPECT_EQ(show.names.find({first, 0})->path, "annex/guest");
}

TEST(ShowProfile, ANodeThatComesAgainIsAddedUpWithWhatItWas) {
  Annexed show;
  ShowProfile profile(&show.names);
  const auto works = [&](std::uint32_t load, std::uint64_t frame, double ms) {
    SpanRecord r;
    r.what = Span::Simulate, r.frame = frame, r.node = {load, 0}, r.took = r.own = ms, r.depth = 1;
    profile.take(0, r);
    r.what = Span::App, r.node = {}, r.depth = 0;
    profile.take(0, r);
  };
  show.annex(CommandId::Load);
  const std::uint32_t first = show.loadOf("annex");
  works(first, 1, 1);
  show.annex(CommandId::Unload);
  show.scene.command("annex", CommandId::Load, {}, 0);
  show.frames(4);
  const std::uint32_t again = show.loadOf("annex");
  works(again, 10, 2);  // its name is not known yet
  show.names.see(show.scene);
  works(again, 11, 4);
  ASSERT_EQ(profile.nodes().size(), 1U);
  const NodeProfile& guest = profile.nodes().at({first, 0});
  EXPECT_DOUBLE_EQ(guest.phases[1], 7);
  EXPECT_DOUBLE_EQ(guest.visit.sum(), 3) << "the last frame may not be over";
}

}  // namespace
}  // namespace stadion
