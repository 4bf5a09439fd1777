#pragma once
/// The result of a schedule: frames a second, latency, and the bottleneck.
///
/// Units    milliseconds.
/// Threads  plain values.

#include "profiling/plan/schedule.h"

namespace stadion::plan {

/// The part of the time in which a resource is in use.
struct Use {
  std::string name;
  double share = 0;
};

struct Forecast {
  double period = 0;      ///< median, from swap to swap
  double perSecond = 0;   ///< frames, overall
  double latency = 0;     ///< median, from the poses to the swap
  std::vector<Use> uses;  ///< threads, turns, rasterisers, processors
  std::string bottleneck;
};

/// Counts the frames between the first ones, which fill the pipeline, and the last ones, which empty it.
Forecast forecastOf(const Schedule& schedule, const Plan& plan);

/// The gain from a change.
struct Remedy {
  std::string what;  ///< "4 cores"
  Forecast then;
};
/// Returns possible changes, the best first: more cores, the other mode, walls as processes, two machines.
std::vector<Remedy> remediesFor(const std::vector<FrameCost>& costs, const Plan& plan);

}  // namespace stadion::plan
