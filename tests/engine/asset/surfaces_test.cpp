// What is kept of a model's masks and pictures of light.
#include "tests/engine/asset/importing.h"

#include "engine/asset/mesh_checks.h"
#include "engine/asset/mesh_file.h"
#include "engine/asset/simplify.h"

namespace stadion::test {
namespace {

const Material& firstMaterial(const Mesh& mesh) {
  return mesh.materials.at(mesh.submeshes.at(0).material);
}

TEST(AssetSurfaces, AMaskIsACutoffAndItsPictureKeepsItsAlpha) {
  Importer importer = importerOf(models());
  auto loaded = importer.load("mask.gltf");
  ASSERT_TRUE(loaded) << loaded.error().message;
  const Mesh& mesh = *loaded.value();
  const Material& m = firstMaterial(mesh);
  EXPECT_EQ(m.alphaCutoff, 0.5f);
  EXPECT_TRUE(m.masked() && m.doubleSided && m.partlyTransparent);
  EXPECT_FALSE(m.transparent() || mesh.transparent());
  const Texture& leaf = mesh.textures.at(static_cast<std::size_t>(m.maps[kBaseMap].texture));
  EXPECT_EQ(leaf.rgba.at(3), 255);
  EXPECT_EQ(leaf.rgba.at(4 * 4 + 3), 0);
}

TEST(AssetSurfaces, APictureOfLightMultipliesTheFactor) {
  Importer importer = importerOf(models());
  auto loaded = importer.load("lamp.gltf");
  ASSERT_TRUE(loaded) << loaded.error().message;
  const Material& m = firstMaterial(*loaded.value());
  EXPECT_EQ(m.emissive, (std::array<float, 3>{1, 1, 1}));
  EXPECT_EQ(m.maps[kEmissiveMap].texture, 0);
  EXPECT_EQ(m.maps[kBaseMap].texture, -1);
  EXPECT_EQ(loaded.value()->textures.at(0).width, 16u);
}

/// A square with texture coordinates; `colours`: those of one corner have an alpha of 127.
std::string squareOf(const std::string& material, const std::string& picture, bool colours) {
  return R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 156, "uri": "data:application/octet-stream;base64,)"
         "AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAAAACAvwAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"
         "AAAAAAAA"
         "AAAAAIA/AAAAAAAAAAAAAIA/AAAAAAAAgD8AAIA/AACAPwAAgD8AAAAAAAAAAAAAAAAAAAEAAgAAAAIAAwD////////////////"
         "///9/"
         R"("}], "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 48},
         {"buffer": 0, "byteOffset": 48, "byteLength": 48}, {"buffer": 0, "byteOffset": 96, "byteLength": 32},
         {"buffer": 0, "byteOffset": 128, "byteLength": 12}, {"buffer": 0, "byteOffset": 140, "byteLength": 16}],
         "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]},
         {"bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC3"},
         {"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"},
         {"bufferView": 3, "componentType": 5123, "count": 6, "type": "SCALAR"},
         {"bufferView": 4, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC4"}],
         "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2)" +
         std::string(colours ? R"(, "COLOR_0": 4)" : "") +
         R"(}, "indices": 3, "material": 0}]}], "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0,
         "images": [{"uri": ")" +
         picture + R"("}], "textures": [{"source": 0}], "materials": [{)" + material + "}]}";
}

/// The two pictures of the corpus, and room for a model.
struct ModelFolder {
  TestFolder folder;
  ModelFolder() {
    for (const char* name : {"leaf.png", "lamp.png"})
      std::filesystem::copy_file(models() / name, folder.path() / name);
  }
};

TEST(AssetSurfaces, AMaskIsOneOnlyWhereSomethingCanBeCutOut) {
  const ModelFolder in;
  const auto pictured = [](const char* factor, const char* cutoff) {
    return R"("pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "baseColorFactor": [1, 1, 1, )" +
           std::string(factor) + R"(]}, "alphaMode": "MASK")" + cutoff;
  };
  const struct {
    const char* picture;
    std::string material;
    bool colours;
    float cutoff;
  } cases[] = {
      {"leaf.png", pictured("1", ""), false, 0.5f},
      {"leaf.png", pictured("1", R"(, "alphaCutoff": 0.25)"), false, 0.25f},
      {"leaf.png", pictured("1", R"(, "alphaCutoff": 0)"), false, 0},
      {"leaf.png", pictured("1", R"(, "alphaCutoff": 1.5)"), false, 1.5f},
      {"lamp.png", pictured("1", ""), false, 0},
      {"lamp.png", pictured("0.5", R"(, "alphaCutoff": 0.4)"), false, 0},
      {"lamp.png", pictured("0.5", R"(, "alphaCutoff": 0.6)"), false, 0.6f},
      {"lamp.png", pictured("1", ""), true, 0.5f},
      {"lamp.png", R"("alphaMode": "MASK")", false, 0},
  };
  Importer importer = importerOf(in.folder.path());
  for (const auto& c : cases) {
    in.folder.write("square.gltf", squareOf(c.material, c.picture, c.colours));
    auto loaded = importer.load("square.gltf");
    ASSERT_TRUE(loaded) << loaded.error().message;
    const Material& m = firstMaterial(*loaded.value());
    EXPECT_EQ(m.alphaCutoff, c.cutoff) << c.material;
    EXPECT_FALSE(m.transparent()) << c.material;
    EXPECT_TRUE(c.cutoff > 0 || m.baseColour[3] == 1) << c.material;
  }
}

