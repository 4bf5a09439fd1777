/// Light from all around and the curves of bright light: both renderers draw them alike, and energy is kept.

#include "engine/environment/radiance_map.h"
#include "pipeline/cpu_draw/kernels/choose_kernels.h"
#include "tests/engine/environment/surroundings.h"
#include "tests/pipeline/cpu_draw/compared_pictures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stadion::test {
namespace {

constexpr std::uint32_t kSurroundedWidth = 480, kSurroundedHeight = 320;

MeshId surroundings(MeshStore& meshes, const RadianceMap& map, std::uint64_t hash) {
  auto mesh = std::make_unique<Mesh>();
  mesh->materials.emplace_back();
  mesh->environment = std::make_shared<const EnvironmentLight>(environmentLight(map));
  mesh->hash = hash;
  return meshes.add(std::move(mesh));
}

/// Three rows of spheres: of plastic, of gold and half of it, from smooth to rough.
struct SurroundedScene {
  explicit SurroundedScene(const RadianceMap& map = surroundingsOf(256, hallAt)) {
    picture = surroundings(meshes, map, 4711);
    list = plainList();
    list.views[0] = lookAt(Vec3(0, -9, 0), Vec3(0, 0, 0), 0.75, double{kSurroundedWidth} / kSurroundedHeight);
    list.sky.environment = {1, picture, 1, 1, 0.8f, 0.6f};
    for (int row = 0; row < 3; ++row)
      for (int i = 0; i < 5; ++i) {
        Material m = row == 0 ? matt(0.5f, 0.1f, 0.1f) : matt(1, 0.77f, 0.34f);
        m.metallic = 0.5f * static_cast<float>(row);
        m.roughness = 0.08f + 0.23f * static_cast<float>(i);
        Affine X = Affine::Identity();
        X.translation() = Vec3(1.7 * (i - 2), 0, 1.7 * (row - 1));
        list.opaque.push_back(place(meshes.add(MeshMaker(m).sphere(0.75, 40).seal()), X));
      }
  }
  Picture byCpu(const PictureRung& rung = {}, std::size_t threads = 1, const DrawKernels* kernels = nullptr) {
    return drawnByCpu(meshes, list, kSurroundedWidth, kSurroundedHeight, rung, threads, kernels);
  }
  Picture byOpenGl(const RenderQuality& quality = {}) {
    return drawnByOpenGl(meshes, list, kSurroundedWidth, kSurroundedHeight, quality);
  }
  void expectAlike(const std::string& what, const PictureRung& rung = {}, const RenderQuality& quality = {}) {
    const PictureDifference d = difference(byCpu(rung), byOpenGl(quality));
    EXPECT_LE(d.mean, 0.3) << what;
    EXPECT_GE(d.alike, 0.995) << what << ", most " << d.most;
  }
  MeshStore meshes;
  MeshId picture = kNoMesh;
  DrawList list;
};

TEST(EnvironmentDrawing, BothRenderersDrawSurroundingsAlike) {
  SurroundedScene scene;
  scene.expectAlike("picture");
  scene.list.sky.environment.intensity = 2.5f;
  scene.expectAlike("bright");
  scene.list.sky.environment.background = 0;
  scene.expectAlike("sky behind");
  scene.list.sky.environment.picture = kNoMesh;
  scene.list.sky.environment.intensity = 1;
  scene.expectAlike("the sky's own light");
  scene.list.sky.hazeDistance = 20;
  DrawLight sun;
  sun.direction = {-0.4f, 0.7f, -0.6f};
  scene.list.lights.push_back(sun);
  scene.expectAlike("haze and sun");
}

TEST(EnvironmentDrawing, BothRenderersMirrorHarmonicsAlikeOnTheCheapRung) {
  SurroundedScene scene;
  PictureRung rung;
  RenderQuality quality;
  rung.reflections = quality.reflections = false;
  scene.expectAlike("harmonics", rung, quality);
  EXPECT_NE(scene.byCpu(rung), scene.byCpu());
}

TEST(EnvironmentDrawing, ThePlainLookHasTheMeanLightFromEverywhere) {
  SurroundedScene scene;
  PictureRung rung;
  rung.look = Look::Plain;
  RenderQuality quality;
  quality.look = Look::Plain;
  scene.expectAlike("plain", rung, quality);
  scene.list.sky.tones.exposure = 2;
  scene.expectAlike("plain, exposed", rung, quality);
}

TEST(EnvironmentDrawing, MapsOfTheSurfaceCountForItToo) {
  SurroundedScene scene;
  MeshMaker maker(matt(0.9f, 0.8f, 0.7f));
  auto mesh = maker.texture(chequered(64, 8)).sphere(1.4, 40).seal();
  Material& m = mesh->materials[0];
  m.metallic = 1;
  for (const MapKind kind : {kMetallicRoughnessMap, kNormalMap, kOcclusionMap}) {
    mesh->textures.push_back(chequered(64, kind == kNormalMap ? 1 : 4));
    m.maps[kind].texture = static_cast<std::int32_t>(mesh->textures.size()) - 1;
  }
  scene.list.opaque = {place(scene.meshes.add(std::move(mesh)))};
  scene.expectAlike("maps");
}

TEST(EnvironmentDrawing, KernelsAndThreadsDoNotChangeThePicture) {
  SurroundedScene scene;
  const Picture one = scene.byCpu();
  for (const DrawKernels* kernels : drawKernelsHere())
    for (const std::size_t threads : {1u, 3u})
      EXPECT_EQ(one, scene.byCpu({}, threads, kernels)) << kernels->name << " " << threads;
  scene.list.sky.tones = {1.7f, ToneCurve::Neutral};
  PictureRung cheap;
  cheap.reflections = false;
  const Picture other = scene.byCpu(cheap);
  for (const DrawKernels* kernels : drawKernelsHere()) EXPECT_EQ(other, scene.byCpu(cheap, 3, kernels));
}

/// In white surroundings white balls cannot be seen, however rough they are and whether they are of metal.
TEST(EnvironmentDrawing, WhiteBallsAreAsBrightAsTheirSurroundings) {
  SurroundedScene scene(whiteSurroundings());
  scene.list.sky.environment.intensity = 0.5f;
  scene.list.views[0] =
      lookAt(Vec3(0, -14, 0), Vec3(0, 0, 0), 0.75, double{kSurroundedWidth} / kSurroundedHeight);
  scene.list.opaque.clear();
  for (int row = 0; row < 3; ++row)
    for (int i = 0; i <= 10; ++i) {
      Material m = matt(1, 1, 1);
      m.metallic = 0.5f * static_cast<float>(row);
      m.roughness = 0.1f * static_cast<float>(i);
      Affine X = Affine::Identity();
      X.translation() = Vec3(i - 5, 0, 1.2 * (row - 1));
      scene.list.opaque.push_back(place(scene.meshes.add(MeshMaker(m).sphere(0.45, 40).seal()), X));
    }
  for (const bool maps : {true, false}) {
    PictureRung rung;
    RenderQuality quality;
    rung.reflections = quality.reflections = maps;
    for (const Picture& p : {scene.byCpu(rung), scene.byOpenGl(quality)})
      for (std::uint32_t y = 0; y < p.height; ++y)
        for (std::uint32_t x = 0; x < p.width; ++x)
          for (int k = 0; k < 3; ++k)
            ASSERT_NEAR(p.at(x, y)[k], sRgb(0.5), 1) << x << " " << y << " " << maps;
  }
}

/// How much of white surroundings a metal of this colour shows where it faces the eye: the integral of GGX over half
/// vectors, and what is mirrored several times.
double facingMetal(double colour, double roughness) {
  const double squared = std::pow(roughness, 4);
  double scale = 0, bias = 0;
  constexpr int kSteps = 4096;
  for (int i = 0; i < kSteps; ++i) {
    const double share = (i + 0.5) / kSteps, half = std::sqrt((1 - share) / (1 + (squared - 1) * share));
    const double out = 2 * half * half - 1;  // cosine of the mirrored way
    if (out <= 0) continue;
    const double visible = 0.5 / (out + std::sqrt(squared + (1 - squared) * out * out));
    const double part = 4 * out * visible / kSteps, grazing = std::pow(1 - half, 5);
    scale += part * (1 - grazing), bias += part * grazing;
  }
  const double lost = 1 - scale - bias, once = colour * scale + bias, mean = colour + (1 - colour) / 21;
  return once + once * mean / (1 - lost * mean) * lost;
}

TEST(EnvironmentDrawing, MetalsMirrorAsMuchAsTheIntegralOfGgx) {
  for (const float roughness : {0.2f, 0.4f, 0.6f, 0.8f, 1.0f}) {
    SurroundedScene scene(whiteSurroundings());
    scene.list.sky.environment.intensity = 1;
    scene.list.opaque.clear();
    Material m = matt(0.5f, 0.3f, 0.1f);
    m.metallic = 1, m.roughness = roughness;
    scene.list.opaque.push_back(
        place(scene.meshes.add(MeshMaker(m).sphere(0.75, 40).seal()), Affine::Identity()));
    const Picture p = scene.byCpu();
    const auto* middle = p.at(kSurroundedWidth / 2, kSurroundedHeight / 2);
    const double colours[] = {0.5, 0.3, 0.1};
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(middle[k], sRgb(facingMetal(colours[k], double{roughness})), 3) << roughness << " " << k;
  }
}

TEST(EnvironmentDrawing, TheSurroundingsAreSeenWhereTheyAre) {
  // Red in front, green to the right, blue behind, white above.
  SurroundedScene scene(surroundingsOf(128, [](const auto& d) {
    if (d[2] > 0.8) return std::array<double, 3>{1, 1, 1};
    if (std::abs(d[0]) > std::abs(d[1])) return std::array<double, 3>{0, d[0] > 0 ? 0.6 : 0.1, 0};
    return d[1] > 0 ? std::array<double, 3>{0.6, 0, 0} : std::array<double, 3>{0, 0, 0.6};
  }));
  scene.list.opaque.clear();
  const auto seenTowards = [&](const Vec3& way, float turnCos, float turnSin) {
    scene.list.sky.environment.turnCos = turnCos, scene.list.sky.environment.turnSin = turnSin;
    scene.list.views[0] = lookAt(Vec3(0, 0, 0), way, 0.2, 1.5);
    const Picture cpu = scene.byCpu(), gl = scene.byOpenGl();
    const auto *a = cpu.at(240, 160), *b = gl.at(240, 160);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[k], 2) << way.transpose();
    return std::array<int, 3>{a[0], a[1], a[2]};
  };
  const int bright = sRgb(0.6);
  EXPECT_NEAR(seenTowards({0, 1, 0}, 1, 0)[0], bright, 3);
  EXPECT_NEAR(seenTowards({1, 0, 0}, 1, 0)[1], bright, 3);
  EXPECT_NEAR(seenTowards({0, -1, 0}, 1, 0)[2], bright, 3);
  // Turned by 90 degrees, counter-clockwise from above: what was to the right is in front.
  EXPECT_NEAR(seenTowards({0, 1, 0}, 0, 1)[1], bright, 3);
  EXPECT_NEAR(seenTowards({-1, 0, 0}, 0, 1)[0], bright, 3);
}

