#pragma once
/// Colours that say from which direction light comes, whatever is done to its brightness.
///
/// One component of the unit direction from the eye becomes a phase. Red, green and blue are waves of that
/// phase, a third of a turn apart, in linear light. Their ratio gives the phase back: blending scales all
/// three alike.
///
/// Frames   R is the rig. Units: components of unit directions.
/// Threads  const use from any number of threads.

#include "show/simulation/picture_source.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace stadion {

/// The sRGB colours of a turn.
class PhaseColours {
public:
  PhaseColours();
  const std::array<std::uint8_t, 3>& of(double turns) const;

private:
  std::vector<std::array<std::uint8_t, 3>> colours_;
};

class DirectionWave {
public:
  /// `frequency` is in turns for each unit of the component `axis`.
  DirectionWave(const PhaseColours& colours, int axis, double frequency)
      : colours_(colours), axis_(axis), frequency_(frequency) {}

  void paint(const SourceView& view, Picture& picture) const;

  struct Reading {
    double error = 0;  ///< component that was seen minus that of `direction`, within half a turn
    double gain = 0;   ///< brightness; 1 = as painted
  };
  /// Reads light, which is 1 where white was painted. `direction` has unit length.
  Reading read(const Vec3& light, const Vec3& direction) const;

private:
  const PhaseColours& colours_;
  int axis_;
  double frequency_;
};

/// Calls take(x, y, direction) for each pixel of a view of this size, with the unit direction of its centre.
template <class Take>
void forEachDirection(const SourceView& view, std::uint32_t width, std::uint32_t height, const Take& take) {
  // A pixel is the line in which two planes through the eye meet: one of its column and one of its row.
  const Mat4& m = view.clipFromRig;
  const Vec3 x = m.row(0).head<3>().transpose(), y = m.row(1).head<3>().transpose(),
             w = m.row(3).head<3>().transpose();
  std::vector<Vec3> columns(width);
  for (std::uint32_t i = 0; i < width; ++i) columns[i] = x - ((2 * i + 1.0) / width - 1) * w;
  for (std::uint32_t j = 0; j < height; ++j) {
    const Vec3 row = y - (1 - (2 * j + 1.0) / height) * w;
    for (std::uint32_t i = 0; i < width; ++i) {
      Vec3 d = columns[i].cross(row);
      if (d.dot(w) < 0) d = -d;
      take(i, j, Vec3(d / d.norm()));
    }
  }
}

}  // namespace stadion
