/// Mapped memory and indirect draws: the pictures are those that are drawn without them, bit for bit.
#include "engine/base/run_stopped.h"
#include "pipeline/gl_draw/gpu/indirect_draws.h"
#include "pipeline/gl_draw/gpu/upload_ring.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace stadion {
namespace {

using test::matt;
using test::MeshMaker;
using test::place;
using test::Stage;

constexpr std::uint32_t kAcross = 160, kDown = 120;
constexpr GlSubmission kDirect{GlUse::Never, GlUse::Never}, kMapped{GlUse::Always, GlUse::Never},
    kIndirect{GlUse::Never, GlUse::Always}, kBoth{GlUse::Always, GlUse::Always};

struct SubmissionQuality {
  const char* name;
  RenderQuality quality;
};
// With one sample a pixel, software removes triangles itself unless everything goes to OpenGL.
const SubmissionQuality kSubmissionQualities[] = {
    {"full", {}},
    {"full, one sample", {Look::Full, 1, 1024, false, false}},
    {"plain", {Look::Plain, 1, 1024, false, false}},
    {"few instances a call", {Look::Full, 4, 3}},
};

RenderQuality with(RenderQuality quality, GlSubmission submission) {
  quality.submission = submission;
  return quality;
}

Affine standing(double x, double y, double z, double scale = 1) {
  Affine X = Affine::Identity();
  X.translation() = Vec3(x, y, z);
  X.linear() *= scale;
  return X;
}

/// A box whose faces have three materials: matt, shining and glowing.
std::unique_ptr<Mesh> manyColouredBox(double hue) {
  const auto h = static_cast<float>(hue);
  auto mesh = MeshMaker(matt(h, 0.3f, 1 - h)).box({-0.4, -0.4, 0}, {0.4, 0.4, 0.8}).seal();
  Material gold = matt(0.9f, h, 0.2f), lamp = matt(0.1f, 0.1f, h);
  gold.roughness = 0.3f, gold.metallic = 1;
  lamp.emissive = {0.2f, h, 0.4f};
  mesh->materials.insert(mesh->materials.end(), {gold, lamp});
  mesh->submeshes = {{0, 12, 0}, {12, 12, 1}, {24, 12, 2}};
  return mesh;
}

std::unique_ptr<Mesh> oneSided(bool textured, float alphaCutoff) {
  Material material = matt(0.4f, 0.7f, 0.3f);
  material.doubleSided = true;
  material.alphaCutoff = alphaCutoff;
  MeshMaker maker(material);
  if (textured) {
    Texture picture = test::chequered(32, 4);
    for (std::size_t i = 3; i < picture.rgba.size(); i += 4 * 7) picture.rgba[i] = 0;
    maker.texture(std::move(picture));
  }
  return maker.quad({-0.5, 0, 0}, {0.5, 0.1, 0}, {0.5, 0, 1}, {-0.5, 0.1, 1}).seal();
}

/// A mesh with an opaque and a transparent part, of which the opaque one is drawn with opaque objects.
std::unique_ptr<Mesh> halfGlass() {
  auto mesh = manyColouredBox(0.5);
  mesh->materials[2].baseColour[3] = 0.4f;
  return mesh;
}

/// Meshes of all kinds in rows, under a sun with shadows, a lamp and haze.
struct Bazaar {
  MeshStore meshes;
  DrawList list;

  Bazaar() {
    list = test::richList(meshes, double{kAcross} / kDown);
    std::vector<MeshId> kinds;
    for (int i = 0; i < 9; ++i) kinds.push_back(meshes.add(manyColouredBox(0.1 * i)));
    kinds.push_back(meshes.add(oneSided(false, 0)));
    kinds.push_back(meshes.add(oneSided(true, 0.5f)));
    kinds.push_back(meshes.add(oneSided(true, 0)));
    int placed = 0;
    for (const MeshId kind : kinds)
      for (int i = 0; i < 5; ++i, ++placed) {
        Affine X = standing(-3 + 0.55 * (placed % 12), 0.6 * (placed / 12), 0.1, 0.6);
        if (placed % 7 == 0) X.linear() *= Vec3(1, 1, -1).asDiagonal();  // mirrored
        list.opaque.push_back(place(kind, X));
      }
    const MeshId glass = meshes.add(halfGlass());
    for (int i = 0; i < 3; ++i) list.transparent.push_back(place(glass, standing(-1 + i, -2, 0)));
    addShadows();
  }

