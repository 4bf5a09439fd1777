#pragma once
/// The bodies of one simulation that are in the visitor's hands: where the hands take them within a frame,
/// and how fast a hand was when it let go.
///
/// A hand is a tracker. While nothing is heard of it, it stands still, and so does what it holds.
///
/// Units    s, m, rad; show times [ns]. Poses in World coordinates.
/// Threads  its node's.

#include "dynamics/motion/hand_motion.h"
#include "dynamics/world/world.h"
#include "engine/maths/pose_track.h"
#include "engine/scene/node.h"

#include <optional>
#include <string>
#include <vector>

namespace stadion {

class StateFields;
class StateHash;
struct FrameContext;

/// A body in a hand.
struct Grip {
  BodyId body = 0;
  NodeRef node;
  std::string tracker;
  Pose X_TN;  ///< how it lies in the hand
  HandMotion hand;
  PoseTrack track;          ///< path of the hand in this frame; empty while the tracker is silent
  Nanoseconds jumped = -1;  ///< when the hand last jumped while it held the body

  template <class Self, class Fields>
  static void fields(Self& g, Fields& f) {  // the way in this frame is over
    f("body", g.body), f("node", g.node), f("tracker", g.tracker), f("X_TN", g.X_TN), f("hand", g.hand);
    f("jumped", g.jumped);
  }
  bool silentBefore(Nanoseconds t) const {
    return track.empty() || (track.front().jump && t <= track.front().time);
  }
};

class Grips {
public:
  explicit Grips(World& world) : world_(world) {}
  bool empty() const { return grips_.empty(); }

  /// Closes the hand, that goes this way, around the body. Null if the body cannot be held.
  const Grip* grab(BodyId body, NodeRef node, const std::string& tracker, PoseTrack way, Nanoseconds when);
  /// Opens the hand and tells how it was. The body stays held in the world until its releaseBody(). Nothing
  /// if no hand has it.
  std::optional<Grip> open(BodyId body);
  /// The body was removed, or put elsewhere.
  void forget(BodyId body);

  /// Reads the paths of the hands in this frame. Adds to `cuts` the times at which they turn, jump or let go.
  void follow(FrameContext& frame, std::vector<Nanoseconds>& cuts);
  /// Moves the bodies of hands that jump at `time` along with them.
  void jump(Nanoseconds time);
  void move(Nanoseconds from, Nanoseconds to, bool jump);

  const std::vector<Grip>& all() const { return grips_; }
  void hash(StateHash& h) const;
  void state(StateFields& f);

private:
  World& world_;
  std::vector<Grip> grips_;
};

}  // namespace stadion
