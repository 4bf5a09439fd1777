/// Surfaces with holes (alphaMode MASK), and pictures that say where a surface emits light.
#include "engine/asset/mesh_checks.h"
#include "engine/asset/simplify.h"
#include "engine/maths/srgb.h"
#include "pipeline/surface/mask_levels.h"
#include "pipeline/process/per_wall_process_renderer.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using test::matt;
using test::MeshMaker;
using test::place;

struct MaskQuality {
  const char* name;
  RenderQuality quality;
};

const MaskQuality kMaskQualities[] = {
    {"full", {}},
    {"full, one sample", {Look::Full, 1, 1024, true, true}},
    {"plain", RenderQuality::plain()},
    {"plain, all by OpenGL", {Look::Plain, 1, 1024, false, false}},
};

/// Draws with one renderer, whatever is added to the store.
struct MaskStage : test::Stage {
  MaskStage(const MeshStore& meshes, const RenderQuality& quality, std::uint32_t side = 64)
      : Stage(meshes, side, side, GlProviderKind::OsMesa, quality) {}
};

/// Solid where `there` says so; of a colour.
template <class F>
Texture leaf(std::uint32_t side, const F& there, std::uint8_t hole = 0) {
  Texture t{side, side, {}, "leaf"};
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x)
      for (const std::uint8_t c :
           {std::uint8_t{255}, std::uint8_t{255}, std::uint8_t{255}, there(x, y) ? std::uint8_t{255} : hole})
        t.rgba.push_back(c);
  return t;
}

Texture leftHalf(std::uint32_t side = 16) {
  return leaf(side, [&](std::uint32_t x, std::uint32_t) { return x < side / 2; });
}

Material masked(float r, float g, float b, float cutoff = 0.5f) {
  Material m = matt(r, g, b);
  m.alphaCutoff = cutoff, m.doubleSided = true;
  return m;
}

std::unique_ptr<Mesh> card(Material material, Texture texture, double y = 0, double half = 1) {
  MeshMaker maker(std::move(material));
  return maker.texture(std::move(texture))
      .quad({-half, y, -half}, {half, y, -half}, {half, y, half}, {-half, y, half})
      .seal();
}

std::unique_ptr<Mesh> sheetAt(Material material, double y, double half = 1) {
  return MeshMaker(std::move(material))
      .quad({-half, y, -half}, {half, y, -half}, {half, y, half}, {-half, y, half})
      .seal();
}

/// So many pixels in which that channel alone is bright.
std::size_t ofColour(const test::Picture& picture, std::size_t channel) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    bool is = picture.rgba[i + channel] > 150;
    for (std::size_t k = 0; k < 3; ++k) is = is && (k == channel || picture.rgba[i + k] < 100);
    count += is;
  }
  return count;
}

/// A near red card with holes before a far green one, in one mesh, with the far one's triangles last or
/// first; behind them blue sky.
std::unique_ptr<Mesh> twoCards(bool farFirst) {
  MeshMaker maker(masked(1, 1, 1));
  maker.texture(leftHalf());
  const double depths[] = {farFirst ? 1.0 : 0.0, farFirst ? 0.0 : 1.0};
  for (const double y : depths) {
    const double shift = y > 0 ? 0.5 : 0;  // its solid half is behind both halves of the near one
    maker.quad({-1 + shift, y, -1}, {1 + shift, y, -1}, {1 + shift, y, 1}, {-1 + shift, y, 1});
  }
  auto mesh = maker.seal();
  mesh->colours.assign(8, {0, 255, 0, 255});
  std::fill_n(mesh->colours.begin() + (farFirst ? 4 : 0), 4, std::array<std::uint8_t, 4>{255, 0, 0, 255});
  return mesh;
}

DrawList blueList() {
  DrawList list = test::plainList();
  list.sky.zenith = list.sky.horizon = {0, 0, 1};
  list.sky.ground = {0, 0, 1};
  list.sky.ambient = {1, 1, 1};
  list.lights = {};
  return list;
}

