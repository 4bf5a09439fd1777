#pragma once
/// `path`: moves its target, or what stands below it, along key frames.
///
/// Positions run along straight lines or, with smooth=on, along a cubic through the keys (Catmull-Rom, with
/// the keys' own times); orientations turn with constant angular velocity from key to key.
///
/// Events    finished, at the last key's exact time; a looping path tells it at the end of each pass.
/// Commands  enable (goes on where it stopped; after its end, from the first key again), disable (the target
///           stays where it is at the command's time), toggle, reset (back to the first key), and those of a
///           placed node when it moves what stands below it.
/// Times     nodes that watch the target get its motion inside the frame: straight motion exactly, bends and
///           turns as curves of 2 ms on a grid of show time (pose_track.h).
/// Degraded  while it rests, its time stands still. If it runs in one of several frames, its target is then
///           where its own time has it. Watching nodes see it go straight there within that frame.
/// Frames    keys are in the coordinates of the target's parent, or of its own parent.

#include "engine/nodes/switch_state.h"
#include "engine/scene/placed_node.h"

#include <optional>

namespace stadion {

extern const NodeType kPathType;

struct Keyframe {
  double time = 0;  ///< from the path's start [s]
  Pose X_PN;
};

class PathNode : public PlacedNode {
public:
  /// Expects at least one key, times strictly increasing from >= 0; a looping path should last a millisecond.
  PathNode(NodeRef self, std::string name, PlaceAttributes place, NodeRef target, std::vector<Keyframe> keys,
           bool loop, bool smooth, bool on)
      : PlacedNode(kPathType, self, std::move(name), std::move(place)), target_(target),
        keys_(std::move(keys)), loop_(loop && length() > 0), smooth_(smooth), bends_(bends()), switch_(on) {}

  Rank rank() const override { return Rank::Motion; }
  bool busy() const override { return switch_.on() || PlacedNode::busy(); }
  void hash(StateHash& h) const override;
  void state(StateFields& f) override;
  bool resume(Scene& scene) override;
  template <class Self, class Fields>
  static void fields(Self& self, Fields& f);

  /// The pose `seconds` after the path's start.
  Pose poseAt(double seconds) const;

protected:
  void onEnter(Scene& scene) override;
  void receive(const Message& m, FrameContext& frame) override;
  void simulate(FrameContext& frame) override;

private:
  Nanoseconds length() const { return fromSeconds(keys_.back().time); }
  /// Skips passes up to `time`: they do not count.
  void restUntil(Nanoseconds time);
  /// Advances to `time`: posts the events of passes that end until then, and of the end of the path.
  void advanceTo(Nanoseconds time, FrameContext& frame);
  void putTarget(Scene& scene);
  bool bends() const;
  PlacedNode* target(Scene& scene);
  void trace(Nanoseconds to, FrameContext& frame);
  void jump(Nanoseconds when, FrameContext& frame);

  NodeRef target_;  ///< invalid = itself
  std::vector<Keyframe> keys_;
  bool loop_, smooth_, bends_;
  SwitchState switch_;
  Nanoseconds elapsed_ = 0;
  Nanoseconds since_ = 0;             ///< show time up to which elapsed_ counts
  std::optional<Nanoseconds> putAt_;  ///< time at which the node last placed its target
  std::vector<Nanoseconds> passed_;   ///< trace()'s own: where its way turns, since since_
};

}  // namespace stadion
