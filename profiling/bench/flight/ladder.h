#pragma once
/// Every rung on every thing: how far off it is on the reference flights and on flights it was not fitted to.

#include "profiling/bench/flight/checks.h"
#include "profiling/bench/flight/objects.h"
#include "profiling/bench/flight/show_flights.h"

namespace stadion::bench {

/// A way to fly.
struct Rung {
  Thing thing = Thing::Javelin;
  std::string name;
  std::function<Trajectory(const Throw&)> fly;
};
std::vector<Rung> rungsOf(Thing thing);

/// Over a set of flights: root mean squares, the worst, and the mean of the attitude's.
struct SetErrors {
  double range = 0, landing = 0, landingMost = 0;  ///< in parts of the range
  double attitude = 0;                             ///< [degrees]
};

struct RungResult {
  Thing thing = Thing::Javelin;
  std::string rung;
  SetErrors reference, held;
};

struct Ladder {
  std::vector<RungResult> rungs;
  Checks checks;
};
/// `show`: what is thrown by scripts as well; null: nothing.
Ladder measureLadder(const std::vector<ReferenceFlight>& references, int held,
                     const ShowFlights* show = nullptr);

}  // namespace stadion::bench
