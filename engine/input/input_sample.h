#pragma once
/// The state of the visitor's devices at one moment.
///
/// Frames   R is the rig; T is a tracked device. X_RT places the device in the rig. The axes of a head or
///          wand: +X to its right, +Y the way it points, +Z up.
/// Units    metres, show time in nanoseconds, axes from -1 to 1.
/// Threads  plain values, any thread.

#include "engine/base/time_signature.h"
#include "engine/maths/pose_track.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

constexpr std::size_t kTrackerAxes = 8;

/// The state of a device's buttons and axes from a time on.
struct ControlKnot {
  Nanoseconds time = 0;  ///< show time [ns]
  std::uint32_t buttons = 0;
  std::array<float, kTrackerAxes> axes{};

  bool operator==(const ControlKnot&) const = default;
  template <class Self, class Fields>
  static void fields(Self& k, Fields& f) {
    f("time", k.time), f("buttons", k.buttons), f("axes", k.axes);
  }
};

struct TrackerSample {
  std::string name;                        ///< name, such as head, wand, foot; unique in a sample
  Pose X_RT;                               ///< while not valid: the last one known
  std::uint32_t buttons = 0;               ///< buttons, one bit each
  std::array<float, kTrackerAxes> axes{};  ///< joypad and triggers
  Nanoseconds stamp = 0;                   ///< time of its newest measurement [ns]
  bool valid = true;                       ///< false: its pose is not known at the moment
  /// The device sends buttons and axes and has never sent a pose: they count, although it is not valid.
  bool controlsOnly = false;
  /// The corners of its way since the frame before, X_RT at times inside the frame (a jump may be at its very
  /// end); without any it came straight.
  PoseTrack knots;
  /// Changes of buttons and axes within the frame, and their state at its start. Buttons are constant until
  /// the next knot. Axes change evenly to the next knot, and from the last one to `axes` at the frame's end.
  /// Two knots of the same time are a jump of the axes. Empty if the device does not know the times: then
  /// buttons were pressed at the frame's end, and axes were constant.
  std::vector<ControlKnot> controls;
  /// Time of its newest measurement, by the clock of the playing machine [ns]; 0: unknown, as in a replay. It
  /// gives the age of a picture. The show does not depend on it, and comparisons of samples ignore it.
  Nanoseconds measured = 0;

  /// Returns true if its buttons and axes count.
  bool hasControls() const { return valid || controlsOnly; }

  template <class Self, class Fields>
  static void fields(Self& t, Fields& f) {
    f("name", t.name), f("pose", t.X_RT), f("buttons", t.buttons), f("axes", t.axes);
    f("stamp", t.stamp), f("valid", t.valid), f("controls only", t.controlsOnly);
    f("knots", t.knots), f("controls", t.controls);
  }
  bool operator==(const TrackerSample& o) const {
    return name == o.name && X_RT.p == o.X_RT.p && X_RT.q.coeffs() == o.X_RT.q.coeffs() &&
           buttons == o.buttons && axes == o.axes && stamp == o.stamp && valid == o.valid &&
           controlsOnly == o.controlsOnly && knots == o.knots && controls == o.controls;
  }
};

struct InputSample {
  Nanoseconds time = 0;  ///< show time it holds for [ns]
  std::vector<TrackerSample> trackers;

  template <class Self, class Fields>
  static void fields(Self& s, Fields& f) {
    f("time", s.time), f("trackers", s.trackers);
  }
  /// The tracker of that name, or nullptr.
  const TrackerSample* find(std::string_view name) const {
    for (const TrackerSample& t : trackers)
      if (t.name == name) return &t;
    return nullptr;
  }
};

constexpr double kTeleportSpeed = 60;  ///< faster than any hand, foot or bat [m/s]

/// Returns true if a tracker that went from `previous` to `next` in `dt` cannot have moved there: it was lost
/// and found, or another one took its name. What follows it must be put there without impulse.
inline bool teleported(const Pose& previous, const Pose& next, Nanoseconds dt) {
  const double distance = (next.p - previous.p).norm();
  if (!(dt > 0)) return distance > 0;
  return !(distance <= kTeleportSpeed * toSeconds(dt));
}

}  // namespace stadion
