#include "pipeline/state/bounds_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stadion {
namespace {

constexpr std::uint32_t kWide = BoundsLayout::kWide;
constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// Least and greatest coordinate on each axis.
struct Box {
  std::array<float, 3> lo{kInfinite, kInfinite, kInfinite}, hi{-kInfinite, -kInfinite, -kInfinite};
};

Box boxOfSpheres(const float* group, std::uint32_t lanes) {
  Box box;
  const float* radius = group + 3 * kWide;
  for (std::uint32_t lane = 0; lane < lanes; ++lane)
    for (std::size_t k = 0; k < 3; ++k) {
      const float at = group[k * kWide + lane];
      box.lo[k] = std::min(box.lo[k], at - radius[lane]);
      box.hi[k] = std::max(box.hi[k], at + radius[lane]);
    }
  return box;
}

Box boxOfBoxes(const float* group, std::uint32_t lanes) {
  Box box;
  for (std::uint32_t lane = 0; lane < lanes; ++lane)
    for (std::size_t k = 0; k < 3; ++k) {
      box.lo[k] = std::min(box.lo[k], group[k * kWide + lane]);
      box.hi[k] = std::max(box.hi[k], group[(3 + k) * kWide + lane]);
    }
  return box;
}

}  // namespace

BoundsLayout::BoundsLayout(std::uint32_t capacity) {
  std::uint32_t nodes = capacity;
  for (std::uint32_t level = 0; level < kMostLevels; ++level) {
    at[level] = floats;
    if (level > 0 && nodes == 0) continue;
    floats += groupsOf(nodes) * (level == 0 ? kSphereFloats : kBoxFloats);
    nodes = nodes > kWide ? groupsOf(nodes) : 0;
  }
}

std::uint32_t BoundsTree::nodes(std::uint32_t level) const {
  std::uint32_t n = count;
  for (; level > 0; --level) n = BoundsLayout::groupsOf(n);
  return n;
}

std::uint32_t BoundsTree::top() const {
  std::uint32_t level = 0;
  for (std::uint32_t n = count; n > kWide; n = BoundsLayout::groupsOf(n)) ++level;
  return level;
}

bool isShown(const InstanceRecord& r) {
  return r.radius >= 0 && (r.flags & InstanceRecord::kShown) != 0;
}

void putSphere(float* floats, std::uint32_t place, const InstanceRecord& r, const Vec3& origin) {
  float* group = floats + place / kWide * BoundsLayout::kSphereFloats + place % kWide;
  bool known = std::isfinite(r.radius);
  std::array<float, 4> sphere{0, 0, 0, r.radius};
  for (std::size_t k = 0; k < 3; ++k) {
    sphere[k] = static_cast<float>(r.centre[k] - origin[static_cast<int>(k)]);
    known = known && std::isfinite(sphere[k]);
  }
  // A sphere without finite bounds is everywhere, so it is always tested more closely.
  if (!known) sphere = {0, 0, 0, kInfinite};
  if (!isShown(r)) sphere = {0, 0, 0, -kInfinite};
  for (std::size_t k = 0; k < 4; ++k) group[k * kWide] = sphere[k];
}

void putBoxes(float* floats, const BoundsLayout& layout, std::uint32_t level, std::uint32_t first,
              std::uint32_t end, std::uint32_t below) {
  for (std::uint32_t node = first; node < end; ++node) {
    const std::uint32_t lanes = std::min(kWide, below - node * kWide);
    const float* from = floats + layout.at[level - 1];
    const Box box = level == 1 ? boxOfSpheres(from + node * BoundsLayout::kSphereFloats, lanes)
                               : boxOfBoxes(from + node * BoundsLayout::kBoxFloats, lanes);
    float* to = floats + layout.at[level] + node / kWide * BoundsLayout::kBoxFloats + node % kWide;
    for (std::size_t k = 0; k < 3; ++k) {
      to[k * kWide] = box.lo[k];
      to[(3 + k) * kWide] = box.hi[k];
    }
  }
}

}  // namespace stadion
