#include "show/measure/soak_visitor.h"

#include "engine/input/tracker_names.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <limits>

namespace stadion {
namespace {

constexpr double kThrowEvery = 4, kHoldsFor = 1.2, kSwing = 0.4;  ///< [s]
constexpr double kSilentEvery = 19, kSilentFor = 1.1;             ///< all trackers [s]
constexpr double kMadEvery = 5;                                   ///< interval of impossible values [s]

double phaseOf(double t, double period) {
  return t - period * static_cast<double>(static_cast<std::int64_t>(t / period));
}

Quat turned(double yaw) {
  return det::expRotation(Vec3(0, 0, yaw));
}

}  // namespace

void SoakVisitor::restart() {
  feed_.restart();
  holds_ = false;
}

// In the last part of the time it is held the ball is swung forward and up, and let go on the way.
void SoakVisitor::measure(Nanoseconds at) {
  const double t = toSeconds(at);
  if (phaseOf(t, kSilentEvery) > kSilentEvery - kSilentFor) return;
  const double sway = det::sin(2 * kPi * phaseOf(t, 7) / 7);
  feed_.pose(kHeadTracker, at, {{0.2 * sway, 0.1 * sway, 1.7}, turned(0.5 * sway)});
  const double phase = phaseOf(t, kThrowEvery);
  const bool holds = phase < kHoldsFor;
  const double swing = std::clamp((phase - (kHoldsFor - kSwing)) / kSwing, 0.0, 1.0);
  feed_.pose(kWandTracker, at, {{0.3, 0.5 + 1.2 * swing * swing, 1.3 + 0.6 * swing * swing}, turned(0)});
  if (holds != holds_) {
    feed_.button(kWandTracker, at, 1, holds);
    throws_ += holds ? 0 : 1;
    holds_ = holds;
  }
  if (phaseOf(t, kMadEvery) > 0.02) return;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  feed_.pose(kHeadTracker, at, {{nan, 0, 1e9}, turned(0)});
  feed_.pose("unknown", at, {{0, 0, 1}, turned(0)});
  feed_.button(kWandTracker, at, 4711, true);
}

void SoakVisitor::sampleFrame(Nanoseconds start, Nanoseconds end, InputSample& sample) {
  if (end > start) measure(start + (end - start) / 2);
  measure(end);
  feed_.sampleFrame(end, start, end, sample);
}

}  // namespace stadion
