#include "engine/figure/figure_bounds.h"
#include "engine/figure/figure_pose.h"
#include "engine/figure/morph.h"
#include "tests/engine/figure/figures.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stadion::test {
namespace {

FigureRecord playing(std::initializer_list<ClipLayer> layers) {
  FigureRecord r;
  for (const ClipLayer& layer : layers) r.layers[r.layerCount++] = layer;
  return r;
}

TEST(FigurePose, ABentBoneCarriesThoseBelowIt) {
  Skeleton s = chain(3);
  const auto half = static_cast<float>(std::sqrt(0.5));
  s.clips.push_back(
      {"bend", 0, {channel(1, ChannelTarget::Rotation, Interpolation::Linear, {0}, {half, 0, 0, half})}});
  FigurePose pose;
  pose.set(s, playing({{0, 1, 0}}));
  // The second bone turns by 90 degrees about x: the third is beside it, at -y.
  EXPECT_LT((pose.bone(2).translation() - Vec3(0, -1, 1)).norm(), 1e-6);
  // The vertex at the third bone's end goes with it.
  const std::vector<std::array<float, 3>> position{{0, 0, 3}}, normal{{0, 0, 1}};
  const std::vector<VertexJoints> joints{{{2, 0, 0, 0}, {1, 0, 0, 0}}};
  std::array<SkinnedVertex, 1> out;
  skin({position, normal, joints}, pose.palette(), 0, out);
  EXPECT_NEAR(out[0].position[1], -2, 1e-6);
  EXPECT_NEAR(out[0].position[2], 1, 1e-6);
  EXPECT_NEAR(out[0].normal[1], -1, 1e-6);
}

TEST(FigurePose, AtRestAndWithoutWeightEveryBoneIsWhereItWas) {
  Skeleton s = chain(4);
  s.clips.push_back(wildClip(s, 3));
  FigurePose pose;
  for (const FigureRecord& r : {FigureRecord(), playing({{0, 0, 1}}), playing({{77, 1, 1}})}) {
    pose.set(s, r);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(pose.bone(i).translation(), Vec3(0, 0, i));
  }
}

TEST(FigurePose, ALayerOfHalfTheWeightIsHalfway) {
  Skeleton s = chain(2);
  s.clips.push_back(
      {"up", 0, {channel(1, ChannelTarget::Translation, Interpolation::Linear, {0}, {0, 0, 3})}});
  s.clips.push_back(
      {"side", 0, {channel(1, ChannelTarget::Translation, Interpolation::Linear, {0}, {4, 0, 3})}});
  FigurePose pose;
  pose.set(s, playing({{0, 1, 0}, {1, 0.5f, 0}}));
  EXPECT_EQ(pose.bone(1).translation(), Vec3(2, 0, 3));
  pose.set(s, playing({{0, 1, 0}, {1, 1, 0}}));
  EXPECT_EQ(pose.bone(1).translation(), Vec3(4, 0, 3));
}

/// The same in double precision, by matrices and without vectors of the compiler.
SkinnedVertex reference(const Skeleton& s, const FigurePose& pose, const std::array<float, 3>& p,
                        const std::array<float, 3>& n, const VertexJoints& carried) {
  Eigen::Matrix<double, 3, 4> m = Eigen::Matrix<double, 3, 4>::Zero();
  for (std::size_t k = 0; k < 4; ++k)
    m += double{carried.weight[k]} *
         (pose.bone(s.joints[carried.joint[k]].bone) * s.joints[carried.joint[k]].X_BN).matrix().topRows<3>();
  const Vec3 at = m * Vec4(double{p[0]}, double{p[1]}, double{p[2]}, 1);
  const Vec3 normal =
      (m.leftCols<3>().inverse().transpose() * Vec3(double{n[0]}, double{n[1]}, double{n[2]})).normalized();
  SkinnedVertex v;
  for (int k = 0; k < 3; ++k)
    v.position[static_cast<std::size_t>(k)] = static_cast<float>(at[k]),
    v.normal[static_cast<std::size_t>(k)] = static_cast<float>(normal[k]);
  return v;
}

TEST(FigurePose, SkinningAgreesWithDoublePrecision) {
  double worst = 0, worstNormal = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Skeleton s = chain(5);
    s.clips.push_back(wildClip(s, seed));
    FigurePose pose;
    pose.set(s, playing({{0, 1, 0.1 * seed}}));
    RandomKeys random(seed + 100);
    for (int i = 0; i < 200; ++i) {
      const std::vector<std::array<float, 3>> p{{random.in(-1, 1), random.in(-1, 1), random.in(0, 4)}};
      std::vector<std::array<float, 3>> n{{random.in(-1, 1), random.in(-1, 1), random.in(0.1, 1)}};
      const float length = std::sqrt(n[0][0] * n[0][0] + n[0][1] * n[0][1] + n[0][2] * n[0][2]);
      for (float& x : n[0]) x /= length;
      VertexJoints joints;
      const float w = random.in(0, 1);
      const auto first = static_cast<std::uint16_t>(random.in(0, 3.999));
      joints.joint = {first, static_cast<std::uint16_t>(first + 1), 0, 0};
      joints.weight = {w, 1 - w, 0, 0};
      std::array<SkinnedVertex, 1> out;
      skin({p, n, std::span(&joints, 1)}, pose.palette(), 0, out);
      const SkinnedVertex want = reference(s, pose, p[0], n[0], joints);
      for (std::size_t k = 0; k < 3; ++k) {
        worst = std::max(worst, std::fabs(double{out[0].position[k]} - double{want.position[k]}));
        worstNormal = std::max(worstNormal, std::fabs(double{out[0].normal[k]} - double{want.normal[k]}));
      }
    }
  }
  EXPECT_LT(worst, 1e-5);
  EXPECT_LT(worstNormal, 1e-3);  // blended matrices may be nearly flat
  RecordProperty("worst position [um]", static_cast<int>(worst * 1e6));
}

