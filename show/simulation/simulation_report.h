#pragma once
/// A simulation as a table and as JSON.
///
/// Threads  pure functions.

#include "show/simulation/hall_simulation.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace stadion {

std::string textOf(const SimulationResult& result);

/// Has geometry_error_px_max, luminance_error_max, uncovered_fraction, and figures by projector and seam.
nlohmann::ordered_json jsonOf(const SimulationResult& result);

}  // namespace stadion
