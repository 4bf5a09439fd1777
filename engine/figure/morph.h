#pragma once
/// Morph targets: differences that weights add to the vertices of a mesh before its joints carry them.
///
/// Formula  p' = p + sum of w · d over the targets, normals likewise (glTF 2.0, section 3.7.2.2). Skinning brings
///          the normals to unit length.
/// Frames   the mesh's own coordinates, as its positions.
/// Threads  pure; a MorphedVertices serves one thread at a time.

#include "engine/figure/skinning.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace stadion {

struct Morph {
  std::uint32_t weight = 0;                     ///< which of Skeleton::weights
  std::vector<std::uint32_t> vertices;          ///< that it moves, ascending
  std::vector<std::array<float, 3>> positions;  ///< differences, as many [m]
  std::vector<std::array<float, 3>> normals;    ///< differences, as many, or none
};

/// Keeps the memory for morphed vertices from frame to frame.
class MorphedVertices {
public:
  /// Returns what skin() takes. It refers to `source`, or to this object until the next call.
  SkinSource apply(const SkinSource& source, std::span<const Morph> morphs, std::span<const float> weights);

private:
  std::vector<std::array<float, 3>> positions_, normals_;
};

}  // namespace stadion
