// glTF files: accessors, topology, scenes, extensions, and files that are wrong on purpose.

#include "tests/engine/asset/gltf_builder.h"
#include "tests/engine/asset/importing.h"

#include "engine/asset/mesh_checks.h"

namespace stadion::test {
namespace {

using Builder = GltfBuilder;

class Gltf : public ::testing::Test {
protected:
  Imported load(const Builder& b) {
    folder_.write("m.glb", b.glb());
    return importOf(folder_.path(), "m.glb");
  }
  std::string errorOf(const Builder& b) {
    const Imported m = load(b);
    EXPECT_FALSE(m.mesh) << b.json.dump();
    return m.error;
  }
  TestFolder folder_;
};

void expectSquare(const Imported& m, double side = 1) {
  ASSERT_TRUE(m.mesh) << m.error;
  EXPECT_EQ(m.mesh->indices.size(), 6u);
  EXPECT_NEAR(area(*m.mesh), side * side, 1e-5 * side);
  EXPECT_TRUE(m.mesh->bounds.hi.isApprox(Vec3(side, 0, side), 1e-5)) << m.mesh->bounds.hi.transpose();
  for (const auto& n : m.mesh->normals) EXPECT_NEAR(n[1], -1, 1e-5) << "+Z of the file is -Y of the show";
}

TEST_F(Gltf, CornersMayHave8Or16Or32BitsOrBeInOrder) {
  Builder bytes, words, inOrder;
  bytes.square();
  bytes.primitive()["indices"] =
      bytes.accessor(std::vector<std::uint8_t>{0, 1, 2, 0, 2, 3}, Builder::kUnsignedByte, "SCALAR", 6);
  expectSquare(load(bytes));
  words.square();
  words.primitive()["indices"] =
      words.accessor(std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}, Builder::kUnsignedInt, "SCALAR", 6);
  expectSquare(load(words));
  inOrder.attribute("POSITION", std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0},
                    Builder::kFloat, "VEC3", 6);
  expectSquare(load(inOrder));
}

TEST_F(Gltf, StripsAndFansFaceTheSameWay) {
  for (const int mode : {5, 6}) {
    Builder b;
    b.square();
    const std::vector<std::uint16_t> strip{0, 1, 3, 2}, fan{0, 1, 2, 3};
    b.primitive()["indices"] = b.accessor(mode == 5 ? strip : fan, Builder::kUnsignedShort, "SCALAR", 4);
    b.primitive()["mode"] = mode;
    expectSquare(load(b));
  }
}

TEST_F(Gltf, SparseAccessorsReplaceSomeElements) {
  Builder b;
  b.square();
  // all corners at 0 but for three, with and without a view of their own
  for (const bool based : {true, false}) {
    const std::vector<std::uint8_t> places{1, 2, 3};
    const std::vector<float> values{1, 0, 0, 1, 1, 0, 0, 1, 0};
    const auto placeView = b.view(places.data(), places.size()), valueView = b.view(values.data(), 36);
    const auto position = based ? b.accessor(std::vector<float>(12, 0.0f), Builder::kFloat, "VEC3", 4)
                                : b.emptyAccessor(Builder::kFloat, "VEC3", 4);
    b.json["accessors"][position]["sparse"] = {
        {"count", 3},
        {"indices", {{"bufferView", placeView}, {"componentType", Builder::kUnsignedByte}}},
        {"values", {{"bufferView", valueView}}}};
    b.primitive()["attributes"]["POSITION"] = position;
    expectSquare(load(b));
  }
}

TEST_F(Gltf, QuantizedMeshesAreScaledByTheirNode) {
  Builder b;
  b.square();
  b.attribute("POSITION",
              std::vector<std::int16_t>{0, 0, 0, 0, 32767, 0, 0, 0, 32767, 32767, 0, 0, 0, 32767, 0, 0},
              Builder::kShort, "VEC3", 4);
  auto& position = b.json["accessors"].back();
  position["normalized"] = true;
  b.json["bufferViews"].back()["byteStride"] = 8;
  b.attribute("NORMAL", std::vector<std::int8_t>{0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0},
              Builder::kByte, "VEC3", 4);
  b.json["accessors"].back()["normalized"] = true;
  b.json["bufferViews"].back()["byteStride"] = 4;
  b.json["nodes"][0]["scale"] = {5, 5, 5};
  b.json["extensionsUsed"] = b.json["extensionsRequired"] = {"KHR_mesh_quantization"};
  const Imported m = load(b);
  expectSquare(m, 5);
  EXPECT_TRUE(m.used("glTF extension \"KHR_mesh_quantization\"")) << m.all();
}

