// Maps of materials, from glTF files to meshes.

#include "engine/asset/mesh_checks.h"
#include "tests/engine/asset/gltf_builder.h"
#include "tests/engine/asset/importing.h"

#include <cmath>
#include <numbers>

namespace stadion::test {
namespace {

using Json = nlohmann::json;

/// A square with a picture and this material.
GltfBuilder materialSquare(const Json& material) {
  GltfBuilder b;
  b.square();
  b.attribute("NORMAL", std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, b.kFloat, "VEC3", 4);
  b.attribute("TEXCOORD_0", std::vector<float>{0, 0, 1, 0, 1, 1, 0, 1}, b.kFloat, "VEC2", 4);
  b.attribute("TEXCOORD_1", std::vector<float>{0, 0.5f, 1, 0.5f, 1, 1, 0, 1}, b.kFloat, "VEC2", 4);
  b.json["images"] = {{{"uri", "arms.png"}}, {{"uri", "none.png"}}};
  b.json["textures"] = {{{"source", 0}}, {{"source", 1}}};
  b.json["materials"] = Json::array({material});
  b.json["materials"][0]["name"] = "m";
  b.primitive()["material"] = 0;
  return b;
}

class MaterialImport : public ::testing::Test {
protected:
  MaterialImport() { std::filesystem::copy_file(models() / "arms.png", folder_.path() / "arms.png"); }
  Imported load(const GltfBuilder& b) {
    folder_.write("m.glb", b.glb());
    Imported m = importOf(folder_.path(), "m.glb");
    EXPECT_TRUE(m.mesh) << m.error;
    return m;
  }
  Imported load(const std::string& material) { return load(materialSquare(Json::parse(material))); }
  TestFolder folder_;
};

TEST_F(MaterialImport, ReadsAllMapsWithTheirStrengths) {
  const Imported m = load(R"({"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": 0}},
      "normalTexture": {"index": 0, "scale": 0.5}, "occlusionTexture": {"index": 0, "strength": 0.25}})");
  const Material& material = m.mesh->materials[0];
  EXPECT_FALSE(material.maps[kBaseMap].given() || material.maps[kEmissiveMap].given());
  for (const MapKind kind : {kMetallicRoughnessMap, kNormalMap, kOcclusionMap})
    EXPECT_EQ(material.maps[kind].texture, 0);
  EXPECT_EQ(m.mesh->textures.size(), 1u);
  EXPECT_EQ(material.normalScale, 0.5f);
  EXPECT_EQ(material.occlusionStrength, 0.25f);
  EXPECT_FALSE(m.mesh->uvs.empty() || !m.mesh->secondUvs.empty());
}

TEST_F(MaterialImport, ReadsSamplers) {
  GltfBuilder b =
      materialSquare(Json::parse(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})"));
  b.json["textures"][0]["sampler"] = 0;
  const auto samplerOf = [&](const char* json) {
    b.json["samplers"] = Json::array({Json::parse(json)});
    return load(b).mesh->materials[0].maps[kBaseMap].sampler;
  };
  constexpr WrapMode kRepeat = WrapMode::Repeat;
  EXPECT_EQ(samplerOf("{}"), Sampler{});
  EXPECT_EQ(samplerOf(R"({"wrapS": 33071, "wrapT": 33648})"), (Sampler{WrapMode::Clamp, WrapMode::Mirror}));
  EXPECT_EQ(samplerOf(R"({"magFilter": 9728})"), (Sampler{kRepeat, kRepeat, true}));
  const std::pair<int, Sampler> filters[]{{9728, {kRepeat, kRepeat, false, true, MipmapUse::None}},
                                          {9729, {kRepeat, kRepeat, false, false, MipmapUse::None}},
                                          {9984, {kRepeat, kRepeat, false, true, MipmapUse::Nearest}},
                                          {9985, {kRepeat, kRepeat, false, false, MipmapUse::Nearest}},
                                          {9986, {kRepeat, kRepeat, false, true, MipmapUse::Between}},
                                          {9987, {kRepeat, kRepeat, false, false, MipmapUse::Between}}};
  for (const auto& [number, sampler] : filters)
    EXPECT_EQ(samplerOf(("{\"minFilter\": " + std::to_string(number) + "}").c_str()), sampler) << number;
}

TEST_F(MaterialImport, OfMapsThatAgreeKeepsTheHashOfTheBaseColourAlone) {
  const char* moved = R"({"index": 0, "extensions": {"KHR_texture_transform": {"scale": [2, 3]}}})";
  const auto with = [&](const std::string& more) {
    return load(R"({"pbrMetallicRoughness": {"baseColorTexture": )" + std::string(moved) + "}" + more + "}");
  };
  const Imported base = with(""), both = with(R"(, "normalTexture": )" + std::string(moved));
  EXPECT_EQ(both.mesh->uvs, base.mesh->uvs);
  EXPECT_FALSE(both.mesh->materials[0].maps[kNormalMap].movesUvs());
  EXPECT_NE(both.mesh->hash, base.mesh->hash);
  Mesh& plain = *both.mesh;
  plain.materials[0].maps[kNormalMap] = {};
  plain.tangents.clear();
  finish(plain);
  EXPECT_EQ(plain.hash, base.mesh->hash);
}

TEST_F(MaterialImport, GivesMapsThatDisagreeTransformsOfTheirOwn) {
  const Imported m = load(R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
      "normalTexture": {"index": 0, "texCoord": 1, "extensions": {"KHR_texture_transform":
          {"offset": [0.5, 2], "scale": [2, 4], "rotation": 1.57079632679}}}})");
  const auto& maps = m.mesh->materials[0].maps;
  EXPECT_FALSE(maps[kBaseMap].movesUvs());
  EXPECT_TRUE(maps[kNormalMap].secondUvs);
  // A quarter turn: (u, v) becomes (v, -u).
  constexpr std::array<float, 6> kWanted{0, 4, 0.5f, -2, 0, 2};
  for (std::size_t i = 0; i < kWanted.size(); ++i)
    EXPECT_NEAR(maps[kNormalMap].uvTransform[i], kWanted[i], 1e-5) << i;
  ASSERT_EQ(m.mesh->secondUvs.size(), m.mesh->positions.size());
  for (std::size_t i = 0; i < m.mesh->uvs.size(); ++i)
    EXPECT_NEAR(m.mesh->secondUvs[i][1], 0.5 + 0.5 * double{m.mesh->uvs[i][1]}, 1e-6);
  EXPECT_TRUE(m.losses.all().empty()) << m.all();
}