TEST(EnvironmentDrawing, BothRenderersBendBrightLightAlike) {
  SurroundedScene scene;
  scene.list.sky.environment.intensity = 3;
  for (const ToneCurve curve : {ToneCurve::Soft, ToneCurve::Clamp, ToneCurve::Neutral, ToneCurve::Aces})
    for (const float exposure : {0.4f, 1.0f, 3.0f}) {
      scene.list.sky.tones = {exposure, curve};
      scene.expectAlike("curve " + std::to_string(static_cast<int>(curve)));
    }
}

TEST(EnvironmentDrawing, CurvesGiveTheirPublishedValues) {
  SurroundedScene scene(surroundingsOf(32, [](const auto&) { return std::array<double, 3>{0.5, 0.25, 2}; }));
  scene.list.opaque.clear();
  const auto shown = [&](ToneCurve curve, float exposure) {
    scene.list.sky.tones = {exposure, curve};
    const Picture p = scene.byCpu();
    return std::array<int, 3>{p.at(9, 9)[0], p.at(9, 9)[1], p.at(9, 9)[2]};
  };
  EXPECT_NEAR(shown(ToneCurve::Clamp, 1)[0], sRgb(0.5), 1);
  EXPECT_NEAR(shown(ToneCurve::Clamp, 0.5f)[0], sRgb(0.25), 1);
  EXPECT_EQ(shown(ToneCurve::Clamp, 1)[2], 255);
  const auto aces = [](double x) { return (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14); };
  for (const std::size_t k : {0u, 1u, 2u})
    EXPECT_NEAR(shown(ToneCurve::Aces, 1)[k], sRgb(aces(std::array{0.5, 0.25, 2.0}[k])), 1) << k;
  const double peak = 2 - 0.04, most = 1 - 0.24 * 0.24 / (peak + 0.24 - 0.76),
               white = 1 - 1 / (0.15 * (peak - most) + 1);
  for (const std::size_t k : {0u, 1u, 2u}) {
    const double scaled = (std::array{0.5, 0.25, 2.0}[k] - 0.04) * most / peak;
    EXPECT_NEAR(shown(ToneCurve::Neutral, 1)[k], sRgb(scaled + (most - scaled) * white), 1) << k;
  }
}