TEST(PictureMask, ANearCardCoversAFarOneAndIsSeenThroughWhereItHasHoles) {
  for (const MaskQuality& q : kMaskQualities)
    for (const std::uint32_t side : {64u, 40u}) {
      MeshStore meshes;
      MaskStage stage(meshes, q.quality, side);
      for (const bool farFirst : {false, true}) {
        DrawList list = test::plainList();
        list.opaque = {place(meshes.add(twoCards(farFirst)))};
        const auto picture = stage.draw(list);
        // Red in the left half; green from a quarter to three quarters, of which the left part is hidden.
        EXPECT_NEAR(double(ofColour(picture, 0)), side * side / 2.0, 2.0 * side) << q.name;
        EXPECT_NEAR(double(ofColour(picture, 1)), side * side / 4.0, 2.0 * side) << q.name;
        EXPECT_GT(picture.at(side / 8, side / 2)[0], 200);
        EXPECT_GT(picture.at(3 * side / 8, side / 2)[0], 200) << "red before green";
        EXPECT_LT(picture.at(3 * side / 8, side / 2)[1], 60);
        EXPECT_GT(picture.at(5 * side / 8, side / 2)[1], 200) << "green through the hole";
      }
    }
}

/// Alpha at or above the cutoff is there, whichever factor it comes from.
TEST(PictureMask, AlphaIsTheProductOfPictureFactorAndVertexColour) {
  const struct {
    float factor, cutoff;
    std::uint8_t picture, vertex;
    bool seen;
  } cases[] = {{1, 0.5f, 255, 255, true},     {1, 0.5f, 127, 255, false},    {1, 0.5f, 128, 255, true},
               {1, 0.5f, 255, 127, false},    {1, 0.5f, 255, 128, true},     {0.6f, 0.5f, 255, 255, true},
               {0.6f, 0.5f, 200, 255, false}, {0.6f, 0.5f, 255, 200, false}, {0.4f, 0.5f, 255, 255, false},
               {0.4f, 0.3f, 255, 255, true},  {1, 1, 255, 255, true},        {1, 1, 254, 255, false},
               {1, 1.5f, 255, 255, false},    {1, 0.004f, 0, 255, false}};
  for (const MaskQuality& q : kMaskQualities) {
    MeshStore meshes;
    MaskStage stage(meshes, q.quality, 16);
    for (const bool pictured : {true, false})
      for (const auto& c : cases) {
        if (!pictured && c.picture != 255) continue;
        Material material = masked(1, 0, 0, c.cutoff);
        material.baseColour[3] = c.factor;
        auto mesh = pictured ? card(material, leaf(
                                                  4, [](auto, auto) { return false; }, c.picture))
                             : sheetAt(material, 0);
        mesh->colours.assign(mesh->positions.size(), {255, 255, 255, c.vertex});
        DrawList list = test::plainList();
        list.opaque = {place(meshes.add(std::move(mesh)))};
        const std::size_t red = ofColour(stage.draw(list), 0);
        EXPECT_EQ(red, c.seen ? 256u : 0u) << q.name << ", " << c.factor << ", " << c.cutoff << ", "
                                           << int(c.picture) << ", " << int(c.vertex);
      }
  }
}

TEST(PictureMask, SimplifiedLevelsAndMirroredThingsHaveTheSameHoles) {
  for (const MaskQuality& q : kMaskQualities) {
    MeshStore meshes;
    auto mesh = card(masked(1, 0, 0), leftHalf());
    mesh->levels.push_back({mesh->indices, mesh->submeshes, 0.1});
    const MeshId id = meshes.add(std::move(mesh));
    DrawList list = blueList();
    list.opaque = {place(id)};
    MaskStage stage(meshes, q.quality);
    const auto full = stage.draw(list);
    list.opaque[0].level = 1;
    EXPECT_EQ(stage.draw(list), full) << q.name;
    Affine mirror = Affine::Identity();
    mirror.linear()(0, 0) = -1;
    list.opaque = {place(id, mirror)};
    const auto mirrored = stage.draw(list);
    EXPECT_NEAR(double(ofColour(mirrored, 0)), double(ofColour(full, 0)), 128) << q.name;
    EXPECT_GT(mirrored.at(48, 32)[0], 200) << q.name;
    EXPECT_LT(mirrored.at(16, 32)[0], 60) << q.name;
  }
}

