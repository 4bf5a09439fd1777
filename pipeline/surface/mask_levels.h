#pragma once
/// Smaller levels of a picture with holes, for textures.
///
/// A mean of texels has a mean alpha: below the cutoff, what is fine would go as a whole where it is far
/// away. So each level's alpha is scaled until as large a part of it is there as of the picture itself
/// (Castano, "Computing Alpha Mipmaps", 2010). Where no scale gives that, as for a pattern as fine as the
/// texels, the levels end.
///
/// Threads  a pure function.

#include "engine/asset/mesh.h"
#include "pipeline/shader/look.h"

#include <vector>

namespace stadion {

/// Level 1 and what follows, each half as large as the one before, rounded down. Colours are means by alpha,
/// of linear light in the full look. Texels with an alpha of at least `alphaCutoff`, 0 .. 1, are there.
std::vector<Texture> maskLevels(const Texture& texture, float alphaCutoff, Look look);

}  // namespace stadion