TEST_F(Gltf, BuffersMayLieInTheTextOrInFilesWithBlanks) {
  Builder b;
  b.square();
  folder_.write("a b.bin", b.bytes);
  folder_.write("m.gltf", b.gltf("a%20b.bin"));
  expectSquare(importOf(folder_.path(), "m.gltf"));
  std::filesystem::create_directory(folder_.path() / "sub");
  folder_.write("sub/m.gltf", b.gltf("../a%20b.bin"));
  expectSquare(importOf(folder_.path(), "sub/m.gltf"));
  folder_.write("m.gltf", b.gltf("c%20d.bin"));
  EXPECT_TRUE(
      contains(importOf(folder_.path(), "m.gltf").error, "buffer 0: the file \"c d.bin\" is missing"));
  folder_.write("m.gltf", b.gltf("data:application/octet-stream;base64,?"));
  EXPECT_TRUE(contains(importOf(folder_.path(), "m.gltf").error, "buffer 0: its data is not base64"));
  folder_.write("m.gltf", b.gltf("data:application/octet-stream;base64,AAAA"));
  EXPECT_TRUE(contains(importOf(folder_.path(), "m.gltf").error, "buffer 0: it has 3 bytes instead of 60"));
}

TEST_F(Gltf, FilesOutsideTheFolderAreNotRead) {
  Builder b;
  b.square();
  const auto inner = folder_.path() / "inner";
  std::filesystem::create_directory(inner);
  folder_.write("secret.bin", b.bytes);
  folder_.write("inner/m.gltf", b.gltf("%2e%2e/secret.bin"));
  EXPECT_TRUE(contains(importOf(inner, "m.gltf").error, "lies outside the asset folder"));
  folder_.write("inner/m.gltf", b.gltf((folder_.path() / "secret.bin").string()));
  EXPECT_FALSE(importOf(inner, "m.gltf").mesh);
}

TEST_F(Gltf, TheDefaultSceneIsShownAndOthersAreNamed) {
  Builder b;
  b.square();
  b.json["nodes"] = nlohmann::json::parse(R"([{"mesh": 0}, {"mesh": 0, "translation": [0, 0, -7]}])");
  b.json["scenes"] =
      nlohmann::json::parse(R"([{"name": "day", "nodes": [0]}, {"name": "night", "nodes": [1]}])");
  b.json["scene"] = 1;
  const Imported m = load(b);
  ASSERT_TRUE(m.mesh) << m.error;
  EXPECT_NEAR(m.mesh->bounds.lo.y(), 7, 1e-6);
  EXPECT_TRUE(m.leftOut("1 further scene (\"day\"): part=NODE of an object shows a node of one")) << m.all();
  b.json.erase("scenes"), b.json.erase("scene");
  const Imported all = load(b);
  ASSERT_TRUE(all.mesh) << all.error;
  EXPECT_EQ(all.mesh->indices.size(), 12u) << "without scenes, all roots are shown";
}

