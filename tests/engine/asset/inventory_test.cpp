// What the author is told about a file's content.

#include "tests/engine/asset/gltf_builder.h"
#include "tests/engine/asset/importing.h"

namespace stadion::test {
namespace {

using Builder = GltfBuilder;

TEST(ModelInventory, IsTheSameAfterTheWayThroughText) {
  ModelInventory inventory;
  inventory.add(ContentUse::Used, "2 triangles");
  inventory.add(ContentUse::LeftOut, "1 light (\"sun: bright\")");
  inventory.add(ContentUse::Approximated, "two\nlines");
  const ModelInventory back = ModelInventory::fromText("nonsense\nused\n" + inventory.asText(1000));
  ASSERT_EQ(back.items().size(), 3u);
  EXPECT_EQ(back.texts(ContentUse::Used), std::vector<std::string>{"2 triangles"});
  EXPECT_EQ(back.texts(ContentUse::LeftOut), std::vector<std::string>{"1 light (\"sun: bright\")"});
  EXPECT_EQ(back.texts(ContentUse::Approximated), std::vector<std::string>{"two lines"});
}

TEST(ModelInventory, ThatIsTooLongSaysHowMuchIsMissing) {
  ModelInventory inventory;
  for (int i = 0; i < 100; ++i) inventory.add(ContentUse::Used, "thing " + std::to_string(i));
  const std::string text = inventory.asText(300);
  EXPECT_LE(text.size(), 300u);
  const ModelInventory back = ModelInventory::fromText(text);
  const std::size_t shown = back.items().size() - 1;
  EXPECT_EQ(back.items()[shown - 1].text, "thing " + std::to_string(shown - 1));
  EXPECT_EQ(back.items()[shown].text,
            std::to_string(100 - shown) + " more lines of this list, which is too long");
  EXPECT_EQ(back.items()[shown].use, ContentUse::LeftOut);
}

/// Everything that a studio may put into a file.
Builder fullScene() {
  Builder b;
  b.square();
  b.attribute("NORMAL", std::vector<float>(12, 0.0f), Builder::kFloat, "VEC3", 4);
  for (const char* name : {"TEXCOORD_0", "TEXCOORD_1"})
    b.attribute(name, std::vector<float>(8, 0.5f), Builder::kFloat, "VEC2", 4);
  b.attribute("COLOR_0", std::vector<std::uint8_t>(16, 255), Builder::kUnsignedByte, "VEC4", 4);
  b.json["accessors"].back()["normalized"] = true;
  b.attribute("COLOR_1", std::vector<float>(16, 1.0f), Builder::kFloat, "VEC4", 4);
  b.attribute("TANGENT", std::vector<float>(16, 1.0f), Builder::kFloat, "VEC4", 4);
  b.attribute("JOINTS_0", std::vector<std::uint8_t>(16, 0), Builder::kUnsignedByte, "VEC4", 4);
  b.attribute("WEIGHTS_0", std::vector<float>(16, 0.25f), Builder::kFloat, "VEC4", 4);
  const auto target = b.accessor(std::vector<float>(12, 0.0f), Builder::kFloat, "VEC3", 4);
  const auto times = b.accessor(std::vector<float>{0, 1}, Builder::kFloat, "SCALAR", 2);
  const auto moves = b.accessor(std::vector<float>(6, 0.0f), Builder::kFloat, "VEC3", 2);
  const auto point = b.accessor(std::vector<float>(6, 0.0f), Builder::kFloat, "VEC3", 2);
  b.primitive()["targets"] = {{{"POSITION", target}}};
  b.primitive()["material"] = 0;
  b.json["meshes"][0]["name"] = "body";
  b.json["meshes"][0]["extras"] = {{"targetNames", {"smile"}}};
  b.json["meshes"][0]["primitives"].push_back({{"mode", 1}, {"attributes", {{"POSITION", point}}}});
  b.json["meshes"][0]["primitives"].push_back({{"mode", 0}, {"attributes", {{"POSITION", point}}}});
  b.json["nodes"] = nlohmann::json::parse(
      R"([{"name": "figure", "mesh": 0, "skin": 0}, {"name": "hip"}, {"camera": 0},
          {"extensions": {"KHR_lights_punctual": {"light": 0}}}])");
  b.json["scenes"] = nlohmann::json::parse(R"([{"nodes": [0, 1, 2, 3]}, {"name": "night"}])");
  b.json["skins"] = nlohmann::json::parse(R"([{"name": "rig", "joints": [1]}])");
  b.json["cameras"] =
      nlohmann::json::parse(R"([{"name": "front", "perspective": {"yfov": 1, "znear": 0.1}}])");
  b.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"name", "sun"}, {"type", "directional"}},
                                                           {{"name", "lamp"}, {"type", "point"}}};
  for (const char* name : {"walk", "wave"})
    b.json["animations"].push_back(
        {{"name", name},
         {"samplers", {{{"input", times}, {"output", moves}, {"interpolation", "STEP"}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}});
  b.json["images"] = {{{"uri", "arms.png"}}};
  b.json["samplers"] = nlohmann::json::parse(R"([{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}])");
  b.json["textures"] = nlohmann::json::parse(R"([{"source": 0, "sampler": 0}])");
  b.json["materials"] = nlohmann::json::parse(R"([{"name": "skin",
      "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 0}},
      "normalTexture": {"index": 0}, "occlusionTexture": {"index": 0},
      "extensions": {"KHR_materials_clearcoat": {"clearcoatTexture": {"index": 0}}}},
      {"name": "sign", "extensions": {"KHR_materials_unlit": {}}}])");
  b.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_clearcoat", "ACME_smell"};
  return b;
}

