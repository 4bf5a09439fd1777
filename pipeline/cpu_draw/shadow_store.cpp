#include "pipeline/cpu_draw/shadow_store.h"

#include "pipeline/cpu_draw/cutouts.h"
#include "pipeline/cpu_draw/picture_setup.h"
#include "pipeline/cpu_draw/surface_blocks.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr int kRingSide = static_cast<int>(kShadowTexels);
static_assert(2 * kRingSide == kShadowSide && kRingSide % kShadowTile == 0);
/// Away from the light, so that no surface shadows itself: by its slope, and by steps of the depth.
constexpr float kAwayBySlope = -2, kAwayBySteps = -4;
/// Enough for walls that draw successive frames.
constexpr std::size_t kMostSets = 4;

using RingArea = std::array<int, 4>;

/// The first texel of a ring in the set.
std::array<int, 2> cornerOf(std::size_t ring) {
  return {static_cast<int>(ring % 2) * kRingSide, static_cast<int>(ring / 2) * kRingSide};
}

/// What movers cover, with a texel around it.
RingArea movedOf(const DrawShadowRing& ring) {
  const auto& a = ring.movingArea;
  if (!(a[0] < a[2] && a[1] < a[3])) return {};
  const auto texel = [](float at) {
    return static_cast<int>(std::lround((0.5f + 0.5f * std::clamp(at, -1.0f, 1.0f)) * kRingSide));
  };
  return {std::max(texel(a[0]) - 1, 0), std::max(texel(a[1]) - 1, 0), std::min(texel(a[2]) + 1, kRingSide),
          std::min(texel(a[3]) + 1, kRingSide)};
}

RingArea aroundBoth(const RingArea& a, const RingArea& b) {
  if (a[0] >= a[2]) return b;
  if (b[0] >= b[2]) return a;
  return {std::min(a[0], b[0]), std::min(a[1], b[1]), std::max(a[2], b[2]), std::max(a[3], b[3])};
}

/// The light's view of a ring.
ViewGeometry geometryOf(const DrawShadows& shadows, std::size_t ring) {
  Mat4 toClip = Mat4::Identity();
  for (int k = 0; k < 3; ++k) {
    const auto along = [&](int axis) { return double{shadows.axes[static_cast<std::size_t>(3 * axis + k)]}; };
    toClip(0, k) = along(0) / kShadowReach[ring];
    toClip(1, k) = along(1) / kShadowReach[ring];
    toClip(2, k) = 0.5 * along(2) / kShadowDepth;
  }
  toClip(2, 3) = 0.5;
  const auto geometry = ViewGeometry::of(toClip, Mat4::Identity(), kShadowTexels, kShadowTexels);
  return geometry ? *geometry : ViewGeometry();
}

/// Draws the casters that reach into a band of a ring.
void drawCasterBand(const DrawKernels& kernels, const PictureSetup& setup, std::size_t band, float* depths,
                    int stride) {
  static constexpr SceneParameters kNoLight{};
  static constexpr ViewParameters kNoView{};
  const SurfaceBlocks blocks(kernels, setup, Look::Full, kNoLight, kNoView);
  Cutouts cutouts;
  BandTriangles list;
  const int low = static_cast<int>(band) * kBandRows, end = low + kBandRows;
  const BandSamples samples{depths + static_cast<std::ptrdiff_t>(low) * stride, nullptr, stride, low, end};
  for (const Transparency which : {Transparency::Opaque, Transparency::Transparent}) {
    list.collect(setup, which, band);
    for (const BandTriangles::Run& run : list.runs()) {
      if (!run.masked) kernels.coverDepth(list.records() + run.first, run.count, nullptr, samples);
      for (unsigned i = run.first; run.masked && i < run.first + run.count; ++i)
        kernels.coverDepth(list.records() + i, 1,
                           cutouts.present(kernels, setup, list, i, blocks, false, {low, end, stride, 1}),
                           samples);
    }
  }
}

}  // namespace

ShadowSet::ShadowSet() : depths_(std::size_t{kShadowSide} * kShadowSide), bounds_(2 * kTiles * kTiles) {}

