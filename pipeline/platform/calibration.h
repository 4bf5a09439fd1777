#pragma once
/// Results of `stadion calibrate`: how fast walls are drawn with each setting, on each machine.
///
/// The file keeps figures, not decisions. A run that can only use threads, or asks for pinning, takes the
/// best remaining setting.
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

/// The settings that were tried for a number of walls.
struct MeasuredRoom {
  std::size_t walls = 0;
  std::uint32_t width = 0, height = 0;  ///< size of one eye's picture [pixels]
  std::string look;                     ///< full or plain
  std::vector<MeasuredSetting> settings;
};

struct MachineCalibration {
  Machine machine;
  std::string when;  ///< "2026-11-23 05:01 UTC"
  std::vector<MeasuredRoom> rooms;
};

/// The figures of a calibration file. It may hold several machines: those that share a home folder.
struct Calibration {
  std::vector<MachineCalibration> machines;

  /// Returns null if this machine has not been measured.
  const MachineCalibration* of(const Machine& machine) const;
  /// Adds its rooms. Each replaces the known room with the same number of walls and the same look.
  void add(MachineCalibration measured);
};

/// Settings that differ by less than this part of the fastest are equally fast.
constexpr double kAlike = 0.03;

/// Returns the fastest setting that meets the wishes. Of equally fast ones it takes the one with the least
/// processor time. Null if none meets them.
const MeasuredSetting* best(const MeasuredRoom& room, const DrawWishes& wishes = {});

/// Returns the room with the figures for this number of walls: of the same look if there is one, then the
/// nearest number. Figures for one wall do not apply to several, nor the reverse. Null if there is none.
const MeasuredRoom* roomFor(const MachineCalibration& machine, std::size_t walls, const std::string& look);

/// Returns the settings to try for this number of walls and processors, none of them pinned: threads and
/// processes, with none to one rasteriser thread per processor; the most promising ones first.
std::vector<DrawSetting> settingsToTry(std::uint32_t processors, std::size_t walls);

}  // namespace stadion
