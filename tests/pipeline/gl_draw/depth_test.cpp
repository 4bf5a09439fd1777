/// Of two surfaces that are close together the nearer one is seen, near the eye and far away, in one picture.
#include "engine/display/frustum.h"
#include "tests/pipeline/cull/cull_room.h"
#include "tests/pipeline/gl_draw/renderer_scene.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using test::matt;
using test::MeshMaker;
using test::Random;

struct NamedWall {
  const char* name;
  Wall wall;
};

/// All are seen from near the origin; the last one's picture stands on its head.
const NamedWall kDepthWalls[] = {
    {"front", {"w", {-1.5, 1.5, -1.5}, {1.5, 1.5, -1.5}, {-1.5, 1.5, 1.5}}},
    {"off-axis", {"w", {-0.2, 0.5, -0.3}, {2.2, 0.5, -0.3}, {-0.2, 0.5, 1.9}}},
    {"slanted", {"w", {-1, 1, -1}, {0.8, 1.9, -0.7}, {-1, 1.2, 1}}},
    {"upside down", {"w", {1.5, 1, 1.2}, {-1.5, 1, 1.2}, {1.5, 1, -1.2}}},
};

constexpr double kDepthFar = 20000;

DrawList lookingThrough(const Wall& wall) {
  DrawList list = test::plainList();
  list.sky.zenith = list.sky.horizon = list.sky.ground = {0, 0, 0};
  list.viewCount = 2;
  for (std::uint32_t eye = 0; eye < 2; ++eye) {
    const EyeFrustum f = eyeFrustum(wall, Vec3(eye == 0 ? -0.032 : 0.032, 0, 0), {0.1, kDepthFar});
    list.views[eye].projection = projectionMatrix(f);
    list.views[eye].view = viewMatrix(f, Pose(), Vec3::Zero());
  }
  return list;
}

/// Red sheets, and green ones a little smaller and so far behind them that they are hidden.
struct SheetPairs {
  MeshStore meshes;
  MeshId red, green;
  std::vector<DrawItem> reds, greens;

  SheetPairs() {
    const auto sheet = [&](const Material& material) {
      return meshes.add(
          MeshMaker(material).quad({-0.5, 0, -0.5}, {0.5, 0, -0.5}, {0.5, 0, 0.5}, {-0.5, 0, 0.5}).seal());
    };
    red = sheet(matt(1, 0, 0)), green = sheet(matt(0, 1, 0));
  }
  /// `turned`: from facing the direction `at`.
  void add(const Vec3& at, double size, double gap, const Quat& turned) {
    Affine X = Affine::Identity();
    const Quat facing = Quat::FromTwoVectors(Vec3::UnitY(), at) * turned;
    X.linear() = facing.toRotationMatrix() * size;
    X.translation() = at;
    reds.push_back(test::place(red, X));
    X.linear() *= 0.9;
    X.translation() += gap * (facing * Vec3::UnitY());
    greens.push_back(test::place(green, X));
    reds.back().distance = greens.back().distance = static_cast<float>(at.norm());
  }
  std::vector<DrawItem> both(bool greenFirst) const {
    std::vector<DrawItem> items = greenFirst ? greens : reds;
    items.insert(items.end(), (greenFirst ? reds : greens).begin(), (greenFirst ? reds : greens).end());
    return items;
  }
};

Quat slantedBy(Random& random, double most) {
  return Quat(Eigen::AngleAxisd(random.from(-most, most), random.within(1).normalized()));
}

std::size_t coloured(const test::Picture& picture, int channel) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    count += picture.rgba[i + static_cast<std::size_t>(channel)] >
             picture.rgba[i + 1 - static_cast<std::size_t>(channel)];
  return count;
}

struct NamedQuality {
  const char* name;
  RenderQuality quality;
};

const NamedQuality kDepthQualities[] = {
    {"full", {}},
    {"full, one sample", {Look::Full, 1, 1024, true, true}},
    {"plain", RenderQuality::plain()},
    {"plain, all by OpenGL", {Look::Plain, 1, 1024, false, false}},
    {"plain, four samples", {Look::Plain, 4, 1024, true, true}},
};

/// The picture of both is that of the near ones alone, in either order.
void expectNearOnes(const SheetPairs& pairs, std::uint32_t width, std::uint32_t height,
                    GlProviderKind kind = GlProviderKind::OsMesa, std::uint32_t walls = 4) {
  for (const NamedQuality& q : kDepthQualities) {
    test::Stage stage(pairs.meshes, width, height, kind, q.quality);
    for (std::uint32_t i = 0; i < 2 * walls; ++i) {
      const NamedWall& w = kDepthWalls[i / 2];
      DrawList list = lookingThrough(w.wall);
      list.opaque = pairs.reds;
      const auto near = stage.draw(list, i % 2);
      EXPECT_GT(coloured(near, 0), 5u) << w.name;
      list.opaque = pairs.both(i / 2 % 2 == 0);
      const auto both = stage.draw(list, i % 2);
      ASSERT_EQ(coloured(both, 1), 0u) << w.name << ", " << q.name << ", eye " << i % 2;
      ASSERT_EQ(both, near) << w.name << ", " << q.name << ", eye " << i % 2;
      list.opaque = pairs.both(i / 2 % 2 != 0);
      ASSERT_EQ(stage.draw(list, i % 2), near) << w.name << ", " << q.name << ", eye " << i % 2;
    }
  }
}

