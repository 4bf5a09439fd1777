#pragma once
/// `bone`: a place that goes with a bone of a figure, for what hangs from it: a discus in a hand.
///
/// Its parent is the figure; its position, orientation and scale are in the bone's coordinates. A tracker may
/// take it, as any placed node; a detached one returns to its bone.
/// The figure moves it, and reports its motion within a frame.

#include "engine/scene/placed_node.h"

#include <cstdint>
#include <optional>

namespace stadion {

class FigureNode;

extern const NodeType kBoneType;

class BoneNode : public PlacedNode {
public:
  /// `bone`: number in the figure's skeleton; nothing: the figure's model is missing.
  BoneNode(NodeRef self, std::string name, PlaceAttributes place, std::optional<std::uint32_t> bone);

  bool resume(Scene& scene) override;

protected:
  void onEnter(Scene& scene) override;
  void onLeave(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;

private:
  FigureNode* figure(Scene& scene) const;

  std::optional<std::uint32_t> bone_;
};

}  // namespace stadion
