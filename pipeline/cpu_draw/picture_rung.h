#pragma once
/// A rung of the ladder of pictures: what a view's picture costs, and how near it comes to the best one.

#include "pipeline/shader/look.h"

#include <cstdint>

namespace stadion {

struct PictureRung {
  Look look = Look::Full;
  int samples = 4;            ///< for each pixel: 1, 2, 4 or 8
  int shadowTaps = 16;        ///< texels of the shadow map that are compared: 16 or 4
  bool nearestLevel = false;  ///< textures are read from one level instead of two
  bool coarse = false;        ///< inside of triangles two by two pixels are shaded once
  bool reflections = true;    ///< shiny surfaces mirror an environment's maps; else its harmonics alone

  static PictureRung of(const RenderQuality& quality) {
    PictureRung rung;
    rung.look = quality.look;
    rung.reflections = quality.reflections;
    rung.samples = quality.samples <= 1 ? 1 : quality.samples <= 2 ? 2 : quality.samples <= 4 ? 4 : 8;
    return rung;
  }
  /// What is drawn under stress (ViewerRecord::stress): for each quarter of an octave half the samples, which
  /// save more time for an error than any other setting (README.md). Beyond one sample, shiny surfaces
  /// mirror harmonics.
  PictureRung under(double stress) const {
    constexpr double kQuarter = 1.1892;  // of an octave
    PictureRung rung = *this;
    double step = 1.09;
    for (; stress > step && rung.samples > 1; step *= kQuarter) rung.samples /= 2;
    rung.reflections = rung.reflections && stress <= step;
    return rung;
  }
  bool operator==(const PictureRung&) const = default;
};

}  // namespace stadion
