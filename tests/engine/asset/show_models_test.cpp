// The models in assets/: what the program writes, and what shows rely on.

#include "tests/engine/asset/importing.h"

#include "engine/asset/mesh_checks.h"

#include <set>

namespace stadion::test {
namespace {

const std::filesystem::path kAssets = std::filesystem::path(STADION_SOURCE_DIR) / "assets";

TEST(AssetShowModels, AreMadeByTheirProgramByteForByte) {
  const TestFolder models;
  const auto program = Importer::installedProgram().parent_path() / "stadion-assets";
  ASSERT_EQ(::system(("'" + program.string() + "' '" + models.path().string() + "'").c_str()), 0);
  for (const auto& entry : std::filesystem::directory_iterator(kAssets)) {
    const std::string name = entry.path().filename();
    if (name == "README.md" || entry.is_directory()) continue;
    const std::string made = bytesOf(models.path() / name);
    EXPECT_FALSE(made.empty()) << name << " is not made by the program";
    EXPECT_TRUE(made == bytesOf(kAssets / name)) << name << " differs from the one that is checked in";
  }
  for (const auto& entry : std::filesystem::directory_iterator(models.path()))
    EXPECT_TRUE(std::filesystem::exists(kAssets / entry.path().filename()))
        << entry.path() << " is not checked in";
}

TEST(AssetShowModels, TheFootballIsARoundClosedBallOnTheOrigin) {
  auto loaded = importerOf(kAssets).load("football.3ds");
  ASSERT_TRUE(loaded) << loaded.error().message;
  const Mesh& ball = *loaded.value();
  constexpr double kRadius = 0.11;
  EXPECT_TRUE(closed(ball));
  EXPECT_GE(ball.indices.size() / 3, 1280u);
  EXPECT_EQ(ball.bounds.lo.z(), 0);
  for (const auto& p : ball.positions)
    ASSERT_NEAR((Vec3(p[0], p[1], p[2]) - Vec3(0, 0, kRadius)).norm(), kRadius, 3e-8)
        << "a vertex off the sphere";
  for (std::size_t i = 0; i < ball.indices.size(); i += 3) {
    Vec3 middle = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      const auto& p = ball.positions[ball.indices[i + k]];
      middle += Vec3(p[0], p[1], p[2]) / 3;
    }
    ASSERT_GT((middle - Vec3(0, 0, kRadius)).norm(), 0.99 * kRadius) << "farther than 1 % inside the sphere";
  }
  const double sphere = 4.0 / 3 * 3.14159265358979 * kRadius * kRadius * kRadius;
  EXPECT_NEAR(volume(ball) / sphere, 1, 0.01);
  std::set<std::string> paints;
  for (const Submesh& s : ball.submeshes) paints.insert(ball.materials[s.material].name);
  EXPECT_EQ(paints, (std::set<std::string>{"white", "black", "seam"}));
}

TEST(AssetShowModels, ThePlaneIsOneFlatLayerWithoutOverlaps) {
  Diagnostics notes;
  auto loaded = importerOf(kAssets).load("plane.3ds", {}, {}, &notes);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(notes.all().empty()) << format(notes.all()[0]);
  const Mesh& plane = *loaded.value();
  EXPECT_FALSE(closed(plane));
  const Vec3 size = plane.bounds.hi - plane.bounds.lo;
  EXPECT_GE(size.x(), 120);
  EXPECT_GE(size.y(), 120);
  for (const auto& p : plane.positions) ASSERT_EQ(p[2], 0);
  for (const auto& n : plane.normals) ASSERT_NEAR(n[2], 1, 1e-6);
  // Every triangle faces up, so equal areas mean neither overlap nor hole.
  EXPECT_NEAR(area(plane), size.x() * size.y(), 1e-2);
  EXPECT_EQ(plane.textures.size(), 1u);
}

TEST(AssetShowModels, CornersOfThePlaneMeetOnlyCorners) {
  auto loaded = importerOf(kAssets).load("plane.3ds");
  ASSERT_TRUE(loaded);
  const Mesh& plane = *loaded.value();
  const auto weld = weldPositions(plane.positions);
  std::multiset<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (std::size_t i = 0; i < plane.indices.size(); i += 3)
    for (int k = 0; k < 3; ++k)
      edges.emplace(weld[plane.indices[i + k]], weld[plane.indices[i + (k + 1) % 3]]);
  for (const auto& [a, b] : edges) {
    ASSERT_EQ(edges.count({a, b}), 1u);
    const bool rim = std::abs(plane.positions[a][0]) == 70 || std::abs(plane.positions[a][1]) == 70;
    ASSERT_TRUE(rim || edges.count({b, a}) == 1) << plane.positions[a][0] << ' ' << plane.positions[a][1];
  }
}

TEST(AssetShowModels, TheFootIsClosedAndPointsForward) {
  auto loaded = importerOf(kAssets).load("crude_foot.obj");
  ASSERT_TRUE(loaded) << loaded.error().message;
  const Mesh& foot = *loaded.value();
  EXPECT_TRUE(closed(foot));
  EXPECT_GT(volume(foot), 1e-3);
  EXPECT_NEAR(foot.bounds.lo.z(), 0, 1e-6);
  EXPECT_GT(foot.bounds.hi.z(), 0.4) << "the leg stands up";
  EXPECT_GT(foot.bounds.hi.y(), 0.2) << "toes forward";
  double heel = 0;
  for (const auto& p : foot.positions)
    if (p[2] < 0.06f) heel = std::min(heel, double{p[1]});
  EXPECT_NEAR(foot.bounds.hi.y() - heel, 0.28, 0.005);
}

std::unique_ptr<Mesh> modelOf(const char* name) {
  Diagnostics notes;
  ImportOptions options;
  options.form = ModelForm::Either;
  auto loaded = importerOf(kAssets).load(name, options, {}, &notes);
  EXPECT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(notes.all().empty()) << format(notes.all()[0]);
  return loaded ? std::move(loaded.value()) : nullptr;
}

TEST(AssetShowModels, TheDiscusIsAClosedLensAboutItsCentre) {
  const auto discus = modelOf("discus.glb");
  ASSERT_TRUE(discus);
  EXPECT_TRUE(closed(*discus));
  EXPECT_NEAR(discus->bounds.hi.x() - discus->bounds.lo.x(), 0.22, 1e-6);
  EXPECT_NEAR(discus->bounds.hi.z(), -discus->bounds.lo.z(), 1e-7);
  EXPECT_GT(discus->bounds.hi.z(), 0.01);
  // Two kilograms are 2.4 times as dense as water: a wooden core in bronze.
  EXPECT_NEAR(2.0 / (1000 * volume(*discus)), 2.4, 0.05);
}

TEST(AssetShowModels, TheJavelinLooksAlongXAndItsOriginIsWhereItBalances) {
  const auto javelin = modelOf("javelin.glb");
  ASSERT_TRUE(javelin);
  EXPECT_TRUE(closed(*javelin));
  EXPECT_NEAR(javelin->bounds.hi.x(), 1.05, 1e-6);
  EXPECT_NEAR(javelin->bounds.lo.x(), 1.05 - 2.65, 1e-6);
  EXPECT_LT(javelin->bounds.hi.z(), 0.016);
  EXPECT_NEAR(0.806 / (1000 * volume(*javelin)), 0.79, 0.03) << "relative density of cornel wood";
}

TEST(AssetShowModels, TheLeatherBallIsASphereAboutItsCentre) {
  const auto ball = modelOf("leather_ball.glb");
  ASSERT_TRUE(ball);
  EXPECT_TRUE(closed(*ball));
  for (const auto& p : ball->positions) ASSERT_NEAR(Vec3(p[0], p[1], p[2]).norm(), 0.11, 1e-7);
}

TEST(AssetShowModels, TheTrackOfOlympiaIsSixHundredFeetFromSillToSill) {
  const auto track = modelOf("olympia_track.glb");
  ASSERT_TRUE(track);
  // Only the sills rise 25 mm above the earth inside the channel.
  double first = 1e9, last = -1e9;
  for (const auto& p : track->positions)
    if (std::abs(p[2] - 0.025f) < 1e-6f)
      first = std::min(first, double{p[1]}), last = std::max(last, double{p[1]});
  const double depth = 0.48;
  EXPECT_NEAR(last - first - depth, 600 * 0.32045, 1e-3);
  EXPECT_NEAR(first + depth / 2, 0, 1e-6) << "the origin is the middle of the start sill";
}

TEST(AssetShowModels, EveryModelOfOlympiaIsReadWithoutANote) {
  for (const auto& entry : std::filesystem::directory_iterator(kAssets))
    if (entry.path().extension() == ".glb") {
      EXPECT_TRUE(modelOf(entry.path().filename().c_str())) << entry.path();
    }
}

}  // namespace
}  // namespace stadion::test
