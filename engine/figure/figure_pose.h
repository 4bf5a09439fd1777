#pragma once
/// From what a figure plays to where its bones are.
///
///     FigurePose pose;
///     pose.set(skeleton, record);
///     pose.bone(i);     // X_NB
///     pose.palette();   // a matrix for each joint, for skinning
///     pose.weights();   // a weight for each morph target
///
/// Blending  a layer of weight w over a pose: translations, scales and weights of morph targets on the straight
///           line, rotations with constant angular velocity, the short way. What a layer's clip does not move
///           counts as at rest there.
/// Adding    an added layer changes what its clip moves by the difference to the clip's beginning, times its
///           weight w: translations and weights of morph targets by w (v(t) - v(0)), scales by
///           1 + w (v(t) / v(0) - 1), rotations by the turn from q(0) to q(t) in the bone's own axes. three.js
///           does so, too (AnimationUtils.makeClipAdditive), but adds scales.
/// Root      a root bone stays where it is at rest on the ground, and keeps its heading (ground_move.h): its
///           way moves the node instead. Added layers come on top and do not move the node.
/// Threads   one at a time for each object; the results depend on the arguments alone.

#include "engine/figure/figure_record.h"
#include "engine/figure/skeleton.h"

#include <span>
#include <vector>

namespace stadion {

/// Takes positions of the mesh to where the joint carries them: the four columns of a matrix (3 x 4), each
/// with a fourth number of no use.
using JointMatrix = std::array<float, 16>;

class FigurePose {
public:
  /// Layers with unknown clips count for nothing.
  void set(const Skeleton& skeleton, const FigureRecord& playing);

  /// X_NB of a bone.
  const Affine& bone(std::size_t i) const { return bones_[i]; }
  /// By joint. Valid until the next call of set().
  std::span<const JointMatrix> palette() const { return palette_; }
  /// By morph weight (Skeleton::weights). Valid until the next call of set().
  std::span<const float> weights() const { return weights_; }

private:
  void takeRest(const Skeleton& skeleton, std::vector<BonePlace>& places) const;
  void blend(const Skeleton& skeleton, const ClipLayer& layer);
  void add(const Skeleton& skeleton, const ClipLayer& layer);
  void setWeights(const Skeleton& skeleton, const FigureRecord& playing);
  Affine placeOf(const Skeleton& skeleton, std::size_t bone) const;
  Affine undoneMove(const Skeleton& skeleton, std::size_t root) const;
  void placeBones(const Skeleton& skeleton, std::size_t root, const Affine& undone);
  void makePalette(const Skeleton& skeleton);

  std::vector<BonePlace> places_, layer_, begin_;
  std::vector<char> moved_;  ///< by bone: some layer moves it
  std::vector<Affine> bones_;
  std::vector<JointMatrix> palette_;
  std::vector<float> weights_;
};

}  // namespace stadion