TEST(FigurePose, NoClipAndNoBlendLeavesTheReach) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    Skeleton s = chain(6);
    for (unsigned c = 0; c < 3; ++c) s.clips.push_back(wildClip(s, 10 * seed + c));
    if (seed % 3 == 0)  // the first bones keep their axes
      for (Clip& clip : s.clips)
        std::erase_if(clip.channels, [](const ClipChannel& c) {
          return c.bone < 3 && c.target != ChannelTarget::Translation;
        });
    RandomKeys random(seed);
    std::vector<std::array<float, 3>> positions, normals;
    std::vector<VertexJoints> joints;
    for (int i = 0; i < 60; ++i) {
      positions.push_back({random.in(-0.3, 0.3), random.in(-0.3, 0.3), random.in(0, 6)});
      normals.push_back({0, 0, 1});
      VertexJoints v;
      v.joint[0] = static_cast<std::uint16_t>(random.in(0, 5.999));
      joints.push_back(v);
    }
    const Sphere reach = figureReach(s, positions, joints);
    FigurePose pose;
    std::vector<SkinnedVertex> out(positions.size());
    for (int i = 0; i < 50; ++i) {
      pose.set(s, playing({{0, 1, random.in(0, 2.5)},
                           {1, random.in(0, 1), random.in(0, 2.5)},
                           {2, random.in(0, 1), random.in(0, 2.5)}}));
      skin({positions, normals, joints}, pose.palette(), 0, out);
      for (const SkinnedVertex& v : out)
        EXPECT_LE(
            (Vec3(double{v.position[0]}, double{v.position[1]}, double{v.position[2]}) - reach.centre).norm(),
            reach.radius)
            << seed;
    }
  }
}

/// A weight's keys overshoot between cubic ones; the reach holds for that, too.
TEST(FigurePose, NoMorphTargetLeavesTheReach) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomKeys random(seed);
    Skeleton s = chain(2);
    s.clips.push_back(wildClip(s, seed));
    s.weights = {{"smile", 0.3f}, {"blink", 0}};
    for (std::uint32_t w = 0; w < 2; ++w)
      s.clips[0].channels.push_back(channel(w, ChannelTarget::Weights,
                                            w == 0 ? Interpolation::Cubic : Interpolation::Linear,
                                            {0, 0.7f, 2}, random.many(w == 0 ? 9 : 3, -2, 2)));
    std::vector<std::array<float, 3>> positions, normals;
    std::vector<VertexJoints> joints(40);
    std::vector<Morph> morphs(2);
    for (std::uint32_t i = 0; i < 40; ++i) {
      positions.push_back({random.in(-0.3, 0.3), random.in(-0.3, 0.3), random.in(0, 2)});
      normals.push_back({0, 0, 1});
      joints[i].joint[0] = static_cast<std::uint16_t>(i % 2);
      morphs[i % 2].vertices.push_back(i);
      morphs[i % 2].positions.push_back({random.in(-1, 1), random.in(-1, 1), random.in(-1, 1)});
    }
    morphs[1].weight = 1;
    const Sphere reach = figureReach(s, positions, joints, morphs);
    FigurePose pose;
    MorphedVertices morphed;
    std::vector<SkinnedVertex> out(positions.size());
    for (int i = 0; i < 60; ++i) {
      pose.set(s, playing({{0, 1, random.in(0, 2)}}));
      skin(morphed.apply({positions, normals, joints}, morphs, pose.weights()), pose.palette(), 0, out);
      for (const SkinnedVertex& v : out)
        EXPECT_LE(
            (Vec3(double{v.position[0]}, double{v.position[1]}, double{v.position[2]}) - reach.centre).norm(),
            reach.radius)
            << seed;
    }
  }
}

TEST(FigurePose, AMorphTargetAddsItsWeightTimesTheDifference) {
  Skeleton s = chain(1);
  s.weights = {{"smile", 0.25f}};
  Clip clip{"laugh", 1, {}};
  clip.channels.push_back(channel(0, ChannelTarget::Weights, Interpolation::Linear, {0, 1}, {0, 1}));
  s.clips = {clip, {"still", 1, {}}};
  const std::vector<std::array<float, 3>> positions{{0, 0, 0}, {1, 0, 0}}, normals(2, {0, 0, 1});
  const std::vector<VertexJoints> joints(2);
  const std::vector<Morph> morphs{{0, {1}, {{0, 0, 2}}, {{0, 1, -1}}}};
  FigurePose pose;
  MorphedVertices morphed;
  const auto second = [&](const FigureRecord& record) {
    pose.set(s, record);
    std::vector<SkinnedVertex> out(2);
    skin(morphed.apply({positions, normals, joints}, morphs, pose.weights()), pose.palette(), 0, out);
    EXPECT_EQ(out[0].position, positions[0]);
    return out[1];
  };
  EXPECT_FLOAT_EQ(second({}).position[2], 0.5f);
  EXPECT_FLOAT_EQ(second(playing({{0, 1, 0.75}})).position[2], 1.5f);
  EXPECT_FLOAT_EQ(second(playing({{0, 1, 1}})).normal[1], 1);
  // Half of a clip that leaves the weight at rest.
  EXPECT_FLOAT_EQ(second(playing({{0, 1, 1}, {1, 0.5f, 0}})).position[2], 1.25f);
}

}  // namespace
}  // namespace stadion::test
