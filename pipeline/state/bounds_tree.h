#pragma once
/// Bounding spheres below a hierarchy of boxes, in groups of eight, so that one instruction tests several.
///
/// Level 0 holds the spheres, level 1 a box around each eight neighbouring spheres, level 2 a box around each
/// eight of those, and so on. Node j of a level holds nodes 8 j to 8 j + 7 of the level below. The tree thus
/// consists of numbers without pointers, and other processes can map it.
///
/// Frames     relative to `origin`, a place in World amid the contents, in single precision. The tests allow
///            for the rounding (pipeline/cull/bounds_kernels.h).
/// Threads    plain memory: a thread that may read the records may read their tree.

#include "engine/published/records.h"

#include <array>
#include <span>

namespace stadion {

/// Positions of the levels in a tree with room for `capacity` spheres, counted in floats.
struct BoundsLayout {
  static constexpr std::uint32_t kWide = 8;         ///< nodes side by side
  static constexpr std::size_t kSphereFloats = 32;  ///< floats for eight spheres: x, y, z, radius
  static constexpr std::size_t kBoxFloats = 48;  ///< floats for eight boxes: least x, y, z, greatest x, y, z
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
  const std::uint32_t* order = nullptr;  ///< record of each sphere; null: spheres are in the order of the
                                         ///< records
  const float* floats = nullptr;
  BoundsLayout layout;

  std::uint32_t indexOf(std::uint32_t place) const { return order ? order[place] : place; }
  std::uint32_t nodes(std::uint32_t level) const;
  std::uint32_t top() const;  ///< the lowest level that has at most eight nodes
};

bool isShown(const InstanceRecord& r);

/// Writes the sphere of a record. A hidden record gets a sphere that touches nothing.
void putSphere(float* floats, std::uint32_t place, const InstanceRecord& r, const Vec3& origin);
/// Writes boxes `first` to `end` of a level around the nodes of the level below, which has `below` nodes.
void putBoxes(float* floats, const BoundsLayout& layout, std::uint32_t level, std::uint32_t first,
              std::uint32_t end, std::uint32_t below);

}  // namespace stadion
