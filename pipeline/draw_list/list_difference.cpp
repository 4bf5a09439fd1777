#include "pipeline/draw_list/list_difference.h"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace stadion {
namespace {

/// Compares bits, so that numbers which are not finite equal themselves.
template <class T>
bool isSame(const T& a, const T& b) {
  return std::memcmp(static_cast<const void*>(&a), static_cast<const void*>(&b), sizeof(T)) == 0;
}

using Field = std::optional<std::string_view>;

Field differenceOf(const DrawItem& a, const DrawItem& b) {
  if (!isSame(a.model, b.model)) return "model";
  if (!isSame(a.mesh, b.mesh)) return "mesh";
  if (!isSame(a.owner, b.owner)) return "owner";
  if (!isSame(a.distance, b.distance)) return "distance";
  if (!isSame(a.pixels, b.pixels)) return "pixels";
  if (!isSame(a.level, b.level)) return "level";
  if (!isSame(a.figure, b.figure)) return "figure";
  if (!isSame(a.paint, b.paint)) return "paint";
  if (!isSame(a.views, b.views)) return "views";
  return {};
}

bool isSameLight(const DrawLight& a, const DrawLight& b) {
  return a.kind == b.kind && isSame(a.position, b.position) && isSame(a.direction, b.direction) &&
         isSame(a.colour, b.colour) && isSame(a.range, b.range) && isSame(a.cosInner, b.cosInner) &&
         isSame(a.cosOuter, b.cosOuter) && a.shadows == b.shadows;
}

bool isSameView(const DrawView& a, const DrawView& b) {
  return isSame(a.view, b.view) && isSame(a.projection, b.projection) && a.eye == b.eye;
}

std::optional<ListDifference> differenceOf(const std::vector<DrawItem>& a, const std::vector<DrawItem>& b,
                                           std::string_view name) {
  if (a.size() != b.size()) return ListDifference{name, {}};
  static_assert(std::is_trivially_copyable_v<DrawItem>);
  if (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(DrawItem)) == 0) return {};
  for (std::size_t i = 0; i < a.size(); ++i)
    if (const Field field = differenceOf(a[i], b[i])) return ListDifference{*field, a[i].owner};
  return {};
}

std::optional<ListDifference> differenceOf(const DrawShadows& a, const DrawShadows& b) {
  if (a.light != b.light || !isSame(a.axes, b.axes)) return ListDifference{"shadows", {}};
  for (std::size_t i = 0; i < a.rings.size(); ++i) {
    const DrawShadowRing &r = a.rings[i], &s = b.rings[i];
    if (r.still != s.still || r.stillKey != s.stillKey || r.movingKey != s.movingKey ||
        !isSame(r.offset, s.offset) || !isSame(r.movingArea, s.movingArea))
      return ListDifference{"shadow rings", {}};
    if (const auto casters = differenceOf(r.moving, s.moving, "shadow casters")) return casters;
  }
  return {};
}

}  // namespace

std::optional<ListDifference> differenceOf(const DrawList& a, const DrawList& b) {
  const auto named = [](std::string_view field) { return ListDifference{field, {}}; };
  if (a.wall != b.wall || !isSame(a.origin, b.origin)) return named("origin");
  if (a.viewCount != b.viewCount || !std::ranges::equal(a.views, b.views, isSameView)) return named("views");
  if (!isSame(a.viewer, b.viewer)) return named("viewer");
  if (!isSame(a.sky, b.sky)) return named("sky");
  if (!std::ranges::equal(a.lights, b.lights, isSameLight)) return named("lights");
  if (!std::ranges::equal(a.figures, b.figures)) return named("figures");
  if (!std::ranges::equal(a.paints, b.paints)) return named("paints");
  if (const auto opaque = differenceOf(a.opaque, b.opaque, "opaque")) return opaque;
  if (const auto transparent = differenceOf(a.transparent, b.transparent, "transparent")) return transparent;
  return differenceOf(a.shadows, b.shadows);
}

}  // namespace stadion