bool ShadowSet::holds(const DrawShadows& shadows) const {
  for (std::size_t i = 0; i < kShadowRings; ++i)
    if (!rings_[i].drawn || rings_[i].stillKey != shadows.rings[i].stillKey ||
        rings_[i].movingKey != shadows.rings[i].movingKey)
      return false;
  return true;
}

/// Of the tiles that an area of a ring touches. A lookup begins in a tile and reaches three texels beyond it.
void ShadowSet::bound(std::size_t ring, const std::array<int, 4>& area) {
  if (area[0] >= area[2]) return;
  constexpr int kReach = 3, kCount = static_cast<int>(kTiles);
  const auto corner = cornerOf(ring);
  const int x0 = std::max(corner[0] + area[0] - kReach, 0) / kShadowTile,
            x1 = (corner[0] + area[2] - 1) / kShadowTile;
  const int y0 = std::max(corner[1] + area[1] - kReach, 0) / kShadowTile,
            y1 = (corner[1] + area[3] - 1) / kShadowTile;
  std::vector<float> least(kShadowSide), most(kShadowSide);
  const int left = x0 * kShadowTile, right = std::min((x1 + 1) * kShadowTile + kReach, kShadowSide);
  for (int ty = y0; ty <= y1; ++ty) {
    const int low = ty * kShadowTile, high = std::min(low + kShadowTile + kReach, kShadowSide);
    boundColumns(left, right, low, high, least.data(), most.data());
    for (int tx = x0; tx <= x1; ++tx) {
      const int first = tx * kShadowTile, end = std::min(first + kShadowTile + kReach, kShadowSide);
      const auto tile = static_cast<std::size_t>(2 * (ty * kCount + tx));
      bounds_[tile] = *std::min_element(least.data() + first, least.data() + end);
      bounds_[tile + 1] = *std::max_element(most.data() + first, most.data() + end);
    }
  }
}

/// Least and greatest depth of texels above each other.
void ShadowSet::boundColumns(int left, int right, int low, int high, float* least, float* most) const {
  const auto row = [&](int y) { return depths_.data() + static_cast<std::ptrdiff_t>(y) * kShadowSide; };
  std::copy(row(low) + left, row(low) + right, least + left);
  std::copy(row(low) + left, row(low) + right, most + left);
  for (int y = low + 1; y < high; ++y) {
    const float* depth = row(y);
    for (int x = left; x < right; ++x) {
      least[x] = std::min(least[x], depth[x]);
      most[x] = std::max(most[x], depth[x]);
    }
  }
}

ShadowParameters ShadowSet::parameters(const DrawShadows& shadows, int taps) const {
  ShadowParameters out{};
  const auto& a = shadows.axes;
  const auto depth = static_cast<float>(kShadowDepth);
  std::copy_n(a.begin(), 3, out.right), std::copy_n(a.begin() + 3, 3, out.up),
      std::copy_n(a.begin() + 6, 3, out.towards);
  out.depthScale = 0.5f / depth;
  for (std::size_t i = 0; i < kShadowRings; ++i) {
    const auto corner = cornerOf(i);
    const auto& offset = shadows.rings[i].offset;
    const auto reach = static_cast<float>(kShadowReach[i]);
    const auto middle = [](int at) { return (static_cast<float>(at) + 0.5f * kRingSide) / kShadowSide; };
    const float scale = 0.25f / reach;
    const float ring[4] = {middle(corner[0]) + offset[0] * scale, middle(corner[1]) + offset[1] * scale,
                           0.5f + 0.5f * offset[2] / depth, scale};
    std::ranges::copy(ring, out.rings[i]);
    out.lift[i] = 2 * reach / kRingSide;
  }
  out.depths = depths_.data();
  out.bounds = bounds_.data();
  out.taps = taps;
  return out;
}

std::shared_ptr<const ShadowSet> ShadowStore::find(const DrawShadows& shadows, const ListMeshes& meshes,
                                                   DrawPool& pool) {
  const std::lock_guard lock(mutex_);
  const auto held = std::ranges::find_if(sets_, [&](const auto& set) { return set->holds(shadows); });
  if (held != sets_.end()) {
    std::rotate(sets_.begin(), held, held + 1);
    return sets_.front();
  }
  const std::shared_ptr<ShadowSet> set = freeSet();
  update(*set, shadows, meshes, pool);
  return set;
}

