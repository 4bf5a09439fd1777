// Material libraries of OBJ files.

#include "tests/engine/asset/importing.h"

namespace stadion::test {
namespace {

/// A triangle with a material library of these lines.
class ObjMaterials : public ::testing::Test {
protected:
  ObjMaterials() {
    for (const char* name : {"leaf.png", "lamp.png", "arms.png"})
      std::filesystem::copy_file(models() / name, folder_.path() / name);
    folder_.write("m.obj", kTriangle);
  }
  Imported load(const std::string& lines) {
    folder_.write("my lib.mtl", "newmtl wood\n" + lines);
    return importOf(folder_.path(), "m.obj");
  }
  static const Material& woodOf(const Mesh& mesh) { return mesh.materials.at(mesh.submeshes.at(0).material); }
  static std::array<float, 2> uvAt(const Mesh& mesh, float x) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      if (mesh.positions[i][0] == x) return mesh.uvs[i];
    return {-1, -1};
  }
  static constexpr const char* kTriangle =
      "mtllib my lib.mtl\nv 0 0 0\nv 1 0 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl wood\nf 1/1 2/2 3/3\n";
  TestFolder folder_;
};

TEST_F(ObjMaterials, ScaleAndOffsetOfAMapMoveItsTextureCoordinates) {
  for (const char* options : {"-s 2 3 1 -o 0.25 0.5", "-s 2 3 -blendu on -o .25 .5 0"}) {
    const Imported m = load(std::string("map_Kd ") + options + " arms.png\n");
    ASSERT_TRUE(m.mesh) << m.error;
    ASSERT_EQ(m.mesh->textures.size(), 1u) << m.all();
    // from the bottom: (u, v) becomes (2u + 0.25, 3v + 0.5); Stadion counts from the top
    EXPECT_NEAR(uvAt(*m.mesh, 0)[0], 0.25, 1e-6);
    EXPECT_NEAR(uvAt(*m.mesh, 0)[1], 0.5, 1e-6);
    EXPECT_NEAR(uvAt(*m.mesh, 1)[0], 2.25, 1e-6);
    EXPECT_NEAR(uvAt(*m.mesh, 2)[1], -2.5, 1e-6);
    EXPECT_TRUE(m.used("texture transform of 1 material (\"wood\")")) << m.all();
  }
}

TEST_F(ObjMaterials, OptionsThatChangeNothingHereAreNamed) {
  const Imported m = load("map_Kd -mm 0.5 2 -clamp on arms.png\nmap_Bump -bm 0.3 arms.png\n");
  ASSERT_TRUE(m.mesh) << m.error;
  EXPECT_EQ(m.mesh->textures.size(), 1u) << m.all();
  EXPECT_TRUE(m.leftOut("map option -mm of \"wood\"")) << m.all();
  EXPECT_TRUE(m.leftOut("height map of 1 material (\"wood\")")) << m.all();
  EXPECT_TRUE(m.used("wrap mode \"clamp\" of 1 material (\"wood\")")) << m.all();
}

TEST_F(ObjMaterials, AnOpacityMapGivesTheAlpha) {
  const Imported alone = load("Kd 1 0 0\nmap_d leaf.png\n");
  ASSERT_TRUE(alone.mesh) << alone.error;
  ASSERT_EQ(alone.mesh->textures.size(), 1u) << alone.all();
  const Texture& leaf = alone.mesh->textures[0];
  EXPECT_EQ(leaf.rgba[0], 255) << "the picture's colour is not that of the surface";
  EXPECT_EQ(leaf.rgba[3], 255);
  EXPECT_EQ(leaf.rgba[4 * 4 + 3], 0);
  EXPECT_TRUE(woodOf(*alone.mesh).transparent());
  const Imported both = load("map_Kd arms.png\nmap_d leaf.png\n");
  ASSERT_TRUE(both.mesh) << both.error;
  ASSERT_EQ(both.mesh->textures.size(), 1u) << both.all();
  EXPECT_EQ(both.mesh->textures[0].width, 2u);
  EXPECT_TRUE(woodOf(*both.mesh).partlyTransparent);
  EXPECT_TRUE(both.approximated("the opacity map \"leaf.png\": its size is that of \"arms.png\""))
      << both.all();
  const Imported same = load("map_Kd arms.png\nmap_d arms.png\n");
  ASSERT_TRUE(same.mesh) << same.error;
  EXPECT_EQ(same.mesh->textures[0].rgba[15], 128);
  EXPECT_TRUE(same.losses.all().empty()) << same.all();
}

TEST_F(ObjMaterials, AMissingLibraryIsNamed) {
  folder_.write("m.obj", "mtllib lost.mtl\nv 0 0 0\nv 1 0 0\nv 2 1 0\nf 1 2 3\n");
  const Imported m = importOf(folder_.path(), "m.obj");
  ASSERT_TRUE(m.mesh) << m.error;
  EXPECT_TRUE(m.leftOut("the material library \"lost.mtl\": it is missing")) << m.all();
}

TEST_F(ObjMaterials, VerticesMayHaveColoursAndLinesAreNamed) {
  folder_.write("m.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 .5 0\nv 2 1 0 0 0 1\nf 1 2 3\nl 1 2\nl 2 3\n");
  const Imported m = importOf(folder_.path(), "m.obj");
  ASSERT_TRUE(m.mesh) << m.error;
  ASSERT_EQ(m.mesh->colours.size(), 3u);
  EXPECT_EQ(m.mesh->colours[0], (std::array<std::uint8_t, 4>{255, 0, 0, 255}));
  EXPECT_EQ(m.mesh->colours[1][1], 128) << "taken as sRGB";
  EXPECT_TRUE(m.leftOut("2 lines")) << m.all();
}

}  // namespace
}  // namespace stadion::test
