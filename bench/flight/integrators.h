#pragma once
/// Accuracy of integrators against the exact flight of the exact models, and the cost of a step.

#include "bench/comparison/measurement.h"
#include "bench/flight/checks.h"
#include "bench/flight/objects.h"

namespace stadion::bench {

struct IntegratorResult {
  Thing thing = Thing::Javelin;
  std::string scheme;
  int hz = 60;
  double landing = 0;   ///< root mean square over the reference flights, relative to the range
  double worst = 0;     ///< greatest error
  double attitude = 0;  ///< mean [degrees]
  double ns = 0;        ///< cost of one step with the exact model; the median of five flights
};

struct Integrators {
  std::vector<IntegratorResult> results;
  Checks checks;
  /// Returns the order of convergence: the exponent with which the error of landing falls with the rate. It
  /// is the slope through the errors that are neither rounding nor lost flights; NaN for fewer than two.
  double order(Thing thing, const std::string& scheme) const;
  /// For `workPrecisionPlot`: steps a frame of 1/60 s, error of landing.
  std::vector<Measurement> measurements(Thing thing) const;
};

Integrators measureIntegrators(const std::vector<ReferenceFlight>& references);

}  // namespace stadion::bench
