// FBX and PLY files: axes, units, colours.

#include "tests/engine/asset/importing.h"
#include "tests/engine/asset/written_models.h"

#include "engine/asset/mesh_checks.h"

#include <cstring>

namespace stadion::test {
namespace {

void expectWedge(const Imported& m) {
  ASSERT_TRUE(m.mesh) << m.error;
  EXPECT_TRUE(m.mesh->bounds.lo.isZero(1e-6)) << m.mesh->bounds.lo.transpose();
  EXPECT_TRUE(m.mesh->bounds.hi.isApprox(Vec3(1, 2, 3), 1e-6)) << m.mesh->bounds.hi.transpose();
  EXPECT_TRUE(closed(*m.mesh));
  EXPECT_NEAR(volume(*m.mesh), 1, 1e-6);
}

class FbxImport : public ::testing::Test {
protected:
  Imported load(const std::string& text, const ImportOptions& options = {}) {
    folder_.write("m.fbx", text);
    return importOf(folder_.path(), "m.fbx", options);
  }
  TestFolder folder_;
};

TEST_F(FbxImport, TakesAxesAndUnitFromTheFile) {
  expectWedge(load(fbxZUpCentimetres()));
  // +Y up, the viewer on +Z, metres
  expectWedge(load(fbxWedge(fbxAxes(0, 1, 1, 1, 2, 1) + fbxSetting("UnitScaleFactor", "double", "100"),
                            "0,0,0,1,0,0,0,0,-2,0,3,0")));
  // -X up, +Y right, the viewer on +Z, inches
  expectWedge(load(fbxWedge(fbxAxes(1, 1, 0, -1, 2, 1) + fbxSetting("UnitScaleFactor", "double", "2.54"),
                            "0,0,0,0,39.3700787,0,0,0,-78.7401575,-118.110236,0,0")));
}

TEST_F(FbxImport, WithoutSettingsIsInCentimetresWithYUp) {
  expectWedge(load(fbxWedge("", "0,0,0,100,0,0,0,0,-200,0,300,0")));
}

TEST_F(FbxImport, TheScriptsUnitAndUpAxisOverrideTheFiles) {
  expectWedge(load(fbxWedge(fbxAxes(0, 1, 2, 1, 1, -1) + fbxSetting("UnitScaleFactor", "double", "1"),
                            "0,0,0,1,0,0,0,0,-2,0,3,0"),
                   {1.0, UpAxis::Y}));
}

TEST_F(FbxImport, ThatIsNoFbxIsAnError) {
  EXPECT_TRUE(contains(load("whatever").error, "cannot be read as FBX"));
}

TEST(PlyImport, HasZUpMetresAndColours) {
  TestFolder folder;
  folder.write("m.ply", plyWedge());
  const Imported m = importOf(folder.path(), "m.ply");
  expectWedge(m);
  ASSERT_EQ(m.mesh->colours.size(), m.mesh->positions.size());
  for (std::size_t i = 0; i < m.mesh->positions.size(); ++i)
    if (m.mesh->positions[i] == std::array<float, 3>{1, 0, 0}) {
      EXPECT_EQ(m.mesh->colours[i], (std::array<std::uint8_t, 4>{0, 255, 0, 255}));
    }
  EXPECT_TRUE(m.used("vertex colours of 1 mesh")) << m.all();
  const Imported turned = importOf(folder.path(), "m.ply", {0.5, UpAxis::Y});
  ASSERT_TRUE(turned.mesh);
  EXPECT_TRUE(turned.mesh->bounds.lo.isApprox(Vec3(0, -1.5, 0), 1e-6)) << turned.mesh->bounds.lo.transpose();
}

TEST(PlyImport, ReadsBinaryFiles) {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
  const float positions[]{0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3};
  text.append(reinterpret_cast<const char*>(positions), sizeof positions);
  for (const auto& face : {std::array<int, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}) {
    text += '\3';
    text.append(reinterpret_cast<const char*>(face.data()), sizeof face);
  }
  TestFolder folder;
  folder.write("m.ply", text);
  expectWedge(importOf(folder.path(), "m.ply"));
}

TEST(PlyImport, OfPointsAloneIsRefused) {
  TestFolder folder;
  folder.write("m.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                        "property float z\nend_header\n0 0 0\n1 1 1\n");
  EXPECT_TRUE(contains(importOf(folder.path(), "m.ply").error, "holds no triangles"));
}

}  // namespace
}  // namespace stadion::test
