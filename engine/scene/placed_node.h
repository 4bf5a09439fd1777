#pragma once
/// A node that has a place in the world: under its parent, or following a tracker.
///
/// Commands  attach all|position|orientation [tracker], detach, show, hide, reset.
/// Frames    X_PN maps Node to Parent. Attached, the node follows tracker x rig with no offset and keeps its
///          scale; what it does not take over from the tracker still comes from its parent. Detached, it goes
///          along with its parent again, from where the two were at that time.
/// Times    attach, detach and reset put it elsewhere at their exact time: inside the frame for dynamics (the
///          course that it leaves in the scene), at the frame's end for the picture.

#include "engine/core/state_fields.h"
#include "engine/maths/course.h"
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
  /// Makes X_WN the place that reset brings it back to, and goes there.
  void becomeHome(Scene& scene, const Affine& X_WN);
  /// Places the node below its parent, so that it is at X_WN now. False if X_WN is not finite.
  bool place(Scene& scene, const Affine& X_WN);
  /// Places the node in World by a direct call (dynamics nodes), whatever its parent does from now on.
  bool hold(Scene& scene, const Affine& X_WN, Held part = Held::All);
  /// Another node moves its placement from now on, frame by frame, without telling it: it is no part of its
  /// state where that is.
  void letMove(Scene& scene);
  /// It stays where its placement is: that is its own state again.
  void stay(Scene& scene);
  /// It has been detached in this frame, when its parent was at X_WP: goes along with it from now on.
  void rejoin(Scene& scene, const Affine& X_WP);
  bool attached() const { return follow_ != Held::Nothing; }
  bool follows(std::string_view tracker) const { return attached() && tracker_ == tracker; }
  /// Whether a tracker or the dynamics moves it: then no path does.
  virtual bool moved() const { return attached(); }
  /// Static objects stand below this node: they must become nodes before it may move.
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
  /// Passes that a node which has been put back may have missed: each is told.
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
  Course& course(FrameContext& frame) const;
  Pose following(const Pose& X_WT, const Pose& own) const;
  Affine placedAt(const Pose& X_WN, const Scene& scene) const;
  bool trace(Nanoseconds to, FrameContext& frame);

  PlaceAttributes attributes_;
  PlacementId placement_ = kNoPlacement;
  Held follow_ = Held::Nothing;
  std::string tracker_;
  Nanoseconds traced_ = 0;  ///< up to here its way along the tracker is known
  bool arrived_ = false;    ///< it has been put where the tracker is
  bool shown_ = true;
  bool carriesStatics_ = false;
  Affine X_PN_ = Affine::Identity();  ///< for the hash: where it was last put, in World if it is held there
};

}  // namespace stadion
