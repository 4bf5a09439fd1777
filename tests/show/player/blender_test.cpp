/// What Blender exports, against Blender's own numbers. blender/character.py makes the files and the numbers.

#include "engine/asset/import.h"
#include "engine/figure/figure_pose.h"
#include "engine/figure/skinning.h"
#include "tests/programs/program.h"

#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

constexpr double kExact = 1e-5;  // [m]

std::vector<Vec3> pointsOf(const nlohmann::json& numbers) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    points.emplace_back(numbers[i].get<double>(), numbers[i + 1].get<double>(), numbers[i + 2].get<double>());
  return points;
}

/// Of each point, the distance to the nearest of the others; the greatest of these.
double farthest(const std::vector<Vec3>& points, const std::vector<Vec3>& from) {
  double most = 0;
  for (const Vec3& p : points) {
    double nearest = 1e9;
    for (const Vec3& q : from) nearest = std::min(nearest, (p - q).norm());
    most = std::max(most, nearest);
  }
  return most;
}

class ProgramFullBlender : public testing::Test {
protected:
  void SetUp() override {
    if (!fullRuns()) GTEST_SKIP() << "needs Blender; runs with --full";
    const ProgramResult made = runProgram(
        {{"blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python",
          STADION_SOURCE_DIR "/tests/show/player/blender/character.py", "--", folder_.path().string()}});
    ASSERT_EQ(made.status, 0) << made.out << made.err;
    truth_ = nlohmann::json::parse(fileContent(folder_.path() / "truth.json"));
  }

  std::unique_ptr<Mesh> read(const std::string& file, ModelForm form) const {
    AssetRoots roots;
    EXPECT_TRUE(roots.add(folder_.path()));
    Importer importer(Importer::installedProgram(), std::move(roots));
    ImportOptions options;
    options.form = form;
    auto mesh = importer.load(file, options);
    EXPECT_TRUE(mesh) << mesh.error().message;
    return mesh ? std::move(mesh.value()) : nullptr;
  }

  /// Those of the character, which alone has this material.
  static std::vector<std::uint32_t> verticesOfSkin(const Mesh& mesh) {
    std::vector<std::uint32_t> vertices;
    for (const Submesh& run : mesh.submeshes)
      if (mesh.materials[run.material].name == "Skin")
        vertices.insert(vertices.end(), mesh.indices.begin() + run.firstIndex,
                        mesh.indices.begin() + run.firstIndex + run.indexCount);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  static std::vector<Vec3> posed(const Mesh& mesh, const FigureRecord& playing) {
    FigurePose pose;
    pose.set(*mesh.skeleton, playing);
    std::vector<SkinnedVertex> skinned(mesh.positions.size());
    skin({mesh.positions, mesh.normals, mesh.joints}, pose.palette(), 0, skinned);
    std::vector<Vec3> points;
    for (const SkinnedVertex& v : skinned)
      points.emplace_back(double{v.position[0]}, double{v.position[1]}, double{v.position[2]});
    return points;
  }

  /// "walk", or as FBX has it, "Rig|walk".
  static std::uint32_t clipOf(const Mesh& mesh, const std::string& name) {
    const auto& clips = mesh.skeleton->clips;
    const auto at = std::ranges::find_if(clips, [&](const Clip& c) { return c.name.ends_with(name); });
    EXPECT_NE(at, clips.end()) << name;
    return static_cast<std::uint32_t>(at - clips.begin());
  }

  void expectBones(const Mesh& mesh) const {
    const auto& bones = mesh.skeleton->bones;
    std::map<std::string, std::string> parents;
    for (const Bone& bone : bones)
      parents[bone.name] = bone.parent < 0 ? "" : bones[static_cast<std::size_t>(bone.parent)].name;
    for (const auto& bone : truth_["bones"]) {
      const auto name = bone[0].get<std::string>();
      ASSERT_TRUE(parents.contains(name)) << name;
      const std::string parent = bone[1].is_null() ? parents[name] : bone[1].get<std::string>();
      EXPECT_EQ(parents[name], parent) << name;
    }
    for (const char* other : {"Yard", "Block1", "Camera", "Lamp"})
      EXPECT_TRUE(parents.contains(other)) << other;
    EXPECT_EQ(parents["Block2"], "Block1");
  }

  /// Each vertex against the one of Blender's that it is nearest to over all frames of a clip.
  void expectClip(const Mesh& mesh, const std::string& name) const {
    std::vector<std::vector<Vec3>> ours, theirs;
    for (const auto& frame : truth_["clips"][name]) {
      FigureRecord playing;
      playing.layerCount = 1;
      playing.layers[0] = {clipOf(mesh, name), 1, frame["time"].get<double>()};
      ours.push_back(posed(mesh, playing));
      theirs.push_back(pointsOf(frame["positions"]));
    }
    double worst = 0;
    std::vector<bool> met(theirs[0].size(), false);
    for (const std::uint32_t v : verticesOfSkin(mesh)) {
      double nearest = 1e9;
      std::size_t which = 0;
      for (std::size_t t = 0; t < theirs[0].size(); ++t) {
        double error = 0;
        for (std::size_t f = 0; f < ours.size(); ++f)
          error = std::max(error, (ours[f][v] - theirs[f][t]).norm());
        if (error < nearest) nearest = error, which = t;
      }
      met[which] = true;
      worst = std::max(worst, nearest);
    }
    std::printf("  %s: worst vertex %.1e m\n", name.c_str(), worst);
    EXPECT_LT(worst, kExact) << name;
    EXPECT_EQ(std::count(met.begin(), met.end(), false), 0) << "vertices that are missing";
  }

  void expectStatic(const std::vector<Vec3>& points) const {
    EXPECT_EQ(truth_["static"].size(), 7u);
    for (const auto& [name, places] : truth_["static"].items())
      EXPECT_LT(farthest(pointsOf(places), points), kExact) << name;
  }

  void expectFigure(const std::string& file) const {
    const auto mesh = read(file, ModelForm::Figure);
    ASSERT_TRUE(mesh && mesh->skeleton);
    std::printf("%s\n", file.c_str());
    expectBones(*mesh);
    EXPECT_EQ(mesh->skeleton->clips.size(), 2u);
    expectClip(*mesh, "walk");
    expectClip(*mesh, "wave");
    expectStatic(posed(*mesh, {}));
  }

  TestFolder folder_;
  nlohmann::json truth_;
};

TEST_F(ProgramFullBlender, GlbHasItsHierarchyClipsAndPoses) {
  expectFigure("character.glb");
}

TEST_F(ProgramFullBlender, FbxHasItsHierarchyClipsAndPosesInEitherUnit) {
  expectFigure("character.fbx");
  expectFigure("character-metres.fbx");
}

TEST_F(ProgramFullBlender, ObjHasItsGeometryAndMaterials) {
  const auto mesh = read("character.obj", ModelForm::Object);
  ASSERT_TRUE(mesh);
  std::vector<Vec3> points;
  for (const auto& p : mesh->positions) points.emplace_back(double{p[0]}, double{p[1]}, double{p[2]});
  EXPECT_LT(farthest(pointsOf(truth_["rest"]), points), kExact);
  expectStatic(points);
  std::map<std::string, bool> textured;
  for (const Submesh& run : mesh->submeshes) {
    const Material& m = mesh->materials[run.material];
    textured[m.name] = m.maps[kBaseMap].given();
  }
  EXPECT_EQ(textured, (std::map<std::string, bool>{{"Skin", true}, {"Stone", false}}));
}

}  // namespace
}  // namespace stadion
