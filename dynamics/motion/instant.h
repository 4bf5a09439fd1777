#pragma once
/// A point of show time finer than a nanosecond: bodies keep their own clocks, and an impact does not fall on
/// a tick.

#include "engine/base/time_signature.h"

namespace stadion {

struct Instant {
  Nanoseconds ns = 0;  ///< show time, rounded down [ns]
  double rest = 0;     ///< [s], in [0, 1e-9)

  /// Returns this moment plus `s` seconds, |s| < 1e6.
  Instant plus(double s) const {
    const double whole = rest + s;
    auto n = static_cast<Nanoseconds>(whole * 1e9);
    double r = whole - static_cast<double>(n) * 1e-9;
    if (r < 0) {
      r += 1e-9;
      --n;
    }
    if (r >= 1e-9) {
      r -= 1e-9;
      ++n;
    }
    return {ns + n, r > 0 ? r : 0};
  }
  /// Seconds from `earlier` to this moment.
  double since(const Instant& earlier) const {
    return static_cast<double>(ns - earlier.ns) * 1e-9 + (rest - earlier.rest);
  }
  /// To the nearest nanosecond.
  Nanoseconds rounded() const { return ns + (rest >= 0.5e-9 ? 1 : 0); }
  bool operator==(const Instant&) const = default;
  bool operator<(const Instant& o) const { return ns != o.ns ? ns < o.ns : rest < o.rest; }
};

}  // namespace stadion
