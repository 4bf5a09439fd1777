#pragma once
/// Between sRGB bytes and linear light, where colours may be averaged.

#include <cstdint>

namespace stadion {

constexpr std::uint32_t kFullLight = 65535;

/// Linear light of an sRGB byte, 0 to kFullLight.
std::uint32_t linearFromSrgb(std::uint8_t byte);
/// The sRGB byte nearest in light. linearFromSrgb of any byte comes back to that byte.
std::uint8_t srgbFromLinear(std::uint32_t light);

}  // namespace stadion
