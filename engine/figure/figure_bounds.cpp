#include "engine/figure/figure_bounds.h"

#include "engine/figure/clip_sampler.h"
#include "engine/maths/eigen.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

/// Where a bone's origin may be, and how its axes may stand there.
struct BoneRegion {
  Sphere origin;                 ///< in N
  bool turns = false;            ///< its axes may stand in any way
  Mat3 axes = Mat3::Identity();  ///< else they are these, with their scale
  double scale = 1;              ///< most by which it lengthens what it carries
};

/// What clips may make of a bone's place.
struct Range {
  Aabb translation;
  bool turns = false;
  double scale = 0;
};

double widening(const Mat3& m) {
  return std::sqrt(
      std::max(0.0, (m.transpose() * m).selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff()));
}

/// What an added layer may make of it.
struct Difference {
  Aabb translation;
  double scale = 1;  ///< factor
};

/// Visits values whose hull contains those of the channel. A cubic segment lies in the hull of its Bézier points,
/// p and p ± interval · m / 3.
template <class Take>
void visitHull(const ClipChannel& c, const Take& take) {
  const bool cubic = c.interpolation == Interpolation::Cubic;
  const std::size_t width = c.width(), step = width * (cubic ? 3 : 1);
  const auto vec = [&](std::size_t at) {
    return Vec3(double{c.values[at]}, double{c.values[at + 1]}, double{c.values[at + 2]});
  };
  for (std::size_t key = 0; key < c.times.size(); ++key) {
    const std::size_t at = key * step;
    if (!cubic) {
      take(vec(at));
      continue;
    }
    const Vec3 value = vec(at + width);
    take(value);
    if (key > 0) take(value - (double{c.times[key]} - double{c.times[key - 1]}) / 3 * vec(at));
    if (key + 1 < c.times.size())
      take(value + (double{c.times[key + 1]} - double{c.times[key]}) / 3 * vec(at + 2 * width));
  }
}

void includeKeys(const ClipChannel& c, Range& range) {
  visitHull(c, [&](const Vec3& v) {
    if (c.target == ChannelTarget::Translation) range.translation.include(v);
    if (c.target == ChannelTarget::Scale) range.scale = std::max(range.scale, v.cwiseAbs().maxCoeff());
  });
}

void includeDifferences(const ClipChannel& c, Difference& difference) {
  const auto at0 = sampleChannel(c, 0);
  const Vec3 begin(at0[0], at0[1], at0[2]);
  visitHull(c, [&](const Vec3& v) {
    if (c.target == ChannelTarget::Translation) difference.translation.include(Vec3(v - begin));
    if (c.target == ChannelTarget::Scale)
      for (int k = 0; k < 3; ++k)
        difference.scale = std::max(difference.scale, std::fabs(scaleGrowth(begin[k], v[k])));
  });
}

/// The numbers of a cubic weight lie between its Bézier points, too. `from`: what they are compared with.
void includeWeights(const ClipChannel& c, double from, double& most) {
  const bool cubic = c.interpolation == Interpolation::Cubic;
  const auto take = [&](double value) { most = std::max(most, std::fabs(value - from)); };
  for (std::size_t key = 0; key < c.times.size(); ++key) {
    const auto number = [&](std::size_t which) { return double{c.values[cubic ? 3 * key + which : key]}; };
    const double value = number(cubic ? 1 : 0);
    take(value);
    if (!cubic) continue;
    if (key > 0) take(value - (double{c.times[key]} - double{c.times[key - 1]}) / 3 * number(0));
    if (key + 1 < c.times.size())
      take(value + (double{c.times[key + 1]} - double{c.times[key]}) / 3 * number(2));
  }
}

/// How far morph targets may move each vertex [m].
std::vector<double> morphReach(const Skeleton& skeleton, std::size_t vertices, std::span<const Morph> morphs,
                               std::size_t added) {
  std::vector<double> most, further(skeleton.weights.size(), 0);
  for (const MorphWeight& w : skeleton.weights) most.push_back(std::fabs(double{w.rest}));
  for (const Clip& clip : skeleton.clips)
    for (const ClipChannel& channel : clip.channels)
      if (channel.target == ChannelTarget::Weights) {
        includeWeights(channel, 0, most[channel.bone]);
        includeWeights(channel, sampleChannel(channel, 0)[0], further[channel.bone]);
      }
  for (std::size_t i = 0; i < most.size(); ++i) most[i] += static_cast<double>(added) * further[i];
  std::vector<double> reach(vertices, 0);
  for (const Morph& m : morphs)
    for (std::size_t i = 0; i < m.vertices.size(); ++i) {
      const auto& d = m.positions[i];
      reach[m.vertices[i]] += most[m.weight] * Vec3(double{d[0]}, double{d[1]}, double{d[2]}).norm();
    }
  return reach;
}

/// Widens the ranges by so many added layers.
void addDifferences(const Skeleton& skeleton, std::size_t added, std::vector<Range>& ranges) {
  std::vector<Difference> differences(ranges.size());
  for (Difference& d : differences) d.translation.include(Vec3(Vec3::Zero()));
  for (const Clip& clip : skeleton.clips)
    for (const ClipChannel& channel : clip.channels)
      if (channel.target == ChannelTarget::Translation || channel.target == ChannelTarget::Scale)
        includeDifferences(channel, differences[channel.bone]);
  for (std::size_t i = 0; i < ranges.size(); ++i)
    for (std::size_t layer = 0; layer < added; ++layer) {
      ranges[i].translation.lo += differences[i].translation.lo;
      ranges[i].translation.hi += differences[i].translation.hi;
      ranges[i].scale *= differences[i].scale;
    }
}

