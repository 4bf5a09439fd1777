#pragma once
/// Everything that the bands of one picture need, apart from their own memory.

#include "pipeline/cpu_draw/picture_rung.h"
#include "pipeline/cpu_draw/picture_setup.h"

#include <cstdint>
#include <span>

namespace stadion {

struct PictureShading {
  const DrawKernels* kernels;
  const PictureSetup* setup;
  const SceneParameters* scene;
  const ShadowParameters* shadow;  ///< null: there are no shadows
  const ViewParameters* view;
  PictureRung rung;
  std::span<std::uint8_t> rgba;  ///< the picture (height x width x 4), rows from the top
  bool surfacesOnly = false;     ///< leaves out the sky and writes no picture: to measure what surfaces cost

  int width() const { return setup->geometry().width; }
  /// Rows of a band.
  int low(std::size_t band) const { return static_cast<int>(band) * kBandRows; }
  int end(std::size_t band) const {
    const int next = low(band) + kBandRows, height = setup->geometry().height;
    return next < height ? next : height;
  }
  /// Pixels of a row with room for the widest kernel.
  int paddedWidth() const { return (width() + kKernelPadding - 1) / kKernelPadding * kKernelPadding; }
  int stride() const { return paddedWidth() * rung.samples; }
};

}  // namespace stadion