TEST(AssetSurfaces, AlphaOfVerticesMakesABlendedMaterialTransparent) {
  const ModelFolder in;
  Importer importer = importerOf(in.folder.path());
  const auto transparent = [&](const char* material, bool colours) {
    in.folder.write("square.gltf", squareOf(material, "lamp.png", colours));
    auto loaded = importer.load("square.gltf");
    return loaded && firstMaterial(*loaded.value()).transparent();
  };
  EXPECT_TRUE(transparent(R"("alphaMode": "BLEND")", true));
  EXPECT_FALSE(transparent(R"("alphaMode": "BLEND")", false));
  EXPECT_FALSE(transparent(R"("alphaMode": "OPAQUE")", true));
}

TEST(AssetSurfaces, LightIsThereOnlyWithAFactorAndAPictureThatCanBeRead) {
  const ModelFolder in;
  in.folder.write("broken.png", "no picture");
  const struct {
    const char *picture, *material;
    std::array<float, 3> emissive;
    bool pictured;
  } cases[] = {
      {"lamp.png",
       R"("emissiveTexture": {"index": 0}, "emissiveFactor": [1, 0.5, 0.25])",
       {1, 0.5f, 0.25f},
       true},
      {"lamp.png", R"("emissiveTexture": {"index": 0})", {0, 0, 0}, false},
      {"lamp.png", R"("emissiveFactor": [0, 0.5, 0])", {0, 0.5f, 0}, false},
      {"broken.png", R"("emissiveTexture": {"index": 0}, "emissiveFactor": [1, 1, 1])", {0, 0, 0}, false},
      {"nowhere.png", R"("emissiveTexture": {"index": 0}, "emissiveFactor": [1, 1, 1])", {0, 0, 0}, false},
  };
  Importer importer = importerOf(in.folder.path());
  for (const auto& c : cases) {
    in.folder.write("square.gltf", squareOf(c.material, c.picture, false));
    Diagnostics notes;
    auto loaded = importer.load("square.gltf", {}, {"a.evs", 1, 1}, &notes);
    ASSERT_TRUE(loaded) << loaded.error().message;
    const Material& m = firstMaterial(*loaded.value());
    EXPECT_EQ(m.emissive, c.emissive) << c.picture << ", " << c.material;
    EXPECT_EQ(m.maps[kEmissiveMap].texture >= 0, c.pictured) << c.picture << ", " << c.material;
    EXPECT_EQ(notes.all().size(), std::string(c.picture) == "lamp.png" ? 0u : 1u) << c.picture;
  }
}

TEST(AssetSurfaces, PicturesOfLightOfOtherFormatsGlowWithoutAFactor) {
  const ModelFolder in;
  in.folder.write("square.obj", "mtllib square.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n"
                                "usemtl a\nf 1/1 2/2 3/3\n");
  const struct {
    const char* lines;
    std::array<float, 3> emissive;
  } cases[] = {{"map_Ke lamp.png\n", {1, 1, 1}},
               {"Ke 0 0 0\nmap_Ke lamp.png\n", {1, 1, 1}},
               {"Ke 1 0 0\nmap_Ke lamp.png\n", {1, 0, 0}},
               {"map_Ke lamp.png\nmap_Kd leaf.png\n", {1, 1, 1}}};
  Importer importer = importerOf(in.folder.path());
  for (const auto& c : cases) {
    in.folder.write("square.mtl", std::string("newmtl a\nKd 0.2 0.2 0.2\n") + c.lines);
    auto loaded = importer.load("square.obj");
    ASSERT_TRUE(loaded) << loaded.error().message;
    const Material& m = firstMaterial(*loaded.value());
    EXPECT_EQ(m.emissive, c.emissive) << c.lines;
    ASSERT_GE(m.maps[kEmissiveMap].texture, 0) << c.lines;
    EXPECT_EQ(loaded.value()->textures.at(static_cast<std::size_t>(m.maps[kEmissiveMap].texture)).name,
              "lamp.png");
    EXPECT_FALSE(m.masked()) << c.lines;
  }
}

