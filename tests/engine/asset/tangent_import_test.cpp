/// Tangents that the importer makes for normal maps.

#include "tests/engine/asset/gltf_builder.h"
#include "tests/engine/asset/importing.h"

#include <cmath>
#include <numbers>

namespace stadion::test {
namespace {

using Json = nlohmann::json;
constexpr int kAround = 12;

/// The wall of a cylinder of radius 1 about y, of few sides; u goes around once, v up. With smooth normals.
GltfBuilder cylinder(bool normalMap, float direction = 1) {
  GltfBuilder b;
  std::vector<float> positions, normals, uvs;
  std::vector<std::uint16_t> indices;
  for (int i = 0; i <= kAround; ++i)
    for (int up = 0; up < 2; ++up) {
      const double angle = 2 * std::numbers::pi * i / kAround;
      const auto x = static_cast<float>(std::cos(angle)), z = static_cast<float>(-std::sin(angle));
      positions.insert(positions.end(), {x, static_cast<float>(up), z});
      normals.insert(normals.end(), {x, 0, z});
      uvs.insert(uvs.end(), {direction * static_cast<float>(i) / kAround, static_cast<float>(1 - up)});
    }
  for (int i = 0; i < kAround; ++i) {
    const auto k = static_cast<std::uint16_t>(2 * i);
    for (const int d : {0, 2, 3, 0, 3, 1}) indices.push_back(static_cast<std::uint16_t>(k + d));
  }
  const std::size_t count = positions.size() / 3;
  b.attribute("POSITION", positions, b.kFloat, "VEC3", count);
  b.attribute("NORMAL", normals, b.kFloat, "VEC3", count);
  b.attribute("TEXCOORD_0", uvs, b.kFloat, "VEC2", count);
  b.primitive()["indices"] = b.accessor(indices, b.kUnsignedShort, "SCALAR", indices.size());
  b.json["images"] = {{{"uri", "arms.png"}}};
  b.json["textures"] = {{{"source", 0}}};
  Json material{{"name", "m"}};
  if (normalMap) material["normalTexture"] = {{"index", 0}};
  b.json["materials"] = Json::array({material});
  b.primitive()["material"] = 0;
  return b;
}

Imported bumpyModel(const GltfBuilder& b) {
  TestFolder folder;
  std::filesystem::copy_file(models() / "arms.png", folder.path() / "arms.png");
  folder.write("m.glb", b.glb());
  return importOf(folder.path(), "m.glb");
}

Vec3 vec(const std::array<float, 3>& v) {
  return {double{v[0]}, double{v[1]}, double{v[2]}};
}

/// In the show's coordinates the cylinder stands upright, and u goes around counter-clockwise.
TEST(MadeTangents, AreSmoothOverASurfaceOfFewTriangles) {
  const Imported m = bumpyModel(cylinder(true));
  ASSERT_TRUE(m.mesh) << m.error;
  ASSERT_EQ(m.mesh->tangents.size(), m.mesh->positions.size());
  for (std::size_t i = 0; i < m.mesh->positions.size(); ++i) {
    const auto& t = m.mesh->tangents[i];
    const Vec3 n = vec(m.mesh->normals[i]), along(double{t[0]}, double{t[1]}, double{t[2]});
    const Vec3 expected = Vec3::UnitZ().cross(n);
    const double u = double{m.mesh->uvs[i][0]};
    const bool atSeam = u < 0.01 || u > 0.99;  // there it has triangles on one side only
    EXPECT_GT(along.dot(expected), atSeam ? 0.95 : 1 - 1e-6) << i;
    EXPECT_NEAR(along.norm(), 1, 1e-6);
    EXPECT_EQ(t[3], 1) << "the picture's top is up";
  }
}

TEST(MadeTangents, OfAMirroredPictureTurnRound) {
  const Imported m = bumpyModel(cylinder(true, -1));
  ASSERT_TRUE(m.mesh) << m.error;
  for (std::size_t i = 0; i < m.mesh->positions.size(); ++i) {
    const auto& t = m.mesh->tangents[i];
    EXPECT_LT(
        Vec3(double{t[0]}, double{t[1]}, double{t[2]}).dot(Vec3::UnitZ().cross(vec(m.mesh->normals[i]))),
        -0.95);
    EXPECT_EQ(t[3], -1);
  }
}

TEST(MadeTangents, AreThereOnlyForNormalMaps) {
  const Imported m = bumpyModel(cylinder(false));
  ASSERT_TRUE(m.mesh) << m.error;
  EXPECT_TRUE(m.mesh->tangents.empty());
}

/// Two halves of a square share an edge; the picture of one is mirrored, so the edge needs two tangents a vertex.
TEST(MadeTangents, DoNotMixAPictureWithItsMirrorImage) {
  GltfBuilder b = cylinder(true);
  b.primitive()["attributes"].clear();
  b.attribute("POSITION", std::vector<float>{0, 0, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0}, b.kFloat, "VEC3", 4);
  b.attribute("NORMAL", std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, b.kFloat, "VEC3", 4);
  b.attribute("TEXCOORD_0", std::vector<float>{0, 1, 1, 1, 1, 0, 0, 1}, b.kFloat, "VEC2", 4);
  b.primitive()["indices"] =
      b.accessor(std::vector<std::uint16_t>{0, 1, 2, 1, 3, 2}, b.kUnsignedShort, "SCALAR", 6);
  const Imported m = bumpyModel(b);
  ASSERT_TRUE(m.mesh) << m.error;
  EXPECT_EQ(m.mesh->positions.size(), 6u);
  int right = 0, left = 0;
  for (const auto& t : m.mesh->tangents)
    right += t[0] > 0.99f && t[3] == 1, left += t[0] < -0.99f && t[3] == -1;
  EXPECT_EQ(right, 3);
  EXPECT_EQ(left, 3);
}

TEST(MadeTangents, OfACollapsedPictureAreLeftToTheTriangles) {
  GltfBuilder b = cylinder(true, 0);
  const Imported m = bumpyModel(b);
  ASSERT_TRUE(m.mesh) << m.error;
  EXPECT_TRUE(m.mesh->tangents.empty());
}

}  // namespace
}  // namespace stadion::test
