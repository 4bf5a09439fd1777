#pragma once
/// A force field as an ordinary leaf of the scene: `forcelinear`, `forcespherical`, `forcepoint`,
/// `forcevortex`, `medium`. It moves, turns, scales, is attached and switched; the dynamics nodes whose
/// bodies are hooked to it read it, in their own step.
///
/// Events    enabled, disabled; expired when `duration` ends an activation. Each at its exact time.
/// Commands  enable (starts an activation that `duration` bounds), disable, toggle, reset, and those of a
///           placed node.
/// Frames    the law is in the field's own coordinates; its scale multiplies a linear field's strength and
///           the lengths of the others. The place of a field that is attached to a body counts from the
///           body's centre of mass if `centredOnMass`.
/// Times     a command takes effect inside dynamics at its exact time; a device's axis scales the strength
///           evenly between the times at which it changed.

#include "dynamics/motion/force_field.h"
#include "engine/input/axis_track.h"
#include "engine/nodes/switch_state.h"
#include "engine/scene/placed_node.h"

namespace stadion {

/// Which axis of which device a field's strength is multiplied by.
struct StrengthAxis {
  std::string tracker;
  std::size_t axis = 0;
};

/// Attributes that the script gives a field.
struct FieldAttributes {
  FieldLaw law;
  Nanoseconds duration = 0;  ///< longest activation [ns], 0 = no limit
  bool on = true;            ///< at the start
  std::optional<StrengthAxis> axis;
  bool centredOnMass = false;  ///< if the field stands below a body: its centre is that body's centre of mass
};

extern const NodeType kForceLinearType;
extern const NodeType kForceSphericalType;
extern const NodeType kForcePointType;
extern const NodeType kForceVortexType;
extern const NodeType kMediumType;

class FieldNode : public PlacedNode {
public:
  /// A switch at an exact time within a frame.
  struct Change {
    Nanoseconds when = 0;
    bool on = false;

    template <class Self, class Fields>
    static void fields(Self& c, Fields& f) {
      f("when", c.when), f("on", c.on);
    }
  };

  FieldNode(const NodeType& type, NodeRef self, std::string name, PlaceAttributes place,
            FieldAttributes attributes)
      : PlacedNode(type, self, std::move(name), std::move(place)), law_(attributes.law),
        duration_(attributes.duration), axis_(std::move(attributes.axis)),
        centredOnMass_(attributes.centredOnMass), switch_(attributes.on) {}

  /// The law as the field's present scale makes it.
  FieldLaw law(const Scene& scene) const;
  Pose pose(const Scene& scene) const;  ///< X_WF now
  Nanoseconds duration() const { return duration_; }
  bool initially() const { return switch_.initially(); }
  bool on() const { return switch_.on(); }
  Nanoseconds activated() const { return since_; }  ///< when the present activation began
  /// The switches of frame `frame`, in order.
  const std::vector<Change>& changes(std::uint64_t frame) const;

  /// Returns the factor of the strength in this frame while the field is on; empty without an axis.
  const AxisTrack& strength() const { return strength_; }

  /// A dynamics node that wants to be woken when this field is switched, or its strength changes.
  void addUser(NodeRef dynamics) { users_.push_back(dynamics); }
  void removeUser(NodeRef dynamics) { std::erase(users_, dynamics); }

  bool busy() const override { return PlacedNode::busy() || (axis_ && switch_.on()); }
  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f);

protected:
  void onEnter(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;

private:
  void followAxis(FrameContext& frame);
  void change(bool on, Nanoseconds when, FrameContext& frame);
  void expire(Nanoseconds by);
  void moveToCentreOfMass(Scene& scene);

  FieldLaw law_;
  Nanoseconds duration_;  ///< 0 = no limit
  std::optional<StrengthAxis> axis_;
  bool centredOnMass_;
  AxisTrack strength_;
  SwitchState switch_;
  Nanoseconds since_ = 0;
  std::vector<Change> changes_;
  std::uint64_t changedIn_ = ~std::uint64_t{0};
  std::vector<NodeRef> users_;
};

}  // namespace stadion