/// One context draws list after list: surroundings come, change and go.
TEST(EnvironmentDrawing, OpenGlFollowsTheSurroundingsFromFrameToFrame) {
  SurroundedScene scene;
  const MeshId white = surroundings(scene.meshes, whiteSurroundings(), 815);
  DrawList second = scene.list, third = scene.list;
  second.sky.environment.picture = white;
  third.sky.environment = {};
  const std::array lists{&scene.list, &second, &third};
  std::vector<Picture> expected;
  for (const DrawList* list : lists)
    expected.push_back(drawnByOpenGl(scene.meshes, *list, kSurroundedWidth, kSurroundedHeight));
  Stage stage(scene.meshes, kSurroundedWidth, kSurroundedHeight);
  for (const std::size_t i : {0u, 1u, 2u, 0u, 2u, 1u}) EXPECT_EQ(stage.draw(*lists[i]), expected[i]) << i;
}

TEST(EnvironmentLights, APictureThatIsFreedGivesWayToTheSky) {
  SurroundedScene scene;
  EnvironmentLights lights(scene.meshes);
  const auto pictured = lights.find(scene.list.sky);
  ASSERT_TRUE(pictured);
  EXPECT_GT(pictured->pictureSide, 0u);
  scene.meshes.release(scene.picture, 0);
  scene.meshes.collect(10);
  const auto sky = lights.find(scene.list.sky);
  ASSERT_TRUE(sky);
  EXPECT_EQ(sky->pictureSide, 0u);
  EXPECT_EQ(lights.find(scene.list.sky), sky) << "made once";
  scene.list.sky.environment.lit = 0;
  EXPECT_FALSE(lights.find(scene.list.sky));
}

}  // namespace
}  // namespace stadion::test
