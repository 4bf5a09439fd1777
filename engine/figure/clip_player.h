#pragma once
/// Which clips a figure plays, since when, and how they fade into each other.
///
/// A clip's time follows from show time alone: start + speed · (time - since). So for equal commands at equal
/// times the pose is the same to the bit at every frame rate.
///
/// Units    show time in nanoseconds, clip time in seconds.
/// Threads  one at a time.

#include "engine/base/time_signature.h"
#include "engine/figure/figure_record.h"
#include "engine/figure/skeleton.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace stadion {

class ClipPlayer {
public:
  struct Start {
    std::uint32_t clip = 0;
    double length = 0;     ///< of the clip [s]
    double at = 0;         ///< clip time to begin at, from 0 to length [s]
    double speed = 1;      ///< seconds of the clip a second; negative: backwards
    bool loop = true;      ///< else it stays in its last pose
    Nanoseconds fade = 0;  ///< how long it takes to replace what was played before [ns]
  };
  /// A clip that has reached its end: in a loop it goes on from its beginning.
  struct End {
    Nanoseconds when = 0;
    bool loops = false;
  };

  void play(const Start& start, Nanoseconds when);
  /// Everything stands still until resume().
  void pause(Nanoseconds when);
  void resume(Nanoseconds when);
  /// Back to rest.
  void stop();

  bool paused() const { return pausedAt_ >= 0; }
  /// Returns true if the pose after `time` may differ from that at `time`.
  bool moves(Nanoseconds time) const;
  /// Returns the next end of the newest clip, if it comes up to `until`. Each end is returned once.
  std::optional<End> takeEnd(Nanoseconds until);
  /// Forgets clips that others have replaced by `time`.
  void forget(Nanoseconds time);
  FigureRecord at(Nanoseconds time) const;
  /// Adds the times in (from, to] at which the motion may bend or jump: keys of the clips, ends of passes and
  /// of fades. Leaves those of a loop out that passes more than 64 times in between.
  void turns(const Skeleton& skeleton, Nanoseconds from, Nanoseconds to,
             std::vector<Nanoseconds>& times) const;
  /// Returns the number of ends up to `time` that takeEnd() has not returned.
  double endsUpTo(Nanoseconds time) const;
  /// Returns true if a restored state can be played with a skeleton of so many clips.
  bool fits(std::size_t clips) const;

  template <class Self, class Fields>
  static void fields(Self& self, Fields& f) {
    f("clips", self.layers_), f("paused", self.pausedAt_);
  }

private:
  struct Layer {
    std::uint32_t clip = 0;
    double length = 0, start = 0, speed = 1;
    bool loop = true, ended = false;
    Nanoseconds since = 0, fade = 0;
    std::uint64_t passes = 0;  ///< ends that were returned

    template <class Self, class Fields>
    static void fields(Self& l, Fields& f) {
      f("clip", l.clip), f("length", l.length), f("start", l.start), f("speed", l.speed);
      f("loop", l.loop), f("ended", l.ended), f("since", l.since), f("fade", l.fade), f("passes", l.passes);
    }
  };

  Nanoseconds reached(Nanoseconds time) const;
  static void addKeys(const Layer& layer, const Clip& clip, Nanoseconds from, Nanoseconds to,
                      std::vector<Nanoseconds>& times);
  static double timeIn(const Layer& layer, Nanoseconds time);
  static double weightOf(const Layer& layer, Nanoseconds time);
  static std::optional<Nanoseconds> endOf(const Layer& layer);
  /// The lowest layer that still counts.
  std::size_t firstSeen(Nanoseconds time) const;

  std::vector<Layer> layers_;  ///< the newest last
  Nanoseconds pausedAt_ = -1;  ///< -1: it plays
};

}  // namespace stadion