/// Many cards a few pixels wide, which OpenGL need not draw in the plain look.
TEST(PictureMask, SmallCardsHaveTheirHolesToo) {
  MeshStore meshes;
  auto byVertex = sheetAt(masked(1, 0, 0), 0);
  byVertex->colours = {{255, 255, 255, 255}, {255, 255, 255, 0}, {255, 255, 255, 0}, {255, 255, 255, 255}};
  const MeshId ids[] = {meshes.add(card(masked(1, 0, 0), leftHalf())), meshes.add(std::move(byVertex)),
                        meshes.add(sheetAt(matt(1, 0, 0), 0))};
  std::array<std::size_t, 3> red{}, byOpenGl{};
  for (const bool here : {true, false}) {
    MaskStage stage(meshes,
                    here ? RenderQuality::plain() : RenderQuality{Look::Plain, 1, 1024, false, false});
    for (std::size_t kind = 0; kind < 3; ++kind) {
      DrawList list = test::plainList();
      list.views[0] = test::lookAt(Vec3(0, -10, 0), Vec3::Zero(), 0.2, 1);
      for (int i = 0; i < 64; ++i) {
        Affine X = Affine::Identity();
        X.translation() = Vec3(0.25 * (i % 8) - 0.875, 0, 0.25 * (i / 8) - 0.875);
        X.linear() *= 0.1;
        list.opaque.push_back(place(ids[kind], X));
      }
      (here ? red : byOpenGl)[kind] = ofColour(stage.draw(list), 0);
    }
  }
  for (std::size_t kind = 0; kind < 3; ++kind)
    EXPECT_NEAR(double(red[kind]), double(byOpenGl[kind]), kind == 2 ? 8 : 0) << kind;
  for (const std::size_t kind : {0u, 1u}) EXPECT_NEAR(double(red[kind]), red[2] / 2.0, red[2] / 8.0) << kind;
}

/// What is as fine as half a pixel is there for as large a part as near by.
TEST(PictureMask, FarAwayAsMuchOfItIsThereAsNearBy) {
  for (const MaskQuality& q : kMaskQualities) {
    MeshStore meshes;
    MaskStage stage(meshes, q.quality, 61);
    for (const std::uint32_t holes : {1u, 2u, 4u, 8u}) {
      const MeshId id = meshes.add(card(masked(1, 0, 0), leaf(64, [&](std::uint32_t x, std::uint32_t y) {
                                          return x / holes % 2 && y / holes % 2;
                                        })));
      DrawList list = blueList();
      for (int i = 0; i < 256; ++i) {  // each a little over three pixels wide
        Affine X = Affine::Identity();
        X.translation() = Vec3((i % 16 + 0.5) / 8 - 1, 0, (i / 16 + 0.5) / 8 - 1);
        X.linear() *= 1 / 18.3;
        list.opaque.push_back(place(id, X));
      }
      const auto picture = stage.draw(list);
      double red = 0;
      for (std::size_t i = 0; i < picture.rgba.size(); i += 4) red += picture.rgba[i] > 100;
      const double covered = 61 * 61 * 0.765;  // by the cards
      EXPECT_NEAR(red / covered, 0.25, 0.15) << q.name << ", " << holes;
    }
  }
}

TEST(MaskLevels, KeepThePartThatIsThereOrEnd) {
  const auto part = [](const Texture& t, float cutoff) {
    double there = 0;
    for (std::size_t i = 3; i < t.rgba.size(); i += 4) there += static_cast<float>(t.rgba[i]) / 255 >= cutoff;
    return 4 * there / static_cast<double>(t.rgba.size());
  };
  for (const float cutoff : {0.1f, 0.5f, 0.9f, 1.0f})
    for (const Look look : {Look::Full, Look::Plain}) {
      std::uint64_t state = 7;
      Texture noise{37, 64, {}, "noise"};
      for (std::size_t i = 0; i < std::size_t{4} * 37 * 64; ++i) {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        noise.rgba.push_back(static_cast<std::uint8_t>(state >> 40));
      }
      for (const Texture& t : {leftHalf(64), noise}) {
        const auto levels = maskLevels(t, cutoff, look);
        ASSERT_FALSE(levels.empty());
        std::uint32_t width = t.width, height = t.height;
        for (const Texture& level : levels) {
          EXPECT_EQ(level.width, width = std::max(width / 2, 1u));
          EXPECT_EQ(level.height, height = std::max(height / 2, 1u));
          ASSERT_EQ(level.rgba.size(), std::size_t{4} * width * height);
          EXPECT_NEAR(part(level, cutoff), part(t, cutoff), 0.06) << width;
        }
      }
    }
  // Of a net as fine as its texels no level can be made, and colours of holes are seen nowhere.
  EXPECT_TRUE(maskLevels(leaf(16, [](auto x, auto y) { return x % 2 && y % 2; }), 0.5f, Look::Full).empty());
  Texture t = leftHalf(64);
  for (std::size_t i = 0; i < t.rgba.size(); i += 4)
    if (t.rgba[i + 3] == 0) t.rgba[i] = 0;
  for (const Texture& level : maskLevels(t, 0.5f, Look::Full))
    for (std::size_t i = 0; i < level.rgba.size(); i += 4)
      EXPECT_TRUE(level.rgba[i + 3] == 0 || level.rgba[i] == 255);
}