TEST_F(MaterialImport, TurnsTangentsWithTheirNode) {
  GltfBuilder b = materialSquare(Json::parse(R"({"normalTexture": {"index": 0}})"));
  std::vector<float> tangents;
  for (int i = 0; i < 4; ++i) tangents.insert(tangents.end(), {1, 0, 0, 1});
  b.attribute("TANGENT", tangents, b.kFloat, "VEC4", 4);
  const auto tangentOf = [&](const char* node) {
    b.json["nodes"] = Json::array({Json::parse(node)});
    return load(b).mesh->tangents.at(0);
  };
  // +Y up becomes +Z up: x stays, y becomes z.
  const auto expect = [&](const char* node, const std::array<float, 4>& wanted) {
    const auto found = tangentOf(node);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(found[k], wanted[k], 1e-6) << node << ", " << k;
  };
  expect(R"({"mesh": 0, "scale": [3, 1, 1]})", {1, 0, 0, 1});
  expect(R"({"mesh": 0, "rotation": [0, 0, 0.70710678, 0.70710678]})", {0, 0, 1, 1});
  expect(R"({"mesh": 0, "scale": [-1, 1, 1]})", {-1, 0, 0, -1});
  b.json["materials"][0].erase("normalTexture");
  EXPECT_TRUE(load(b).mesh->tangents.empty());
}

TEST_F(MaterialImport, OfUnlitSurfacesReadsTheBaseColourAlone) {
  const Imported m = load(R"({"extensions": {"KHR_materials_unlit": {}}, "normalTexture": {"index": 0},
      "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})");
  EXPECT_TRUE(m.mesh->materials[0].unlit);
  EXPECT_TRUE(m.mesh->materials[0].maps[kBaseMap].given());
  EXPECT_FALSE(m.mesh->materials[0].maps[kNormalMap].given());
  EXPECT_TRUE(m.used("unlit surface of 1 material (\"m\")")) << m.all();
}

TEST_F(MaterialImport, NamesWhatIsWrongWithAMap) {
  const Imported far = load(R"({"normalTexture": {"index": 0, "scale": 1e39},
      "occlusionTexture": {"index": 0, "strength": -2}})");
  EXPECT_EQ(far.mesh->materials[0].normalScale, kMostNormalScale);
  EXPECT_EQ(far.mesh->materials[0].occlusionStrength, 0);
  EXPECT_EQ(far.inventory.texts(ContentUse::Approximated).size(), 2u) << far.all();
  const Imported missing = load(R"({"normalTexture": {"index": 1}, "occlusionTexture": {"index": 0}})");
  EXPECT_FALSE(missing.mesh->materials[0].maps[kNormalMap].given());
  EXPECT_TRUE(missing.mesh->materials[0].maps[kOcclusionMap].given());
  EXPECT_TRUE(contains(missing.all(), "left out: the texture \"none.png\"")) << missing.all();
  GltfBuilder b = materialSquare(Json::parse(R"({"normalTexture": {"index": 0, "texCoord": 1}})"));
  b.primitive()["attributes"].erase("TEXCOORD_0");
  b.primitive()["attributes"].erase("TEXCOORD_1");
  const Imported bare = load(b);
  EXPECT_TRUE(bare.mesh->uvs.empty() && bare.mesh->secondUvs.empty());
  EXPECT_TRUE(contains(bare.all(), "left out: maps that lack texture coordinates of 1 mesh")) << bare.all();
}

