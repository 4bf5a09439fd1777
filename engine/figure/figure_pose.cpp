#include "engine/figure/figure_pose.h"

#include "engine/figure/clip_sampler.h"
#include "engine/figure/ground_move.h"
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
  const std::size_t root = playing.root - std::size_t{1};  // 0 becomes a bone that no skeleton has
  const Affine undone = root < skeleton.bones.size() ? undoneMove(skeleton, root) : Affine::Identity();
  const std::size_t added = std::min<std::size_t>(playing.addedCount, FigureRecord::kMostAdded);
  for (std::size_t i = 0; i < added; ++i)
    if (playing.added[i].clip < skeleton.clips.size()) add(skeleton, playing.added[i]);
  placeBones(skeleton, root, undone);
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

void FigurePose::add(const Skeleton& skeleton, const ClipLayer& layer) {
  const double weight = std::clamp(double{layer.weight}, 0.0, 1.0);
  if (weight == 0) return;
  const Clip& clip = skeleton.clips[layer.clip];
  takeRest(skeleton, layer_);
  takeRest(skeleton, begin_);
  sampleClip(clip, layer.time, layer_);
  sampleClip(clip, 0, begin_);
  for (const ClipChannel& channel : clip.channels) {
    if (channel.target == ChannelTarget::Weights) continue;
    const std::size_t i = channel.bone;
    const BonePlace &begin = begin_[i], &now = layer_[i];
    BonePlace& place = places_[i];
    moved_[i] = 1;
    if (channel.target == ChannelTarget::Translation)
      place.translation += weight * (now.translation - begin.translation);
    if (channel.target == ChannelTarget::Rotation)
      place.rotation =
          (place.rotation * det::slerp(Quat::Identity(), begin.rotation.conjugate() * now.rotation, weight))
              .normalized();
    if (channel.target == ChannelTarget::Scale)
      for (int k = 0; k < 3; ++k)
        place.scale[k] *= 1 + weight * (scaleGrowth(begin.scale[k], now.scale[k]) - 1);
  }
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
  const std::size_t added = std::min<std::size_t>(playing.addedCount, FigureRecord::kMostAdded);
  for (std::size_t i = 0; i < added; ++i) {
    const ClipLayer& layer = playing.added[i];
    if (layer.clip >= skeleton.clips.size()) continue;
    std::vector<double> begin = rest, now = rest;
    sampleWeights(skeleton.clips[layer.clip], 0, begin);
    sampleWeights(skeleton.clips[layer.clip], layer.time, now);
    const double share = std::clamp(double{layer.weight}, 0.0, 1.0);
    for (std::size_t k = 0; k < under.size(); ++k) under[k] += share * (now[k] - begin[k]);
  }
  weights_.assign(under.begin(), under.end());
}

/// In its parent. A bone that no clip moves keeps its matrix, which may shear.
Affine FigurePose::placeOf(const Skeleton& skeleton, std::size_t bone) const {
  return moved_[bone] ? places_[bone].matrix() : skeleton.bones[bone].X_PB;
}

/// Takes the root bone back to where it is at rest on the ground.
Affine FigurePose::undoneMove(const Skeleton& skeleton, std::size_t root) const {
  Affine X_NB = Affine::Identity(), atRest = Affine::Identity();
  for (auto i = static_cast<std::int32_t>(root); i >= 0;
       i = skeleton.bones[static_cast<std::size_t>(i)].parent) {
    X_NB = placeOf(skeleton, static_cast<std::size_t>(i)) * X_NB;
    atRest = skeleton.bones[static_cast<std::size_t>(i)].X_PB * atRest;
  }
  return toAffine(groundMoveOf(X_NB, atRest).inverse().pose());
}

void FigurePose::placeBones(const Skeleton& skeleton, std::size_t root, const Affine& undone) {
  bones_.clear();
  for (std::size_t i = 0; i < skeleton.bones.size(); ++i) {
    const std::int32_t parent = skeleton.bones[i].parent;
    const Affine X_PB = placeOf(skeleton, i);
    bones_.push_back(parent < 0 ? X_PB : bones_[static_cast<std::size_t>(parent)] * X_PB);
    if (i == root) bones_.back() = undone * bones_.back();
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
