#include "pipeline/target/monitor_rows.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

/// Returns an empty rectangle if they do not overlap.
PixelRectangle overlap(const PixelRectangle& a, const PixelRectangle& b) {
  const auto right = [](const PixelRectangle& r) { return r.x + std::int64_t{r.width}; };
  const auto bottom = [](const PixelRectangle& r) { return r.y + std::int64_t{r.height}; };
  const std::int32_t x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  const std::int64_t width = std::min(right(a), right(b)) - x, height = std::min(bottom(a), bottom(b)) - y;
  if (width <= 0 || height <= 0) return {};
  return {x, y, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

}  // namespace

std::vector<MonitorPart> partsOnMonitors(const PixelRectangle& content,
                                         std::span<const PixelRectangle> monitors, double pixels) {
  const auto scaled = [&](auto coordinates) {
    return std::lround(pixels * static_cast<double>(coordinates));
  };
  std::vector<MonitorPart> parts;
  for (const PixelRectangle& monitor : monitors) {
    const PixelRectangle shared = overlap(content, monitor);
    if (shared.width == 0) continue;
    MonitorPart part;
    part.place.x = static_cast<std::int32_t>(scaled(shared.x - content.x));
    part.place.y = static_cast<std::int32_t>(scaled(shared.y - content.y));
    part.place.width = static_cast<std::uint32_t>(scaled(shared.width));
    part.place.height = static_cast<std::uint32_t>(scaled(shared.height));
    part.firstRow = static_cast<std::int32_t>(scaled(content.y - monitor.y));
    parts.push_back(part);
  }
  std::ranges::stable_sort(parts, std::greater<>(), [](const MonitorPart& p) {
    return std::uint64_t{p.place.width} * p.place.height;
  });
  if (parts.empty())
    parts.push_back({{0, 0, static_cast<std::uint32_t>(scaled(content.width)),
                      static_cast<std::uint32_t>(scaled(content.height))},
                     static_cast<std::int32_t>(scaled(content.y))});
  return parts;
}

}  // namespace stadion