/// At so many metres, so far apart.
constexpr double kPairs[][2] = {{1, 0.001}, {800, 0.2}, {8000, 2}, {19000, 4}};

TEST(PictureDepth, TheNearerOfTwoSheetsIsSeenAtOneMetreAndAtKilometresInOnePicture) {
  Random random(61);
  for (const auto& [width, height] : {std::pair(64u, 48u), std::pair(37u, 51u)}) {
    SheetPairs pairs;
    for (int i = 0; i < 4; ++i) {
      const double along = kPairs[i][0];
      const Vec3 direction(-0.45 + 0.3 * i, 1, random.from(0, 0.3));
      pairs.add(along * direction.normalized(), 0.2 * along, kPairs[i][1],
                slantedBy(random, i == 0 ? 0.3 : 1));
    }
    expectNearOnes(pairs, width, height);
  }
}

TEST(PictureDepth, ThroughEglAsWell) {
  Random random(62);
  SheetPairs pairs;
  for (int i = 0; i < 4; ++i)
    pairs.add(kPairs[i][0] * Vec3(-0.45 + 0.3 * i, 1, 0.1).normalized(), 0.2 * kPairs[i][0], kPairs[i][1],
              slantedBy(random, 0.3));
  expectNearOnes(pairs, 40, 30, GlProviderKind::Egl, 1);
}

TEST(PictureDepth, SmallSheetsThatAreDrawnWithoutOpenGlAreOrderedAlike) {
  Random random(63);
  SheetPairs pairs;
  for (int x = -12; x <= 12; ++x)
    for (int z = -6; z <= 12; ++z) {
      const double along = random.sizeFrom(1, 15000);
      pairs.add(along * Vec3(0.1 * x, 1, 0.1 * z).normalized(), 0.05 * along, 2.5e-4 * along,
                slantedBy(random, 0.3));
    }
  expectNearOnes(pairs, 120, 90);
}

/// Floors and roofs begin beside the eye and end at the horizon.
TEST(PictureDepth, SurfacesThatReachFromTheEyeToTheHorizonAreOrderedToo) {
  SheetPairs pairs;
  for (const double height : {-1.7, -40.0, 25.0}) {
    Affine X = Affine::Identity();
    X.linear() =
        Eigen::AngleAxisd(height < 0 ? -M_PI / 2 : M_PI / 2, Vec3::UnitX()).toRotationMatrix() * 16000;
    X.translation() = Vec3(0, 0, height);
    pairs.reds.push_back(test::place(pairs.red, X));
    X.translation() *= 1.05;
    pairs.greens.push_back(test::place(pairs.green, X));
  }
  expectNearOnes(pairs, 64, 48);
}

/// Where a head turns or moves after Cull, lists keep their origin.
TEST(PictureDepth, HoldsWhereTheListsOriginIsFarFromTheWorldsAndFromTheEye) {
  Random random(64);
  for (const Vec3& eye : {Vec3(0.4, -0.3, 0.2), Vec3(-30, 10, 2)}) {
    SheetPairs pairs;
    for (int i = 0; i < 4; ++i)
      pairs.add(eye + kPairs[i][0] * Vec3(-0.45 + 0.3 * i, 1, 0.1).normalized(), 0.2 * kPairs[i][0],
                kPairs[i][1], slantedBy(random, 0.2));
    for (const NamedQuality& q : kDepthQualities) {
      DrawList list = lookingThrough(kDepthWalls[0].wall);
      for (DrawView& e : list.views) e.view.topRightCorner<3, 1>() -= e.view.topLeftCorner<3, 3>() * eye;
      list.opaque = pairs.reds;
      test::Stage stage(pairs.meshes, 64, 48, GlProviderKind::OsMesa, q.quality);
      const auto near = stage.draw(list);
      list.opaque = pairs.both(true);
      EXPECT_EQ(stage.draw(list), near) << q.name;
    }
  }
}

/// The sky is behind everything, and what lies beyond the far plane is not seen.
TEST(PictureDepth, TheSkyIsBehindWhatIsFarthestAndHidesWhatIsBeyond) {
  SheetPairs pairs;
  pairs.add({0, 19990, 0}, 100000, 1, Quat::Identity());
  for (const NamedQuality& q : kDepthQualities) {
    DrawList list = lookingThrough(kDepthWalls[0].wall);
    list.sky = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {1, 1, 1}, 0};
    list.opaque = {pairs.reds[0]};
    test::Stage stage(pairs.meshes, 32, 24, GlProviderKind::OsMesa, q.quality);
    EXPECT_GT(stage.draw(list).at(16, 12)[0], 200) << q.name;
    list.opaque[0].model[7] = 20010;
    EXPECT_LT(stage.draw(list).at(16, 12)[0], 100) << q.name;
  }
}

TEST(Depths, OfSinglePrecisionTellSurfacesApartFromTheNearPlaneToTheFarOne) {
  for (const double far : {100.0, 1000.0, 20000.0, 1e7}) {
    const EyeFrustum f = eyeFrustum(kDepthWalls[1].wall, Vec3::Zero(), {0.1, far});
    const Mat4 p = projectionMatrix(f);
    const auto depthAt = [&](double distance) {
      const Vec4 clip = p * Vec4(0, 0, -distance, 1);
      return static_cast<float>(clip.z() / clip.w());
    };
    for (double d = 0.1; d < 0.9 * far; d *= 1.07)
      EXPECT_GT(depthAt(d), depthAt(d * (1 + 2e-6))) << d << ", " << far;
  }
}

}  // namespace
}  // namespace stadion