  void addShadows() {
    list.lights[0].shadows = true;
    DrawShadows& shadows = list.shadows;
    shadows.light = 0;
    const Vec3 towards =
        -Vec3(list.lights[0].direction[0], list.lights[0].direction[1], list.lights[0].direction[2])
             .normalized();
    const Vec3 right = Vec3::UnitZ().cross(towards).normalized(), up = towards.cross(right);
    for (int k = 0; k < 3; ++k) {
      const auto at = static_cast<std::size_t>(k);
      shadows.axes[at] = static_cast<float>(right[k]);
      shadows.axes[3 + at] = static_cast<float>(up[k]);
      shadows.axes[6 + at] = static_cast<float>(towards[k]);
    }
    const std::size_t half = list.opaque.size() / 2;
    const auto middle = list.opaque.begin() + static_cast<std::ptrdiff_t>(half);
    for (DrawShadowRing& ring : shadows.rings) {
      ring.still = std::make_shared<const std::vector<DrawItem>>(list.opaque.begin(), middle);
      ring.moving.assign(middle, list.opaque.end());
      ring.movingArea = {-1, -1, 1, 1};
      ring.stillKey = ring.movingKey = 1;
    }
  }

  /// Moves what may move.
  void step() {
    for (DrawItem& item : list.opaque) item.model[11] += 0.05f;
    for (DrawShadowRing& ring : list.shadows.rings) {
      for (DrawItem& item : ring.moving) item.model[11] += 0.05f;
      ++ring.movingKey;
    }
  }
};

class GlSubmissionTest : public testing::Test {
protected:
  void SetUp() override {
    static const bool there = static_cast<bool>(openGlProvider(GlProviderKind::Egl));
    if (!there) GTEST_SKIP() << "this machine has no EGL";
  }
};

using PictureSubmission = GlSubmissionTest;

/// Draws with one renderer. A thread has one context at a time, so renderers are compared one after the other.
template <class Frame>
void drawnBy(const MeshStore& meshes, const RenderQuality& quality, const Frame& frame,
             GlProviderKind kind = GlProviderKind::Egl, std::uint32_t width = kAcross,
             std::uint32_t height = kDown) {
  Stage stage(meshes, width, height, kind, quality);
  frame(stage);
}

using Pictures = std::vector<test::Picture>;

/// Both eyes of a bazaar.
Pictures eyesOf(const Bazaar& bazaar, const RenderQuality& quality,
                GlProviderKind kind = GlProviderKind::Egl) {
  Pictures pictures;
  const auto both = [&](Stage& stage) {
    for (const std::uint32_t eye : {0u, 1u}) pictures.push_back(stage.draw(bazaar.list, eye));
  };
  drawnBy(bazaar.meshes, quality, both, kind);
  return pictures;
}

TEST_F(PictureSubmission, EveryWayDrawsTheSamePixels) {
  for (const SubmissionQuality& q : kSubmissionQualities) {
    const Bazaar bazaar;
    const Pictures expected = eyesOf(bazaar, q.quality, GlProviderKind::OsMesa);
    EXPECT_NE(expected[0], expected[1]);
    for (const GlSubmission submission : {kDirect, kMapped, kIndirect, kBoth})
      EXPECT_TRUE(eyesOf(bazaar, with(q.quality, submission)) == expected)
          << q.name << ", mapped " << int(submission.mapped) << ", indirect " << int(submission.indirect);
  }
}

TEST_F(PictureSubmission, ManyFramesDrawTheSamePixels) {
  Pictures expected;
  for (const GlSubmission submission : {kDirect, kMapped, kIndirect, kBoth}) {
    Bazaar bazaar;
    Pictures pictures;
    drawnBy(bazaar.meshes, with({}, submission), [&](Stage& stage) {
      for (int frame = 0; frame < 9; ++frame, bazaar.step()) pictures.push_back(stage.draw(bazaar.list));
    });
    EXPECT_NE(pictures[0], pictures[8]);
    if (expected.empty()) expected = pictures;
    EXPECT_TRUE(pictures == expected);
  }
}

TEST_F(PictureSubmission, ALongListOutgrowsTheMappedMemory) {
  Pictures expected;
  for (const GlSubmission submission : {kDirect, kBoth}) {
    Bazaar bazaar;
    const std::vector<DrawItem> few = bazaar.list.opaque;
    std::vector<DrawItem> many(30'000, few.back());
    for (std::size_t i = 0; i < many.size(); ++i) {
      many[i].model[3] += 0.001f * static_cast<float>(i % 300);
      many[i].model[7] += 0.1f * static_cast<float>(i / 300);
    }
    Pictures pictures;
    const auto inTurns = [&](Stage& stage) {
      for (int frame = 0; frame < 5; ++frame) {
        bazaar.list.opaque = frame % 2 ? many : few;
        pictures.push_back(stage.draw(bazaar.list));
      }
    };
    drawnBy(bazaar.meshes, with({}, submission), inTurns, GlProviderKind::Egl, 48, 36);
    if (expected.empty()) expected = pictures;
    EXPECT_TRUE(pictures == expected);
  }
}

TEST_F(PictureSubmission, OfSurfacesAtTheSameDepthTheLastOneIsSeen) {
  const auto sheet = [](float red, bool textured) {
    MeshMaker maker(matt(red, 0.5f, 1 - red));
    if (textured) maker.texture(test::chequered(16, 2));
    return maker.quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}).seal();
  };
  MeshStore meshes;
  DrawList list = test::plainList();
  for (const auto& [red, textured] : {std::pair(0.0f, false), std::pair(0.5f, true), std::pair(1.0f, false)})
    list.opaque.push_back(place(meshes.add(sheet(red, textured))));
  DrawList lastAlone = list;
  lastAlone.opaque = {list.opaque.back()};
  drawnBy(meshes, with({}, kBoth), [&](Stage& stage) {
    EXPECT_TRUE(stage.draw(list) == stage.draw(lastAlone));
    stage.draw(list);
    EXPECT_EQ(stage.renderer().counts().calls, 4u) << "three runs, and the sky";
  });
}

