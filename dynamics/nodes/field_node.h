#pragma once
/// A force field as an ordinary leaf of the scene: `forcelinear`, `forcespherical`, `forcepoint`,
/// `forcevortex`, `medium`. It moves, turns, scales, is attached and switched; the dynamics nodes whose
/// bodies are hooked to it read it, in their own step.
///
/// Commands  enable (starts an activation that `duration` bounds), disable, toggle, reset, and those of a
/// placed node. Frames    the law is in the field's own coordinates; its scale multiplies a linear field's
/// strength and the
///           lengths of the others.
/// Times     a command takes effect inside dynamics at its exact time.

#include "dynamics/force_field.h"
#include "engine/nodes/placed_node.h"
#include "engine/nodes/switched.h"

namespace stadion {

class FieldNode : public PlacedNode {
public:
  /// A switch at an exact time within a frame.
  struct Change {
    Nanoseconds when;
    bool on;
  };

  FieldNode(NodeKind kind, NodeRef self, std::string name, PlaceAttributes place, FieldLaw law,
            Nanoseconds duration, bool on)
      : PlacedNode(kind, self, std::move(name), std::move(place)), law_(law), duration_(duration),
        switch_(on) {}

  /// The law as the field's present scale makes it.
  FieldLaw law(const Scene& scene) const;
  Pose pose(const Scene& scene) const;  ///< X_WF now
  Nanoseconds duration() const { return duration_; }
  bool initially() const { return switch_.initially(); }
  bool on() const { return switch_.on(); }
  Nanoseconds activated() const { return since_; }  ///< when the present activation began
  /// The switches of frame `frame`, in order.
  const std::vector<Change>& changes(std::uint64_t frame) const;

  /// A dynamics node that wants to be woken when this field is switched.
  void addUser(NodeRef dynamics) { users_.push_back(dynamics); }
  void removeUser(NodeRef dynamics) { std::erase(users_, dynamics); }

  void hash(StateHash& h) const override;

protected:
  void onEnter(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;

private:
  void change(bool on, Nanoseconds when, FrameContext& frame);

  FieldLaw law_;
  Nanoseconds duration_;  ///< 0 = no limit
  Switched switch_;
  Nanoseconds since_ = 0;
  std::vector<Change> changes_;
  std::uint64_t changedIn_ = ~std::uint64_t{0};
  std::vector<NodeRef> users_;
};

}  // namespace stadion
