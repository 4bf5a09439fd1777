#pragma once
/// `sway`: moves its targets along sinusoids about the places that the script gives them, and turns them
/// evenly: boats, banners, a shoal.
///
/// Target k, from 0, is displaced along each axis by amplitude x sin(2 pi frequency t + phase + k phasestep)
/// and turned about itself by angularvelocity x t. t is the time for which the node has been on. The node
/// integrates nothing, so its targets' poses do not depend on the frame rate.
///
/// The node moves all targets together, as a fleet (Placements). It computes the shared part of the sinusoids
/// once a frame, and once for each 64 successive targets. A target then costs a few multiplications, by
/// sin(a + b) = sin a cos b + cos a sin b. A target's pose follows from this node's state. It becomes a part
/// of the target's own state only when this node leaves the target there.
///
/// Commands  enable (continues from its last t), disable (the targets keep their poses at the command's
///           time), toggle, reset (back to t = 0), and the commands of a placed node if it moves its
///           children.
/// Times     nodes that watch a target receive its path inside the frame, as chords of 2 ms on a grid of show
///           time.
/// Degraded  while it rests, t stands still. If it runs in one of several frames, its targets are then where
///           its own time has them. Watching nodes see them go straight there within that frame.
/// Frames    displacement and angular velocity are in the coordinates of the target's parent.

#include "engine/nodes/switch_state.h"
#include "engine/scene/placed_node.h"

#include <optional>
#include <span>
#include <vector>

namespace stadion {

extern const NodeType kSwayType;

struct SwayAttributes {
  std::vector<NodeRef> targets;         ///< in the order of the script; empty = itself
  Vec3 amplitude = Vec3::Zero();        ///< [m]
  Vec3 frequency = Vec3::Zero();        ///< [Hz]
  Vec3 phase = Vec3::Zero();            ///< phase of the first target [rad]
  Vec3 phaseStep = Vec3::Zero();        ///< from target to target [rad]
  Vec3 angularVelocity = Vec3::Zero();  ///< [rad/s]
};

class SwayNode : public PlacedNode, private FleetRule {
public:
  SwayNode(NodeRef self, std::string name, PlaceAttributes place, SwayAttributes sway, bool on)
      : PlacedNode(kSwayType, self, std::move(name), std::move(place)), sway_(std::move(sway)), switch_(on) {}

  Rank rank() const override { return Rank::Motion; }
  bool busy() const override { return switch_.on() || PlacedNode::busy(); }
  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f);
  bool resume(Scene& scene) override;

protected:
  void onEnter(Scene& scene) override;
  void onLeave(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;

private:
  static constexpr std::size_t kBlock = 64;  ///< targets that follow each other

  /// A target at rest.
  struct Swing {
    Vec3 place;                ///< [m]
    double along, across, up;  ///< axes of an upright target: uprightAxes()
    double widens;             ///< sphereScale()
  };
  struct Angles {
    Vec3 sin, cos;
  };
  /// The values that all targets share at a time.
  struct Moment {
    Angles first;  ///< angles of target 0, without its phase
    Mat3 turn;
  };

  void putMembers(std::size_t first, std::span<MemberPlace> places) const override;
  void prepareTargets(Scene& scene);
  void findTargets(Scene& scene);
  void prepareTarget(std::size_t k, Scene& scene);
  void preparePhases();
  Moment momentAt(Nanoseconds elapsed) const;
  void putAll(const Moment& m, std::size_t first, std::span<MemberPlace> places) const;
  void put(std::size_t k, const Mat3& turn, const Angles& block, MemberPlace& place) const;
  void restUntil(Nanoseconds time);
  void advanceTo(Nanoseconds time, FrameContext& frame);
  void putTargets(Scene& scene);
  void leaveTargets(Scene& scene);
  void trace(Nanoseconds to, FrameContext& frame);
  void traceOne(std::size_t k, Nanoseconds to, FrameContext& frame) const;
  void jump(Nanoseconds when, FrameContext& frame);

  SwayAttributes sway_;
  SwitchState switch_;
  Nanoseconds elapsed_ = 0;
  Nanoseconds since_ = 0;             ///< show time up to which elapsed_ counts
  std::optional<Nanoseconds> putAt_;  ///< time at which the node last placed its targets

  Moment moment_{};  ///< shared values at `putAt_`

  // By target; found in its first cycle, when all of them are there.
  bool prepared_ = false;
  FleetId fleet_ = kNoFleet;
  std::vector<PlacedNode*> nodes_;  ///< null: has no place
  std::vector<PlacementId> placements_;
  std::vector<Swing> swings_;
  std::vector<Mat3> axes_;  ///< rotation and scale at rest; empty while all stand upright and turn about +Z
  std::vector<Angles> blocks_;  ///< the phase of the first of each kBlock
  std::vector<Angles> steps_;   ///< how far the phase of the others is from that: amplitude x (sin, cos)
};

}  // namespace stadion
