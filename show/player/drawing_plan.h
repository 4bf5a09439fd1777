#pragma once
/// How a run draws its walls on processors, and why.
///
/// OpenGL  as the settings say, else as `stadion calibrate` found to be fastest on this machine, else by a
///         rule (unmeasuredSetting).
/// CPU     one pool of threads draws all walls of this process; processes only if they are asked for. The
///         calibration measures OpenGL, so it decides nothing here.
///
/// Threads  to be settled before the first OpenGL context is made.

#include "pipeline/platform/calibration.h"
#include "pipeline/shader/look.h"

#include <optional>
#include <string>

namespace stadion {

class Diagnostics;

/// The known properties of this machine.
struct KnownMachine {
  std::uint32_t processors = 1;
  std::optional<MachineCalibration> measured{};  ///< nothing: it has not been calibrated
};

/// Reads the calibration. A file that is damaged, or about other machines, causes a warning and counts
/// for nothing.
KnownMachine knownMachine(Diagnostics& findings);

struct DrawingNeeds {
  DrawWishes wishes{};
  std::string here{};  ///< why this program must draw itself; empty: others may
  std::size_t walls = 1;
  Look look = Look::Full;
  /// Threads of the CPU renderer, on all processors that may draw; 0: OpenGL draws.
  std::uint32_t cpuThreads = 0;
};

class DrawingPlan {
public:
  DrawingPlan(const DrawingNeeds& needs, const KnownMachine& machine);

  const DrawSetting& setting() const { return chosen_.setting; }
  /// "calibrated 2026-11-23 05:01 UTC: 17.2 frames/s with 4 walls, 12.3 by threads"
  const std::string& why() const { return chosen_.why; }
  /// "2 threads of the CPU renderer for all walls"
  std::string text(std::size_t walls) const;
  /// Threads of this program's rasteriser, for in-process and wall-process walls alike.
  std::uint32_t rasteriserThreadsHere() const { return here_.setting.rasteriserThreads; }

  /// Notes that this program must draw after all.
  void drawHere(const std::string& why);

private:
  struct Choice {
    DrawSetting setting;
    std::string why;
  };
  static Choice choose(const DrawingNeeds& needs, const KnownMachine& machine);
  static Choice chooseForCpu(const DrawingNeeds& needs);

  bool drawsWithGl_;
  Choice chosen_, here_;
};

}  // namespace stadion
