#pragma once
/// The points at which two shapes touch or nearly touch, for the contact solver.

#include "dynamics/touch.h"

#include <cstdint>
#include <vector>

namespace stadion {

/// Whose corner the point is: it turns with that side, the normal with the other.
enum class Carrier : std::uint8_t { None, A, B };

struct ManifoldPoint {
  Gap gap;                ///< normal from b to a
  std::uint32_t key = 0;  ///< the same feature has the same key from step to step
  Carrier carrier = Carrier::None;
};

/// Points of a and b closer than `margin`, at most 16 a pair, in a fixed order.
void manifold(const Side& a, const Side& b, double tau, double margin, std::vector<ManifoldPoint>& points);

}  // namespace stadion
