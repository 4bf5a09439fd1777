#pragma once
/// What `stadion calibrate` found out: how fast walls are drawn with which setting, on which machine.
///
/// Figures are kept, not decisions: who can only use threads, or asks for pinning, takes the best of what is
/// left.
///
/// Units    frames a second, processor milliseconds.
/// Threads  plain values.

#include "pipeline/platform/draw_setting.h"
#include "pipeline/platform/machine.h"

#include <string>
#include <vector>

namespace stadion {

struct MeasuredSetting {
  DrawSetting setting;
  double framesPerSecond = 0;  ///< the median of its rounds
  double cpuMs = 0;            ///< a frame, of all processes; the median
  std::uint32_t rounds = 0;
};

/// The settings that were tried for so many walls.
struct MeasuredRoom {
  std::size_t walls = 0;
  std::uint32_t width = 0, height = 0;  ///< of one eye's picture [pixels]
  std::string look;                     ///< full or plain
  std::vector<MeasuredSetting> settings;
};

struct MachineCalibration {
  Machine machine;
  std::string when;  ///< "2026-11-23 05:01 UTC"
  std::vector<MeasuredRoom> rooms;
};

/// One file may know several machines: those that share a home folder.
struct Calibration {
  std::vector<MachineCalibration> machines;

  /// Null if this machine has not been measured.
  const MachineCalibration* of(const Machine& machine) const;
  /// Its rooms of as many walls and that look take the place of what was known of them.
  void add(MachineCalibration measured);
};

/// Settings that differ by less than this part of the fastest are equally fast.
constexpr double kAlike = 0.03;

/// The fastest setting that has what is wished for; of those that are equally fast the one that takes the
/// least processor time. Null if none has.
const MeasuredSetting* best(const MeasuredRoom& room, const DrawWishes& wishes = {});

/// Which room's figures hold for so many walls: of the same look if there is one, then the nearest number.
/// What holds for one wall says nothing about several, nor the other way round. Null if there is none.
const MeasuredRoom* roomFor(const MachineCalibration& machine, std::size_t walls, const std::string& look);

/// The settings that are worth trying for so many walls on so many processors, none of them pinned: threads
/// and processes, with rasteriser threads from none to one for each processor; the likeliest ones first.
std::vector<DrawSetting> settingsToTry(std::uint32_t processors, std::size_t walls);

}  // namespace stadion
