#include "pipeline/cull/shadow_cull.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace stadion {
namespace {

/// How far inside a ring, in texels of the next one, its own texels alone are looked up: the lookups there
/// reach that far. Of the ring itself a fiftieth at the edge is left to the next one (shaders.cpp).
constexpr double kLookup = 4, kUsed = 0.98;

/// Returns a hash of the layers that a figure plays.
std::uint64_t keyOf(const FigureRecord& figure) {
  std::uint64_t key = figure.layerCount | std::uint64_t{figure.addedCount} << 32;
  const auto add = [&](const ClipLayer& layer) {
    key = mixedBits(
        key ^ (std::uint64_t{layer.clip} | std::uint64_t{std::bit_cast<std::uint32_t>(layer.weight)} << 32));
    key = mixedBits(key ^ std::bit_cast<std::uint64_t>(layer.time));
  };
  for (const ClipLayer& layer : figure.layers) add(layer);
  for (const ClipLayer& layer : figure.added) add(layer);
  return key;
}

/// Right, up and towards the light: any frame will do that depends on the direction alone.
Mat3 axesTowards(const Vec3& light) {
  const Vec3 helper = std::abs(light.z()) < 0.99 ? Vec3::UnitZ() : Vec3::UnitY();
  const Vec3 right = helper.cross(light).normalized();
  Mat3 axes;
  axes.row(0) = right;
  axes.row(1) = light.cross(right);
  axes.row(2) = light;
  return axes;
}

}  // namespace

ShadowCull::ShadowCull(const SlotView& state, StillCasters& still, DrawList& out)
    : shadows_(out.shadows), figures_(state.figures), origin_(out.origin) {
  shadows_.light = -1;
  const auto shades = [](const DrawLight& l) { return l.kind == DrawLight::Kind::Directional && l.shadows; };
  const auto light = std::ranges::find_if(out.lights, shades);
  if (light == out.lights.end()) return;
  const auto index = static_cast<std::size_t>(light - out.lights.begin());
  const double* d = state.lights[index].direction;
  const Vec3 towards = -Vec3(d[0], d[1], d[2]);
  if (!towards.allFinite() || towards.squaredNorm() < 0.5) return;
  shadows_.light = static_cast<std::int32_t>(index);
  axes_ = axesTowards(towards.normalized());
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t k = 0; k < 3; ++k)
      shadows_.axes[3 * row + k] =
          static_cast<float>(axes_(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(k)));
  for (std::size_t ring = 0; ring < kShadowRings; ++ring) {
    const double* c = state.shadows->centre[ring];
    placeRing(ring, Vec3(c[0], c[1], c[2]));
    const RingCasters casters = still.at(places_[ring], state);
    shadows_.rings[ring].still = casters.items;
    shadows_.rings[ring].stillKey += casters.key;
  }
}

void ShadowCull::placeRing(std::size_t index, const Vec3& centre) {
  DrawShadowRing& ring = shadows_.rings[index];
  const double texel = 2 * kShadowReach[index] / kShadowTexels;
  Vec3 c_L = axes_ * centre;
  for (int k = 0; k < 2; ++k) c_L[k] = std::round(c_L[k] / texel) * texel;
  places_[index] = {index, axes_, c_L, axes_.transpose() * c_L};
  const Vec3 offset = axes_ * origin_ - c_L;
  for (std::size_t k = 0; k < 3; ++k) ring.offset[k] = static_cast<float>(offset[static_cast<int>(k)]);
  ring.moving.clear();
  ring.stillKey = 0;
  for (const double x : {c_L[0], c_L[1], c_L[2], axes_(2, 0), axes_(2, 1), axes_(2, 2)})
    ring.stillKey = mixedBits(ring.stillKey ^ std::bit_cast<std::uint64_t>(x));
  ring.movingKey = 0;
  ring.movingArea = {1, 1, -1, -1};
}

/// Returns true if all that may see the shadow of this ball is looked up in that ring or in a finer one.
bool ShadowCull::coveredBy(std::size_t ring, const Vec3& p_L, double radius) const {
  const Vec3 p = p_L - places_[ring].centre_L;
  const double nextTexel = 2 * kShadowReach[ring + 1] / kShadowTexels;
  return std::max(std::abs(p.x()), std::abs(p.y())) + radius <
         kUsed * kShadowReach[ring] - kLookup * nextTexel;
}

void ShadowCull::cast(const InstanceRecord& r) {
  if (!casts(r)) return;
  const double radius = double{r.radius};
  const Vec3 p_L = axes_ * Vec3(r.centre[0], r.centre[1], r.centre[2]);
  for (std::size_t index = 0; index < kShadowRings; ++index) {
    // What moves costs a drawing in each frame, so it is drawn only where it is looked up. What stands still
    // is drawn everywhere, so that the outer rings need not be drawn again when the inner ones follow the
    // head.
    if (index > 0 && coveredBy(index - 1, p_L, radius)) break;
    const double reach = kShadowReach[index];
    const Vec3 p = p_L - places_[index].centre_L;
    if (!places_[index].isReachedBy(r, p)) continue;
    DrawShadowRing& ring = shadows_.rings[index];
    ring.moving.push_back(places_[index].itemOf(r));
    ring.movingKey += keyOf(ring.moving.back());
    if (const std::uint32_t figure = r.figure(); figure != 0 && figure <= figures_.size())
      ring.movingKey += mixedBits(keyOf(figures_[figure - 1]) ^ keyOf(ring.moving.back()));
    auto& area = ring.movingArea;
    for (std::size_t k = 0; k < 2; ++k) {
      const double at = p[static_cast<int>(k)];
      area[k] = std::min(area[k], static_cast<float>((at - radius) / reach));
      area[2 + k] = std::max(area[2 + k], static_cast<float>((at + radius) / reach));
    }
  }
}

}  // namespace stadion
