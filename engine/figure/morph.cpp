#include "engine/figure/morph.h"

#include <algorithm>

namespace stadion {
namespace {

void addTo(std::vector<std::array<float, 3>>& values, const std::vector<std::uint32_t>& vertices,
           const std::vector<std::array<float, 3>>& differences, float weight) {
  for (std::size_t i = 0; i < differences.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) values[vertices[i]][k] += weight * differences[i][k];
}

}  // namespace

SkinSource MorphedVertices::apply(const SkinSource& source, std::span<const Morph> morphs,
                                  std::span<const float> weights) {
  const auto weightOf = [&](const Morph& m) { return m.weight < weights.size() ? weights[m.weight] : 0.0f; };
  if (std::ranges::all_of(morphs, [&](const Morph& m) { return weightOf(m) == 0; })) return source;
  positions_.assign(source.positions.begin(), source.positions.end());
  normals_.assign(source.normals.begin(), source.normals.end());
  for (const Morph& m : morphs)
    if (const float weight = weightOf(m); weight != 0) {
      addTo(positions_, m.vertices, m.positions, weight);
      addTo(normals_, m.vertices, m.normals, weight);
    }
  return {positions_, normals_, source.joints};
}

}  // namespace stadion