/// Seen from above: a card over the ground, under a sun that stands straight above both.
TEST(PictureMask, TheShadowHasTheHolesOfTheCard) {
  MeshStore meshes;
  MaskStage stage(meshes, {});
  std::uint64_t key = 0;
  for (const bool byVertex : {false, true})
    for (const bool moves : {false, true}) {
      ++key;
      MeshMaker flat(masked(0.6f, 0.6f, 0.6f));
      flat.texture(byVertex ? leaf(4, [](auto, auto) { return true; }) : leftHalf());
      flat.quad({-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0});
      auto mesh = flat.seal();
      if (byVertex) {  // from solid at the left to nothing at the right
        mesh->colours = {{255, 255, 255, 255}, {255, 255, 255, 0}, {255, 255, 255, 0}, {255, 255, 255, 255}};
        mesh->textures.clear(), mesh->uvs.clear();
        mesh->materials[0].maps[kBaseMap].texture = -1;
      }
      Affine up = Affine::Identity();
      up.translation() = Vec3(0, 0, 30);
      const DrawItem caster = place(meshes.add(std::move(mesh)), up);
      MeshMaker ground(matt(0.5f, 0.5f, 0.5f));
      ground.quad({-20, -20, 0}, {20, -20, 0}, {20, 20, 0}, {-20, 20, 0});
      DrawList list = test::plainList();
      list.sky.ambient = {0.1f, 0.1f, 0.1f};
      list.opaque = {place(meshes.add(ground.seal()))};
      list.views[0] = test::lookAt(Vec3(0, -0.01, 10), Vec3::Zero(), 0.6, 1);
      DrawLight sun;
      sun.direction = {0, 0, -1}, sun.shadows = true;
      list.lights = {sun};
      list.shadows.light = 0;
      list.shadows.axes = {1, 0, 0, 0, 1, 0, 0, 0, 1};
      for (DrawShadowRing& ring : list.shadows.rings) {
        ring.stillKey = ring.movingKey = key;
        if (moves)
          ring.moving = {caster}, ring.movingArea = {-1, -1, 1, 1};
        else
          ring.still = std::make_shared<std::vector<DrawItem>>(1, caster);
      }
      const auto picture = stage.draw(list);
      const auto at = [&](double x, double y) {  // [m]
        const double scale = 32 / (10 * std::tan(0.3));
        return int(picture.at(static_cast<std::uint32_t>(32 + scale * x),
                              static_cast<std::uint32_t>(32 - scale * y))[1]);
      };
      for (const double y : {-1.0, 0.0, 1.5}) {
        EXPECT_LT(at(-1.2, y), 120) << "below what is solid";
        EXPECT_GT(at(1.2, y), 150) << "below the hole";
        EXPECT_GT(at(2.6, y), 150) << "beside it";
      }
    }
}

