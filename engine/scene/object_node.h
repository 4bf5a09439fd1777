#pragma once
/// A mesh in the world: `object`. It is drawn, may collide, and moves only if a node or a command moves it.
///
/// Commands  tint COLOUR, emit COLOUR, opacity SHARE, reset, and those of a placed node. They change the
///           materials from the end of the frame on; the paint is part of the show's state.

#include "engine/published/paint_table.h"
#include "engine/published/records.h"
#include "engine/scene/placed_node.h"

#include <optional>

namespace stadion {

/// The mesh and look of an object. The load counts the mesh as used, not the node.
struct Appearance {
  MeshId mesh = kNoMesh;
  bool drawn = true;        ///< `draw=false` is not drawn and still collides
  std::string shape;        ///< `shape=`: how it collides; empty = auto
  double tolerance = 0.02;  ///< `tolerance=`: of shape=auto, relative to the size
  Paint paint{};            ///< `tint=`, `emit=` and `opacity=`: at the start and after reset
};

class ObjectNode : public PlacedNode {
public:
  ObjectNode(const NodeType& type, NodeRef self, std::string name, PlaceAttributes place,
             Appearance appearance)
      : PlacedNode(type, self, std::move(name), std::move(place)), appearance_(std::move(appearance)) {}

  const Appearance& appearance() const { return appearance_; }

  void hash(StateHash& h) const override;
  void state(StateFields& f) override { fields(*this, f); }
  template <class Self, class Fields>
  static void fields(Self& whole, Fields& f) {
    auto& self = partOf<ObjectNode>(whole);
    PlacedNode::fields(self, f);
    f.unhashed("instance", self.instance_);
    f("paint", self.paint_), f.unhashed("paint number", self.paintNumber_);
  }
  bool resume(Scene& scene) override;

protected:
  void onEnter(Scene& scene) override;
  void onLeave(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  InstanceId instance() const { return instance_; }

private:
  void paint(const Paint& paint, Scene& scene);

  Appearance appearance_;
  InstanceId instance_ = 0;
  std::optional<Paint> paint_;  ///< nothing: the materials are those of the file
  PaintTable::Number paintNumber_ = 0;
};

}  // namespace stadion
