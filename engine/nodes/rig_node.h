#pragma once
/// The visitor's platform and what drives it.

#include "engine/input/input_sample.h"
#include "engine/input/tracker_names.h"
#include "engine/nodes/switch_state.h"
#include "engine/scene/placed_node.h"

namespace stadion {

/// `rig`: the tracked platform that carries walls and trackers. The last one to enter is the one in use.
extern const NodeType kRigType;

class RigNode : public PlacedNode {
public:
  RigNode(NodeRef self, std::string name, PlaceAttributes place, double eyeHeight)
      : PlacedNode(kRigType, self, std::move(name), std::move(place)), eyeHeight_(eyeHeight) {}

  Rank rank() const override { return Rank::Input; }

protected:
  void onEnter(Scene& scene) override;
  void onLeave(Scene& scene) override;

private:
  double eyeHeight_;  ///< height of an untracked head [m]
};

/// `navigator`: the joypad moves the rig where the wand points, and turns it about the visitor's head, so
/// that the world turns around them and not they around the room's centre. Axis 0 turns (right is positive),
/// axis 1 goes forward; both at once go along an arc. walk keeps to the horizontal, fly does not. The motion
/// is integrated over the times at which the axes changed, so that it does not depend on the frame rate.
extern const NodeType kNavigatorType;

class NavigatorNode : public Node {
public:
  struct Attributes {
    double speed = 1.5;     ///< [m/s] at full deflection
    double turnRate = 0.8;  ///< [rad/s] at full deflection
    bool fly = false;
    std::string tracker = kWandTracker;
  };

  NavigatorNode(NodeRef self, std::string name, Attributes a, bool on)
      : Node(kNavigatorType, self, std::move(name)), attributes_(std::move(a)), switch_(on) {}

  Rank rank() const override { return Rank::Input; }
  bool busy() const override { return switch_.on(); }
  void hash(StateHash& h) const override { hashFields(*this, h); }
  void state(StateFields& f) override { fields(*this, f); }
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f) {
    f("switch", self.switch_), f("ended", self.ended_);
    f("wand", self.q_RT_), f("head", self.p_RH_);
    f.unhashed("since", self.since_);
  }

protected:
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;

private:
  /// Moves the rig from where it was at since_ to where it is at `until`.
  void drive(FrameContext& frame, Nanoseconds until);
  PoseTrack way(const TrackerSample* t, const FrameContext& frame, const Pose& before, const Pose& now) const;

  Attributes attributes_;
  SwitchState switch_;
  Nanoseconds since_ = 0;  ///< show time up to which it has driven or was off
  // What the devices said at the end of the last frame it was visited in.
  Nanoseconds ended_ = -1;
  Quat q_RT_ = Quat::Identity();
  Vec3 p_RH_ = Vec3::Zero();
};

}  // namespace stadion