DrawCounts countsOf(const Bazaar& bazaar, const RenderQuality& quality) {
  DrawCounts counts;
  drawnBy(bazaar.meshes, quality, [&](Stage& stage) {
    stage.draw(bazaar.list);
    counts = stage.renderer().counts();
  });
  return counts;
}

TEST_F(PictureSubmission, IndirectDrawsTakeFewerCallsForTheSameTriangles) {
  const Bazaar bazaar;
  const DrawCounts each = countsOf(bazaar, with({}, kDirect)), joined = countsOf(bazaar, with({}, kIndirect));
  EXPECT_EQ(joined.instances, each.instances);
  EXPECT_EQ(joined.triangles, each.triangles);
  EXPECT_LT(2 * joined.calls, each.calls) << joined.calls << " instead of " << each.calls;
}

TEST_F(PictureSubmission, ACallForEachObjectStaysOne) {
  const Bazaar bazaar;
  RenderQuality strict;
  strict.mostAtOnce = 1;
  EXPECT_EQ(countsOf(bazaar, with(strict, kBoth)).calls, countsOf(bazaar, with(strict, kDirect)).calls);
}

TEST_F(PictureSubmission, SoftwareUsesNeitherUnlessAsked) {
  const Bazaar bazaar;
  bool software = false;
  drawnBy(bazaar.meshes, {}, [&](Stage& stage) { software = isSoftware(stage.gl()); });
  if (!software) GTEST_SKIP() << "a graphics card draws";
  EXPECT_EQ(countsOf(bazaar, {}).calls, countsOf(bazaar, with({}, kDirect)).calls);
}

TEST_F(PictureSubmission, MeshesComeAndGoInSharedPages) {
  Pictures expected;
  for (const GlSubmission submission : {kDirect, kBoth}) {
    Bazaar bazaar;
    const std::vector<DrawItem> kept = bazaar.list.opaque;
    Pictures pictures;
    drawnBy(bazaar.meshes, with({}, submission), [&](Stage& stage) {
      for (std::uint64_t frame = 0; frame < 6; ++frame) {
        const MeshId passing = bazaar.meshes.add(manyColouredBox(0.15 * static_cast<double>(frame)));
        bazaar.list.opaque = kept;
        bazaar.list.opaque.push_back(place(passing, standing(0, -3, 1)));
        pictures.push_back(stage.draw(bazaar.list));
        bazaar.meshes.release(passing, frame);
        bazaar.meshes.collect(frame);
      }
    });
    if (expected.empty()) expected = pictures;
    EXPECT_TRUE(pictures == expected);
  }
}

