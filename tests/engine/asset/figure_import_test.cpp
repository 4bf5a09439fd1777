#include "engine/asset/mesh_file.h"
#include "engine/figure/figure_pose.h"
#include "engine/figure/morph.h"
#include "tests/engine/asset/importing.h"
#include "tests/engine/asset/rigged_model.h"

namespace stadion::test {
namespace {

Imported figureOf(const GltfBuilder& b, bool figure = true) {
  TestFolder folder;
  folder.write("model.glb", b.glb());
  ImportOptions options;
  options.form = figure ? ModelForm::Figure : ModelForm::Object;
  return importOf(folder.path(), "model.glb", options);
}

std::vector<SkinnedVertex> posed(const Mesh& mesh, std::uint32_t clip, double time) {
  FigureRecord playing;
  playing.layerCount = 1;
  playing.layers[0] = {clip, 1, time};
  FigurePose pose;
  pose.set(*mesh.skeleton, playing);
  std::vector<SkinnedVertex> out(mesh.positions.size());
  MorphedVertices morphed;
  skin(morphed.apply({mesh.positions, mesh.normals, mesh.joints}, mesh.morphs, pose.weights()),
       pose.palette(), 0, out);
  return out;
}

/// The greatest height of the vertices, and the farthest along -x.
Vec3 extentOf(const std::vector<SkinnedVertex>& vertices) {
  Aabb box;
  for (const SkinnedVertex& v : vertices)
    box.include(Vec3(double{v.position[0]}, double{v.position[1]}, double{v.position[2]}));
  return {box.lo.x(), box.hi.x(), box.hi.z()};
}

TEST(FigureImport, BonesSkinAndClipsArriveByName) {
  const Imported i = figureOf(riggedTube());
  ASSERT_TRUE(i.mesh) << i.error;
  ASSERT_TRUE(i.mesh->skeleton);
  const Skeleton& s = *i.mesh->skeleton;
  std::vector<std::string> names;
  for (const Bone& b : s.bones) names.push_back(b.name);
  EXPECT_EQ(names, (std::vector<std::string>{"", "tube", "lower", "upper"}));
  ASSERT_EQ(s.clips.size(), 2u);
  EXPECT_EQ(s.clips[0].name, "bend");
  EXPECT_EQ(s.clips[1].length, 0.5);
  EXPECT_EQ(i.mesh->joints.size(), i.mesh->positions.size());
  EXPECT_TRUE(i.used("1 skin (\"rig\") of 2 bones")) << i.all();
  EXPECT_TRUE(i.used("2 clips (\"bend\", \"lift\")")) << i.all();
}

/// File: +Y up, turned to +Z up. "bend" turns the upper metre to the file's -x.
TEST(FigureImport, ItsPosesAreThoseOfTheFile) {
  const Imported i = figureOf(riggedTube());
  ASSERT_TRUE(i.mesh) << i.error;
  const Vec3 rest = extentOf(posed(*i.mesh, 0, 0)), bent = extentOf(posed(*i.mesh, 0, 1)),
             lifted = extentOf(posed(*i.mesh, 1, 0.25));
  EXPECT_LT((rest - Vec3(-0.1, 0.1, 2)).norm(), 1e-6) << rest;
  EXPECT_LT((bent - Vec3(-1, 0.1, 1.1)).norm(), 1e-6) << bent;
  EXPECT_LT((lifted - Vec3(-0.1, 0.1, 2.5)).norm(), 1e-6) << lifted;
}

TEST(FigureImport, MorphTargetsFollowTheirClip) {
  const Imported i = figureOf(morphingSquare());
  ASSERT_TRUE(i.mesh) << i.error;
  ASSERT_EQ(i.mesh->morphs.size(), 1U);
  EXPECT_EQ(i.mesh->morphs[0].vertices.size(), 2U);
  EXPECT_EQ(i.mesh->skeleton->weights[0].name, "open");
  EXPECT_FLOAT_EQ(i.mesh->skeleton->weights[0].rest, 0.5f);
  for (const double time : {0.0, 0.25, 1.0})
    EXPECT_NEAR(extentOf(posed(*i.mesh, 0, time)).y(), 1 + time, 1e-6) << time;
  EXPECT_TRUE(i.used("1 morph target (\"open\")")) << i.all();
}

TEST(FigureImport, AnObjectKeepsTheShapeOfItsWeightsAtRest) {
  GltfBuilder b = morphingSquare();
  b.json["nodes"].push_back(b.json["nodes"][0]);
  b.json["nodes"][1]["translation"] = {0, 5, 0};
  b.json["nodes"][1]["weights"] = {-0.5};
  b.json["scenes"][0]["nodes"] = {0, 1};
  const Imported i = figureOf(b, false);
  ASSERT_TRUE(i.mesh) << i.error;
  std::vector<float> widths;
  for (const auto& p : i.mesh->positions) widths.push_back(p[0]);
  EXPECT_EQ(widths, (std::vector<float>{0, 1.5f, 1.5f, 0, 0, 0.5f, 0.5f, 0}));
}

TEST(FigureImport, WithoutASkinEachNodeCarriesItsMesh) {
  GltfBuilder b;
  b.square();
  b.json["nodes"] = nlohmann::json::parse(
      R"([{"name": "arm", "translation": [2, 0, 0], "children": [1]}, {"name": "hand", "mesh": 0, "translation": [0, 1, 0]}])");
  const std::size_t times = b.accessor(std::vector<float>{0, 2}, GltfBuilder::kFloat, "SCALAR", 2);
  const std::size_t values = b.accessor(std::vector<float>{2, 0, 0, 8, 0, 0}, GltfBuilder::kFloat, "VEC3", 2);
  b.json["animations"] = {
      {{"samplers", {{{"input", times}, {"output", values}}}},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
  const Imported i = figureOf(b);
  ASSERT_TRUE(i.mesh) << i.error;
  EXPECT_EQ(i.mesh->skeleton->clips[0].name, "clip1");
  const Vec3 middle = extentOf(posed(*i.mesh, 0, 1));
  EXPECT_LT((middle - Vec3(5, 6, 2)).norm(), 1e-6) << middle;
}

TEST(FigureImport, AnObjectSaysThatItPlaysNothing) {
  const Imported i = figureOf(riggedTube(), false);
  ASSERT_TRUE(i.mesh) << i.error;
  EXPECT_FALSE(i.mesh->skeleton);
  EXPECT_TRUE(i.mesh->joints.empty());
  EXPECT_TRUE(i.leftOut("2 clips (\"bend\", \"lift\"): an object plays none, use figure( )")) << i.all();
}

TEST(FigureImport, TheBoundsHoldEveryPose) {
  const Imported i = figureOf(riggedTube());
  ASSERT_TRUE(i.mesh) << i.error;
  for (const std::uint32_t clip : {0u, 1u})
    for (double t = 0; t <= 1; t += 0.05)
      for (const SkinnedVertex& v : posed(*i.mesh, clip, t))
        EXPECT_LE((Vec3(double{v.position[0]}, double{v.position[1]}, double{v.position[2]}) -
                   i.mesh->sphere.centre)
                      .norm(),
                  i.mesh->sphere.radius);
  EXPECT_LT(i.mesh->sphere.radius, 3);
}

TEST(FigureImport, TimesThatDoNotAscendAreNamed) {
  GltfBuilder b = riggedTube();
  const std::size_t times = b.accessor(std::vector<float>{1, 0}, GltfBuilder::kFloat, "SCALAR", 2);
  b.json["animations"][0]["samplers"][0]["input"] = times;
  const Imported i = figureOf(b);
  ASSERT_TRUE(i.mesh) << i.error;
  EXPECT_TRUE(i.leftOut("1 channel of clips with times that do not ascend, numbers that are not finite, or "
                        "too few or many of them"))
      << i.all();
  EXPECT_TRUE(i.mesh->skeleton->clips[0].channels.empty());
}

/// The importer may send anything.
TEST(FigureImport, ADamagedSkeletonIsRefusedOrHarmless) {
  const Imported i = figureOf(riggedTube());
  ASSERT_TRUE(i.mesh) << i.error;
  const std::vector<std::uint8_t> good = encode(*i.mesh);
  ASSERT_TRUE(decode(good));
  EXPECT_EQ(encode(*decode(good).value()), good);
  for (std::size_t cut = 0; cut < good.size(); cut += 7)
    EXPECT_FALSE(decode(std::span(good).first(cut))) << cut;
  std::size_t refused = 0;
  for (std::size_t at = 0; at < good.size(); ++at)
    for (const int mask : {0x01, 0x80, 0xff}) {
      std::vector<std::uint8_t> bad = good;
      bad[at] = static_cast<std::uint8_t>(bad[at] ^ mask);
      const auto mesh = decode(bad);
      refused += !mesh;
      if (!mesh || !mesh.value()->skeleton) continue;
      FigurePose pose;
      FigureRecord playing;
      playing.layerCount = 1;
      playing.layers[0] = {0, 1, 0.3};
      pose.set(*mesh.value()->skeleton, playing);
      std::vector<SkinnedVertex> out(mesh.value()->positions.size());
      skin({mesh.value()->positions, mesh.value()->normals, mesh.value()->joints}, pose.palette(), 0, out);
    }
  EXPECT_GT(refused, good.size() / 2);
}

}  // namespace
}  // namespace stadion::test
