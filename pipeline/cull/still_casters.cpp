#include "pipeline/cull/still_casters.h"

#include "pipeline/cull/bounds_search.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace stadion {
namespace {

/// What is smaller than this part of a texel casts no shadow that could be seen.
constexpr double kLeastCaster = 0.5;

/// What a ring reaches, as far as it does not depend on the thing.
SearchVolume volumeOf(const RingPlace& place) {
  SearchVolume ring;
  ring.origin = place.centre_W;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {1.0, -1.0})
      ring.volume.planes[ring.volume.count++] = {sign * place.axes.row(axis).transpose(),
                                                 axis < 2 ? kShadowReach[place.ring] : kShadowDepth};
  return ring;
}

RingCasters castersOf(const RingPlace& place, const SlotView& state) {
  auto items = std::make_shared<std::vector<DrawItem>>();
  RingCasters found;
  const auto consider = [&](const InstanceRecord& r) {
    if (!casts(r) || (r.flags & kMoves) != 0) return;
    const Vec3 p_L = place.axes * Vec3(r.centre[0], r.centre[1], r.centre[2]);
    if (!place.isReachedBy(r, p_L - place.centre_L)) return;
    items->push_back(place.itemOf(r));
    found.key += keyOf(items->back());
  };
  const std::array<SearchVolume, 1> ring{volumeOf(place)};
  BoundsSearch search;
  std::vector<std::uint32_t> near;
  for (const ChunkId id : state.chunks) {
    const ChunkView chunk = state.chunk(id);
    near.clear();
    for (const TreeSphere& sphere : search.find(chunk.bounds, ring))
      near.push_back(chunk.bounds.indexOf(sphere.place));
    std::ranges::sort(near);
    for (const std::uint32_t i : near)
      if (i < chunk.records.size() && !((chunk.hidden[i / 64] >> (i % 64)) & 1)) consider(chunk.records[i]);
  }
  for (const InstanceRecord& r : state.instances) consider(r);
  found.items = std::move(items);
  return found;
}

}  // namespace

std::uint64_t mixedBits(std::uint64_t x) {  // the finaliser of MurmurHash3
  x = (x ^ (x >> 33)) * 0xff51afd7ed558ccd;
  x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53;
  return x ^ (x >> 33);
}

bool casts(const InstanceRecord& r) {
  return r.radius >= 0 &&
         (r.flags & (InstanceRecord::kShown | InstanceRecord::kTransparent)) == InstanceRecord::kShown;
}

std::uint64_t keyOf(const DrawItem& item) {
  std::uint64_t key = item.mesh;
  for (std::size_t k = 0; k < 12; k += 2)
    key = mixedBits(key ^ (std::uint64_t{std::bit_cast<std::uint32_t>(item.model[k])} |
                           std::uint64_t{std::bit_cast<std::uint32_t>(item.model[k + 1])} << 32));
  return key;
}

bool RingPlace::isReachedBy(const InstanceRecord& r, const Vec3& p) const {
  const double radius = double{r.radius}, reach = kShadowReach[ring];
  // Not the other way round: what is not finite is left out.
  return std::max(std::abs(p.x()), std::abs(p.y())) < reach + radius &&
         std::abs(p.z()) < kShadowDepth + radius && !(radius < kLeastCaster * 2 * reach / kShadowTexels);
}

DrawItem RingPlace::itemOf(const InstanceRecord& r) const {
  DrawItem item;
  for (int k = 0; k < 12; ++k) {
    const double shift = k % 4 == 3 ? centre_W[k / 4] : 0.0;
    item.model[static_cast<std::size_t>(k)] = static_cast<float>(r.model[k] - shift);
  }
  item.mesh = r.mesh;
  item.owner = r.owner;
  item.figure = r.figure();
  return item;
}

RingCasters StillCasters::at(const RingPlace& place, const SlotView& state) {
  const std::lock_guard lock(mutex_);
  auto& kept = known_[place.ring];
  const auto known = std::ranges::find_if(kept, [&](const Known& k) {
    return k.casters.items && k.version == state.stillVersion && k.place == place;
  });
  if (known != kept.end()) return known->casters;
  const RingCasters casters = castersOf(place, state);
  // The result for a slot that was taken away meanwhile must not be kept for others.
  if (state.intact()) {
    std::rotate(kept.begin(), kept.end() - 1, kept.end());
    kept.front() = {place, state.stillVersion, casters};
  }
  return casters;
}

}  // namespace stadion