TEST_F(Gltf, NodesTurnScaleAndMirrorTheirMeshes) {
  Builder b;
  b.square();
  b.json["nodes"] = nlohmann::json::parse(
      R"([{"children": [1], "rotation": [0, 0, 0.70710678, 0.70710678]},
          {"mesh": 0, "scale": [2, 3, 1], "translation": [1, 0, 0]}])");
  const Imported m = load(b);
  ASSERT_TRUE(m.mesh) << m.error;
  // x: 1..3 and y: 0..3 in the parent, turned by a quarter about z: x -3..0, y 1..3; then +Y up becomes +Z up
  EXPECT_TRUE(m.mesh->bounds.lo.isApprox(Vec3(-3, 0, 1), 1e-5)) << m.mesh->bounds.lo.transpose();
  EXPECT_TRUE(m.mesh->bounds.hi.isApprox(Vec3(0, 0, 3), 1e-5)) << m.mesh->bounds.hi.transpose();
  b.json["nodes"][1] = {{"mesh", 0}, {"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
  const Imported mirrored = load(b);
  ASSERT_TRUE(mirrored.mesh) << mirrored.error;
  for (const auto& n : mirrored.mesh->normals) EXPECT_NEAR(n[1], -1, 1e-5);
}

/// A square with a picture, whose texture is used with this JSON.
Builder pictured(const nlohmann::json& info) {
  Builder b;
  b.square();
  b.attribute("TEXCOORD_0", std::vector<float>{0, 0, 1, 0, 1, 1, 0, 1}, Builder::kFloat, "VEC2", 4);
  b.attribute("TEXCOORD_1", std::vector<float>(8, 0.25f), Builder::kFloat, "VEC2", 4);
  b.json["images"] = {{{"uri", "arms.png"}}};
  b.json["textures"] = {{{"source", 0}}};
  b.json["materials"] = {{{"name", "wood"}, {"pbrMetallicRoughness", {{"baseColorTexture", info}}}}};
  b.primitive()["material"] = 0;
  return b;
}

TEST_F(Gltf, TextureTransformsMoveTextureCoordinates) {
  std::filesystem::copy_file(models() / "arms.png", folder_.path() / "arms.png");
  // a quarter turn: (u, v) becomes (v, -u)
  const Imported m = load(pictured(nlohmann::json::parse(
      R"({"index": 0, "extensions": {"KHR_texture_transform":
          {"offset": [0.5, 2], "scale": [2, 4], "rotation": 1.57079632679}}})")));
  ASSERT_TRUE(m.mesh) << m.error;
  const auto uvAt = [&](float x, float z) {
    for (std::size_t i = 0; i < m.mesh->positions.size(); ++i)
      if (m.mesh->positions[i][0] == x && m.mesh->positions[i][2] == z) return m.mesh->uvs[i];
    return std::array<float, 2>{-1, -1};
  };
  EXPECT_NEAR(uvAt(0, 0)[0], 0.5, 1e-5);
  EXPECT_NEAR(uvAt(0, 0)[1], 2, 1e-5);
  EXPECT_NEAR(uvAt(1, 1)[0], 4.5, 1e-5);
  EXPECT_NEAR(uvAt(1, 1)[1], 0, 1e-5);
  EXPECT_TRUE(m.used("texture transform of 1 material (\"wood\")")) << m.all();
}

TEST_F(Gltf, MapsWithOtherTextureCoordinatesThanTheBaseColourKeepThem) {
  std::filesystem::copy_file(models() / "arms.png", folder_.path() / "arms.png");
  Builder b = pictured({{"index", 0}, {"texCoord", 1}});
  const Imported second = load(b);
  ASSERT_TRUE(second.mesh) << second.error;
  EXPECT_NEAR(second.mesh->uvs.at(0)[0], 0.25, 1e-6);
  b.json["materials"][0]["emissiveFactor"] = {1, 1, 1};
  b.json["materials"][0]["emissiveTexture"] = {{"index", 0}};
  const Imported both = load(b);
  ASSERT_TRUE(both.mesh) << both.error;
  const auto& maps = both.mesh->materials[0].maps;
  EXPECT_TRUE(maps[kBaseMap].secondUvs);
  EXPECT_EQ(maps[kEmissiveMap].texture, 0);
  EXPECT_FALSE(maps[kEmissiveMap].movesUvs());
  EXPECT_NEAR(both.mesh->secondUvs.at(0)[0], 0.25, 1e-6);
  EXPECT_NEAR(both.mesh->uvs.at(0)[0], 0, 1e-6);
  EXPECT_TRUE(both.used("emissive map of 1 material (\"wood\")")) << both.all();
}

TEST_F(Gltf, TheStrengthOfEmissionMultipliesItsFactor) {
  Builder b;
  b.square();
  b.json["materials"] = nlohmann::json::parse(
      R"([{"emissiveFactor": [0.5, 0, 0], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}}}])");
  b.primitive()["material"] = 0;
  const Imported m = load(b);
  ASSERT_TRUE(m.mesh) << m.error;
  EXPECT_NEAR(m.mesh->materials[0].emissive[0], 4, 1e-6);
}

TEST_F(Gltf, ThatRequiresWhatIsUnknownIsRefused) {
  Builder b;
  b.square();
  b.json["extensionsRequired"] = {"KHR_texture_basisu"};
  EXPECT_TRUE(
      contains(errorOf(b), "requires the glTF extension \"KHR_texture_basisu\", which shows do not read"));
  b.json["extensionsRequired"] = {"KHR_materials_unlit"};
  EXPECT_TRUE(load(b).mesh);
}

TEST_F(Gltf, ThatIsWrongIsNamedWithItsPlace) {
  const struct {
    const char *pointer, *value, *error;
  } cases[] = {
      {"/accessors/0/count", "5", "accessor 0: it reaches beyond its buffer view"},
      {"/accessors/0/count", "4611686018427387904", "accessor 0: \"count\" is not a whole number"},
      {"/accessors/0/count", "1000000000", "accessor 0: it has more than 60000000 elements"},
      {"/accessors/0/byteOffset", "4", "accessor 0: it reaches beyond its buffer view"},
      {"/accessors/0/byteOffset", "9007199254740991", "accessor 0: it reaches beyond its buffer view"},
      {"/accessors/0/componentType", "5124", "accessor 0: its type is unknown"},
      {"/accessors/0/type", "\"VEC9\"", "accessor 0: its type is unknown"},
      {"/accessors/0/bufferView", "7", "accessor 0: \"bufferView\" names number 7, but there are 2"},
      {"/accessors/1/count", "-1", "accessor 1: \"count\" is not a whole number"},
      {"/bufferViews/0/byteLength", "1000", "buffer view 0: it reaches beyond its buffer"},
      {"/bufferViews/0/byteOffset", "9007199254740991", "buffer view 0: it reaches beyond its buffer"},
      {"/bufferViews/0/byteStride", "9007199254740991", "accessor 0: it reaches beyond its buffer view"},
      {"/bufferViews/0/byteStride", "1", "accessor 0: it reaches beyond its buffer view"},
      {"/meshes/0/primitives/0/indices", "0", "accessor 0: it holds no single numbers"},
      {"/meshes/0/primitives/0/mode", "9", "mesh 0, primitive 0: its mode is unknown"},
      {"/meshes/0/primitives/0/material", "0",
       "mesh 0, primitive 0: \"material\" names number 0, but there are 0"},
      {"/nodes/0/mesh", "1", "node 0: \"mesh\" names number 1, but there are 1"},
      {"/nodes/0/children", "[0]", "node 0: it is its own ancestor"},
      {"/nodes/0/name", "7", "node 0: \"name\" is not a text"},
      {"/scenes/0/nodes", "[1]", "scene 0: \"nodes\" names number 1, but there are 1"},
      {"/meshes/0/primitives/0/extensions",
       R"({"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {}}})",
       "mesh 0, primitive 0: its compressed data is damaged"},
      {"/bufferViews/0/extensions",
       R"({"EXT_meshopt_compression": {"buffer": 0, "byteLength": 48, "byteStride": 12, "count": 4, "mode": "ATTRIBUTES"}})",
       "buffer view 0: its compressed data is damaged"},
      {"/bufferViews/0/extensions",
       R"({"EXT_meshopt_compression": {"buffer": 0, "byteLength": 48, "byteStride": 12, "count": 4000000000, "mode": "ATTRIBUTES"}})",
       "buffer view 0: it unpacks to more than a show's files may have"},
  };
  for (const auto& c : cases) {
    Builder b;
    b.square();
    b.json[nlohmann::json::json_pointer(c.pointer)] = nlohmann::json::parse(c.value);
    const std::string error = errorOf(b);
    EXPECT_TRUE(contains(error, std::string("is wrong in ") + c.error))
        << c.pointer << " = " << c.value << ": " << error;
  }
}

