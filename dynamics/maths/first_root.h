#pragma once
/// The first moment at which two things touch whose gap and its rate are known at any moment. Internal to
/// dynamics/.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace stadion {

struct Probe {
  double gap, rate;
};

/// Before this time the gap, which is like this at tau, cannot close; tau itself if it closes right there,
/// nothing if it never does. `acceleration` is the largest |gap''|.
inline std::optional<double> soonestRoot(Probe p, double tau, double acceleration, double tolerance) {
  if (!(p.gap == p.gap) || !(p.rate == p.rate)) return {};
  if (p.gap <= tolerance) {
    if (p.rate < 0) return tau;
    p.gap = 0;
  }
  const double root = std::sqrt(p.rate * p.rate + 2 * acceleration * p.gap);
  if (p.rate < 0) return tau + std::max(2 * p.gap / (root - p.rate), 1e-12);
  if (acceleration > 0) return tau + std::max((p.rate + root) / acceleration, 1e-12);
  return {};
}

/// The first tau in [from, to] at which the gap closes; see touch.h.
template <class F>
std::optional<double> firstRoot(F probe, double from, double to, double acceleration, double tolerance,
                                std::uint64_t& iterations) {
  double tau = from;
  for (int i = 0; i < 200; ++i) {
    ++iterations;
    const auto next = soonestRoot(probe(tau), tau, acceleration, tolerance);
    if (!next || *next == tau) return next;
    tau = *next;
    if (!(tau <= to)) return {};
  }
  return tau;  // grazing: as good as touching
}

}  // namespace stadion
