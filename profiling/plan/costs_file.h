#pragma once
/// The costs of a show's frames as a file: measured once, used for plans on any machine.
///
///     {"format": "stadion-plan-costs 1", "show": "kick.evs", "size": "800x600", "look": "full",
///      "eyes": 2, "walls": ["front", "left"], "cores": 2, "raster_threads": 2, "waits_in_turn": true,
///      "frames": [{"app": 0.05, "app_helpers": 0, "swap": 0.002,
///                  "walls": [{"cull": 0.01, "pictures": [[0.4, 10.5, 1.9], [0.4, 10.5, 1.9]]}]}]}
///
/// Costs are milliseconds of processor time. A picture has three numbers: the time of its calls in the
/// drawing thread, the time of its rasterising in all threads of the rasteriser together, and how many of
/// these work at a time. With the CPU renderer ("renderer": "cpu") these are the time of the drawing thread,
/// that of the renderer's threads together, and how many of those work at a time.
///
/// Threads  plain values, any thread.
/// Errors   a message that says what is wrong and where.

#include "engine/base/diagnostic.h"
#include "profiling/plan/schedule.h"

namespace stadion::plan {

struct ShowCosts {
  std::string show, size;
  std::string look = "full";    ///< or "plain"; a file without it was measured in the full look
  std::string renderer = "gl";  ///< or "cpu"; a file without it was measured with OpenGL
  std::size_t eyes = 2;
  std::vector<std::string> walls;  ///< names
  double cores = 1;                ///< cores of the machine where the costs were measured
  double rasterThreads = 1;        ///< threads that the rasteriser had on that machine
  bool waitsInTurn = true;         ///< CostProbe
  std::vector<FrameCost> frames;
};

/// Returns the costs as a line of JSON.
std::string toJson(const ShowCosts& costs);
/// Also reads a larger object that has it as "costs". `name` appears in errors.
Result<ShowCosts> readCosts(const std::string& text, const std::string& name);

}  // namespace stadion::plan
