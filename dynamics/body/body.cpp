#include "dynamics/body/body.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

/// What both sides say together; the default if neither says anything.
double decided(const std::optional<double>& a, const std::optional<double>& b, double fallback, bool product) {
  if (!a && !b) return fallback;
  if (!a || !b) return a ? *a : *b;
  return product ? std::sqrt(*a * *b) : std::max(*a, *b);
}

}  // namespace

PairSurface combine(const Surface& a, const Surface& b) {
  return {decided(a.friction, b.friction, 0.5, true), decided(a.restitution, b.restitution, 0.5, false),
          decided(a.rolling, b.rolling, 0.01, false)};
}

}  // namespace stadion
