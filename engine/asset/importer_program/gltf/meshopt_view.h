#pragma once
/// Buffer views that EXT_meshopt_compression has packed.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace stadion::importer {

struct MeshoptView {
  std::span<const std::uint8_t> bytes;
  std::uint64_t count = 0;   ///< elements
  std::uint64_t stride = 0;  ///< [bytes] of an element
  std::string mode;          ///< "ATTRIBUTES", "TRIANGLES" or "INDICES"
  std::string filter;        ///< "", "NONE", "OCTAHEDRAL", "QUATERNION" or "EXPONENTIAL"
};

/// Returns the elements, or nothing and the reason. Makes at most `mostBytes`.
std::optional<std::vector<std::uint8_t>> unpack(const MeshoptView& view, std::uint64_t mostBytes,
                                                std::string& why);

}  // namespace stadion::importer
