#pragma once
/// Bounding spheres below a hierarchy of boxes, eight of each side by side, so that one instruction tests
/// several.
///
/// Level 0 are the spheres, level 1 the boxes of eight neighbouring spheres each, level 2 of eight such
/// boxes, and so on: node j of a level holds nodes 8 j to 8 j + 7 of the level below. So there is nothing to
/// follow and nothing but numbers; other processes can map it.
///
/// Frames     relative to `origin`, a place in World amid what is held, in single precision. What was rounded
///            is allowed for by those who test (pipeline/cull/bounds_kernels.h).
/// Threads    plain memory: whoever may read the records may read their tree.

#include "engine/published/records.h"

#include <array>
#include <span>

namespace stadion {

/// Where the levels lie of a tree that has room for `capacity` spheres, counted in floats.
struct BoundsLayout {
  static constexpr std::uint32_t kWide = 8;         ///< nodes side by side
  static constexpr std::size_t kSphereFloats = 32;  ///< of eight: x, y, z, radius
  static constexpr std::size_t kBoxFloats = 48;     ///< of eight: least x, y, z, greatest x, y, z
  static constexpr std::uint32_t kMostLevels = 11;

  std::array<std::size_t, kMostLevels> at{};
  std::size_t floats = 0;  ///< in all

  BoundsLayout() = default;
  explicit BoundsLayout(std::uint32_t capacity);

  static constexpr std::uint32_t groupsOf(std::uint32_t nodes) {
    return nodes / kWide + (nodes % kWide != 0);
  }
};

struct BoundsTree {
  Vec3 origin = Vec3::Zero();            ///< World [m]
  std::uint32_t count = 0;               ///< spheres
  const std::uint32_t* order = nullptr;  ///< which record each sphere is of; null: they stand in order
  const float* floats = nullptr;
  BoundsLayout layout;

  std::uint32_t indexOf(std::uint32_t place) const { return order ? order[place] : place; }
  std::uint32_t nodes(std::uint32_t level) const;
  std::uint32_t top() const;  ///< the lowest level that has at most eight nodes
};

bool isShown(const InstanceRecord& r);

/// Writes the sphere of a record; of what is not shown, one that touches nothing.
void putSphere(float* floats, std::uint32_t place, const InstanceRecord& r, const Vec3& origin);
/// Writes boxes `first` to `end` of a level, around what the level below has there; it has `below` nodes.
void putBoxes(float* floats, const BoundsLayout& layout, std::uint32_t level, std::uint32_t first,
              std::uint32_t end, std::uint32_t below);

}  // namespace stadion
