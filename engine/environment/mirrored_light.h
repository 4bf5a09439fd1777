#pragma once
/// What a surface of some roughness mirrors, seen square on: the mean of the light around the mirrored
/// direction, weighted with the GGX lobe and the cosine.
///
/// Method   a fixed set of half vectors, spread as the lobe is (Hammersley points); each looks at an area
///          of the surroundings as large as the share of the lobe that it stands for (Krivanek and Colbert 2008,
///          "Real-time Shading with Filtered Importance Sampling").
/// Threads  pure; no function of the C library but the root.

#include <array>
#include <cstdint>
#include <vector>

namespace stadion {

/// A direction of incoming light, in axes in which the surface's normal is +Z.
struct MirroredRay {
  std::array<double, 3> direction;  ///< unit
  double weight;                    ///< of all rays together 1
  double solidAngle;                ///< that it stands for [sr]
};

/// Expects a roughness above 0. `count`: of half vectors; some of them mirror no light.
std::vector<MirroredRay> mirroredRays(double roughness, std::uint32_t count);

/// The weight of light from a direction, by the cosine of its angle to the normal: GGX and the cosine.
double mirroredWeight(double roughness, double cosine);

/// Two unit vectors that are square to n, unit, and to each other.
std::array<std::array<double, 3>, 2> axesAround(const std::array<double, 3>& n);

}  // namespace stadion
