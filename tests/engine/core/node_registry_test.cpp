#include "engine/core/node_registry.h"

#include "engine/core/shared_rows.h"
#include "engine/scene/node.h"
#include "engine/scene/scene_snapshot.h"
#include "engine/script/script.h"
#include "tests/engine/scene/show_fixture.h"
#include "tests/node_types.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

std::unique_ptr<Node> makeNone(const NodeRequest&) {
  return nullptr;
}

constexpr AttributeSpec kPull[] = {
    {.name = "pull", .kind = ValueKind::Number, .help = "how strongly", .standard = "2"}};
constexpr EventSpec kSnapped[] = {{"snapped", "it has torn"}};
constexpr CommandSpec kTug[] = {{"tug", ArgumentKind::None, "tug", "pulls once"}};
constexpr NodeType kRope{.name = "rope",
                         .help = "pulls",
                         .attributes = kPull,
                         .events = kSnapped,
                         .commands = kTug,
                         .traits = {Trait::Placed},
                         .make = makeNone};

std::string faultOf(const NodeType& type) {
  NodeRegistry types = testTypes();
  return types.add(type, "a test").value_or("");
}

TEST(NodeRegistry, AnAddedTypeBelongsToTheLanguage) {
  NodeRegistry types = testTypes();
  ASSERT_EQ(types.add(kRope, "a test"), std::nullopt);
  Diagnostics findings;
  const Document d = checkScript(
      SourceText::make("a.evs", "rope( name=r, position=\"1, 2, 3\", eventmessage=\"snapped, r, tug\" )")
          .value(),
      types, findings);
  for (const Diagnostic& found : findings.all()) ADD_FAILURE() << format(found);
  ASSERT_EQ(d.size(), 1U);
  EXPECT_EQ(d[0].number("pull"), 2);
  EXPECT_EQ(d[0].vec3("position"), Vec3(1, 2, 3));
  EXPECT_EQ(d[0].eventMessages()[0].commandId, commandNamed("tug"));
  EXPECT_EQ(d[0].eventMessages()[0].event, Event("snapped"));
}

TEST(NodeRegistry, ATypeOfATakenNameIsRefused) {
  NodeType timer = kRope;
  timer.name = "timer", timer.kind = "timer";
  EXPECT_EQ(faultOf(timer), "the node type \"timer\" is already there, from engine");
}

TEST(NodeRegistry, ATypeThatIsNotWholeIsRefused) {
  NodeType type = kRope;
  type.make = nullptr;
  EXPECT_EQ(faultOf(type), "\"rope\" has no function that makes a node");
  type = kRope;
  type.name = "Big Rope";
  EXPECT_EQ(faultOf(type), "\"Big Rope\" is not a word of small letters and digits");
  constexpr AttributeSpec kTwice[] = {{.name = "budget", .kind = ValueKind::Number, .help = "again"}};
  type = kRope;
  type.attributes = kTwice;
  EXPECT_TRUE(faultOf(type).starts_with("\"rope\": the attribute \"budget\" is already one of this type"));
  constexpr CommandSpec kOtherSay[] = {{"say", ArgumentKind::None, "say", "says nothing"}};
  type = kRope;
  type.commands = kOtherSay;
  EXPECT_TRUE(
      faultOf(type).starts_with("the command \"say\" of \"rope\" is already there with other arguments"));
}

/// Loads nothing, and has plugins.
class PluginLoader final : public TestLoader {
public:
  std::string plugins() const override { return words; }
  std::string words;
};

TEST(NodeRegistry, ASnapshotNamesThePlugins) {
  const auto saved = [](const std::string& plugins) {
    PluginLoader loader;
    loader.words = plugins;
    loader.files["show"] = [](LoadedScene&) {};
    MeshStore meshes;
    Scene scene(loader, meshes);
    scene.open("show");
    return SceneSnapshot(scene).save();
  };
  const auto restored = [](const std::vector<std::uint8_t>& state, const std::string& plugins) {
    PluginLoader loader;
    loader.words = plugins;
    loader.files["show"] = [](LoadedScene&) {};
    MeshStore meshes;
    Scene scene(loader, meshes);
    return SceneSnapshot(scene).restore(state, "show").value_or("");
  };
  const auto plain = saved(""), spring = saved("spring 1.0 (12ab)");
  EXPECT_EQ(restored(plain, ""), "");
  EXPECT_EQ(restored(spring, "spring 1.0 (12ab)"), "");
  EXPECT_EQ(restored(spring, ""),
            "it was saved with the plugins spring 1.0 (12ab), and this program has no plugins");
  EXPECT_EQ(restored(plain, "spring 2.0 (34cd)"),
            "it was saved with no plugins, and this program has the plugins spring 2.0 (34cd)");
}

}  // namespace
}  // namespace stadion
