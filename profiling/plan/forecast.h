#pragma once
/// What a schedule comes to: frames a second, latency, and what is in the way.
///
/// Units    milliseconds. Threads  plain values.

#include "profiling/plan/schedule.h"

namespace stadion::plan {

/// How much of the time something is in use.
struct Use {
  std::string name;
  double share = 0;
};

struct Forecast {
  double period = 0;      ///< from swap to swap, the middle one
  double perSecond = 0;   ///< frames, on the whole
  double latency = 0;     ///< from the poses to the swap, the middle one
  std::vector<Use> uses;  ///< threads, turns, rasterisers, processors
  std::string bottleneck;
};

/// Of the frames between the first ones, that fill the pipeline, and the last ones, that empty it.
Forecast forecastOf(const Schedule& schedule, const Plan& plan);

/// What would be gained by something else.
struct Remedy {
  std::string what;  ///< "4 cores"
  Forecast then;
};
/// More cores, the other mode, walls as processes, two machines; those that can be had, the best first.
std::vector<Remedy> remediesFor(const std::vector<FrameCost>& costs, const Plan& plan);

}  // namespace stadion::plan
