#pragma once
/// Which clips a figure plays, since when, how they fade into each other, and which are added on top.
///
/// A clip's time follows from show time alone: start + speed · (time - since). So for equal commands at equal
/// times the pose is the same to the bit at every frame rate.
///
/// The clips that are played replace each other. An added layer stays until it is taken away, whatever is played
/// below it.
///
/// Units    show time in nanoseconds, clip time in seconds.
/// Threads  one at a time.

#include "engine/base/time_signature.h"
#include "engine/figure/clip_markers.h"
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
    double weight = 1;     ///< of an added layer, from 0 to 1
  };
  /// A clip that has reached its end: in a loop it goes on from its beginning.
  struct End {
    Nanoseconds when = 0;
    bool loops = false;
  };
  /// A marker that a clip has passed.
  struct Passed {
    Nanoseconds when = 0;
    std::size_t marker = 0;  ///< its number in the ClipMarkers
  };
  /// What a clip plays from one time to another. A loop goes on counting: its second pass begins at `length`.
  struct Stretch {
    std::uint32_t clip = 0;
    double length = 0, from = 0, to = 0;  ///< [s]
    bool loop = false;
    double weight = 1;  ///< over those before it, halfway
  };

  void play(const Start& start, Nanoseconds when);
  /// Everything stands still until resume().
  void pause(Nanoseconds when);
  void resume(Nanoseconds when);
  /// Back to rest, without layers.
  void stop();
  /// Adds a layer. If there are too many, the oldest one gives way; one of the same clip fades out. During a
  /// pause it waits for resume().
  void addLayer(const Start& start, Nanoseconds when);
  /// Fades out the layers of a clip; without one, all.
  void removeLayers(std::optional<std::uint32_t> clip, Nanoseconds fade, Nanoseconds when);

  bool paused() const { return pausedAt_ >= 0; }
  /// Returns true if the pose after `time` may differ from that at `time`.
  bool moves(Nanoseconds time) const;
  /// Returns the next end of the newest clip, if it comes up to `until`. Each end is returned once.
  std::optional<End> takeEnd(Nanoseconds until);
  /// Likewise the next marker: of the newest clip, or of a layer that does not fade out. Of what comes at one
  /// time, the markers of a pass come before its end, and before those of layers.
  std::optional<Passed> takeMarker(const ClipMarkers& markers, Nanoseconds until);
  /// Forgets clips that others have replaced by `time`, and layers that are gone.
  void forget(Nanoseconds time);
  /// The next time after `time` at which a clip has replaced those before it; nothing: the newest one has.
  std::optional<Nanoseconds> nextReplaced(Nanoseconds time) const;
  /// What is played below the layers from one time to another, the lowest first. Expects that nothing is
  /// replaced in between.
  std::vector<Stretch> stretches(Nanoseconds from, Nanoseconds to) const;
  /// Show time, or when it was paused.
  Nanoseconds reached(Nanoseconds time) const;
  FigureRecord at(Nanoseconds time) const;
  /// Adds the times in (from, to] at which the motion may bend or jump: keys of the clips, ends of passes and
  /// of fades. Leaves those of a loop out that passes more than 64 times in between.
  void turns(const Skeleton& skeleton, Nanoseconds from, Nanoseconds to,
             std::vector<Nanoseconds>& times) const;
  /// Returns the number of ends up to `time` that takeEnd() has not returned.
  double endsUpTo(Nanoseconds time) const;
  /// Likewise, about, of markers.
  double markersUpTo(const ClipMarkers& markers, Nanoseconds time) const;
  /// Returns true if a restored state can be played with a skeleton of so many clips.
  bool fits(std::size_t clips) const;

  template <class Self, class Fields>
  static void fields(Self& self, Fields& f) {
    f("clips", self.layers_), f("paused", self.pausedAt_), f("layers", self.added_);
  }

private:
  struct Layer {
    std::uint32_t clip = 0;
    double length = 0, start = 0, speed = 1;
    bool loop = true, ended = false;
    Nanoseconds since = 0, fade = 0;
    std::uint64_t passes = 0;  ///< ends that were returned
    std::uint64_t told = 0;    ///< markers that were returned; follows from the time

    template <class Self, class Fields>
    static void fields(Self& l, Fields& f) {
      f("clip", l.clip), f("length", l.length), f("start", l.start), f("speed", l.speed);
      f("loop", l.loop), f("ended", l.ended), f("since", l.since), f("fade", l.fade), f("passes", l.passes);
      f.unhashed("markers", l.told);
    }
  };
  struct Added {
    Layer layer;
    double weight = 1;          ///< when it has faded in
    Nanoseconds outSince = -1;  ///< -1: it stays
    Nanoseconds outFade = 0;

    template <class Self, class Fields>
    static void fields(Self& a, Fields& f) {
      f("layer", a.layer), f("weight", a.weight), f("out since", a.outSince), f("out fade", a.outFade);
    }
    bool goneAt(Nanoseconds time) const { return outSince >= 0 && time >= outSince + outFade; }
    double weightAt(Nanoseconds time) const;
  };

  static Layer layerOf(const Start& start, Nanoseconds when);
  struct Coming {
    Nanoseconds when = 0;
    std::uint64_t pass = 0;
    std::size_t marker = 0;
  };
  static std::optional<Coming> nextMarker(const Layer& layer, const ClipMarkers& markers);
  static double unwrapped(const Layer& layer, Nanoseconds time);
  static void addKeys(const Layer& layer, const Clip& clip, Nanoseconds from, Nanoseconds to,
                      std::vector<Nanoseconds>& times);
  static double timeIn(const Layer& layer, Nanoseconds time);
  static double weightOf(const Layer& layer, Nanoseconds time);
  static std::optional<Nanoseconds> endOf(const Layer& layer);
  static std::optional<Nanoseconds> endOf(const Layer& layer, std::uint64_t pass);
  static std::optional<Nanoseconds> after(const Layer& layer, double way);
  /// The lowest layer that still counts.
  std::size_t firstSeen(Nanoseconds time) const;

  std::vector<Layer> layers_;  ///< the newest last
  std::vector<Added> added_;   ///< likewise
  Nanoseconds pausedAt_ = -1;  ///< -1: it plays
};

}  // namespace stadion
