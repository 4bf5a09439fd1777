#pragma once
/// A picture of the surroundings, and the light that it gives.
///
/// Layout    equirectangular: the columns go once around, the rows from straight up to straight down. The
///           middle of the picture is forward (+Y), its right half is to the right (+X).
/// Threads   pure. The result is the same on every machine: no function of the C library but the root.

#include "engine/environment/environment_light.h"

namespace stadion {

struct RadianceMap {
  std::uint32_t width = 0, height = 0;  ///< [pixels] width is twice the height
  std::vector<Radiance> pixels;         ///< rows from the top; finite, not negative

  const Radiance& at(std::uint32_t x, std::uint32_t y) const { return pixels[std::size_t{y} * width + x]; }
};

/// The direction of a place in such a picture, u and v from 0 to 1.
std::array<double, 3> equirectangularDirection(double u, double v);

/// Expects a map that is twice as wide as high, with at least one row. Takes it, since it may be large.
EnvironmentLight environmentLight(RadianceMap map);

/// The light of a sky that has the same colours all around: what the renderers draw without haze and sun.
EnvironmentLight skyLight(const Radiance& zenith, const Radiance& horizon, const Radiance& ground);
/// The colour of that sky in a direction with this z.
std::array<double, 3> skyColour(const Radiance& zenith, const Radiance& horizon, const Radiance& ground,
                                double z);

}  // namespace stadion