TEST(ModelInventory, NamesWhatAFileHolds) {
  TestFolder folder;
  std::filesystem::copy_file(models() / "arms.png", folder.path() / "arms.png");
  folder.write("full.glb", fullScene().glb());
  const Imported full = importOf(folder.path(), "full.glb");
  ASSERT_TRUE(full.mesh) << full.error;
  for (const char* text :
       {"2 triangles of 1 mesh (\"body\")", "texture coordinates of 1 mesh (\"body\")",
        "vertex colours of 1 mesh (\"body\")", "base colour map of 1 material (\"skin\")",
        "normal map of 1 material (\"skin\")", "occlusion map of 1 material (\"skin\")",
        "metallic-roughness map of 1 material (\"skin\")", "tangents of 1 mesh (\"body\")",
        "unlit surface of 1 material (\"sign\")", "wrap mode \"clamp\" of 1 material (\"skin\")",
        "wrap mode \"mirror\" of 1 material (\"skin\")",
        "1 light (\"sun\"): light( parent=, source=NAME ) lights the show with one",
        "1 camera (\"front\"): rig( model=, camera=NAME ) starts at one",
        "filter \"nearest\" of 1 material (\"skin\")"})
    EXPECT_TRUE(full.used(text)) << text << "\n" << full.all();
  for (const char* text :
       {"1 light (\"lamp\"): no node holds it",
        "2 clips (\"walk\", \"wave\"): an object plays none, use figure( )",
        "1 skin (\"rig\") of 1 bone: an object stands as its meshes are stored, use figure( )",
        "1 morph target (\"smile\"): an object keeps the shape of their weights at rest, use figure( )",
        "1 line", "2 points", "further texture coordinates of 1 mesh (\"body\")",
        "1 further vertex attribute (\"COLOR_1\")",
        "1 further scene (\"night\"): part=NODE of an object shows a node of one",
        "map \"clearcoatTexture\" of 1 material (\"skin\")", "unknown glTF extension \"ACME_smell\""})
    EXPECT_TRUE(full.leftOut(text)) << text << "\n" << full.all();
  EXPECT_EQ(full.losses.all().size(), full.inventory.texts(ContentUse::LeftOut).size() +
                                          full.inventory.texts(ContentUse::Approximated).size());
  EXPECT_TRUE(contains(full.losses.all()[0].message, "full.glb\": left out: "))
      << full.losses.all()[0].message;
}

TEST(ModelInventory, ShowsThreeNamesAndCountsTheOthers) {
  TestFolder folder;
  Builder b;
  b.square();
  for (const char* name : {"a", "b", "c", "d", "e"})
    b.json["cameras"].push_back({{"name", name}, {"perspective", {{"yfov", 1}, {"znear", 1}}}});
  folder.write("m.glb", b.glb());
  const Imported m = importOf(folder.path(), "m.glb");
  EXPECT_TRUE(m.leftOut("5 cameras (\"a\", \"b\", \"c\" and 2 more): no node holds them")) << m.all();
}

TEST(ModelInventory, OfThousandsOfExtensionsIsNotCutInSilence) {
  TestFolder folder;
  Builder b;
  b.square();
  for (int i = 0; i < 3000; ++i) b.json["extensionsUsed"].push_back("ACME_thing_" + std::to_string(i));
  folder.write("m.glb", b.glb());
  const Imported m = importOf(folder.path(), "m.glb");
  ASSERT_TRUE(m.mesh) << m.error;
  EXPECT_TRUE(contains(m.inventory.items().back().text, " more lines of this list"))
      << m.inventory.items().back().text;
}

TEST(ModelInventory, OfOurOwnModelsHoldsNoLoss) {
  const Imported arms = importOf(models(), "arms.glb");
  ASSERT_TRUE(arms.mesh);
  EXPECT_TRUE(arms.losses.all().empty()) << arms.all();
  EXPECT_TRUE(arms.used("base colour map of 1 material (\"m\")")) << arms.all();
}

}  // namespace
}  // namespace stadion::test
