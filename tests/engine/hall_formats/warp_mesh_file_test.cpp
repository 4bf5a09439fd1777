/// Warp meshes of other programs: each format against numbers that were worked out by hand.

#include "engine/hall_formats/hall_text.h"
#include "engine/hall_formats/warp_mesh_file.h"
#include "engine/maths/angles.h"
#include "tests/engine/hall_formats/hall_samples.h"

#include <gtest/gtest.h>

#include <cstring>

namespace stadion {
namespace {

std::optional<WarpFile> warpOf(const std::string& bytes, const std::string& name, std::string* all = nullptr,
                               double aspect = 1) {
  Diagnostics out;
  auto file = readWarpFile(bytes, name, aspect, out);
  if (all) *all = hall_samples::said(out);
  EXPECT_TRUE(file || out.hasErrors());
  return file;
}

/// The source share that a point of the output shows.
Vec2 shownAt(const WarpFile& file, double x, double y) {
  const auto grid = sampleWarp(file.mesh, 100, 100);
  EXPECT_TRUE(grid);
  return grid->source[static_cast<std::size_t>(y * 100) * 100 + static_cast<std::size_t>(x * 100)];
}

TEST(WarpMeshFile, PaulBourkeCountsFromTheLowerLeft) {
  const std::string text = "2\n2 2\n-2 -1 0 0 1\n2 -1 1 0 0.5\n-2 1 0 0.5 1\n2 1 1 0.5 -1\n";
  const auto file = warpOf(text, "a.data", nullptr, 2);
  ASSERT_TRUE(file);
  EXPECT_EQ(file->mesh.vertices[0].at, Vec2(0, 1));
  EXPECT_EQ(file->mesh.vertices[1].source, Vec2(1, 1));
  EXPECT_EQ(file->mesh.vertices[1].light, 0.5);
  EXPECT_FALSE(file->mesh.vertices[3].at.allFinite());
}

TEST(WarpMeshFile, ObjShowsATexture) {
  const std::string text =
      "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 0.5 0\nvt 0.5 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\nq\n";
  std::string all;
  const auto file = warpOf(text, "a.obj", &all);
  ASSERT_TRUE(file);
  EXPECT_TRUE(file->ofWindow);
  EXPECT_NE(all.find("\"q\" lines are not understood"), std::string::npos);
  EXPECT_LT((shownAt(*file, 0.505, 0.255) - Vec2(0.2525, 0.255)).norm(), 1e-9);
}

TEST(WarpMeshFile, PfmBeginsAtTheTop) {
  // pointsAsPfm writes the lowest row first: the last one given here is the first one of the file.
  const auto file = warpOf(pointsAsPfm({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, 2, 2), "a.pfm");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->mesh.vertices[0].at, Vec2(0, 0));
  EXPECT_EQ(file->mesh.vertices[0].source, Vec2(0, 0));
  EXPECT_EQ(file->mesh.vertices[3].source, Vec2(1, 1));
}

TEST(WarpMeshFile, DomeprojectionNumbersItsPoints) {
  const auto file = warpOf(
      "x;y;u;v;column;row\n0;0;0.1;0.2;0;0\n0;1;0.1;0.9;0;1\n1;1;0.8;0.9;1;1\n1;0;0.8;0.2;1;0\n", "a.csv");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->mesh.vertices[1].at, Vec2(1, 0));
  EXPECT_EQ(file->mesh.vertices[2].source, Vec2(0.1, 0.9));
  EXPECT_FALSE(warpOf("0;0;0;0;0;0\n1;0;1;0;5;5\n", "a.csv"));
}

TEST(WarpMeshFile, SimcadMovesASquare) {
  const std::string text =
      "<GeometryFile><GeometryDefinition><X-FlatParameters range=\"2\">0 0.2 0 0</X-FlatParameters>"
      "<Y-FlatParameters range=\"1\">0 0 0 -0.1</Y-FlatParameters></GeometryDefinition></GeometryFile>";
  const auto file = warpOf(text, "a.simcad");
  ASSERT_TRUE(file);
  EXPECT_LT((file->mesh.vertices[1].at - Vec2(1.1, 0)).norm(), 1e-12);
  EXPECT_LT((file->mesh.vertices[3].at - Vec2(1, 0.9)).norm(), 1e-12);
}

TEST(WarpMeshFile, SkyskanStatesItsView) {
  const std::string text =
      "Dome Azimuth=90\nDome Elevation=0\nHorizontal FOV=60\nVertical FOV=40\nFoo=1\n2 2\n"
      "0 0 0 0\n1 0 1 0\n0 1 0 1\n1 1 1 1\n";
  std::string all;
  const auto file = warpOf(text, "a.skyskan", &all);
  ASSERT_TRUE(file && file->view) << all;
  EXPECT_NE(all.find("\"Foo\" is not understood"), std::string::npos);
  EXPECT_LT((file->view->q_RP * Vec3::UnitY() - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_NEAR(file->view->up, 20 * kDegree, 1e-12);
}

TEST(WarpMeshFile, ScalableCountsItsVertices) {
  const std::string text =
      "OPENMESH Version 1.1\nVERTICES 3\nFACES 1\nMAPPING NORMALIZED\nNATIVEXRES 100\nNATIVEYRES 50\n"
      "PERSPECTIVE_LEFT -30\nPERSPECTIVE_RIGHT 30\nPERSPECTIVE_TOP 20\nPERSPECTIVE_BOTTOM -20\n"
      "0 0 255 0 0\n100 0 51 0 1\n0 50 255 1 0\n[ 0 1 2 ]\n";
  std::string all;
  const auto file = warpOf(text, "a.ol", &all);
  ASSERT_TRUE(file && file->view) << all;
  EXPECT_EQ(all, "");
  EXPECT_EQ(file->mesh.vertices[0].at, Vec2(0, 1));
  EXPECT_EQ(file->mesh.vertices[2].at, Vec2(0, 0));
  EXPECT_NEAR(file->mesh.vertices[1].light, 0.2, 1e-12);
  EXPECT_FALSE(warpOf("VERTICES 2\nFACES 0\n0 0 255 0 0\n", "a.ol"));
}

TEST(WarpMeshFile, ScissIsBinary) {
  std::string bytes = "SGC\x01";
  const auto add = [&bytes](const auto& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  add(std::uint32_t{0});
  for (const float v : {0.F, 0.F, 0.F, 1.F, 0.F, 1.5F, 0.F, 20.F, 10.F, 30.F, 30.F}) add(v);
  add(std::uint32_t{2});
  add(std::uint32_t{2});
  for (const float v : {0.F, 0.F, 0.F, 0.F, 1.F, 0.F, 1.F, 0.F, 0.F, 1.F, 1.F, 0.F,
                        0.F, 1.F, 0.F, 0.F, 0.F, 0.F, 1.F, 1.F, 0.F, 1.F, 0.F, 0.F})
    add(v);
  add(std::uint32_t{4});
  for (const std::uint32_t v : {0U, 1U, 2U, 3U}) add(v);
  const auto file = warpOf(bytes, "a.sgc");
  ASSERT_TRUE(file && file->view);
  EXPECT_EQ(file->mesh.triangles.size(), 2u);
  EXPECT_EQ(file->view->eye, Vec3(0, 0, 1.5));
  EXPECT_NEAR(file->view->down, -10 * kDegree, 1e-9);
  EXPECT_EQ(file->mesh.vertices[0].source, Vec2(0, 0));
  EXPECT_FALSE(warpOf(bytes.substr(0, bytes.size() - 1), "a.sgc"));
}

TEST(WarpMeshFile, WrongFilesAreRefusedWithTheReason) {
  const std::tuple<const char*, const char*, const char*> kWrong[] = {
      {"a.xyz", "", "this kind of warp file is not read; known are .data, .obj"},
      {"a.data", "2\n100000 2\n", "columns and rows, from 2 to 8192"},
      {"a.data", "2\n8000 500\n0 0 0 0 1\n", "the file ends too early"},
      {"a.data", "2\n2 2\n0 0 0 0 x\n0 0 0 0 1\n0 0 0 0 1\n0 0 0 0 1\n", "five numbers must stand here"},
      {"a.obj", "v 0 0 0\nf 1 1 9\n", "\"9\" is no corner of a face"},
      {"a.obj", "v 0 0 0\n", "1 v lines and 0 vt lines"},
      {"a.simcad", "<x/>", "GeometryFile/GeometryDefinition is missing"},
      {"a.sgc", "SGC", "this is not an SGC file"}};
  for (const auto& [name, text, why] : kWrong) {
    std::string all;
    EXPECT_FALSE(warpOf(text, name, &all));
    EXPECT_NE(all.find(why), std::string::npos) << all;
  }
}

TEST(WarpMesh, LeavesNoGapBetweenTriangles) {
  WarpMesh mesh;
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 7; ++column)
      mesh.vertices.push_back({Vec2(column / 6.0, row / 4.0), Vec2(column / 6.0, row / 4.0), 1});
  addGridTriangles(mesh, 7, 5);
  const auto grid = sampleWarp(mesh, 91, 77);
  ASSERT_TRUE(grid);
  for (std::size_t i = 0; i < grid->source.size(); ++i)
    EXPECT_LT((grid->source[i] - Vec2((i % 91 + 0.5) / 91, (i / 91 + 0.5) / 77)).norm(), 1e-9);
  EXPECT_FALSE(lightOf(*grid));
}

TEST(WarpMesh, ManyTrianglesOverEachOtherAreRefused) {
  WarpMesh mesh;
  mesh.vertices = {{Vec2(0, 0), Vec2(0, 0), 1}, {Vec2(2, 0), Vec2(1, 0), 1}, {Vec2(0, 2), Vec2(0, 1), 1}};
  mesh.triangles.assign(1000, {0, 1, 2});
  EXPECT_FALSE(sampleWarp(mesh, 1024, 1024));
}

}  // namespace
}  // namespace stadion
