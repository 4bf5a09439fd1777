#pragma once
/// `lod`: draws one of its children, by how far away from the visitor's head it is.
///
/// Nearer than the first range, the first child is shown, and so on. Beyond the last range, the child after
/// it is shown, or nothing. To avoid flicker, an approaching visitor sees a child again only a tenth nearer
/// than where it went. While the show is under stress, or the node has to give up detail, it counts as
/// farther away.
///
/// The choice is made here, once a frame, for all walls and both eyes. It changes no simulated state and is
/// no part of the hash.

#include "engine/scene/placed_node.h"

namespace stadion {

extern const NodeType kLodType;

class LodNode : public PlacedNode {
public:
  static constexpr double kBand = 0.1;  ///< hysteresis, as a part of a range

  /// `children` in the order of the script; `ranges` growing [m], at least one.
  LodNode(NodeRef self, std::string name, PlaceAttributes place, std::vector<NodeRef> children,
          std::vector<double> ranges)
      : PlacedNode(kLodType, self, std::move(name), std::move(place)), children_(std::move(children)),
        ranges_(std::move(ranges)) {}

  bool busy() const override { return true; }
  /// The child that is drawn; the number of children: none.
  std::size_t level() const { return level_; }

  void state(StateFields& f) override {
    PlacedNode::state(f);
    f.unhashed("level", level_), f.unhashed("chosen", chosen_);
  }

  /// The level at that distance [m] for one that is at `level` now.
  static std::size_t levelAt(double distance, std::size_t level, const std::vector<double>& ranges);

protected:
  void simulate(FrameContext& frame) override;

private:
  void choose(Scene& scene, std::size_t level);

  std::vector<NodeRef> children_;
  std::vector<double> ranges_;
  std::size_t level_ = 0;
  bool chosen_ = false;
};

}  // namespace stadion
