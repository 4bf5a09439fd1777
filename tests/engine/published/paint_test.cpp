/// Paints of models: their table, the commands and attributes, state and snapshots.

#include "engine/core/node_registry.h"
#include "engine/published/paint_table.h"
#include "engine/scene/scene_snapshot.h"
#include "tests/engine/scene/show_fixture.h"
#include "tests/node_types.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stadion {
namespace {

Paint faded(double opacity) {
  Paint p;
  p.opacity = opacity;
  return p;
}

TEST(PaintTable, EqualPaintsShareANumberAndTheLowestFreeOneIsTakenNext) {
  PaintTable table;
  EXPECT_EQ(table.add(faded(0.1)), 1);
  EXPECT_EQ(table.add(faded(0.2)), 2);
  EXPECT_EQ(table.add(faded(0.1)), 1);
  EXPECT_EQ(table.add(faded(0.3)), 3);
  table.remove(1);
  EXPECT_TRUE(table.holds(1, faded(0.1))) << "it has one more user";
  table.remove(3);
  table.remove(1);
  table.remove(0);
  EXPECT_FALSE(table.holds(1, faded(0.1)));
  EXPECT_EQ(table.add(faded(0.4)), 1);
  EXPECT_EQ(table.add(faded(0.5)), 3);
  ChangeSet changes;
  table.publish(changes);
  ASSERT_TRUE(changes.paintsChanged);
  ASSERT_EQ(changes.paints.size(), 3u);
  EXPECT_EQ(changes.paints[0].opacity, 0.4f);
  table.remove(table.add(faded(0.5)));
  table.publish(changes);
  EXPECT_FALSE(changes.paintsChanged) << "nothing new";
}

TEST(PaintTable, NoMorePaintsThanItCanNumber) {
  PaintTable table;
  for (std::size_t i = 1; i <= kMostPaints; ++i)
    ASSERT_EQ(table.add(faded(static_cast<double>(i) / 4096)), i);
  EXPECT_EQ(table.add(faded(0.9)), 0);
  EXPECT_EQ(table.add(faded(1.0 / 4096)), 1) << "a known one has a number";
  table.remove(77);
  EXPECT_EQ(table.add(faded(0.9)), 77);
}

TEST(Paint, ColoursBecomeLinear) {
  Paint p;
  p.tint = Vec3(1, 0.5, 0);
  p.emit = Vec3(0, 0.5, 1);
  const PaintRecord r = recordOf(p);
  EXPECT_EQ(r.tint[0], 1);
  EXPECT_NEAR(r.tint[1], 0.21404, 1e-5);
  EXPECT_EQ(r.emit[1], r.tint[1]);
  EXPECT_EQ(recordOf(Paint()), PaintRecord());
  p.opacity = 1.5;
  EXPECT_FALSE(p.isValid());
  p.opacity = std::nan("");
  EXPECT_FALSE(p.isValid());
}

struct PaintShow : ShowFixture {
  struct Told {
    double when;
    const char* command;
    std::vector<std::string> arguments;
  };
  explicit PaintShow(std::vector<Told> told = {}, Paint first = {}, bool opens = true) {
    loader.files["show"] = [=, this](LoadedScene& load) {
      Appearance look;
      look.mesh = meshes.add(unitMesh());
      look.paint = first;
      const auto position = static_cast<std::uint32_t>(load.nodes.size());
      auto node =
          std::make_unique<ObjectNode>(testTypes().named("object")->type(), NodeRef{load.number, position},
                                       "box", PlaceAttributes(), look);
      object = node.get();
      load.nodes.push_back(std::move(node));
      load.enterOrder.push_back(position);
      load.names["box"] = position;
      for (const Told& t : told)
        addNode<SpeakingNode>(load, "", std::vector{fromSeconds(t.when)})
            .addNotification(notify(Event("timesup"), "box", commandNamed(t.command), 0, t.arguments));
    };
    if (opens) scene.open("show");
  }
  void run(double until) {
    while (next == 0 || scene.now() < fromSeconds(until)) {
      frame();
      for (const auto& i : changes.instances) record = i.record;
      if (changes.paintsChanged) paints = changes.paints;
      hash = scene.stateHash();
    }
  }
  /// What the object is published with.
  PaintRecord seen() const { return record.paint() == 0 ? PaintRecord() : paints.at(record.paint() - 1); }
  bool isSeeThrough() const { return (record.flags & InstanceRecord::kTransparent) != 0; }
  bool isShown() const { return (record.flags & InstanceRecord::kShown) != 0; }

