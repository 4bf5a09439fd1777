#pragma once
/// The rig, the visitor's head and the trackers, as nodes see them.
///
/// Frames     input samples are in rig coordinates; the feed converts them to World.
/// Units      metres, nanoseconds.
/// Ownership  borrows its collaborators; rig nodes belong to the tree.
/// Threads    App only.
/// Errors     a tracker that is not valid has no pose: the result is empty. The head then stands upright at
///            its standard height.

#include "engine/input/input_sample.h"
#include "engine/scene/node.h"
#include "engine/scene/placements.h"
#include "engine/scene/pose_tracks.h"
#include "engine/scene/scene_time.h"

#include <string>
#include <vector>

namespace stadion {

class InputFeed {
public:
  InputFeed(const Placements& placements, const PoseTracks& tracks, const SceneTime& time)
      : placements_(placements), poseTracks_(tracks), time_(time) {}

  // For nodes.

  /// Uses this rig node until it is dropped. `eyeHeight` is that of a head without tracker [m].
  void addRig(NodeRef rig, PlacementId placement, double eyeHeight) {
    rigs_.push_back({rig, placement, eyeHeight});
  }
  void dropRig(NodeRef rig) {
    std::erase_if(rigs_, [&](const Rig& r) { return r.node == rig; });
  }
  Pose rigPose() const;  ///< X_WR
  /// X_RH, or the standing pose if the head has no valid tracker.
  Pose headInRig(const InputSample& input) const;
  /// The sample of the frame before.
  const InputSample& lastInput() const { return lastInput_; }
  /// The pose track of the tracker in World, from its first known pose in this frame to the frame's end. Null
  /// if the tracker is not valid at the end. If it was known before, its track begins at the frame's start.
  /// Valid until the next call.
  const PoseTrack* poseTrackOf(const std::string& tracker, const FrameContext& frame);

  // For the scene.

  /// The rig node in use; invalid: none.
  NodeRef rig() const { return rigs_.empty() ? NodeRef{} : rigs_.back().node; }
  /// Moves the rig of a show without a rig node.
  void moveFreeRig(const Pose& X_WR) {
    if (X_WR.finite()) freeRig_ = X_WR;
  }
  const Pose& freeRig() const { return freeRig_; }
  void beginFrame() { rigStart_ = rigPose(); }
  void endFrame(const InputSample& input) { lastInput_ = input; }

  void stateOfRigs(StateFields& f);
  void stateOfInput(StateFields& f);
  bool consistent() const;

private:
  struct Rig {
    NodeRef node;
    PlacementId placement = kNoPlacement;
    double eyeHeight = 0;

    template <class Self, class Fields>
    static void fields(Self& r, Fields& f) {
      f("node", r.node), f("placement", r.placement), f("eye height", r.eyeHeight);
    }
  };

  void toWorld(PoseTrack& track, Nanoseconds start, Nanoseconds end);

  const Placements& placements_;
  const PoseTracks& poseTracks_;
  const SceneTime& time_;
  std::vector<Rig> rigs_;  ///< the last one is in use
  Pose freeRig_;           ///< X_WR of a show without a rig node
  Pose rigStart_;          ///< X_WR at this frame's start
  InputSample lastInput_;
  PoseTrack tracker_;            ///< poseTrackOf()'s answer
  PoseTrack rigTrack_, ridden_;  ///< toWorld()'s own
};

}  // namespace stadion
