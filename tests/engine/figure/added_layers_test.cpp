/// Layers that add the difference to the beginning of their clip, and the root bone: poses and bounds.

#include "engine/figure/figure_bounds.h"
#include "engine/figure/figure_pose.h"
#include "engine/figure/ground_move.h"
#include "engine/figure/morph.h"
#include "engine/maths/pose_track.h"
#include "tests/engine/figure/figures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stadion::test {
namespace {

using Layers = std::initializer_list<ClipLayer>;

FigureRecord layered(Layers layers, Layers added = {}, std::uint32_t root = 0) {
  FigureRecord r;
  for (const ClipLayer& layer : layers) r.layers[r.layerCount++] = layer;
  for (const ClipLayer& layer : added) r.added[r.addedCount++] = layer;
  r.root = root;
  return r;
}

Clip still(const char* name, ClipChannel only) {
  return {name, 1, {std::move(only)}};
}

std::vector<float> aboutX(double from, double to) {
  const auto f = [](double x) { return static_cast<float>(x); };
  return {f(std::sin(from / 2)), 0, 0, f(std::cos(from / 2)), f(std::sin(to / 2)), 0, 0, f(std::cos(to / 2))};
}

TEST(AddedLayers, PositionsAreAddedScalesAndTurnsMultiplied) {
  Skeleton s = chain(2);
  const Interpolation linear = Interpolation::Linear;
  s.clips = {still("base", channel(1, ChannelTarget::Translation, linear, {0}, {5, 0, 1})),
             still("shift", channel(1, ChannelTarget::Translation, linear, {0, 1}, {7, 7, 7, 7, 8, 9})),
             still("grow", channel(1, ChannelTarget::Scale, linear, {0, 1}, {2, 2, 2, 4, 2, 1})),
             still("nod", channel(1, ChannelTarget::Rotation, linear, {0, 1}, aboutX(0.2, 0.8)))};
  FigurePose pose;
  pose.set(s, layered({{0, 1, 0}}, {{1, 1, 1}}));
  EXPECT_EQ(pose.bone(1).translation(), Vec3(5, 1, 3));
  pose.set(s, layered({{0, 1, 0}}, {{1, 0.5f, 1}, {1, 1, 0.5}}));
  EXPECT_EQ(pose.bone(1).translation(), Vec3(5, 1, 3));
  pose.set(s, layered({}, {{2, 1, 1}, {2, 1, 1}}));
  EXPECT_LT((scaleOf(pose.bone(1)) - Vec3(4, 1, 0.25)).norm(), 1e-12);
  pose.set(s, layered({}, {{3, 1, 1}, {3, 0.5f, 1}}));
  EXPECT_NEAR(Eigen::AngleAxisd(pose.bone(1).linear()).angle(), 0.9, 1e-6);
  // At the beginning of its clip a layer changes nothing, and without weight neither.
  pose.set(s, layered({{0, 1, 0}}, {{1, 1, 0}, {2, 1, 0}, {3, 0, 1}}));
  EXPECT_EQ(pose.bone(1).translation(), Vec3(5, 0, 1));
}

/// A nod stays one about the head's own axes.
TEST(AddedLayers, ATurnIsInTheAxesOfTheBoneAsItStands) {
  Skeleton s = chain(2);
  const auto half = static_cast<float>(std::sqrt(0.5));
  s.clips = {
      still("aside", channel(1, ChannelTarget::Rotation, Interpolation::Linear, {0}, {0, 0, half, half})),
      still("nod", channel(1, ChannelTarget::Rotation, Interpolation::Linear, {0, 1}, aboutX(0, 0.5)))};
  FigurePose pose;
  pose.set(s, layered({{0, 1, 0}}, {{1, 1, 1}}));
  const Mat3 want = Eigen::AngleAxisd(std::acos(0.0), Vec3::UnitZ()).toRotationMatrix() *
                    Eigen::AngleAxisd(0.5, Vec3::UnitX()).toRotationMatrix();
  EXPECT_LT((pose.bone(1).linear() - want).norm(), 1e-6);
}

TEST(AddedLayers, MorphWeightsAreAdded) {
  Skeleton s = chain(1);
  s.weights = {{"smile", 0.25f}};
  s.clips = {still("laugh", channel(0, ChannelTarget::Weights, Interpolation::Linear, {0, 1}, {0.5f, 1}))};
  FigurePose pose;
  pose.set(s, layered({}, {{0, 1, 1}, {0, 0.5f, 1}}));
  EXPECT_FLOAT_EQ(pose.weights()[0], 0.25f + 0.5f + 0.25f);
}

/// A mesh around a chain, with two morph targets.
struct Body {
  Skeleton skeleton;
  std::vector<std::array<float, 3>> positions, normals;
  std::vector<VertexJoints> joints;
  std::vector<Morph> morphs;

