#pragma once
/// Error against cost of the rungs as a picture in SVG.
///
/// Threads  a plain function.

#include "bench/looks/looks_results.h"

namespace stadion::bench {

/// One line for each wall of a scene, one dot for each rung; mean error over processor time a view.
std::string looksPlot(const std::vector<LooksRow>& rows);

}  // namespace stadion::bench
