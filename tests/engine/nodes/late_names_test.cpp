#include "engine/nodes/scene_node.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

/// A speaker tells "inner/ear" at 0.5 s with a delay of one second; the file "inner" comes and goes
/// meanwhile.
struct LateShow : ShowFixture {
  std::map<std::uint32_t, ListeningNode*> ears;  ///< by load
  std::uint64_t lost = 0, delivered = 0;

  explicit LateShow(bool initially) {
    rate = 10;
    loader.files["inner"] = [this](LoadedScene& load) {
      ears[load.number] = &addNode<ListeningNode>(load, "ear");
    };
    loader.files["show"] = [initially](LoadedScene& load) {
      addNode<SceneNode>(load, "inner", PlaceAttributes{}, "inner", Nanoseconds{0}, initially);
      addNode<SpeakingNode>(load, "speaker", std::vector<Nanoseconds>{fromSeconds(0.5)})
          .addNotification(notify(Event("timesup"), "inner/ear", CommandId::Enable, 1));
    };
    scene.open("show");
  }
  void until(double seconds) {
    while (signatureAt(next, rate).time <= fromSeconds(seconds)) {
      frame();
      lost += scene.counters().messagesLost;
      delivered += scene.counters().messagesDelivered;
    }
  }
};

TEST(LateNames, ADelayedMessageFindsWhatWasLoadedMeanwhile) {
  LateShow show(false);
  show.until(0.8);
  show.scene.command("inner", CommandId::Load, {}, fromSeconds(1));
  show.until(2);
  ASSERT_EQ(show.ears.size(), 1u);
  ASSERT_EQ(show.ears.begin()->second->heard.size(), 1u);
  EXPECT_EQ(show.ears.begin()->second->heard[0].effective, fromSeconds(1.5));
  EXPECT_EQ(show.lost, 0u);
}

TEST(LateNames, ADelayedMessageToWhatHasGoneMeanwhileIsLost) {
  LateShow show(true);
  show.until(0.8);
  show.scene.command("inner", CommandId::Unload, {}, fromSeconds(1));
  show.until(2);
  EXPECT_EQ(show.lost, 1u);
  EXPECT_EQ(show.delivered, 1u) << "the unload alone";
}

TEST(LateNames, ADelayedMessageGoesToTheFileThatIsThereWhenItIsDue) {
  LateShow show(true);
  show.until(0.8);
  show.scene.command("inner", CommandId::Unload, {}, fromSeconds(0.9));
  show.scene.command("inner", CommandId::Load, {}, fromSeconds(1.1));
  show.until(2);
  ASSERT_EQ(show.ears.size(), 2u);
  EXPECT_EQ(show.ears.rbegin()->second->heard.size(), 1u);
  EXPECT_EQ(show.lost, 0u);
}

TEST(LateNames, AMessageOutlivesTheFileOfItsSenderButNotTheFileItNames) {
  ShowFixture show;
  ListeningNode* outer = nullptr;
  show.loader.files["inner"] = [](LoadedScene& load) {
    auto& speaker = addNode<SpeakingNode>(load, "speaker", std::vector<Nanoseconds>{fromSeconds(0.1)});
    speaker.addNotification(notify(Event("timesup"), "outer", CommandId::Enable, 1));
    speaker.addNotification(notify(Event("timesup"), "both", CommandId::Enable, 1));
    addNode<ListeningNode>(load, "both");
  };
  ListeningNode* both = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    outer = &addNode<ListeningNode>(load, "outer");
    both = &addNode<ListeningNode>(load, "both");
    addNode<SceneNode>(load, "inner", PlaceAttributes{}, "inner", Nanoseconds{0}, true);
  };
  show.scene.open("show");
  show.scene.command("inner", CommandId::Unload, {}, fromSeconds(0.5));
  show.frames(120);
  EXPECT_EQ(show.scene.tree().loads().size(), 1u);
  EXPECT_EQ(outer->heard.size(), 1u);
  EXPECT_TRUE(both->heard.empty()) << "it meant the node of its own file, which has gone";
}

}  // namespace
}  // namespace stadion
