#pragma once
/// The light at a corner of a triangle in the plain look, as the vertex shader computes it.
///
/// Threads  pure. Uses no library function but the square root, so all machines get the same.

#include "pipeline/cpu_draw/kernels/kernel_data.h"

#include <array>

namespace stadion {

/// Light from everywhere and from all lamps. `normal`: unit.
std::array<float, 3> plainLight(const SceneParameters& scene, const std::array<float, 3>& placed,
                                const std::array<float, 3>& normal);
/// The part of a colour that haze leaves at a distance [m].
float clearnessAt(const SceneParameters& scene, float distance);

}  // namespace stadion