  ObjectNode* object = nullptr;
  InstanceRecord record{};
  std::vector<PaintRecord> paints;
  std::uint64_t hash = 0;
};

TEST(PaintedNode, MessagesChangeItsPaintAndResetEndsIt) {
  PaintShow show({{0.1, "tint", {"1", "0", "0.5"}},
                  {0.2, "emit", {"0", "1", "0"}},
                  {0.3, "opacity", {"0.25"}},
                  {0.4, "reset", {}}});
  show.run(0.15);
  EXPECT_EQ(show.seen().tint[0], 1);
  EXPECT_EQ(show.seen().tint[1], 0);
  EXPECT_FALSE(show.isSeeThrough());
  show.run(0.35);
  EXPECT_EQ(show.seen().tint[1], 0) << "the tint stays";
  EXPECT_EQ(show.seen().emit[1], 1);
  EXPECT_EQ(show.seen().opacity, 0.25f);
  EXPECT_TRUE(show.isSeeThrough());
  EXPECT_TRUE(show.isShown());
  show.run(0.5);
  EXPECT_EQ(show.record.paint(), 0u);
  EXPECT_FALSE(show.isSeeThrough());
}

TEST(PaintedNode, ANeutralValueGivesTheMaterialsOfTheFileBack) {
  PaintShow show({{0.1, "opacity", {"0"}}, {0.2, "opacity", {"1"}}});
  PaintShow never;
  show.run(0.15);
  EXPECT_FALSE(show.isShown());
  never.run(0.15);
  EXPECT_NE(show.hash, never.hash);
  show.run(0.3), never.run(0.3);
  EXPECT_TRUE(show.isShown());
  EXPECT_EQ(show.record.paint(), 0u);
  EXPECT_EQ(show.record.flags, never.record.flags);
}

TEST(PaintedNode, APaintIsPartOfTheStateHashAndNoPaintIsNot) {
  PaintShow red({{0.1, "tint", {"1", "0", "0"}}}), green({{0.1, "tint", {"0", "1", "0"}}}),
      none({{0.1, "show", {}}}), neutral({{0.1, "tint", {"1", "1", "1"}}});
  for (PaintShow* show : {&red, &green, &none, &neutral}) show->run(0.2);
  EXPECT_NE(red.hash, none.hash);
  EXPECT_NE(red.hash, green.hash);
  EXPECT_EQ(neutral.hash, none.hash);
}

TEST(PaintedNode, ResetGoesBackToTheAttributes) {
  PaintShow show({{0.1, "opacity", {"1"}}, {0.2, "reset", {}}}, faded(0.5));
  show.run(0.05);
  EXPECT_EQ(show.seen().opacity, 0.5f);
  show.run(0.15);
  EXPECT_EQ(show.seen(), PaintRecord());
  show.run(0.3);
  EXPECT_EQ(show.seen().opacity, 0.5f);
}

TEST(PaintedNode, WrongArgumentsChangeNothing) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{}, {"2"}, {"-0.1"}, {"nan"}, {"0.5x"}, {"0.5", "0.5"}, {""}}) {
    PaintShow show({{0.1, "opacity", arguments}});
    show.run(0.2);
    EXPECT_EQ(show.record.paint(), 0u);
  }
}

TEST(PaintedNode, ASnapshotKeepsThePaint) {
  const std::vector<PaintShow::Told> told{{0.1, "tint", {"1", "0", "0.5"}}, {0.15, "opacity", {"0.5"}}};
  const std::vector<PaintShow::Told> later{{9, "tint", {}},
                                           {9, "opacity", {}}};  // what is told is in the state
  PaintShow show(told), other(later, {}, false);
  show.run(0.2);
  const auto state = SceneSnapshot(show.scene).save();
  ASSERT_EQ(SceneSnapshot(other.scene).restore(state, "show"), std::nullopt);
  other.next = show.next;
  show.run(0.25), other.run(0.25);
  EXPECT_EQ(show.hash, other.hash);
  EXPECT_EQ(other.seen(), show.seen());
  EXPECT_EQ(other.seen().opacity, 0.5f);
  EXPECT_TRUE(other.isSeeThrough());
  EXPECT_FALSE(SceneSnapshot(other.scene).difference(SceneSnapshot(show.scene).save()));
}

}  // namespace
}  // namespace stadion
