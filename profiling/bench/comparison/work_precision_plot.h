#pragma once
/// Error against cost of one case, both axes logarithmic, as a picture in SVG.

#include "profiling/bench/comparison/measurement.h"

namespace stadion::bench {

/// One line for each engine's setting, one dot for each number of steps a frame. Errors below 1e-16 are drawn
/// there. Dots that lie close together share one label; the legend says whose dots lie under others'
/// altogether. Measurements without cost or error are left out.
std::string workPrecisionPlot(const std::string& title, const std::vector<Measurement>& measurements);

}  // namespace stadion::bench