  explicit Body(unsigned seed) : skeleton(chain(6)), morphs(2) {
    RandomKeys random(seed);
    skeleton.weights = {{"smile", 0.3f}, {"blink", 0}};
    for (unsigned c = 0; c < 3; ++c) {
      skeleton.clips.push_back(wildClip(skeleton, 10 * seed + c));
      for (std::uint32_t w = 0; w < 2; ++w)
        skeleton.clips.back().channels.push_back(
            channel(w, ChannelTarget::Weights, Interpolation::Cubic, {0, 0.7f, 2}, random.many(9, -1, 1)));
    }
    if (seed % 3 == 0)  // the first bones keep their axes
      for (Clip& clip : skeleton.clips)
        std::erase_if(clip.channels, [](const ClipChannel& c) {
          return c.bone < 3 && c.target != ChannelTarget::Translation && c.target != ChannelTarget::Weights;
        });
    for (std::uint32_t i = 0; i < 60; ++i) {
      positions.push_back({random.in(-0.3, 0.3), random.in(-0.3, 0.3), random.in(0, 6)});
      normals.push_back({0, 0, 1});
      joints.emplace_back().joint[0] = static_cast<std::uint16_t>(random.in(0, 5.999));
      morphs[i % 2].vertices.push_back(i);
      morphs[i % 2].positions.push_back({random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)});
    }
    morphs[1].weight = 1;
  }
  Sphere reach(const ReachOptions& options) const {
    return figureReach(skeleton, positions, joints, morphs, options);
  }
  /// How far the farthest vertex is outside the sphere, in its radii; negative: inside.
  double outside(const FigureRecord& record, const Sphere& reach) const {
    FigurePose pose;
    MorphedVertices morphed;
    std::vector<SkinnedVertex> out(positions.size());
    pose.set(skeleton, record);
    skin(morphed.apply({positions, normals, joints}, morphs, pose.weights()), pose.palette(), 0, out);
    double most = 0;
    for (const SkinnedVertex& v : out) {
      const Vec3 p(double{v.position[0]}, double{v.position[1]}, double{v.position[2]});
      most = std::max(most, (p - reach.centre).norm());
    }
    return most / reach.radius - 1;
  }
};

TEST(AddedLayers, NoLayersAndNoRootLeaveTheReach) {
  double nearest = -1;
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Body body(seed);
    RandomKeys random(seed + 500);
    for (const std::uint32_t root : {0u, 1u, 2u, 4u}) {
      ReachOptions options{FigureRecord::kMostAdded, {}};
      if (root > 0) options.root = root - 1;
      const Sphere all = body.reach(options);
      options.added = 0;
      const Sphere without = body.reach(options);
      EXPECT_LT(without.radius, all.radius);
      const auto layer = [&](std::uint32_t clip, double least = 0) {
        return ClipLayer{clip, random.in(least, 1), double{random.in(0, 2.5)}};
      };
      for (int i = 0; i < 40; ++i) {
        const Layers below{layer(0, 1), layer(1), layer(2)};
        EXPECT_LT(body.outside(layered(below, {}, root), without), 0) << seed;
        const FigureRecord added =
            layered(below, {layer(0), layer(i % 3u, 0.9), layer(2), layer((i + 1) % 3u, 0.9)}, root);
        const double outside = body.outside(added, all);
        EXPECT_LT(outside, 0) << seed << " " << root;
        nearest = std::max(nearest, outside);
      }
    }
  }
  RecordProperty("nearest to the sphere", std::to_string(nearest));
}

