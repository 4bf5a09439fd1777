/// The level that is drawn is the coarsest whose error no wall would show, and the same on all of them.

#include "pipeline/cull/level_choice.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

/// A wall of 4 m x 4 m with pixels of 1 cm, 2 m in front of the head: 200 pixels a radian in its middle.
WallPixels front() {
  WallPixels w;
  w.wall.lowerLeft = Vec3(-2, 2, -0.3), w.wall.lowerRight = Vec3(2, 2, -0.3);
  w.wall.upperLeft = Vec3(-2, 2, 3.7);
  w.width = w.height = 400;
  return w;
}

struct LevelRoom {
  MeshStore meshes;
  MeshId id = kNoMesh;
  ViewerRecord viewer;
  std::vector<WallPixels> walls{front()};

  /// A small thing whose two levels are off by 5 cm and by 20 cm.
  explicit LevelRoom(double radius = 0.01) {
    auto mesh = std::make_unique<Mesh>();
    mesh->materials.emplace_back();
    mesh->bounds = {Vec3::Constant(-radius), Vec3::Constant(radius)};
    mesh->sphere = {Vec3::Zero(), radius};
    mesh->levels.resize(2);
    mesh->levels[0].error = 0.05, mesh->levels[1].error = 0.2;
    mesh->hash = 5;
    id = meshes.add(std::move(mesh));
    viewer.set(Pose{Vec3::Zero(), Quat::Identity()}, Pose{Vec3(0, 0, 1.7), Quat::Identity()});
  }
  InstanceRecord at(const Vec3& p, double scale = 1, double lodFactor = 1) const {
    Affine X = Affine::Identity();
    X.translation() = p;
    X.linear() *= scale;
    return makeInstance(X, *meshes.find(id), id, true, {1, 0}, lodFactor);
  }
  std::uint32_t levelOf(const InstanceRecord& r) const {
    LevelChoice levels(walls, meshes);
    levels.setViewer(viewer);
    return levels.levelOf(r);
  }
};

TEST(LevelChoice, TakesTheCoarsestLevelThatIsOffByLessThanAPixel) {
  const LevelRoom room;
  // 5 cm are a pixel at 10 m, 20 cm at 40 m.
  EXPECT_EQ(room.levelOf(room.at(Vec3(0, 9.8, 1.7))), 0U);
  EXPECT_EQ(room.levelOf(room.at(Vec3(0, 10.3, 1.7))), 1U);
  EXPECT_EQ(room.levelOf(room.at(Vec3(0, 39, 1.7))), 1U);
  EXPECT_EQ(room.levelOf(room.at(Vec3(0, 41, 1.7))), 2U);
}

TEST(LevelChoice, WhatIsLargerIsOffByMore) {
  const LevelRoom room;
  EXPECT_EQ(room.levelOf(room.at(Vec3(0, 19, 1.7), 2)), 0U);
  EXPECT_EQ(room.levelOf(room.at(Vec3(0, 21, 1.7), 2)), 1U);
}

TEST(LevelChoice, TowardsTheCornersOfAWallItsPixelsAreFiner) {
  const LevelRoom room;
  // At 45 degrees an error of 5 cm covers twice as many pixels.
  const Vec3 aside(15, 15, 1.7);
  EXPECT_NEAR((aside - Vec3(0, 0, 1.7)).norm(), 21.2, 0.1);
  EXPECT_EQ(room.levelOf(room.at(aside)), 1U);
  EXPECT_EQ(room.levelOf(room.at(Vec3(13, 13, 1.7))), 0U);
}

TEST(LevelChoice, OfAllWallsTheStrictestCountsSoThatAllOfThemChooseAlike) {
  LevelRoom room;
  WallPixels fine = front();
  fine.width = fine.height = 800;
  room.walls = {front(), fine};
  EXPECT_EQ(room.levelOf(room.at(Vec3(0, 15, 1.7))), 0U);
  EXPECT_EQ(room.levelOf(room.at(Vec3(0, 21, 1.7))), 1U);
  std::swap(room.walls[0], room.walls[1]);
  EXPECT_EQ(room.levelOf(room.at(Vec3(0, 15, 1.7))), 0U);
}

TEST(LevelChoice, UnderStressAndWithLessDetailThingsCountAsFartherAway) {
  LevelRoom room;
  const Vec3 p(0, 8, 1.7);
  EXPECT_EQ(room.levelOf(room.at(p)), 0U);
  EXPECT_EQ(room.levelOf(room.at(p, 1, 1.5)), 1U);
  room.viewer.stress = 1.5;
  EXPECT_EQ(room.levelOf(room.at(p)), 1U);
}

TEST(LevelChoice, AViewerInsideAThingSeesAllOfIt) {
  const LevelRoom room(30);
  EXPECT_EQ(room.levelOf(room.at(Vec3(0, 5, 1.7))), 0U);
}

TEST(LevelChoice, ADeepBoxCountsFromItsNearestPoint) {
  const LevelRoom room(30);
  EXPECT_EQ(room.levelOf(room.at(Vec3(0, 45, 1.7))), 0U);  // 15 m away, seen up to 42 degrees aside
  EXPECT_EQ(room.levelOf(room.at(Vec3(0, 60, 1.7))), 1U);  // 30 m
}

TEST(LevelChoice, WithoutLevelsOrWallsTheFullSurfaceIsDrawn) {
  LevelRoom room;
  InstanceRecord r = room.at(Vec3(0, 500, 1.7));
  EXPECT_EQ(room.levelOf(r), 2U);
  r.lodFactor = 0;
  EXPECT_EQ(room.levelOf(r), 0U);
  room.walls.clear();
  EXPECT_EQ(room.levelOf(room.at(Vec3(0, 500, 1.7))), 0U);
}

}  // namespace
}  // namespace stadion