TEST_F(PictureSubmission, ADrawingThatWasGivenUpLeavesNothingBehind) {
  const Bazaar bazaar;
  const test::Picture whole = eyesOf(bazaar, with({}, kDirect))[0];
  drawnBy(bazaar.meshes, with({}, kBoth), [&](Stage& stage) {
    int givenUp = 0;
    for (bool finished = false; !finished; givenUp += 7) {
      int left = givenUp;
      finished = true;
      try {
        stage.renderer().draw(
            bazaar.list, [&] { return left-- == 0; }, nullptr);
      } catch (const RunStopped&) {
        finished = false;
      }
      ASSERT_TRUE(stage.draw(bazaar.list) == whole) << "given up at question " << givenUp;
    }
    EXPECT_GT(givenUp, 14);
  });
}

TEST_F(PictureSubmission, APageIsFreedWithItsLastMesh) {
  MeshStore meshes;
  Stage stage(meshes, 8, 8, GlProviderKind::Egl, with({}, kBoth));
  MeshPages pages(stage.gl(), 40, true);
  const MeshRoom room{100, 300, 1};
  MeshPlace first = pages.placeFor(room);
  EXPECT_TRUE(first.opensPage);
  MeshPlace second = pages.placeFor(room);
  EXPECT_EQ(second.page.get(), first.page.get());
  EXPECT_EQ(second.first.vertices, 100u);
  EXPECT_EQ(second.first.indices, 300u);
  const MeshPlace large = pages.placeFor({std::size_t{1} << 20, 3, 1});
  EXPECT_NE(large.page.get(), first.page.get()) << "what is larger than a page has its own";
  const GLuint buffer = first.page->vertices.name();
  first = {};
  EXPECT_TRUE(stage.gl().IsBuffer(buffer));
  second = {};
  EXPECT_FALSE(stage.gl().IsBuffer(buffer));
}

/// What the card finds at a place of the ring.
std::vector<std::byte> readBack(const GlTable& gl, const UploadRing::Place& place, std::size_t bytes) {
  std::vector<std::byte> found(bytes);
  gl.BindBuffer(GL_COPY_WRITE_BUFFER, place.buffer);
  gl.GetBufferSubData(GL_COPY_WRITE_BUFFER, static_cast<GLintptr>(place.offset),
                      static_cast<GLsizeiptr>(bytes), found.data());
  return found;
}

TEST_F(PictureSubmission, PlacesOfAFrameLastForTheNextOneAndDoNotOverlap) {
  MeshStore meshes;
  Stage stage(meshes, 8, 8, GlProviderKind::Egl);
  ASSERT_TRUE(UploadRing::isSupported(stage.gl()) && IndirectDraws::isSupported(stage.gl()));
  UploadRing ring(stage.gl(), 1024);
  struct Written {
    UploadRing::Place place;
    std::size_t bytes;
    int value;
  };
  std::vector<Written> before, now;
  int value = 0;
  for (int frame = 0; frame < 12; ++frame, before = std::exchange(now, {})) {
    ring.beginFrame();
    for (const std::size_t bytes : {1u, 300u, 64u, 700u * static_cast<unsigned>(frame + 1)}) {
      const auto place = ring.take(bytes);
      ASSERT_TRUE(place);
      EXPECT_EQ(place->offset % 64, 0u);
      std::memset(place->memory, ++value, bytes);
      now.push_back({*place, bytes, value});
    }
    for (const auto* frames : {&before, &now})
      for (const Written& w : *frames)
        EXPECT_EQ(readBack(stage.gl(), w.place, w.bytes),
                  std::vector<std::byte>(w.bytes, static_cast<std::byte>(w.value)))
            << "frame " << frame;
  }
}

}  // namespace
}  // namespace stadion