/// Extreme layers: all of one clip, at the time at which it differs most.
TEST(AddedLayers, FourLayersOfOneClipReachFarAndStayWithin) {
  Skeleton s = chain(1);
  s.clips = {still(
      "far", channel(0, ChannelTarget::Translation, Interpolation::Linear, {0, 1}, {-1, 0, 0, 2, 0, 0}))};
  const std::vector<std::array<float, 3>> positions{{0, 0, 0}};
  const std::vector<VertexJoints> joints(1);
  const Sphere reach = figureReach(s, positions, joints, {}, {.added = FigureRecord::kMostAdded});
  FigurePose pose;
  pose.set(s, layered({{0, 1, 1}}, {{0, 1, 1}, {0, 1, 1}, {0, 1, 1}, {0, 1, 1}}));
  EXPECT_EQ(pose.bone(0).translation(), Vec3(14, 0, 0));
  EXPECT_LE((pose.bone(0).translation() - reach.centre).norm(), reach.radius);
  EXPECT_NEAR(reach.centre.x() + reach.radius, 14, 1e-3) << "no larger than it must be";
  EXPECT_LT(figureReach(s, positions, joints).radius, 2);
}

TEST(RootBone, ItStaysOnTheGroundWhereItIsAtRestAndKeepsItsHeading) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Skeleton s = chain(4);
    s.bones[0].X_PB = moved(1, 2, 0) * Affine(Eigen::AngleAxisd(1.2, Vec3(0.4, 1, -0.2).normalized()));
    s.bones[0].rest.translation = s.bones[0].X_PB.translation();
    s.bones[0].rest.rotation = Quat(s.bones[0].X_PB.linear());
    s.clips = {wildClip(s, seed), wildClip(s, seed + 100)};
    FigurePose at, with, without;
    at.set(s, {});
    for (const double time : {0.0, 0.3, 1.1}) {
      const auto clips = {ClipLayer{0, 1, time}, ClipLayer{1, 0.4f, time}};
      without.set(s, layered(clips));
      with.set(s, layered(clips, {}, 2));
      const GroundMove left = groundMoveOf(with.bone(1), at.bone(1));
      EXPECT_NEAR(left.x, 0, 1e-9);
      EXPECT_NEAR(left.y, 0, 1e-9);
      EXPECT_NEAR(std::sin(left.turn), 0, 1e-9);
      EXPECT_NEAR(with.bone(1).translation().z(), without.bone(1).translation().z(), 1e-9);
      // The move and what is left of the pose make the pose, also of the bones below.
      const Affine move = toAffine(groundMoveOf(without.bone(1), at.bone(1)).pose());
      for (const std::size_t bone : {1u, 3u})
        EXPECT_LT(((move * with.bone(bone)).matrix() - without.bone(bone).matrix()).norm(), 1e-9);
      EXPECT_EQ(with.bone(0).matrix(), without.bone(0).matrix()) << "what is above the root stays";
    }
  }
}

TEST(GroundMoves, APowerIsTheMoveSoManyTimes) {
  const GroundMove step{0.7, -0.2, 0.31};
  GroundMove sum;
  for (int i = 0; i < 37; ++i) sum = sum * step;
  const GroundMove power = groundMovePower(step, 37), back = power * groundMovePower(step, -37);
  EXPECT_NEAR(power.x, sum.x, 1e-12);
  EXPECT_NEAR(power.y, sum.y, 1e-12);
  EXPECT_NEAR(power.turn, sum.turn, 1e-12);
  EXPECT_NEAR(back.x, 0, 1e-12);
  EXPECT_NEAR(back.y, 0, 1e-12);
  EXPECT_EQ(groundMovePower(step, 0).x, 0);
}

}  // namespace
}  // namespace stadion::test
