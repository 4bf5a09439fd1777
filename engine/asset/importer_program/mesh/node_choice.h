#pragma once
/// Which nodes of a scene become the mesh: all, or one part of it, without parts that stand for themselves.

#include "engine/asset/format.h"
#include "engine/asset/importer_program/source/source_scene.h"

#include <vector>

namespace stadion::importer {

class NodeChoice {
public:
  /// Throws Refusal if the scene has no such part. Nodes that it does not have need not be left out.
  NodeChoice(const SourceScene& scene, const NodeSelection& nodes);

  /// The nodes to begin with.
  const std::vector<std::uint32_t>& roots() const { return roots_; }
  /// What is above a root, up to the show's coordinates; of a part, up to its own.
  Affine above(std::uint32_t root) const;
  bool isLeftOut(std::uint32_t node) const { return leftOut_[node]; }
  bool hasGaps() const { return hasGaps_; }
  /// From a part's own coordinates to those of the model: its node's place and orientation, without a scale.
  const Affine& place() const { return place_; }

private:
  Affine parentsOf(std::uint32_t node) const;

  const SourceScene& scene_;
  std::vector<std::uint32_t> roots_;
  std::vector<bool> leftOut_;
  bool hasGaps_ = false;
  Affine place_ = Affine::Identity();
};

}  // namespace stadion::importer
