#pragma once
/// The place of a window's content on the monitors. A display for interlaced pictures counts its own rows, so
/// a window's rows must be counted from the top of the monitor that shows them.
///
/// Units    screen coordinates, in which windows and monitors are placed; pixels of the content.
/// Threads  plain values.

#include <cstdint>
#include <span>
#include <vector>

namespace stadion {

struct PixelRectangle {
  std::int32_t x = 0, y = 0;  ///< upper left corner
  std::uint32_t width = 0, height = 0;

  bool operator==(const PixelRectangle&) const = default;
};

/// A part of a window that one monitor shows.
struct MonitorPart {
  PixelRectangle place;       ///< in the content [pixels]
  std::int32_t firstRow = 0;  ///< the monitor's row in which the top row of the whole content lies [pixels]

  bool operator==(const MonitorPart&) const = default;
};

/// Returns the parts of a content that has `pixels` for each screen coordinate, the largest part first. Never
/// empty: a content that lies on no monitor is one part.
std::vector<MonitorPart> partsOnMonitors(const PixelRectangle& content,
                                         std::span<const PixelRectangle> monitors, double pixels = 1);

}  // namespace stadion
