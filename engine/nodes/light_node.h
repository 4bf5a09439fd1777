#pragma once
/// Light sources and the sky.

#include "engine/nodes/switch_state.h"
#include "engine/published/records.h"
#include "engine/scene/placed_node.h"

namespace stadion {

/// `light`: directional, point or spot. Direction and position are in its own coordinates and move with it.
/// It is dark while it, or something above it, is hidden.
/// Commands  enable, disable, toggle, and those of a placed node.
extern const NodeType kLightType;

class LightNode : public PlacedNode {
public:
  LightNode(NodeRef self, std::string name, PlaceAttributes place, const LightRecord& light, bool on)
      : PlacedNode(kLightType, self, std::move(name), std::move(place)), light_(light), switch_(on) {}

  void hash(StateHash& h) const override { hashFields(*this, h); }
  void state(StateFields& f) override { fields(*this, f); }
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f) {
    PlacedNode::fields(self, f);
    f("switch", self.switch_);
    f.unhashed("handle", self.handle_);
  }
  bool resume(Scene& scene) override;

protected:
  void onEnter(Scene& scene) override;
  void onLeave(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;

private:
  LightRecord light_;
  SwitchState switch_;
  std::size_t handle_ = 0;
};

/// `sky`: colours of the background, light from everywhere, haze. The last one to enter is seen; when it
/// leaves, the one before returns.
extern const NodeType kSkyType;

class SkyNode : public Node {
public:
  SkyNode(NodeRef self, std::string name, const SkyRecord& sky)
      : Node(kSkyType, self, std::move(name)), sky_(sky) {}

  bool resume(Scene& scene) override;

protected:
  void onEnter(Scene& scene) override;
  void onLeave(Scene& scene) override;

private:
  SkyRecord sky_;
};

}  // namespace stadion
