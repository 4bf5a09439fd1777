#include "pipeline/cull/bounds_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace stadion {
namespace {

static_assert(BoundsLayout::kWide == 8 && BoundsLayout::kSphereFloats == 32 && BoundsLayout::kBoxFloats == 48,
              "the kernels rely on it");

/// Never shrinks, so that a search reuses the elements of earlier ones.
template <class T>
T* roomFor(std::vector<T>& in, std::size_t count) {
  if (in.size() < count) in.resize(std::max(count, 2 * in.size()));
  return in.data();
}

}  // namespace

const BoundsKernels& bestBounds() {
  return __builtin_cpu_supports("avx2") ? kEightBounds : kFourBounds;
}

/// The planes in the tree's coordinates.
void BoundsSearch::express(const BoundsTree& tree, std::span<const SearchVolume> volumes) {
  for (std::size_t v = 0; v < volumes.size(); ++v) {
    const Vec3 shift = tree.origin - volumes[v].origin;
    VolumePlanes& to = planes_[v];
    to.count = 0;
    for (const Plane& plane : volumes[v].volume.all()) {
      const double offset = plane.offset + plane.normal.dot(shift);
      for (int k = 0; k < 3; ++k) to.normal[to.count][k] = static_cast<float>(plane.normal[k]);
      to.offset[to.count] = static_cast<float>(offset);
      to.rounding[to.count] = kRounding * static_cast<float>(std::abs(offset));
      ++to.count;
    }
  }
}

std::span<const TreeSphere> BoundsSearch::find(const BoundsTree& tree,
                                               std::span<const SearchVolume> volumes) {
  assert(volumes.size() <= kMostVolumes);
  tested_.fill(0);
  groups_ = 0;
  if (tree.count == 0 || volumes.empty()) return {};
  express(tree, volumes);
  const auto all = static_cast<unsigned>((std::uint64_t{1} << volumes.size()) - 1);
  roomFor(now_, 1)[0] = {0, all, 0};
  groups_ = 1;
  const auto levelAt = [&tree](std::uint32_t level) { return tree.floats + tree.layout.at[level]; };
  for (std::uint32_t level = tree.top(); level > 0; --level) {
    TreeGroup* out = roomFor(next_, groups_ * std::size_t{BoundsLayout::kWide});
    groups_ = kernels_.boxes(levelAt(level), tree.nodes(level), planes_.data(), now_.data(), groups_, out,
                             tested_.data());
    std::swap(now_, next_);
  }
  TreeSphere* out = roomFor(spheres_, groups_ * std::size_t{BoundsLayout::kWide});
  const unsigned found =
      kernels_.spheres(levelAt(0), tree.count, planes_.data(), now_.data(), groups_, out, tested_.data());
  return {out, found};
}

}  // namespace stadion
