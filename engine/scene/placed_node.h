#pragma once
/// A node that has a place in the world: below its parent, or following a tracker.
///
/// Commands  attach all|position|orientation [tracker], detach, show, hide, reset.
/// Frames    X_PN maps Node to Parent. An attached node follows tracker x rig without offset, and keeps its
///           scale. If it takes only position or orientation from the tracker, its parent gives the other. A
///           detached node goes along with its parent again, from where the two were at that time.
/// Times     attach, detach and reset take effect at their exact time: within the frame for dynamics (by the
///           pose track that the node leaves in the scene), at the frame's end for the picture.
/// Threads   App only: no other thread changes the pose of a node. Dynamics nodes call hold() after their
///           worlds have computed.
/// Errors    place() and hold() return false and keep the old pose if X_WN is not finite.

#include "engine/core/state_fields.h"
#include "engine/maths/pose_track.h"
#include "engine/scene/node.h"
#include "engine/scene/placements.h"

namespace stadion {

/// How a placement is written in a script.
struct PlaceAttributes {
  NodeRef parent;                    ///< invalid = World, or in a sub-scene its scene node
  Affine X_PN = Affine::Identity();  ///< where the script puts it, and where reset brings it back to
  bool shown = true;
};

class PlacedNode : public Node {
public:
  PlacedNode(const NodeType& type, NodeRef self, std::string name, PlaceAttributes place)
      : Node(type, self, std::move(name)), attributes_(std::move(place)) {}

  PlacedNode* placed() final { return this; }
  PlacementId placement() const { return placement_; }
  const PlaceAttributes& attributes() const { return attributes_; }
  /// Moves to X_WN, which reset brings it back to from now on.
  void becomeHome(Scene& scene, const Affine& X_WN);
  /// Places the node below its parent, so that it is at X_WN now.
  bool place(Scene& scene, const Affine& X_WN);
  /// Places the node in World. Its parent does not carry it from now on.
  bool hold(Scene& scene, const Affine& X_WN, Held part = Held::All);
  /// From now on another node moves the placement, as part of a fleet. Until stay(), the pose belongs to that
  /// node's state.
  void letMove(Scene& scene);
  /// The node stays where its placement is, and that pose is its own state again.
  void stay(Scene& scene);
  /// The node was detached in this frame, when its parent was at X_WP. Its parent carries it from now on.
  void rejoin(Scene& scene, const Affine& X_WP);
  bool attached() const { return follow_ != Held::Nothing; }
  bool follows(std::string_view tracker) const { return attached() && tracker_ == tracker; }
  /// Returns true if a tracker or a dynamics node moves it; then no path does.
  virtual bool moved() const { return attached(); }
  /// Static objects are below this node. They must become nodes before it may move.
  void carryStatics() { carriesStatics_ = true; }

  Rank rank() const override { return Rank::Attachment; }
  bool busy() const override { return attached(); }
  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  template <class Self, class Fields>
  static void fields(Self& whole, Fields& f) {
    auto& self = partOf<PlacedNode>(whole);
    f("place", self.X_PN_), f("follows", self.follow_), f("tracker", self.tracker_), f("shown", self.shown_);
    f.kept("placement", self.placement_), f.kept("home", self.attributes_.X_PN);
    f.kept("traced", self.traced_), f.kept("arrived", self.arrived_);
    f.kept("carries", self.carriesStatics_);
  }

protected:
  /// Most passes of a loop that a restored node makes up for, one by one.
  static constexpr Nanoseconds kMostPasses = 100'000;
  void onEnter(Scene& scene) override;
  void onLeave(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;
  /// Back to how the script placed it.
  void resetPlace(Scene& scene);

private:
  void aboutToChange(Scene& scene);
  void setFollowing(Held part, Scene& scene);
  void follow(const Message& m, FrameContext& frame);
  void stopFollowing(Nanoseconds when, FrameContext& frame);
  void resetAt(Nanoseconds when, FrameContext& frame);
  PoseTrack& poseTrack(FrameContext& frame) const;
  Pose following(const Pose& X_WT, const Pose& own) const;
  Affine placedAt(const Pose& X_WN, const Scene& scene) const;
  bool trace(Nanoseconds to, FrameContext& frame);

  PlaceAttributes attributes_;
  PlacementId placement_ = kNoPlacement;
  Held follow_ = Held::Nothing;
  std::string tracker_;
  Nanoseconds traced_ = 0;  ///< show time up to which the path along the tracker is known
  bool arrived_ = false;    ///< the node has reached the tracker
  bool shown_ = true;
  bool carriesStatics_ = false;
  /// Where it was last put, in World if it is held. The state hash needs this beside the placement, because
  /// the placement of a fleet's member follows the state of another node.
  Affine X_PN_ = Affine::Identity();
};

}  // namespace stadion