std::unique_ptr<Mesh> withAll() {
  auto mesh = standIn("box");
  mesh->materials[0].alphaCutoff = 0.25f;
  mesh->materials[0].maps[kEmissiveMap].texture = 1;
  mesh->textures.push_back({1, 1, {255, 255, 255, 255}, "light"});
  finish(*mesh);
  return mesh;
}

TEST(AssetSurfaces, AMeshFileCarriesThemAndRefusesWhatTheyCannotBe) {
  const auto mesh = withAll();
  auto back = decode(encode(*mesh));
  ASSERT_TRUE(back) << back.error().message;
  back.value()->standIn = true;
  finish(*back.value());
  EXPECT_EQ(back.value()->hash, mesh->hash);
  EXPECT_EQ(back.value()->materials[0].alphaCutoff, 0.25f);
  EXPECT_EQ(back.value()->materials[0].maps[kEmissiveMap].texture, 1);
  const auto refused = [&](float cutoff, std::int32_t texture) {
    const auto bad = withAll();
    bad->materials[0].alphaCutoff = cutoff, bad->materials[0].maps[kEmissiveMap].texture = texture;
    return !decode(encode(*bad));
  };
  for (const float cutoff : {-0.1f, 2.1f, NAN, INFINITY}) EXPECT_TRUE(refused(cutoff, 0)) << cutoff;
  for (const int texture : {-2, 2, 1 << 30}) EXPECT_TRUE(refused(0.5f, texture)) << texture;
  EXPECT_FALSE(refused(0, -1) || refused(2, 0));
}

TEST(AssetSurfaces, MeshesThatDifferInThemHaveOtherHashes) {
  std::vector<std::uint64_t> hashes;
  for (const float cutoff : {0.0f, 0.25f, 0.5f})
    for (const int texture : {-1, 0, 1}) {
      auto mesh = withAll();
      mesh->materials[0].alphaCutoff = cutoff, mesh->materials[0].maps[kEmissiveMap].texture = texture;
      finish(*mesh);
      hashes.push_back(mesh->hash);
    }
  std::sort(hashes.begin(), hashes.end());
  EXPECT_EQ(std::unique(hashes.begin(), hashes.end()), hashes.end());
}

/// A fine grid whose corners have holes in one quarter: simplified, nearly all triangles go, but for those at
/// the edge of the holes.
TEST(AssetSurfaces, SimplifiedLevelsKeepTheHoles) {
  constexpr std::uint32_t kSide = 33;
  Mesh mesh;
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      mesh.positions.push_back({static_cast<float>(x), static_cast<float>(y), 0});
      mesh.normals.push_back({0, 0, 1});
      const bool hole = x < kSide / 2 && y < kSide / 2;
      mesh.colours.push_back({255, 255, 255, static_cast<std::uint8_t>(hole ? 0 : 255)});
    }
  for (std::uint32_t y = 0; y + 1 < kSide; ++y)
    for (std::uint32_t x = 0; x + 1 < kSide; ++x) {
      const std::uint32_t i = y * kSide + x;
      for (const std::uint32_t k : {i, i + 1, i + kSide, i + 1, i + kSide + 1, i + kSide})
        mesh.indices.push_back(k);
    }
  mesh.materials.resize(1);
  mesh.materials[0].alphaCutoff = 0.5f;
  mesh.submeshes = {{0, static_cast<std::uint32_t>(mesh.indices.size()), 0}};
  finish(mesh);
  addLevels(mesh, 4);
  const auto alphaAt = [&](const std::vector<std::uint32_t>& indices, double x, double y) {
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      const auto& a = mesh.positions[indices[i]];
      const auto& b = mesh.positions[indices[i + 1]];
      const auto& c = mesh.positions[indices[i + 2]];
      const double ux = double{b[0]} - double{a[0]}, uy = double{b[1]} - double{a[1]},
                   vx = double{c[0]} - double{a[0]}, vy = double{c[1]} - double{a[1]};
      const double area = ux * vy - uy * vx, px = x - double{a[0]}, py = y - double{a[1]};
      const double s = (px * vy - py * vx) / area, t = (ux * py - uy * px) / area;
      if (s < 0 || t < 0 || s + t > 1) continue;
      return (1 - s - t) * mesh.colours[indices[i]][3] + s * mesh.colours[indices[i + 1]][3] +
             t * mesh.colours[indices[i + 2]][3];
    }
    return -1.0;
  };
  for (const MeshLevel& level : mesh.levels)
    for (double y = 0.4; y < kSide - 1; y += 3.3)
      for (double x = 0.4; x < kSide - 1; x += 3.3) {
        if (std::abs(x - 16) < 1.5 || std::abs(y - 16) < 1.5) continue;
        EXPECT_EQ(alphaAt(level.indices, x, y) >= 127.5, alphaAt(mesh.indices, x, y) >= 127.5)
            << x << ", " << y;
      }
}

}  // namespace
}  // namespace stadion::test
