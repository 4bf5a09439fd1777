#pragma once
/// A region that notices visitors: `usertrigger` watches the head, `wandtrigger` the wand and its buttons.
///
/// Events    enter, exit; wandtrigger also button1..button4, pressed inside. A visitor who is inside when the
/// trigger first
///           looks (or is enabled) enters it then. Each event carries the exact time of the crossing, the
///           visitor being taken to move in a straight line within a frame.
/// Frames    the region is in the node's own coordinates and moves with its parent.
/// Commands  enable, disable, toggle, reset, and those of a placed node.

#include "engine/nodes/placed_node.h"
#include "engine/nodes/switched.h"

namespace stadion {

/// A sphere, or a box with its edges along the axes.
struct Region {
  enum class Form : std::uint8_t { Sphere, Box } form = Form::Sphere;
  Vec3 centre = Vec3::Zero();    ///< [m]
  double radius = 1;             ///< [m]
  Vec3 halfSize = Vec3::Ones();  ///< [m]

  bool contains(const Vec3& p) const;
  /// The first s in [0, 1] at which a + s (b - a) crosses the boundary; expects that exactly one end is
  /// inside.
  double crossing(const Vec3& a, const Vec3& b) const;
};

class TriggerNode : public PlacedNode {
public:
  TriggerNode(NodeKind kind, NodeRef self, std::string name, PlaceAttributes place, const Region& region,
              std::string tracker, bool on)
      : PlacedNode(kind, self, std::move(name), std::move(place)), region_(region),
        tracker_(std::move(tracker)), switch_(on) {}

  Rank rank() const override { return Rank::Sensing; }
  bool busy() const override { return switch_.on() || PlacedNode::busy(); }
  void hash(StateHash& h) const override;

protected:
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;

private:
  std::optional<Vec3> visitor(const FrameContext& frame) const;
  void watchButtons(const FrameContext& frame);

  Region region_;
  std::string tracker_;  ///< "head" for a usertrigger
  Switched switch_;
  bool inside_ = false;
  bool looked_ = false;       ///< last_ is valid
  Vec3 last_ = Vec3::Zero();  ///< visitor in the node's coordinates
  std::uint32_t buttons_ = 0;
};

}  // namespace stadion