TEST(MeshFile, CarriesMapsAndRefusesWhatTheyCannotBe) {
  const auto make = [] {
    auto mesh = standIn("box");
    mesh->materials[0].maps[kNormalMap] = {
        0, {WrapMode::Mirror, WrapMode::Clamp, true, true, MipmapUse::None}, true, {1, 2, 3, 4, 5, 6}};
    mesh->materials[0].normalScale = -2, mesh->materials[0].occlusionStrength = 0.5f;
    mesh->materials[0].unlit = true;
    mesh->secondUvs.assign(mesh->positions.size(), {0.5f, 0.25f});
    mesh->tangents.assign(mesh->positions.size(), {0, 1, 0, -1});
    finish(*mesh);
    return mesh;
  };
  auto back = decode(encode(*make()));
  ASSERT_TRUE(back) << back.error().message;
  back.value()->standIn = true;
  finish(*back.value());
  EXPECT_EQ(back.value()->hash, make()->hash);
  EXPECT_EQ(back.value()->materials[0].maps, make()->materials[0].maps);
  const auto refused = [&](const std::function<void(Mesh&)>& spoil) {
    auto bad = make();
    spoil(*bad);
    return !decode(encode(*bad));
  };
  EXPECT_TRUE(refused([](Mesh& m) { m.materials[0].maps[kNormalMap].texture = 7; }));
  EXPECT_TRUE(refused([](Mesh& m) { m.materials[0].maps[kOcclusionMap].uvTransform[2] = NAN; }));
  EXPECT_TRUE(
      refused([](Mesh& m) { m.materials[0].maps[kBaseMap].sampler.wrapU = static_cast<WrapMode>(3); }));
  EXPECT_TRUE(refused([](Mesh& m) { m.materials[0].normalScale = NAN; }));
  EXPECT_TRUE(refused([](Mesh& m) { m.materials[0].occlusionStrength = 1.5f; }));
  EXPECT_TRUE(refused([](Mesh& m) { m.tangents[0][3] = INFINITY; }));
  EXPECT_TRUE(refused([](Mesh& m) { m.secondUvs.back()[0] = NAN; }));
}

TEST(MeshHash, DiffersWithEachPartOfAMap) {
  std::vector<std::uint64_t> hashes;
  const auto with = [&](const std::function<void(Mesh&, Material&)>& change) {
    auto mesh = standIn("box");
    mesh->materials[0].maps[kNormalMap].texture = 0;
    change(*mesh, mesh->materials[0]);
    finish(*mesh);
    hashes.push_back(mesh->hash);
  };
  with([](Mesh&, Material&) {});
  with([](Mesh&, Material& m) { m.normalScale = 2; });
  with([](Mesh&, Material& m) { m.unlit = true; });
  with([](Mesh&, Material& m) { m.maps[kNormalMap].sampler.magnifiesNearest = true; });
  with([](Mesh&, Material& m) { m.maps[kNormalMap].uvTransform[2] = 1; });
  with([](Mesh&, Material& m) { m.maps[kBaseMap].sampler.wrapV = WrapMode::Mirror; });
  with([](Mesh&, Material& m) { m.maps[kOcclusionMap].texture = 0; });
  with([](Mesh&, Material& m) { m.maps[kOcclusionMap].texture = 0, m.occlusionStrength = 0.5f; });
  with([](Mesh& mesh, Material&) { mesh.secondUvs = mesh.uvs; });
  with([](Mesh& mesh, Material&) { mesh.tangents.assign(mesh.positions.size(), {1, 0, 0, 1}); });
  std::ranges::sort(hashes);
  EXPECT_EQ(std::unique(hashes.begin(), hashes.end()), hashes.end());
}

TEST_F(MaterialImport, ApproximatesACoatByItsRoughnessWhereThereIsNoMetal) {
  const auto roughness = [&](const std::string& metallic, const std::string& coat) {
    const Imported m =
        load(R"({"pbrMetallicRoughness": {"roughnessFactor": 0.8, "metallicFactor": )" + metallic +
             R"(}, "extensions": {"KHR_materials_clearcoat": {"clearcoatRoughnessFactor": 0.2,
                            "clearcoatFactor": )" +
             coat + "}}}");
    return std::pair{m.mesh->materials[0].roughness, m.all()};
  };
  EXPECT_FLOAT_EQ(roughness("0", "1").first, 0.2f);
  EXPECT_FLOAT_EQ(roughness("0", "0.5").first, 0.5f);
  EXPECT_FLOAT_EQ(roughness("1", "1").first, 0.8f);
  EXPECT_FLOAT_EQ(roughness("0", "0").first, 0.8f);
  EXPECT_TRUE(contains(roughness("0", "1").second, "clearcoat of 1 material")) << roughness("0", "1").second;
}

TEST_F(MaterialImport, ApproximatesTransmissionByAlpha) {
  const auto material = [&](const std::string& metallic) {
    return load(R"({"pbrMetallicRoughness": {"metallicFactor": )" + metallic +
                R"(}, "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}})")
        .mesh->materials[0];
  };
  EXPECT_NEAR(material("0").baseColour[3], 0.1f, 1e-6f);
  EXPECT_TRUE(material("0").transparent());
  EXPECT_FALSE(material("1").transparent()) << "metal lets nothing through";
}

}  // namespace
}  // namespace stadion::test
