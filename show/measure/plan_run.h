#pragma once
/// Plays a show for `stadion plan`: to measure what its stages cost, and, for `stadion bench plan`, what
/// comes of it.

#include "profiling/plan/cost_probe.h"
#include "show/base/reporter.h"
#include "show/player/player.h"
#include "show/player/show_renderer.h"

#include <optional>

namespace stadion {

struct PlanRunOptions {
  ShowOptions show;  ///< complete; `frames` says how many are looked at
  StereoLayout layout = StereoLayout::Pair;
  std::size_t walls = 1;   ///< the first ones of the wall file
  bool processes = false;  ///< playTimes: a process for each wall draws, with one thread of the CPU renderer
};

/// The costs of a show's frames.
struct MeasuredCosts {
  std::vector<std::map<std::uint64_t, plan::FrameCost>> runs;
  bool waitsInTurn = true;
};

/// The measured results of playing a show.
struct PlayedTimes {
  double period = 0;   ///< from swap to swap, the middle one [ms]
  double latency = 0;  ///< from the poses to the swap [ms]
};

/// Frames that are played before those that are looked at: programs are compiled and meshes uploaded in them.
constexpr std::uint64_t kFramesBefore = 6;

/// Threads of the whole machine that were ready, on average over the last minute.
double loadNow();

/// Adds a run. False, with the findings, if something of the user's is wrong.
bool measureCosts(const PlanRunOptions& options, ShowRenderer& renderer, Reporter& reporter,
                  MeasuredCosts& costs, Diagnostics& findings);
std::optional<PlayedTimes> playTimes(const PlanRunOptions& options, Mode mode, ShowRenderer& renderer,
                                     Reporter& reporter, Diagnostics& findings);

}  // namespace stadion
