/// Transparent surfaces are in the right order in every sample of a picture: compared with a peeling of the
/// scene, surface by surface, along a ray through each sample.

#include "engine/asset/mesh_checks.h"
#include "engine/maths/srgb.h"
#include "pipeline/gl_draw/warm_up_list.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

namespace stadion {
namespace {

using test::MeshMaker;
using test::place;
using test::Stage;

constexpr std::uint32_t kWide = 64, kHigh = 48;
constexpr double kView = 1.0;  ///< of the eye, from top to bottom [rad]

/// A parallelogram, seen from both sides.
struct Pane {
  Vec3 corner, along, up;
  std::array<float, 3> colour;
  float alpha;

  MeshId in(MeshStore& meshes) const {
    auto mesh = MeshMaker(test::matt(colour[0], colour[1], colour[2], alpha))
                    .quad(corner, corner + along, corner + along + up, corner + up)
                    .seal();
    finish(*mesh);  // its bounds are needed
    return meshes.add(std::move(mesh));
  }
};

Pane square(const Vec3& middle, const Vec3& along, const Vec3& up, std::array<float, 3> colour,
            float alpha = 0.5f) {
  return {middle - 0.5 * (along + up), along, up, colour, alpha};
}

struct GlassScene {
  std::vector<Pane> panes;  ///< opaque where alpha is 1
  Vec3 from{0, -10, 0}, to{0, 0, 0};

