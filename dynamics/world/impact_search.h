#pragma once
/// Finds the first contact of a pair by the scheme that the world is set to (collision/impact_scheme.h).
///
/// Lasting contact is no part of any scheme. A ball that slides or rolls on a mesh meets its next face
/// exactly.
///
/// Threads  one at a time, as the world that it belongs to (world.h).

#include "dynamics/collision/impact_scheme.h"
#include "dynamics/collision/stepped_search.h"
#include "dynamics/state/world_time.h"
#include "dynamics/world/world.h"

#include <cmath>
#include <optional>

namespace stadion {

class ImpactSearch {
public:
  ImpactSearch(const WorldTime& time, World::Counters& counters) : time_(time), counters_(counters) {}

  void set(const ImpactScheme& scheme) { scheme_ = scheme; }
  /// The first touch of the sides in [from, to].
  std::optional<Touch> first(const Side& a, const Side& b, double from, double to) const {
    if (scheme_.kind == ImpactScheme::Kind::Exact || leans(a, b) || leans(b, a))
      return firstTouch(a, b, from, to, counters_.distances);
    return SteppedSearch(a, b, scheme_, gridTime(), counters_.distances).first(from, to);
  }
  /// How far sides may be apart that touch [m].
  double tolerance() const { return scheme_.kind == ImpactScheme::Kind::Paper ? scheme_.tolerance : 0; }

private:
  static bool leans(const Side& s, const Side& on) {
    return s.body && s.body->support.on.id && s.body->support.on == on.key &&
           s.body->mode != BodyMode::Flight;
  }
  /// The last time of the grid of steps before the window.
  double gridTime() const {
    const double origin = toSeconds(time_.origin());
    return std::floor(origin / scheme_.step) * scheme_.step - origin;
  }

  const WorldTime& time_;
  World::Counters& counters_;
  ImpactScheme scheme_;
};

}  // namespace stadion
