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

/// The first tau in [from, to] at which the gap closes; see touch.h. `acceleration` bounds |gap''| from
/// below.
template <class F>
std::optional<double> firstRoot(F probe, double from, double to, double acceleration, double tolerance,
                                std::uint64_t& iterations) {
  double tau = from;
  for (int i = 0; i < 200; ++i) {
    ++iterations;
    Probe p = probe(tau);
    if (!(p.gap == p.gap) || !(p.rate == p.rate)) return {};
    if (p.gap <= tolerance) {
      if (p.rate < 0) return tau;
      p.gap = 0;
    }
    const double root = std::sqrt(p.rate * p.rate + 2 * acceleration * p.gap);
    double step;
    if (p.rate < 0) {
      step = 2 * p.gap / (root - p.rate);
    } else if (acceleration > 0) {
      step = (p.rate + root) / acceleration;
    } else {
      return {};
    }
    tau += std::max(step, 1e-12);
    if (!(tau <= to)) return {};
  }
  return tau;  // grazing: as good as touching
}

}  // namespace stadion