/// Dark, but for the picture of light.
TEST(PictureGlow, OnlyWhatThePictureOfLightShowsGlows) {
  Texture lamp{16, 16, {}, "lamp"};
  for (std::uint32_t y = 0; y < 16; ++y)
    for (std::uint32_t x = 0; x < 16; ++x)
      for (const int c : {255, 128, 0, 0}) lamp.rgba.push_back(static_cast<std::uint8_t>(x < 8 ? c : 0));
  for (const MaskQuality& q : kMaskQualities) {
    MeshStore meshes;
    MaskStage stage(meshes, q.quality);
    for (const bool pictured : {false, true})
      for (const float factor : {1.0f, 0.25f}) {
        Material material = matt(0.8f, 0.8f, 0.8f);
        material.emissive = {factor, factor, 1};
        auto mesh = card(material, lamp);
        mesh->materials[0].maps[kBaseMap].texture = -1, mesh->materials[0].maps[kEmissiveMap].texture = 0;
        if (pictured) {
          mesh->textures.push_back(test::chequered(16, 4));
          mesh->materials[0].maps[kBaseMap].texture = 1;
        }
        DrawList list = test::plainList();
        list.sky.ambient = {0, 0, 0};
        list.opaque = {place(meshes.add(std::move(mesh)))};
        const auto picture = stage.draw(list);
        const auto *lit = picture.at(16, 20), *dark = picture.at(48, 20);
        EXPECT_EQ(int(dark[0]) + dark[1] + dark[2], 0) << q.name;
        const bool bent = q.quality.look == Look::Full && factor == 1;  // by softClip
        EXPECT_NEAR(lit[0], bent ? 243 : 255 * srgbFromLinear(double{factor}), 3) << q.name << ", " << factor;
        EXPECT_GT(lit[1], 40) << q.name;
        EXPECT_LT(lit[1], 140) << q.name;
        EXPECT_EQ(lit[2], 0) << q.name;
        list.sky.ambient = {1, 1, 1};
        const auto day = stage.draw(list);
        EXPECT_GT(day.at(48, 20)[2], 30) << q.name << ": lit by day";
        EXPECT_NEAR(day.at(48, 20)[0], day.at(48, 20)[2], pictured ? 130 : 1) << q.name;
      }
  }
}

TEST(PictureGlow, AMaskedLampHasHolesAndGlowsBetweenThem) {
  for (const MaskQuality& q : kMaskQualities) {
    MeshStore meshes;
    Material material = masked(1, 1, 1);
    material.emissive = {0, 0.6f, 0};
    auto mesh = card(material, leftHalf());
    mesh->textures.push_back(leaf(4, [](auto, auto) { return true; }));
    mesh->materials[0].maps[kEmissiveMap].texture = 1;
    DrawList list = blueList();
    list.sky.ambient = {0, 0, 0};
    list.opaque = {place(meshes.add(std::move(mesh)))};
    MaskStage stage(meshes, q.quality);
    const auto picture = stage.draw(list);
    EXPECT_GT(picture.at(16, 32)[1], 150) << q.name;
    EXPECT_EQ(picture.at(16, 32)[0], 0) << q.name;
    EXPECT_LT(picture.at(48, 32)[1], 60) << q.name;
  }
}

TEST(ProgramWallProcesses, DrawHolesAndPicturesOfLightAsThisProcessDoes) {
  for (const Look look : {Look::Full, Look::Plain}) {
    MeshStore meshes;
    Material lamp = matt(0.2f, 0.1f, 0.1f);
    lamp.emissive = {1, 0.5f, 0.2f}, lamp.maps[kEmissiveMap].texture = 0;
    auto shining = card(lamp, test::chequered(16, 4), 0.5);
    shining->materials[0].maps[kBaseMap].texture = -1;
    DrawList list = blueList();
    list.opaque = {place(meshes.add(card(masked(1, 0, 0), leftHalf()))),
                   place(meshes.add(std::move(shining)))};
    PerWallProcessParts parts{.meshes = meshes, .walls = {{48, 36}}, .names = {"w"}};
    const RenderQuality quality = look == Look::Full ? RenderQuality{} : RenderQuality::plain();
    parts.quality = quality;
    parts.program = std::filesystem::path(STADION_BINARY_DIR) / "bin" / "stadion-wall";
    PerWallProcessRenderer drawing(std::move(parts));
    const Failure failure = drawing.open(0);
    ASSERT_FALSE(failure) << failure->message;
    ASSERT_FALSE(drawing.draw(0, list, false).failure);
    std::vector<std::uint8_t> rgba(48 * 36 * 4);
    ASSERT_FALSE(drawing.read(0, 0, rgba));
    test::Stage here(meshes, 48, 36, GlProviderKind::OsMesa, quality);
    EXPECT_EQ(rgba, here.draw(list).rgba);
  }
}

}  // namespace
}  // namespace stadion
