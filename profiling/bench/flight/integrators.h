#pragma once
/// How fast integrators come near the exact flight of the exact models, and what a step costs them.

#include "profiling/bench/comparison/measurement.h"
#include "profiling/bench/flight/checks.h"
#include "profiling/bench/flight/objects.h"

namespace stadion::bench {

struct IntegratorResult {
  Thing thing = Thing::Javelin;
  std::string scheme;
  int hz = 60;
  double landing = 0;   ///< root mean square over the reference flights, in parts of the range
  double worst = 0;     ///< the greatest of them
  double attitude = 0;  ///< mean [degrees]
  double ns = 0;        ///< of one step, exact model and all; the median of five flights
};

struct Integrators {
  std::vector<IntegratorResult> results;
  Checks checks;
  /// How the error of landing falls with the rate, as an exponent: the slope through the errors that are
  /// clear of rounding and of flights that are lost; NaN of less than two.
  double order(Thing thing, const std::string& scheme) const;
  /// For `workPrecisionPlot`: steps a frame of 1/60 s, error of landing.
  std::vector<Measurement> measurements(Thing thing) const;
};

Integrators measureIntegrators(const std::vector<ReferenceFlight>& references);

}  // namespace stadion::bench
