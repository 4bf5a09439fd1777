/// Sections of a mesh that a picture leaves out are those that it cannot see.

#include "pipeline/cpu_draw/mesh/mesh_section.h"
#include "pipeline/cpu_draw/view_geometry.h"
#include "tests/pipeline/cpu_draw/compared_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace stadion {
namespace {

constexpr int kSectionWidth = 160, kSectionHeight = 120;

using Corners = std::array<Vec3, 3>;

/// Triangles all around the origin, from near to far; neighbours in the list are neighbours in space.
std::vector<Corners> trianglesAround(std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> within(-1, 1);
  const auto point = [&](double size) {
    return Vec3(size * Vec3(within(random), within(random), within(random)));
  };
  std::vector<Corners> all;
  for (std::size_t i = 0; i < count; ++i) {
    const double turn = 6.3 * static_cast<double>(i) / static_cast<double>(count);
    const double far = 3 + 30 * std::fabs(within(random)), size = 0.02 * far * std::exp(within(random));
    const Vec3 at(far * std::sin(turn), far * std::cos(turn), 0.4 * far * within(random));
    all.push_back({at + point(size), at + point(size), at + point(size)});
  }
  return all;
}

test::Picture pictureOf(const std::vector<Corners>& triangles, const DrawView& view) {
  test::MeshMaker maker(test::matt(0.6f, 0.5f, 0.3f));
  for (const Corners& t : triangles) maker.triangle(t[0], t[1], t[2]);
  MeshStore meshes;
  DrawList list = test::plainList();
  list.views[0] = view;
  list.opaque = {test::place(meshes.add(maker.seal()))};
  DrawLight sun;
  sun.direction = {-0.45f, 0.35f, -0.82f};
  list.lights = {sun};
  return test::drawnByCpu(meshes, list, kSectionWidth, kSectionHeight);
}

TEST(MeshSections, APictureIsTheSameAsWhereNoneCanBeLeftOut) {
  const std::vector<Corners> ordered = trianglesAround(6000);
  std::vector<Corners> mixed = ordered;  // each section of it is everywhere
  std::ranges::shuffle(mixed, std::mt19937(3));
  for (const Vec3& to : {Vec3(0, 5, 0), Vec3(5, 0, 1), Vec3(-3, -4, -1), Vec3(1, 1, 6)}) {
    const DrawView view = test::lookAt(Vec3(0, 0, 0.3), to, 1.2, double{kSectionWidth} / kSectionHeight);
    const test::PictureDifference d = test::difference(pictureOf(ordered, view), pictureOf(mixed, view));
    EXPECT_LE(d.most, 1) << "towards " << to.transpose();
  }
}

TEST(MeshSections, OneWithAPointInThePictureIsSeen) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> within(-1, 1);
  int inside = 0, seen = 0;
  for (int i = 0; i < 20'000; ++i) {
    PixelMatrix m{};
    for (float* row : {m.x, m.y, m.w})
      for (int k = 0; k < 4; ++k) row[k] = static_cast<float>(within(random) * std::exp(4 * within(random)));
    const bool parallel = i % 4 == 0;
    MeshSection s;
    for (std::size_t k = 0; k < 3; ++k) {
      const double middle = 5 * within(random), size = std::exp(3 * within(random) - 2);
      s.low[k] = static_cast<float>(middle - size);
      s.high[k] = static_cast<float>(middle + size);
    }
    bool found = false;
    for (int sample = 0; sample < 30 && !found; ++sample) {
      double p[4] = {0, 0, 0, 1};
      for (std::size_t k = 0; k < 3; ++k)
        p[k] = static_cast<double>(s.low[k]) +
               0.5 * (1 + within(random)) * (static_cast<double>(s.high[k]) - static_cast<double>(s.low[k]));
      const auto at = [&](const float* row) {
        double sum = 0;
        for (int k = 0; k < 4; ++k) sum += static_cast<double>(row[k]) * p[k];
        return sum;
      };
      const double w = parallel ? 1 : at(m.w);
      const double x = at(m.x) / w, y = at(m.y) / w;
      found = w > 0 && x >= 0 && x <= kSectionWidth && y >= 0 && y <= kSectionHeight;
    }
    const bool may = mayBeSeen(s, m, parallel, kSectionWidth, kSectionHeight);
    EXPECT_TRUE(may || !found) << i;
    inside += found;
    seen += may;
  }
  EXPECT_GT(inside, 1000);
  EXPECT_LT(seen, 12'000) << "leaves out what lies beside the picture";
}

TEST(MeshSections, WhatIsBehindTheEyeOrBesideThePictureIsLeftOut) {
  const DrawView view =
      test::lookAt(Vec3::Zero(), Vec3(0, 1, 0), 1.2, double{kSectionWidth} / kSectionHeight);
  const auto geometry = ViewGeometry::of(view.projection, view.view, kSectionWidth, kSectionHeight);
  ASSERT_TRUE(geometry);
  const PixelMatrix m = geometry->placing({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
  const auto seenAt = [&](float x, float y, float z) {
    MeshSection s;
    s.low = {x - 0.5f, y - 0.5f, z - 0.5f};
    s.high = {x + 0.5f, y + 0.5f, z + 0.5f};
    return mayBeSeen(s, m, false, kSectionWidth, kSectionHeight);
  };
  EXPECT_TRUE(seenAt(0, 5, 0));
  EXPECT_TRUE(seenAt(0, 0, 0)) << "around the eye";
  EXPECT_FALSE(seenAt(0, -5, 0));
  EXPECT_FALSE(seenAt(20, 5, 0));
  EXPECT_FALSE(seenAt(-20, 5, 0));
  EXPECT_FALSE(seenAt(0, 5, 20));
  EXPECT_FALSE(seenAt(0, 5, -20));
}

}  // namespace
}  // namespace stadion
