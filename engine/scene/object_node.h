#pragma once
/// A mesh in the world: `object`. It is drawn, may collide, and moves only if a node or a command moves it.

#include "engine/published/records.h"
#include "engine/scene/placed_node.h"

namespace stadion {

/// The mesh and look of an object. The load counts the mesh as used, not the node.
struct Appearance {
  MeshId mesh = kNoMesh;
  bool drawn = true;        ///< `draw=false` is not drawn and still collides
  std::string shape;        ///< `shape=`: how it collides; empty = auto
  double tolerance = 0.02;  ///< `tolerance=`: of shape=auto, relative to the size
};

class ObjectNode : public PlacedNode {
public:
  ObjectNode(const NodeType& type, NodeRef self, std::string name, PlaceAttributes place,
             Appearance appearance)
      : PlacedNode(type, self, std::move(name), std::move(place)), appearance_(std::move(appearance)) {}

  const Appearance& appearance() const { return appearance_; }

  void state(StateFields& f) override { fields(*this, f); }
  template <class Self, class Fields>
  static void fields(Self& whole, Fields& f) {
    auto& self = partOf<ObjectNode>(whole);
    PlacedNode::fields(self, f);
    f.unhashed("instance", self.instance_);
  }
  bool resume(Scene& scene) override;

protected:
  void onEnter(Scene& scene) override;
  void onLeave(Scene& scene) override;
  InstanceId instance() const { return instance_; }

private:
  Appearance appearance_;
  InstanceId instance_ = 0;
};

}  // namespace stadion
