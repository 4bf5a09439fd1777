/// "hall/roof" in a script: a part of a model that hides, moves and collides by itself.

#include "engine/scene/placed_node.h"
#include "engine/scene/scene.h"
#include "tests/engine/asset/gltf_builder.h"
#include "tests/programs/program.h"
#include "tests/show/player/played_show.h"

#include <gtest/gtest.h>
#include <map>

namespace stadion::test {
namespace {

/// Plates of 4 m x 4 m: a floor, a roof 3 m above it and a lamp 1 m below the roof.
GltfBuilder pavilion() {
  GltfBuilder b;
  b.attribute("POSITION", std::vector<float>{-2, 0, -2, 2, 0, -2, 2, 0, 2, -2, 0, 2}, GltfBuilder::kFloat,
              "VEC3", 4);
  b.primitive()["indices"] =
      b.accessor(std::vector<std::uint16_t>{0, 2, 1, 0, 3, 2}, GltfBuilder::kUnsignedShort, "SCALAR", 6);
  b.json["nodes"] = nlohmann::json::parse(
      R"([{"name": "floor", "mesh": 0, "children": [1]},
          {"name": "roof", "mesh": 0, "translation": [0, 3, 0], "children": [2]},
          {"name": "lamp", "mesh": 0, "translation": [0, -1, 0], "scale": [0.1, 0.1, 0.1]}])");
  return b;
}

/// The show "show.evs" beside the model, ready to be played.
struct PartShow : SteppedShow {
  explicit PartShow(const std::string& script, const std::string& inner = "") {
    folder.write("pavilion.glb", pavilion().glb());
    folder.write("inner.evs", inner);
    player = openShow(folder.write("show.evs", script));
  }
  void play(std::uint64_t frames) {
    for (; frames > 0; --frames) {
      SteppedShow::play(1);
      for (const ChangeSet::Instance& i : changes.instances) seen[i.record.owner] = i.record;
      if (changes.paintsChanged) paints = changes.paints;
    }
  }
  NodeRef named(const std::string& name) const { return player->scene().tree().resolve(name, {1, 0}); }
  Affine placeOf(const std::string& name) {
    const auto* node = dynamic_cast<const PlacedNode*>(player->scene().find(named(name)));
    return node ? player->scene().placements().world(node->placement()) : Affine::Identity();
  }
  bool isShown(const std::string& name) {
    const auto at = seen.find(named(name));
    return at != seen.end() && (at->second.flags & InstanceRecord::kShown) != 0;
  }
  TestFolder folder;
  std::map<NodeRef, InstanceRecord> seen;
  std::vector<PaintRecord> paints;
};

constexpr const char* kTimer = "timer( period=0.5, eventmessage=\"timesup, ";

TEST(ObjectParts, APartHidesByItselfAndTheRestStays) {
  PartShow show(std::string("object( name=hall, file=pavilion.glb )\n") + kTimer + "hall/roof, hide\" )\n");
  ASSERT_TRUE(show.player);
  show.play(20);
  EXPECT_TRUE(show.isShown("hall"));
  EXPECT_TRUE(show.isShown("hall/roof"));
  EXPECT_LT((show.placeOf("hall/roof").translation() - Vec3(0, 0, 3)).norm(), 1e-12);
  show.play(20);
  EXPECT_TRUE(show.isShown("hall"));
  EXPECT_FALSE(show.isShown("hall/roof"));
}

/// Of the part alone: neither of its object nor of a part below it that the script names.
TEST(ObjectParts, APartTakesPaintOfItsOwn) {
  PartShow show(
      "object( name=hall, file=pavilion.glb )\n" + std::string(kTimer) +
      "hall/roof, tint 1 0.2 0.2\", eventmessage=\"timesup, hall/roof, opacity 0.5\", "
      "eventmessage=\"timesup, hall/roof/lamp, show\", eventmessage=\"timesup, hall/roof, reset, 0.2\" )\n");
  ASSERT_TRUE(show.player);
  show.play(20);
  const auto record = [&](const char* name) { return show.seen.at(show.named(name)); };
  EXPECT_EQ(record("hall/roof").paint(), 0u);
  show.play(15);
  ASSERT_EQ(record("hall/roof").paint(), 1u);
  EXPECT_NE(record("hall/roof").flags & InstanceRecord::kTransparent, 0u);
  ASSERT_EQ(show.paints.size(), 1u);
  EXPECT_EQ(show.paints[0].opacity, 0.5f);
  EXPECT_EQ(show.paints[0].tint[0], 1);
  EXPECT_LT(show.paints[0].tint[1], 0.1f);
  for (const char* other : {"hall", "hall/roof/lamp"}) {
    EXPECT_EQ(record(other).paint(), 0u) << other;
    EXPECT_EQ(record(other).flags & InstanceRecord::kTransparent, 0u) << other;
  }
  show.play(15);
  EXPECT_EQ(record("hall/roof").paint(), 0u);
  EXPECT_EQ(record("hall/roof").flags & InstanceRecord::kTransparent, 0u);
}

TEST(ObjectParts, APartGoesWithItsObjectAndAPartOfAPartWithThePart) {
  PartShow show(
      "group( name=cart, position=\"10, 0, 0\" )\n"
      "object( name=hall, parent=cart, file=pavilion.glb, orientation=\"0, 0, 90\" )\n"
      "timer( period=9, eventmessage=\"timesup, hall/roof/lamp, hide\", eventmessage=\"timesup, hall/roof, "
      "show\" )\n"
      "path( parent=cart, target=hall/roof, key=\"0, 0, 0, 0, 0, 0, 0\", key=\"1, 0, 0, 6, 0, 0, 0\" )\n");
  ASSERT_TRUE(show.player);
  show.play(1);
  EXPECT_LT((show.placeOf("hall").translation() - Vec3(10, 0, 0)).norm(), 1e-12);
  show.play(120);
  EXPECT_LT((show.placeOf("hall/roof").translation() - Vec3(10, 0, 6)).norm(), 1e-9);
  EXPECT_LT((show.placeOf("hall/roof/lamp").translation() - Vec3(10, 0, 5)).norm(), 1e-9);
}

TEST(ObjectParts, ABodyRestsOnAPart) {
  PartShow show("object( name=hall, file=pavilion.glb )\n"
                "forcelinear( name=gravity, direction=\"0, 0, -1\" )\n"
                "dynobject( name=ball, file=football.3ds, position=\"0, 0, 4\", hook=gravity )\n"
                "dynamics( collider=hall/roof, collidee=ball )\n");
  ASSERT_TRUE(show.player);
  show.play(180);
  EXPECT_GT(show.placeOf("ball").translation().z(), 3);
}

/// The inner script names the roof, so the outer one may too.
TEST(ObjectParts, APartInASubSceneIsReachedThroughItsScene) {
  PartShow show("scene( name=arena, file=inner.evs, position=\"0, 7, 0\" )\n" + std::string(kTimer) +
                    "arena/hall/roof, hide\" )\n",
                "object( name=hall, file=pavilion.glb )\ntimer( period=9, eventmessage=\"timesup, hall/roof, "
                "show\" )\n");
  ASSERT_TRUE(show.player);
  show.play(20);
  EXPECT_TRUE(show.isShown("arena/hall/roof"));
  EXPECT_LT((show.placeOf("arena/hall/roof").translation() - Vec3(0, 7, 3)).norm(), 1e-12);
  show.play(20);
  EXPECT_FALSE(show.isShown("arena/hall/roof"));
}

TEST(ObjectParts, WrongNamesAreErrorsAtTheirPlaces) {
  PartShow group("group( name=hall )\ntimer( period=9, eventmessage=\"timesup, hall/roof, show\" )\n");
  EXPECT_FALSE(group.player);
  PartShow field("object( name=hall, file=pavilion.glb )\ntimer( period=9, eventmessage=\"timesup, "
                 "hall/roof, play\" )\n");
  EXPECT_FALSE(field.player) << "an object takes no such command";
  PartShow unknown("object( name=hall, file=pavilion.glb )\ntimer( period=9, eventmessage=\"timesup, "
                   "hall/attic, show\" )\n");
  ASSERT_TRUE(unknown.player) << "a stand-in is shown, as for each file that cannot be read";
  unknown.play(1);
  EXPECT_TRUE(unknown.isShown("hall/attic"));
}

}  // namespace
}  // namespace stadion::test