TEST_F(Gltf, WithASparsePartThatIsWrongIsRefused) {
  const struct {
    const char *pointer, *value, *error;
  } cases[] = {{"/count", "1", "its sparse part names an element that does not exist"},
               {"/count", "9", "its sparse part reaches beyond its buffer view"},
               {"/indices/byteOffset", "3", "its sparse part reaches beyond its buffer view"},
               {"/values/bufferView", "99", "\"bufferView\" names number 99"},
               {"/indices/componentType", "5126", "its sparse part names no data"}};
  for (const auto& c : cases) {
    Builder b;
    b.square();
    const std::vector<float> values{9, 9, 9};
    const std::vector<std::uint32_t> places{4};  // one more than there are
    const auto placeView = b.view(places.data(), 4), valueView = b.view(values.data(), 12);
    b.json["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", placeView}, {"componentType", Builder::kUnsignedInt}}},
        {"values", {{"bufferView", valueView}}}};
    b.json["accessors"][0]["sparse"][nlohmann::json::json_pointer(c.pointer)] =
        nlohmann::json::parse(c.value);
    EXPECT_TRUE(contains(errorOf(b), c.error)) << c.pointer;
  }
}

TEST_F(Gltf, WithDeepJsonOrDeepNodesIsRefused) {
  folder_.write("m.gltf", R"({"asset": {"version": "2.0"}, "extras": )" + std::string(200'000, '['));
  EXPECT_TRUE(contains(importOf(folder_.path(), "m.gltf").error, "its JSON is nested too deep"));
  Builder b;
  b.square();
  for (int i = 0; i < 1000; ++i) b.json["nodes"][static_cast<std::size_t>(i)]["children"] = {i + 1};
  b.json["nodes"][1000]["mesh"] = 0;
  EXPECT_TRUE(contains(errorOf(b), "nests its nodes deeper than 256"));
  b.json["nodes"] = nlohmann::json::parse(R"([{"children": [2]}, {"children": [2]}, {"mesh": 0}])");
  EXPECT_TRUE(contains(errorOf(b), "node 1: its child 2 has two parents"));
}

TEST_F(Gltf, ATriangleWithoutVertexIsLeftOutByName) {
  Builder b;
  b.square();
  b.primitive()["indices"] =
      b.accessor(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 9}, Builder::kUnsignedShort, "SCALAR", 6);
  const Imported m = load(b);
  ASSERT_TRUE(m.mesh) << m.error;
  EXPECT_EQ(m.mesh->indices.size(), 3u);
  EXPECT_TRUE(m.leftOut("1 triangle of mesh 0, primitive 0 with a vertex that does not exist")) << m.all();
}

}  // namespace
}  // namespace stadion::test
