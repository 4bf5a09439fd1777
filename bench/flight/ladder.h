#pragma once
/// Every rung on every object: its errors on the reference flights and on flights to which it was not fitted.

#include "bench/flight/checks.h"
#include "bench/flight/objects.h"
#include "bench/flight/show_flights.h"

namespace stadion::bench {

/// A flight model.
struct Rung {
  Thing thing = Thing::Javelin;
  std::string name;
  std::function<Trajectory(const Throw&)> fly;
};
std::vector<Rung> rungsOf(Thing thing);

/// Over a set of flights: root mean squares, the worst, and the mean attitude error.
struct SetErrors {
  double range = 0, landing = 0, landingMost = 0;  ///< relative to the range
  double attitude = 0;                             ///< [degrees]
};

struct RungResult {
  Thing thing = Thing::Javelin;
  std::string rung;
  SetErrors reference, heldOut;
};

struct Ladder {
  std::vector<RungResult> rungs;
  Checks checks;
};
/// `show`: also throws by scripts; null: does not.
Ladder measureLadder(const std::vector<ReferenceFlight>& references, int heldOutFlights,
                     const ShowFlights* show = nullptr);

}  // namespace stadion::bench
