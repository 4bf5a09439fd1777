#pragma once
/// `scene`: a file of its own that is loaded and unloaded by message, below this node's place.
///
/// A command takes effect at a fixed show time, `ready` seconds after it is due, whenever the loader
/// finished: so every replica and every replay changes in the same frame.
///
/// Events    loaded, unloaded.
/// Commands  load, unload, reset (unload and load again), and those of a placed node.

#include "engine/scene/placed_node.h"

namespace stadion {

extern const NodeType kSceneType;

class SceneNode : public PlacedNode {
public:
  enum class Change : std::uint8_t { Loaded = 7, Unloaded = 8 };  ///< the numbers are part of the state hash

  SceneNode(NodeRef self, std::string name, PlaceAttributes place, std::string file, Nanoseconds ready,
            bool initially)
      : PlacedNode(kSceneType, self, std::move(name), std::move(place)), file_(std::move(file)),
        ready_(ready), initially_(initially) {}

  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f);

protected:
  void onEnter(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;

private:
  void load(Scene& scene, Nanoseconds at);
  void unload(Scene& scene, Nanoseconds at);

  std::string file_;  ///< as the loader finds it
  Nanoseconds ready_;
  bool initially_;
  std::uint32_t number_ = 0;  ///< the load that is there or asked for; 0 = none
  std::vector<std::pair<Nanoseconds, Change>> expected_;
};

}  // namespace stadion