/// Puts a set in front that nothing reads any more: a new one while there are few, else the one that was used
/// longest ago.
std::shared_ptr<ShadowSet> ShadowStore::freeSet() {
  const auto unread =
      std::ranges::find_if(sets_.rbegin(), sets_.rend(), [](const auto& s) { return s.use_count() == 1; });
  if (sets_.size() < 2 || unread == sets_.rend())
    sets_.insert(sets_.begin(), std::make_shared<ShadowSet>());
  else
    std::rotate(sets_.begin(), unread.base() - 1, unread.base());
  if (sets_.size() > kMostSets) sets_.pop_back();
  return sets_.front();
}

void ShadowStore::update(ShadowSet& set, const DrawShadows& shadows, const ListMeshes& meshes,
                         DrawPool& pool) {
  for (std::size_t ring = 0; ring < kShadowRings; ++ring) updateRing(set, shadows, ring, meshes, pool);
}

void ShadowStore::updateRing(ShadowSet& set, const DrawShadows& shadows, std::size_t ring,
                             const ListMeshes& meshes, DrawPool& pool) {
  const DrawShadowRing& now = shadows.rings[ring];
  ShadowSet::Ring& held = set.rings_[ring];
  const bool redrawn = !held.drawn || held.stillKey != now.stillKey;
  if (!redrawn && held.movingKey == now.movingKey) return;
  held.drawn = false;  // until it is finished; what interrupts it leaves it void
  const std::vector<float>& from = still(shadows, ring, meshes, pool).depths;
  const RingArea moved = movedOf(now),
                 area = redrawn ? RingArea{0, 0, kRingSide, kRingSide} : aroundBoth(held.moved, moved);
  const auto corner = cornerOf(ring);
  float* depths = set.depths_.data() + static_cast<std::ptrdiff_t>(corner[1]) * kShadowSide + corner[0];
  for (int y = area[1]; y < area[3]; ++y)
    std::copy(from.data() + y * kRingSide + area[0], from.data() + y * kRingSide + area[2],
              depths + y * kShadowSide + area[0]);
  drawCasters(shadows, ring, now.moving, meshes, pool, depths, kShadowSide);
  set.bound(ring, area);
  held = {now.stillKey, now.movingKey, true, moved};
}

const ShadowStore::Still& ShadowStore::still(const DrawShadows& shadows, std::size_t ring,
                                             const ListMeshes& meshes, DrawPool& pool) {
  Still& still = still_[ring];
  const DrawShadowRing& now = shadows.rings[ring];
  if (still.drawn && still.key == now.stillKey) return still;
  still.drawn = false;
  still.depths.assign(std::size_t{kShadowTexels} * kShadowTexels, 0.0f);
  if (now.still) drawCasters(shadows, ring, *now.still, meshes, pool, still.depths.data(), kRingSide);
  still.key = now.stillKey;
  still.drawn = true;
  return still;
}

void ShadowStore::drawCasters(const DrawShadows& shadows, std::size_t ring, std::span<const DrawItem> casters,
                              const ListMeshes& meshes, DrawPool& pool, float* depths, int stride) const {
  if (casters.empty()) return;
  PictureSetup setup(kernels_);
  setup.begin(geometryOf(shadows, ring), 1, kAwayBySlope, kAwayBySteps);
  for (const DrawItem& item : casters)
    if (const auto mesh = meshes.find(item))
      for (const Transparency which : {Transparency::Opaque, Transparency::Transparent})
        setup.add(mesh, 0, item.model, which);
  setup.divide();
  pool.run(setup.placePieces(), [&](std::size_t i) { setup.place(i); });
  pool.run(setup.setUpPieces(), [&](std::size_t i) { setup.setUp(i); });
  pool.run(setup.bands(), [&](std::size_t i) { drawCasterBand(kernels_, setup, i, depths, stride); });
}

}  // namespace stadion
