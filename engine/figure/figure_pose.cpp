#include "engine/figure/figure_pose.h"

#include "engine/figure/clip_sampler.h"
#include "engine/maths/functions.h"

#include <algorithm>

namespace stadion {
namespace {

void mix(BonePlace& under, const BonePlace& over, double weight) {
  under.translation += weight * (over.translation - under.translation);
  under.scale += weight * (over.scale - under.scale);
  under.rotation = det::slerp(under.rotation, over.rotation, weight);
}

}  // namespace

void FigurePose::set(const Skeleton& skeleton, const FigureRecord& playing) {
  takeRest(skeleton, places_);
  moved_.assign(skeleton.bones.size(), 0);
  const std::size_t layers = std::min<std::size_t>(playing.layerCount, FigureRecord::kMostLayers);
  for (std::size_t i = 0; i < layers; ++i)
    if (playing.layers[i].clip < skeleton.clips.size()) blend(skeleton, playing.layers[i]);
  placeBones(skeleton);
  makePalette(skeleton);
  setWeights(skeleton, playing);
}

void FigurePose::takeRest(const Skeleton& skeleton, std::vector<BonePlace>& places) const {
  places.clear();
  for (const Bone& bone : skeleton.bones) places.push_back(bone.rest);
}

void FigurePose::blend(const Skeleton& skeleton, const ClipLayer& layer) {
  const double weight = std::clamp(double{layer.weight}, 0.0, 1.0);
  if (weight == 0) return;
  const Clip& clip = skeleton.clips[layer.clip];
  takeRest(skeleton, layer_);
  sampleClip(clip, layer.time, layer_);
  for (const ClipChannel& channel : clip.channels)
    if (channel.target != ChannelTarget::Weights) moved_[channel.bone] = 1;
  for (std::size_t i = 0; i < places_.size(); ++i)
    if (moved_[i]) mix(places_[i], layer_[i], weight);
}

void FigurePose::setWeights(const Skeleton& skeleton, const FigureRecord& playing) {
  weights_.clear();
  if (skeleton.weights.empty()) return;
  std::vector<double> rest, under;
  for (const MorphWeight& w : skeleton.weights) rest.push_back(double{w.rest});
  under = rest;
  const std::size_t layers = std::min<std::size_t>(playing.layerCount, FigureRecord::kMostLayers);
  for (std::size_t i = 0; i < layers; ++i) {
    const ClipLayer& layer = playing.layers[i];
    if (layer.clip >= skeleton.clips.size()) continue;
    std::vector<double> over = rest;
    sampleWeights(skeleton.clips[layer.clip], layer.time, over);
    const double share = std::clamp(double{layer.weight}, 0.0, 1.0);
    for (std::size_t k = 0; k < under.size(); ++k) under[k] += share * (over[k] - under[k]);
  }
  weights_.assign(under.begin(), under.end());
}

/// A bone that no clip moves keeps its matrix, which may shear.
void FigurePose::placeBones(const Skeleton& skeleton) {
  bones_.clear();
  for (std::size_t i = 0; i < skeleton.bones.size(); ++i) {
    const Bone& bone = skeleton.bones[i];
    const Affine X_PB = moved_[i] ? places_[i].matrix() : bone.X_PB;
    bones_.push_back(bone.parent < 0 ? X_PB : bones_[static_cast<std::size_t>(bone.parent)] * X_PB);
  }
}

void FigurePose::makePalette(const Skeleton& skeleton) {
  palette_.clear();
  for (const Joint& joint : skeleton.joints) {
    const Affine X = bones_[joint.bone] * joint.X_BN;
    JointMatrix& columns = palette_.emplace_back();
    for (int k = 0; k < 4; ++k)
      for (int row = 0; row < 3; ++row)
        columns[static_cast<std::size_t>(4 * k + row)] = static_cast<float>(X(row, k));
  }
}

}  // namespace stadion
