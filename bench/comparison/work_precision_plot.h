#pragma once
/// Error against cost of one case, both axes logarithmic, as a picture in SVG.

#include "bench/comparison/measurement.h"

namespace stadion::bench {

/// Draws one line for each engine's setting, and one dot for each number of steps a frame. Errors below 1e-16
/// are drawn there. Dots that lie close together share one label. The legend names the engines with dots
/// wholly under other dots. Measurements without cost or error are left out.
std::string workPrecisionPlot(const std::string& title, const std::vector<Measurement>& measurements);

}  // namespace stadion::bench