std::vector<Range> rangesOf(const Skeleton& skeleton) {
  std::vector<Range> ranges;
  for (const Bone& bone : skeleton.bones) {
    Range range;
    range.translation.include(bone.rest.translation);
    range.translation.include(Vec3(bone.X_PB.translation()));
    range.scale = std::max(bone.rest.scale.cwiseAbs().maxCoeff(), widening(bone.X_PB.linear()));
    ranges.push_back(range);
  }
  for (const Clip& clip : skeleton.clips)
    for (const ClipChannel& channel : clip.channels) {
      if (channel.target == ChannelTarget::Weights) continue;
      Range& range = ranges[channel.bone];
      range.turns |= channel.target != ChannelTarget::Translation;
      if (channel.target != ChannelTarget::Rotation) includeKeys(channel, range);
    }
  return ranges;
}

/// Where a ball in the bone's coordinates may come to.
Sphere carried(const BoneRegion& region, const Vec3& centre, double radius) {
  if (region.turns)
    return {region.origin.centre, region.origin.radius + region.scale * (centre.norm() + radius)};
  return {region.origin.centre + region.axes * centre, region.origin.radius + region.scale * radius};
}

BoneRegion regionOf(const Bone& bone, const Range& range, const std::vector<BoneRegion>& before) {
  const BoneRegion root{{Vec3::Zero(), 0}, false, Mat3::Identity(), 1};
  const BoneRegion& parent = bone.parent < 0 ? root : before[static_cast<std::size_t>(bone.parent)];
  BoneRegion region;
  const Vec3 middle = range.translation.centre();
  region.origin = carried(parent, middle, (range.translation.hi - middle).norm());
  region.turns = parent.turns || range.turns;
  region.scale = parent.scale * range.scale;
  if (!region.turns) region.axes = parent.axes * bone.X_PB.linear(), region.scale = widening(region.axes);
  return region;
}

/// Of a root bone: at rest on the ground, at any of its heights. An added layer moves it from there by as much as it
/// does elsewhere.
BoneRegion rootRegion(const Skeleton& skeleton, std::size_t root, BoneRegion region, bool added) {
  Affine X_NB = Affine::Identity();
  for (auto i = static_cast<std::int32_t>(root); i >= 0;
       i = skeleton.bones[static_cast<std::size_t>(i)].parent)
    X_NB = skeleton.bones[static_cast<std::size_t>(i)].X_PB * X_NB;
  region.origin.centre.head<2>() = X_NB.translation().head<2>();
  if (added) region.origin.radius *= 3;
  region.turns = true;
  return region;
}

std::vector<BoneRegion> regionsOf(const Skeleton& skeleton, const ReachOptions& options) {
  std::vector<Range> ranges = rangesOf(skeleton);
  addDifferences(skeleton, options.added, ranges);
  std::vector<BoneRegion> regions;
  for (std::size_t i = 0; i < skeleton.bones.size(); ++i) {
    regions.push_back(regionOf(skeleton.bones[i], ranges[i], regions));
    if (options.root == i) regions.back() = rootRegion(skeleton, i, regions.back(), options.added > 0);
  }
  return regions;
}

/// The part of a mesh that a joint carries, in its bone's coordinates.
std::vector<Aabb> carriedBoxes(const Skeleton& skeleton, std::span<const std::array<float, 3>> positions,
                               std::span<const VertexJoints> joints, const std::vector<double>& further) {
  std::vector<Aabb> boxes(skeleton.joints.size());
  std::vector<double> scales;
  for (const Joint& joint : skeleton.joints) scales.push_back(widening(joint.X_BN.linear()));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3 p(double{positions[i][0]}, double{positions[i][1]}, double{positions[i][2]});
    for (std::size_t k = 0; k < VertexJoints::kMost; ++k)
      if (joints[i].weight[k] > 0) {
        const std::size_t joint = joints[i].joint[k];
        const Vec3 at = skeleton.joints[joint].X_BN * p, spare = Vec3::Constant(scales[joint] * further[i]);
        boxes[joint].include(Vec3(at - spare));
        boxes[joint].include(Vec3(at + spare));
      }
  }
  return boxes;
}

}  // namespace

Sphere figureReach(const Skeleton& skeleton, std::span<const std::array<float, 3>> positions,
                   std::span<const VertexJoints> joints, std::span<const Morph> morphs,
                   const ReachOptions& options) {
  const std::vector<BoneRegion> regions = regionsOf(skeleton, options);
  std::vector<Sphere> spheres;
  for (const BoneRegion& region : regions) spheres.push_back(region.origin);
  const std::vector<Aabb> boxes = carriedBoxes(skeleton, positions, joints,
                                               morphReach(skeleton, positions.size(), morphs, options.added));
  for (std::size_t j = 0; j < boxes.size(); ++j)
    if (!boxes[j].empty())
      spheres.push_back(carried(regions[skeleton.joints[j].bone], boxes[j].centre(),
                                0.5 * (boxes[j].hi - boxes[j].lo).norm()));
  Aabb box;
  for (const Sphere& s : spheres) {
    box.include(Vec3(s.centre - Vec3::Constant(s.radius)));
    box.include(Vec3(s.centre + Vec3::Constant(s.radius)));
  }
  if (box.empty()) return {};
  Sphere all{box.centre(), 0};
  for (const Sphere& s : spheres)
    all.radius = std::max(all.radius, (s.centre - all.centre).norm() + s.radius);
  all.radius *= 1 + 1e-6;  // single precision of the vertices
  return all;
}

}  // namespace stadion
