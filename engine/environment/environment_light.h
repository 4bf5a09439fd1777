#pragma once
/// Light that arrives from all around, ready to be drawn.
///
/// Diffuse   nine coefficients of spherical harmonics (Ramamoorthi and Hanrahan 2001, "An Efficient
///           Representation for Irradiance Environment Maps"): irradiance / pi, so that an environment of 1
///           lights a white matt surface with 1. Where a bright lamp makes them negative, they count as 0.
/// Mirrored  maps of the same surroundings, each blurred as a surface of one roughness mirrors them (Karis
///           2013, "Real Shading in Unreal Engine 4": GGX, seen square on).
/// Picture   the surroundings themselves, for the background; of the show's own sky there is none.
/// Layout    a map is octahedral: a square of n x n steps with a texel at each of its (n + 1) x (n + 1) corners.
///           So four texels around any place lie side by side, and the edges of the octahedron run through
///           texels: a horizon is as sharp at its corners as elsewhere. `texels` has the picture first, then
///           the maps from smooth to rough, each row by row.
/// Texels    three colours with nine bits each and a common exponent, as GL_RGB9_E5: up to 65408.
/// Frames    World axes: +X right, +Y forward, +Z up.
/// Threads   immutable once made.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace stadion {

using Radiance = std::array<float, 3>;  ///< linear red, green, blue

struct EnvironmentLight {
  static constexpr std::size_t kMaps = 8;
  static constexpr std::array<std::uint32_t, kMaps> kSides{256, 128, 64, 64, 32, 32, 32, 32};
  static constexpr std::uint32_t kLeastPicture = 256, kMostPicture = 2048;  ///< sides, powers of two

  std::array<Radiance, 9> harmonics{};  ///< of Y(0,0), Y(1,-1), Y(1,0), Y(1,1), Y(2,-2) .. Y(2,2)
  std::uint32_t pictureSide = 0;        ///< [steps]; 0 = there is no picture
  std::vector<std::uint32_t> texels;

  /// The roughness for which a map is made.
  static constexpr float roughnessOf(std::size_t map) {
    return static_cast<float>(map) / static_cast<float>(kMaps - 1);
  }
  /// Texels of a map with this side; 0 for none.
  static constexpr std::size_t sizeOf(std::uint32_t side) {
    return side == 0 ? 0 : std::size_t{side + 1} * (side + 1);
  }
  /// Where a map begins in `texels`.
  std::size_t firstOf(std::size_t map) const {
    std::size_t first = sizeOf(pictureSide);
    for (std::size_t i = 0; i < map; ++i) first += sizeOf(kSides[i]);
    return first;
  }
  /// How many texels there must be.
  static std::size_t sizeWith(std::uint32_t pictureSide) {
    std::size_t size = sizeOf(pictureSide);
    for (const std::uint32_t side : kSides) size += sizeOf(side);
    return size;
  }
  /// Irradiance / pi of a face with the unit normal n; without a limit below.
  Radiance matt(const std::array<float, 3>& n) const;
  /// Returns true if there are as many texels as there must be, and all harmonics are finite.
  bool isSound() const;
};

/// Expects numbers that are not negative; what is brighter than 65408 counts as 65408.
std::uint32_t packedLight(const Radiance& light);
Radiance unpackedLight(std::uint32_t texel);

/// The direction, unit, of a place on the octahedral square, -1 to 1.
std::array<double, 3> octahedralDirection(double x, double y);
/// The place of a direction.
std::array<double, 2> octahedralPlace(const std::array<double, 3>& d);

/// Values of the nine harmonics in a direction.
std::array<double, 9> harmonicsAt(const std::array<double, 3>& d);

}  // namespace stadion