  DrawList list(MeshStore& meshes) const {
    DrawList list = test::plainList();
    list.sky.zenith = list.sky.horizon = list.sky.ground = {0.7f, 0.7f, 0.7f};
    list.views[0] = test::lookAt(from, to, kView, double{kWide} / kHigh);
    for (std::uint32_t i = 0; i < panes.size(); ++i) {
      DrawItem item = place(panes[i].in(meshes));
      item.owner = {1, i};
      (panes[i].alpha < 1 ? list.transparent : list.opaque).push_back(item);
    }
    std::ranges::stable_sort(list.opaque, {}, &DrawItem::mesh);
    return list;
  }
};

/// What is seen along one ray, in the colours in which it is blended. Nothing: it is too close to call.
std::optional<std::array<double, 3>> peeled(const GlassScene& scene, const Vec3& ray, double pixel,
                                            Look look) {
  const auto seen = [&](float c) { return look == Look::Full ? double{c} : srgbFromLinear(double{c}); };
  struct Hit {
    double distance;
    const Pane* pane;
  };
  std::vector<Hit> hits;
  for (const Pane& pane : scene.panes) {
    Mat3 m;
    m << pane.along, pane.up, -ray;
    if (std::abs(m.determinant()) < 1e-9) return {};
    const Vec3 at = m.inverse() * (scene.from - pane.corner);
    if (at.z() <= 0.1) {
      if (at.z() > 0.09) return {};
      continue;
    }
    for (int k = 0; k < 2; ++k) {
      const double edge = std::min(std::abs(at[k]), std::abs(at[k] - 1));
      // Corners are rounded to a part of a pixel.
      const double tilt = std::abs(ray.dot(pane.along.cross(pane.up).normalized())) / ray.norm();
      const double close =
          0.03 * pixel * at.z() / std::max(tilt, 1e-3) / (k == 0 ? pane.along : pane.up).norm();
      const bool besideIt = at[1 - k] > -close * 4 && at[1 - k] < 1 + close * 4;
      if (edge < close && besideIt) return {};
    }
    if (at.x() > 0 && at.x() < 1 && at.y() > 0 && at.y() < 1) hits.push_back({at.z(), &pane});
  }
  std::array<double, 3> sum{};
  double left = 1, last = 0;
  for (;;) {  // the next one behind the last
    const Hit* next = nullptr;
    for (const Hit& hit : hits)
      if (hit.distance > last && (!next || hit.distance < next->distance)) next = &hit;
    if (!next) break;
    for (const Hit& hit : hits)
      if (&hit != next && std::abs(hit.distance - next->distance) < 1e-4 * next->distance) return {};
    last = next->distance;
    const double alpha = double{next->pane->alpha};
    for (std::size_t k = 0; k < 3; ++k) sum[k] += left * alpha * seen(next->pane->colour[k]);
    left *= 1 - alpha;
    if (alpha >= 1) return sum;
  }
  for (double& c : sum) c += left * seen(0.7f);
  return sum;
}

/// The greatest difference from the picture [levels], of pixels that are not too close to call.
int differenceFrom(const GlassScene& scene, const test::Picture& picture, Look look,
                   double* judged = nullptr) {
  constexpr std::array<std::array<double, 2>, 4> kSamples{
      {{0.375, 0.125}, {0.875, 0.375}, {0.125, 0.625}, {0.625, 0.875}}};
  const Vec3 ahead = (scene.to - scene.from).normalized(), right = ahead.cross(Vec3::UnitZ()).normalized();
  const Vec3 up = right.cross(ahead);
  const double half = std::tan(kView / 2), pixel = 2 * half / kHigh;
  int most = 0, sure = 0;
  for (std::uint32_t y = 0; y < kHigh; ++y)
    for (std::uint32_t x = 0; x < kWide; ++x) {
      std::array<double, 3> sum{};
      bool isSure = true;
      const std::size_t samples = look == Look::Full ? 4 : 1;
      for (std::size_t s = 0; s < samples && isSure; ++s) {
        const std::array<double, 2> off = look == Look::Full ? kSamples[s] : std::array{0.5, 0.5};
        const double row = kHigh - 1 - y;  // OpenGL's, from the bottom
        const Vec3 ray = ahead + right * ((x + off[0]) * pixel - half * kWide / kHigh) +
                         up * ((row + off[1]) * pixel - half);
        const auto c = peeled(scene, ray, pixel, look);
        isSure = c.has_value();
        for (std::size_t k = 0; isSure && k < 3; ++k) sum[k] += (*c)[k] / static_cast<double>(samples);
      }
      if (!isSure) continue;
      ++sure;
      for (std::size_t k = 0; k < 3; ++k) {
        const int expected =
            look == Look::Full ? int{test::sRgb(sum[k])} : static_cast<int>(std::lround(255 * sum[k]));
        most = std::max(most, std::abs(expected - int{picture.at(x, y)[k]}));
      }
    }
  if (judged) *judged = double(sure) / (kWide * kHigh);
  return most;
}

RenderQuality qualityOf(Look look) {
  return look == Look::Full ? RenderQuality{} : RenderQuality::plain();
}

/// Of all of them, by one renderer for each look.
void expectAsPeeled(const std::vector<GlassScene>& scenes, double leastJudged = 0.5) {
  for (const Look look : {Look::Full, Look::Plain}) {
    MeshStore meshes;
    Stage stage(meshes, kWide, kHigh, GlProviderKind::OsMesa, qualityOf(look));
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const auto picture = stage.draw(scenes[i].list(meshes));
      double judged = 0;
      const int off = differenceFrom(scenes[i], picture, look, &judged);
      EXPECT_LE(off, 2) << "scene " << i << (look == Look::Full ? ", full look" : ", plain look");
      EXPECT_GT(judged, leastJudged) << "scene " << i;
      if (off > 2) test::writePng(picture, "glass-" + std::to_string(i));
    }
  }
}

class GlassDice {
public:
  explicit GlassDice(unsigned seed) : engine_(seed) {}
  double from(double lo, double hi) { return std::uniform_real_distribution(lo, hi)(engine_); }
  Vec3 vector(double most) { return {from(-most, most), from(-most, most), from(-most, most)}; }
  std::array<float, 3> colour() {
    return {static_cast<float>(from(0.02, 0.7)), static_cast<float>(from(0.02, 0.7)),
            static_cast<float>(from(0.02, 0.7))};
  }

private:
  std::mt19937 engine_;
};

TEST(GlassOrder, ALargePaneCoversASmallOneBehindItThoughItsMiddleIsFarther) {
  GlassScene scene;
  scene.panes = {square({8, 0, 0}, {20, 0, 0}, {0, 0, 4}, {0.02f, 0.7f, 0.02f}, 0.9f),
                 square({-1, 2, 0}, {2, 0, 0}, {0, 0, 2}, {0.7f, 0.02f, 0.02f}, 0.9f)};
  GlassScene turned = scene;
  std::swap(turned.panes[0], turned.panes[1]);
  expectAsPeeled({scene, turned});
}

TEST(GlassOrder, PanesThatIntersectAreInOrderOnBothSidesOfTheLine) {
  GlassScene scene;
  scene.panes = {square({0, 0, 0}, {6, 6, 0}, {0, 0, 6}, {0.7f, 0.1f, 0.1f}),
                 square({0, 0, 0}, {6, -6, 0}, {0, 0, 6}, {0.1f, 0.7f, 0.1f}),
                 square({0, 0, 0}, {6, 0, 2}, {0, 5, 3}, {0.1f, 0.1f, 0.7f}, 0.7f)};
  expectAsPeeled({scene});
}

TEST(GlassOrder, RandomPanesOfAnySizeAmongOpaqueOnes) {
  std::vector<GlassScene> scenes;
  for (unsigned seed = 1; seed <= 16; ++seed) {
    GlassDice dice(seed);
    GlassScene scene;
    const int count = 2 + static_cast<int>(seed % 7);
    for (int i = 0; i < count; ++i) {
      const double size = dice.from(1, 12);
      const bool opaque = i % 5 == 4;
      scene.panes.push_back(square(dice.vector(4), dice.vector(size), dice.vector(size), dice.colour(),
                                   opaque ? 1.0f : static_cast<float>(dice.from(0.1, 0.95))));
    }
    scenes.push_back(scene);
  }
  expectAsPeeled(scenes, 0.2);
}

TEST(GlassOrder, ARoomOfGlassFromInsideAndFromOutside) {
  GlassScene scene;
  const std::array<float, 3> walls{0.1f, 0.4f, 0.7f}, ends{0.7f, 0.4f, 0.1f};
  scene.panes = {square({0, 4, 0}, {8, 0, 0}, {0, 0, 5}, ends),
                 square({0, -4, 0}, {8, 0, 0}, {0, 0, 5}, ends),
                 square({4, 0, 0}, {0, 8, 0}, {0, 0, 5}, walls),
                 square({-4, 0, 0}, {0, 8, 0}, {0, 0, 5}, walls),
                 square({0, 0, 2.5}, {8, 0, 0}, {0, 8, 0}, {0.3f, 0.3f, 0.3f}),
                 square({0, 0, -2.5}, {8, 0, 0}, {0, 8, 0}, {0.5f, 0.5f, 0.1f}),
                 square({1, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0.7f, 0, 0}, 1)};
  std::vector<GlassScene> views;
  for (const Vec3& from : {Vec3(0.3, -2, 0.2), Vec3(-3, 3, 1), Vec3(0, -12, 1), Vec3(9, -9, 6)})
    for (const Vec3& to : {Vec3(1, 1, 0), Vec3(-2, 0.5, -1)}) {
      scene.from = from, scene.to = to;
      views.push_back(scene);
    }
  expectAsPeeled(views, 0.3);
}

/// The `count` squares stand one behind the other, in an order that has nothing to do with it.
GlassScene stack(int count, float alpha) {
  GlassScene scene;
  GlassDice dice(static_cast<unsigned>(count));
  for (int i = 0; i < count; ++i) {
    const int at = i * 7 % count;
    scene.panes.push_back(square({0.3 * std::sin(at), 0.35 * at - 4, 0.3 * std::cos(at)}, {5, 0.05 * at, 0},
                                 {0, 0, 4}, dice.colour(), alpha));
  }
  return scene;
}

TEST(GlassOrder, EightTwelveAndThirtyTwoLayersAreExact) {
  std::vector<GlassScene> scenes;
  for (const int layers : {1, 3, 4, 5, 8, 9, 12, 31, 32})
    scenes.push_back(stack(layers, layers > 12 ? 0.1f : 0.3f));
  expectAsPeeled(scenes);
}

TEST(GlassOrder, MoreLayersDegradeGracefully) {
  for (const Look look : {Look::Full, Look::Plain}) {
    MeshStore meshes;
    Stage stage(meshes, kWide, kHigh, GlProviderKind::OsMesa, qualityOf(look));
    for (const int layers : {33, 40, 100}) {
      const GlassScene scene = stack(layers, 0.05f);
      EXPECT_LE(differenceFrom(scene, stage.draw(scene.list(meshes)), look), layers < 50 ? 3 : 12) << layers;
    }
  }
}

TEST(GlassOrder, OfPanesAtTheSameDepthTheLaterInTheListIsInFront) {
  GlassScene scene;
  scene.panes = {square({0, 0, 0}, {4, 0, 0}, {0, 0, 4}, {0.7f, 0, 0}, 0.8f),
                 square({0, 0, 0}, {4, 0, 0}, {0, 0, 4}, {0, 0.7f, 0}, 0.8f),
                 square({0, 0, 0}, {4, 0, 0}, {0, 0, 4}, {0, 0, 0.7f}, 0.8f)};
  MeshStore meshes;
  Stage stage(meshes, kWide, kHigh);
  for (const Vec3& from : {Vec3(0, -10, 0), Vec3(3, -8, 2), Vec3(1, 9, -2)}) {
    scene.from = from;
    for (int k = 0; k < 3; ++k) {
      const auto picture = stage.draw(scene.list(meshes));
      std::array<double, 3> expected{0.7, 0.7, 0.7};
      for (const Pane& pane : scene.panes)
        for (std::size_t c = 0; c < 3; ++c)
          expected[c] = double{pane.alpha} * double{pane.colour[c]} + (1 - double{pane.alpha}) * expected[c];
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(picture.at(kWide / 2, kHigh / 2)[c], test::sRgb(expected[c]), 2) << k;
      std::rotate(scene.panes.begin(), scene.panes.begin() + 1, scene.panes.end());
    }
  }
}

TEST(GlassOrder, OnAnOpaqueSurfaceItIsSeen) {
  GlassScene scene;
  scene.panes = {square({0, 0, 0}, {90, 40, 7}, {-3, 9, 60}, {0.7f, 0.1f, 0.1f}, 1),
                 square({0, 0, 0}, {90, 40, 7}, {-3, 9, 60}, {0.1f, 0.7f, 0.1f}, 0.5f)};
  MeshStore meshes;
  const auto picture = Stage(meshes, kWide, kHigh).draw(scene.list(meshes));
  for (std::uint32_t y = 0; y < kHigh; ++y)
    for (std::uint32_t x = 0; x < kWide; ++x) {
      ASSERT_NEAR(picture.at(x, y)[0], test::sRgb(0.4), 2) << x << " " << y;
      ASSERT_NEAR(picture.at(x, y)[1], test::sRgb(0.4), 2) << x << " " << y;
    }
}

TEST(GlassOrder, ThePictureDoesNotDependOnHowManyFragmentsAreSortedAtATime) {
  GlassScene scene = stack(12, 0.3f);
  scene.panes.push_back(square({0, -1, 0}, {6, 6, 0}, {0, 0, 6}, {0.7f, 0.1f, 0.1f}));
  MeshStore meshes;
  const DrawList list = scene.list(meshes);
  for (const Look look : {Look::Full, Look::Plain}) {
    RenderQuality quality = qualityOf(look);
    const auto whole = Stage(meshes, kWide, kHigh, GlProviderKind::OsMesa, quality).draw(list);
    for (const std::uint32_t most : {20000U, 3000U, 300U}) {
      quality.mostFragments = most;
      Stage stage(meshes, kWide, kHigh, GlProviderKind::OsMesa, quality);
      const auto parts = stage.draw(list), again = stage.draw(list);
      EXPECT_TRUE(parts == whole) << most;
      EXPECT_TRUE(again == whole) << most << ", the second time";
    }
  }
}

TEST(GlassOrder, EveryProviderDrawsTheSame) {
  const GlassScene scene = stack(9, 0.4f);
  MeshStore meshes;
  const DrawList list = scene.list(meshes);
  const auto expected = Stage(meshes, kWide, kHigh).draw(list);
  EXPECT_TRUE(Stage(meshes, kWide, kHigh, GlProviderKind::Egl).draw(list) == expected);
}

/// Light, haze and pictures with holes are those of an opaque surface, as much of them as alpha says.
TEST(GlassOrder, WhatIsKeptIsLitAsAnOpaqueSurfaceIs) {
  MeshStore meshes;
  DrawList list = test::plainList();
  list.sky.zenith = list.sky.horizon = {0.2f, 0.2f, 0.6f};
  list.sky.hazeDistance = 40;
  DrawLight sun, lamp;
  sun.direction = {0.3f, 0.8f, -0.5f}, sun.colour = {0.4f, 0.4f, 0.3f};
  lamp.kind = DrawLight::Kind::Point, lamp.position = {0.5f, -2, 0.3f}, lamp.range = 6;
  list.lights = {sun, lamp};
  list.sky.ambient = {0.1f, 0.1f, 0.1f};
  const auto sheet = [&](float alpha, double y) {
    auto mesh = MeshMaker(test::matt(0.5f, 0.6f, 0.4f, alpha))
                    .texture(test::chequered(8, 2))
                    .quad({-0.8, y, -0.8}, {0.8, y, -0.8}, {0.8, y, 0.8}, {-0.8, y, 0.8})
                    .seal();
    finish(*mesh);
    return meshes.add(std::move(mesh));
  };
  for (const Look look : {Look::Full, Look::Plain}) {
    Stage stage(meshes, kWide, kHigh, GlProviderKind::OsMesa, qualityOf(look));
    const auto empty = stage.draw(list);
    EXPECT_FALSE(stage.renderer().holdsLayers()) << "what is opaque needs none";
    list.opaque = {place(sheet(1, 0))};
    const auto solid = stage.draw(list);
    EXPECT_FALSE(stage.renderer().holdsLayers());
    list.opaque.clear();
    list.transparent = {place(sheet(0.4f, 0))};
    const auto glass = stage.draw(list);
    EXPECT_TRUE(stage.renderer().holdsLayers());
    list.transparent.clear();
    for (std::uint32_t y = 8; y < kHigh; y += 7)
      for (std::uint32_t x = 8; x < kWide; x += 7)
        for (std::size_t k = 0; k < 3; ++k) {
          const auto light = [&](const test::Picture& p) {
            const double stored = p.at(x, y)[k] / 255.0;
            return look == Look::Full ? linearFromSrgb(stored) : stored;
          };
          const double mixed = 0.4 * light(solid) + 0.6 * light(empty);
          EXPECT_NEAR(glass.at(x, y)[k], look == Look::Full ? test::sRgb(mixed) : 255 * mixed, 2.5)
              << x << " " << y;
        }
  }
}

/// The name of a new program: OpenGL counts them, so another one between two tells that it was compiled.
GLuint nextProgram(const GlTable& gl) {
  return gl.CreateProgram();
}

/// Objects that a script fades need other programs than opaque ones. The warm-up compiles them.
TEST(Glass, AfterTheWarmUpNoProgramIsCompiledWhenAnObjectFades) {
  for (const bool isTold : {true, false})
    for (const Look look : {Look::Full, Look::Plain}) {
      MeshStore meshes;
      const GlassScene scene{{square({0, 0, 0}, {2, 0, 0}, {0, 0, 2}, {0.9f, 0.2f, 0.1f}, 1)}};
      DrawList opaque = scene.list(meshes);
      const MeshId id = opaque.opaque[0].mesh;
      RenderQuality quality;
      quality.look = look;
      Stage stage(meshes, kWide, kHigh, GlProviderKind::OsMesa, quality);
      const std::vector<MeshId> fading = isTold ? std::vector<MeshId>{id} : std::vector<MeshId>();
      ASSERT_FALSE(stage.renderer().warmUp(warmUpList(opaque, meshes, fading), {}));
      (void)stage.draw(opaque);
      const GLuint before = nextProgram(stage.gl());
      DrawList faded = opaque;
      faded.paints.push_back({.opacity = 0.5f});
      faded.opaque[0].paint = 1;
      faded.transparent = std::exchange(faded.opaque, {});
      EXPECT_NE(stage.draw(faded).rgba, stage.draw(opaque).rgba);
      EXPECT_EQ(nextProgram(stage.gl()) == before + 1, isTold);
    }
}

}  // namespace
}  // namespace stadion
