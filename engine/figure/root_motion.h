#pragma once
/// Moves a figure's node as its clips move a root bone: along the ground and in heading. Height and tilt stay with
/// the bone, so that the node stays upright on the ground. Game engines do the same (Unity: Root Transform
/// Position XZ and Rotation; Unreal: root lock at the reference pose).
///
/// A clip's way goes on from pass to pass. In a cross-fade the node moves by the blended steps of the clips, 10 ms
/// each, so it neither jumps nor returns to what an older clip would have reached.
///
/// Bits     the place at a show time follows from the commands and their times alone: the way of n passes is a
///          power, and the steps of a cross-fade are on a grid that begins with it. So it is equal at every
///          frame rate.
/// Frames   P: the node's parent; N: the node's mesh.
/// Threads  one at a time.

#include "engine/figure/clip_player.h"
#include "engine/figure/ground_move.h"
#include "engine/figure/skeleton.h"

#include <vector>

namespace stadion {

/// Where the clips of a skeleton take a bone on the ground.
class RootPath {
public:
  /// Expects that the bone is there. Copies what it needs.
  RootPath(const Skeleton& skeleton, std::uint32_t bone);

  std::uint32_t bone() const { return bone_; }
  /// How far a clip takes the bone in a stretch; 0 at rest.
  GroundMove way(const ClipPlayer::Stretch& stretch) const;

private:
  GroundMove at(std::size_t clip, double time) const;
  GroundMove sinceBegin(const ClipPlayer::Stretch& stretch, double time) const;

  std::uint32_t bone_;
  std::vector<Bone> chain_;               ///< from the uppermost to the bone
  std::vector<Clip> clips_;               ///< what of each moves the chain; channels name its bones
  std::vector<std::vector<char>> moved_;  ///< by clip and bone of the chain
  Affine atRest_ = Affine::Identity();
  std::vector<GroundMove> begin_, pass_;  ///< by clip: at its beginning; from there to its end
};

class RootMotion {
public:
  /// From now on it goes on from here.
  void begin(const Pose& X_PN, Nanoseconds when);
  /// X_PN at a time that is not before begin(). `scale`: of the node's axes.
  Pose at(Nanoseconds time, const ClipPlayer& player, const RootPath& path, const Vec3& scale) const;
  /// The same, and begins there: call it before a command changes what is played.
  void settle(Nanoseconds time, const ClipPlayer& player, const RootPath& path, const Vec3& scale);
  /// Begins where a clip has last replaced those before it: call it before ClipPlayer::forget().
  void forget(Nanoseconds time, const ClipPlayer& player, const RootPath& path, const Vec3& scale);
  /// Returns true if a restored state can be played from `time` on.
  bool fits(Nanoseconds time) const { return X_PN_.finite() && since_ >= 0 && since_ <= time; }

  template <class Self, class Fields>
  static void fields(Self& self, Fields& f) {
    f("root", self.X_PN_), f("root since", self.since_);
  }

private:
  /// The last whole step of a cross-fade that was reached, so that no step is made twice.
  struct Reached {
    Nanoseconds from = -1, time = -1;
    GroundMove way{};
  };
  GroundMove fadedWay(Nanoseconds from, Nanoseconds end, Nanoseconds to, const ClipPlayer& player,
                      const RootPath& path) const;
  static Pose moved(const Pose& X_PN, const GroundMove& way, const Vec3& scale);

  Pose X_PN_;
  Nanoseconds since_ = 0;
  mutable Reached reached_;
};

}  // namespace stadion
