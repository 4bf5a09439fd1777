#pragma once
/// A node that has a place in the world: below its parent, or following a tracker.
///
/// Commands  attach all|position|orientation [tracker], detach, show, hide, reset.
/// Frames    X_PN maps Node to Parent. An attached node follows tracker x rig without offset, and keeps its
///           scale. If it takes only position or orientation from the tracker, its parent gives the other. A
///           detached node goes along with its parent again, from where the two were at that time.
/// Times     attach, detach and reset take effect at their exact time: within the frame for dynamics (by the
///           pose track that the node leaves in the scene), at the frame's end for the picture.
/// Threads   App only: no other thread changes the pose of a node while the show plays. The thread that opens a scene
///           sets the first ones. Dynamics nodes call hold() when a body
///           joins, at a reset, and after their worlds have computed.
/// Errors    place() and hold() return false and keep the old pose if X_WN is not finite.

#include "engine/core/state_fields.h"
#include "engine/maths/pose_track.h"
#include "engine/scene/node.h"
#include "engine/scene/placements.h"

namespace stadion {

/// The attributes of a node's place in a script.
struct PlaceAttributes {
  NodeRef parent;                    ///< invalid = World, or in a sub-scene its scene node
  Affine X_PN = Affine::Identity();  ///< pose at the start and after reset
  bool shown = true;
};

class PlacedNode : public Node {
public:
  PlacedNode(const NodeType& type, NodeRef self, std::string name, PlaceAttributes place)
      : Node(type, self, std::move(name)), attributes_(std::move(place)) {}

  PlacedNode* placed() final { return this; }
  PlacementId placement() const { return placement_; }
  const PlaceAttributes& attributes() const { return attributes_; }
  /// Moves the node to X_WN. From now on, reset brings it back there.
  void setHome(Scene& scene, const Affine& X_WN);
  /// Places the node below its parent, so that it is at X_WN now.
  bool place(Scene& scene, const Affine& X_WN);
  /// Places the node in World. Its parent does not carry it from now on.
  bool hold(Scene& scene, const Affine& X_WN, HeldParts parts = HeldParts::All);
  /// Makes nodes of the static objects below this node, so that it can move. A node that moves the placement
  /// as part of a fleet calls it first. Until leaveFleet(), the pose belongs to the state of that node.
  void makeMovable(Scene& scene);
  /// Leaves the fleet: the node keeps its pose, which belongs to its own state again.
  void leaveFleet(Scene& scene);
  /// Lets the parent carry the node again. The node was detached in this frame, when the parent was at X_WP.
  void rejoin(Scene& scene, const Affine& X_WP);
  bool attached() const { return follow_ != HeldParts::Nothing; }
  bool follows(std::string_view tracker) const { return attached() && tracker_ == tracker; }
  /// Returns true if a tracker or a dynamics node moves the node. Then no path or fleet does.
  virtual bool isMovedFromOutside() const { return attached(); }
  /// Notes that static objects are below this node. They must become nodes before it may move.
  void carryStatics() { carriesStatics_ = true; }

  Rank rank() const override { return Rank::Attachment; }
  bool busy() const override { return attached(); }
  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  template <class Self, class Fields>
  static void fields(Self& whole, Fields& f) {
    auto& self = partOf<PlacedNode>(whole);
    f("place", self.X_PN_), f("follows", self.follow_), f("tracker", self.tracker_), f("shown", self.shown_);
    f.unhashed("placement", self.placement_), f.unhashed("home", self.attributes_.X_PN);
    f.unhashed("traced", self.traced_), f.unhashed("arrived", self.arrived_);
    f.unhashed("carries", self.carriesStatics_);
  }

protected:
  /// Most passes of a loop that a restored node makes up for, one by one.
  static constexpr std::int64_t kMostPasses = 100'000;
  void onEnter(Scene& scene) override;
  void onLeave(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;
  /// Returns the node to its pose in the script.
  void resetPlace(Scene& scene);
  /// Places the node at X_PN below its parent. Returns false, and keeps the old pose, if X_PN is not finite.
  bool placeInParent(Scene& scene, const Affine& X_PN);

private:
  void aboutToChange(Scene& scene);
  void setFollowing(HeldParts parts, Scene& scene);
  void follow(const Message& m, FrameContext& frame);
  void stopFollowing(Nanoseconds when, FrameContext& frame);
  void resetAt(Nanoseconds when, FrameContext& frame);
  PoseTrack& poseTrack(FrameContext& frame) const;
  Pose following(const Pose& X_WT, const Pose& own) const;
  Affine placedAt(const Pose& X_WN, const Scene& scene) const;
  bool trace(Nanoseconds to, FrameContext& frame);

  PlaceAttributes attributes_;
  PlacementId placement_ = kNoPlacement;
  HeldParts follow_ = HeldParts::Nothing;
  std::string tracker_;
  Nanoseconds traced_ = 0;  ///< show time up to which the path along the tracker is known
  bool arrived_ = false;    ///< the node has reached the tracker
  bool shown_ = true;
  bool carriesStatics_ = false;
  /// Last pose that was set, in World if the node is held. The state hash needs it beside the placement,
  /// because the placement of a fleet's member follows the state of another node.
  Affine X_PN_ = Affine::Identity();
};

}  // namespace stadion
