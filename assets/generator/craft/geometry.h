#pragma once
/// Small vector arithmetic, and numbers that look random, for the generators.

#include "assets/generator/craft/models.h"

#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion::assets {

constexpr double kPi = 3.14159265358979323846;

inline double dot(Point a, Point b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Point cross(Point a, Point b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Point a) {
  return std::sqrt(dot(a, a));
}
inline Point normalized(Point a) {
  return (1 / std::max(length(a), 1e-12)) * a;
}
/// Component by component.
inline Point times(Point a, Point b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline Point mix(Point a, Point b, double s) {
  return a + s * (b - a);
}
inline double mix(double a, double b, double s) {
  return a + s * (b - a);
}
/// 0 below a, 1 above b, a smooth step between.
inline double smoothstep(double a, double b, double x) {
  const double s = std::clamp((x - a) / (b - a), 0.0, 1.0);
  return s * s * (3 - 2 * s);
}
/// About the Z axis, counter-clockwise [rad].
inline Point turned(Point p, double yaw) {
  const auto [s, c] = det::sincos(yaw);
  return {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
}

/// A small linear congruential generator.
class Dice {
public:
  explicit Dice(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ull + 20260101) {}
  unsigned roll(unsigned sides) { return static_cast<unsigned>((next() >> 33) % sides); }
  /// Evenly from 0 to 1.
  double even() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double between(double a, double b) { return mix(a, b, even()); }

private:
  std::uint64_t next() { return state_ = state_ * 6364136223846793005ull + 1442695040888963407ull; }
  std::uint64_t state_;
};

/// Smooth noise from 0 to 1 with lumps of about one unit.
double noise(Point p);
/// Noise of `octaves` sizes, each half as large and as strong as the one before; from 0 to 1.
double roughNoise(Point p, int octaves);

}  // namespace stadion::assets
