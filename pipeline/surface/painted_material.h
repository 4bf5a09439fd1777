#pragma once
/// What a paint makes of a material, for both renderers.

#include "engine/asset/material.h"
#include "engine/published/paint.h"

namespace stadion {

/// Returns the material with the paint's tint, emission and opacity. Holes of a material that cuts out are
/// those of its picture if the paint is seen through.
inline Material painted(Material material, const PaintRecord& paint) {
  for (std::size_t k = 0; k < 3; ++k) {
    material.baseColour[k] *= paint.tint[k];
    material.emissive[k] += paint.emit[k];
  }
  if (!paint.isSeeThrough()) return material;
  material.baseColour[3] *= paint.opacity;
  material.alphaCutoff = 0;
  return material;
}

}  // namespace stadion
