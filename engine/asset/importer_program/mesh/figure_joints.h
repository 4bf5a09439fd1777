#pragma once
/// The skeleton of a scene: each node becomes a bone, and each use of a bone by vertices a joint.
///
/// Frames   The first bone is the model itself: it brings the file's coordinates to metres, +Z up.
/// Ownership  borrows the scene.
/// Errors   throws Refusal when the scene goes beyond the limits. Channels that cannot be played, with times
///          that do not ascend for example, are left out and named in the inventory.

#include "engine/asset/importer_program/source/source_scene.h"

#include <vector>

namespace stadion::importer {

class FigureJoints {
public:
  FigureJoints(const SourceScene& scene, const SkeletonLimits& limits);

  /// The skin of a node's mesh; -1 = none.
  std::int32_t skinOf(std::uint32_t node, std::uint32_t mesh) const;
  /// What carries a vertex of a primitive below that node.
  VertexJoints of(const SourcePrimitive& part, std::size_t vertex, std::uint32_t node,
                  std::int32_t skin) const;

  /// The weight of the first morph target below that node; -1 = it has none.
  std::int32_t firstWeight(std::uint32_t node) const { return firstWeight_[node]; }

  /// Without its reach.
  Skeleton skeleton(ModelInventory& inventory) const;

private:
  void addBones(std::uint32_t root);
  void addJoints();
  void addWeights();
  VertexJoints carriedBy(std::uint32_t joint) const;
  /// False if it has not a number for each weight of its node.
  bool addWeightChannels(const SourceChannel& from, Clip& clip) const;
  Clip clipOf(const SourceClip& from, std::string name, std::size_t& leftOut) const;

  const SourceScene& scene_;
  SkeletonLimits limits_;
  std::vector<Bone> bones_;
  std::vector<Joint> joints_;
  std::vector<MorphWeight> weights_;
  std::vector<std::int32_t> firstWeight_;   ///< by node
  std::vector<std::int32_t> boneOf_;        ///< by node; -1 = none
  std::vector<std::int32_t> jointOfNode_;   ///< by node: that of what has no skin; -1 = none
  std::vector<std::uint32_t> firstOfSkin_;  ///< by skin: its first joint
};

}  // namespace stadion::importer
