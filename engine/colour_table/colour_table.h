#pragma once
/// Colour look-up tables: what a display has to get so that it shows a colour as meant.
///
/// A table maps the encoded values of a pixel (red, green, blue from 0 to 1) to others. It has a curve for each
/// channel, or a solid, which knows a colour for each grid point of a cube of colours, or both: then the curves come
/// first.
///
/// Range    values below the lowest place of a table are taken for it, those above the highest for that. Results may
///          leave 0..1; a display gets 0 or 1 then.
/// Threads  plain values, any thread.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stadion {

struct ColourTable {
  /// The places of the first and the last entry, by channel. Expects low < high.
  struct Range {
    std::array<double, 3> low{0, 0, 0}, high{1, 1, 1};
    bool operator==(const Range&) const = default;
  };

  std::string title;
  std::uint32_t curveSize = 0;  ///< entries of each curve, at least 2; 0 = no curves
  Range curveRange;
  std::vector<float> curve;     ///< (curveSize x 3)
  std::uint32_t solidSize = 0;  ///< grid points along an edge, at least 2; 0 = no solid
  Range solidRange;
  std::vector<float> solid;  ///< (solidSize x solidSize x solidSize x 3): blue, green, red; red varies first

  bool empty() const { return curveSize == 0 && solidSize == 0; }
  bool operator==(const ColourTable&) const = default;
};

}  // namespace stadion
