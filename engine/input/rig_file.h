#pragma once
/// How a room's trackers are placed, named and smoothed, as text: the rig file.
///
///     stadion-rig 1
///     # the ceiling cameras of hall 2
///     unit m
///     up z
///     origin 0.12 -0.4 0.015       # the middle of the floor, in the cameras' coordinates
///     yaw 91.5                     # where the visitor's forward is in them, degrees about up
///     filter 4 30
///     tracker head  offset 0 0.02 -0.09  turn 0 -12 0  safe 0 0 1.7
///     tracker wand
///
/// The first line names the format and its version, then one statement a line:
///     unit m|cm|mm|in|ft     of the lengths that trackers send (the file's own are metres)
///     up z|y                 which of their axes points up (y: +X right, -Z forward)
///     origin X Y Z, yaw D    where the rig is in tracker coordinates, after unit and up
///     filter HZ BETA         a one-euro filter (one_euro_filter.h); 0 0 leaves poses as they come
///     hold SECONDS           how long a silent tracker stays where it was
///     ease SECONDS           how long it then takes to its safe pose, and back when it is heard of again
///     predict SECONDS        how far at most a pose is carried on beyond its last measurement
///     tracker NAME [offset X Y Z] [turn ROLL PITCH YAW] [safe X Y Z] [sent-as DEVICE]
///         a device. offset and turn: where the eyes (of a head) or the tip (of a wand) are in the sensor's
///         coordinates; safe: where it is, looking forward, while it sends nothing. Without `safe` it is
///         lost then. sent-as: how DTrack or FreeD calls it. A file without trackers has a head (safe 0 0 1.7) and a
///         wand.
///
/// Frames   S is the tracking system, R the rig, D the sensor on a device, T the device as the show knows it.
/// Units    metres, radians, seconds.
/// Threads  plain values.
/// Errors   with line and column; a file with errors is not returned.

#include "engine/base/diagnostic.h"
#include "engine/maths/maths.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

struct RigTracker {
  std::string name;
  Pose X_DT;  ///< from the sensor to what it stands for
  std::optional<Vec3> safe{};
  std::string sentAs{};  ///< how DTrack or FreeD calls it, such as body0; empty: like itself
};

struct RigFile {
  static constexpr std::size_t kMostTrackers = 16;

  double unit = 1;  ///< unit of measured lengths [m]
  bool upIsY = false;
  Vec3 origin = Vec3::Zero();                     ///< p_SR [m]
  double yaw = 0;                                 ///< rotation of the rig in S, about up [rad]
  double cutoff = 4, beta = 30;                   ///< filter [Hz], [1/m] and [1/rad]
  double hold = 0.1, ease = 0.5, predict = 0.02;  ///< [s]
  std::vector<RigTracker> trackers;

  /// Where the device is, of a measurement as it was sent.
  Pose inRig(const Pose& X_SD, const RigTracker& tracker) const;
  /// Where the sensor itself is in the rig.
  Pose sensorInRig(const Pose& X_SD) const;
  /// A measurement in metres with +Z up, still in the tracking system's own place.
  Pose levelled(const Pose& X_SD) const;
  const RigTracker* find(std::string_view name) const;
};

/// Returns the rig without a rig file: head and wand, at the rig's own origin.
RigFile standardRig();

std::optional<RigFile> parseRigFile(std::string_view text, const std::string& file, Diagnostics& out);
std::optional<RigFile> loadRigFile(const std::string& path, Diagnostics& out);
/// Text that parseRigFile reads back to the same values up to the rounding of angles.
std::string formatRigFile(const RigFile& rig);

}  // namespace stadion
