#pragma once
/// Flights seen from the side and from above, as a picture in SVG.

#include "dynamics/flight/trajectory.h"

#include <string>
#include <vector>

namespace stadion::bench {

struct DrawnFlight {
  std::string name;
  Trajectory path;
};

/// The first flight is drawn as the exact one: thick and grey, with the body's axis every half second. `axis`
/// is 0 (x) or 2 (z), or -1 for objects without one. Both views have the same scale in all directions.
std::string trajectoryPlot(const std::string& title, const std::vector<DrawnFlight>& flights, int axis);

}  // namespace stadion::bench
