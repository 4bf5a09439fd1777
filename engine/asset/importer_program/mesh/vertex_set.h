#pragma once
/// Finds equal vertices: open addressing over the numbers of those that are in the set already.

#include "engine/asset/importer_program/mesh/geometry.h"

#include <xxhash.h>

#include <bit>
#include <cstdint>
#include <vector>

namespace stadion::importer {

class VertexSet {
public:
  explicit VertexSet(std::size_t most) : slots_(std::bit_ceil(2 * most + 16), kEmpty) {}

  /// Returns the number of the vertex, the next one if it is new.
  std::uint32_t add(const FlatVertex& v) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = XXH3_64bits(&v, sizeof v) & mask;
    while (slots_[at] != kEmpty && !same(vertices[slots_[at]], v)) at = (at + 1) & mask;
    if (slots_[at] == kEmpty) {
      slots_[at] = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(v);
    }
    return slots_[at];
  }

  std::vector<FlatVertex> vertices;  ///< by number

private:
  static bool same(const FlatVertex& a, const FlatVertex& b) {
    return a.position == b.position && a.normal == b.normal && a.uv == b.uv && a.secondUv == b.secondUv &&
           a.tangent == b.tangent && a.colour == b.colour && a.joints == b.joints && a.morph == b.morph;
  }

  static_assert(sizeof(FlatVertex) == 88, "hashed as bytes: no padding");
  static constexpr std::uint32_t kEmpty = 0xffffffff;
  std::vector<std::uint32_t> slots_;
};

}  // namespace stadion::importer
