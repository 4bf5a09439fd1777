#pragma once
/// The pose tracks of placements within this frame, where more is known than their two ends: placements that
/// follow a tracker or a path, or that a command moved at an exact time.
///
/// Frames   World. Every pose track begins at the frame's start.
/// Threads  App only.
/// Errors   none.

#include "engine/maths/pose_track.h"
#include "engine/scene/placements.h"

#include <cstdint>
#include <deque>
#include <vector>

namespace stadion {

class PoseTracks {
public:
  void clear();
  /// The placement's pose track in this frame; a new one begins with `first`. The reference is valid until
  /// clear().
  PoseTrack& of(PlacementId id, const PoseKnot& first);
  /// The pose track of the placement from `start`, where it was at `before`, to `end`: its own or that of the
  /// nearest above it, on which its place changes evenly; else straight. Empty if it stays. Curves stay curves.
  PoseTrack within(PlacementId id, const Pose& before, Nanoseconds start, Nanoseconds end,
                   const Placements& placements) const;

  /// The pose at a time of this frame, or at its start, if nothing moved on what carries the placement.
  Pose at(PlacementId id, Nanoseconds time, const Placements& placements) const;
  Pose startOf(PlacementId id, const Placements& placements) const;
  /// Returns true if what carries the placement turns or goes along a curve in this frame.
  bool bends(PlacementId id, const Placements& placements) const;
  /// Adds the times of the knots of what carries the placement.
  void addKnots(PlacementId id, const Placements& placements, std::vector<Nanoseconds>& times) const;
  /// Returns true if what carries the placement jumps after `from`, up to `to`.
  bool jumps(PlacementId id, Nanoseconds from, Nanoseconds to, const Placements& placements) const;

private:
  struct Known {
    PlacementId id = kNoPlacement;
    PoseTrack track;
  };
  const Known* above(PlacementId id, const Placements& placements) const;

  std::deque<Known> pool_;  ///< pool of tracks; their memory is used again from frame to frame
  std::uint32_t used_ = 0;
  std::vector<std::uint32_t> at_;  ///< by placement: which of the pool, from 1; 0 = none
};

}  // namespace stadion
