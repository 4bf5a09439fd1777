#pragma once
/// Colours of a band: the triangles that the samples of a pixel show, each shaded once.
///
/// Places   of colours: first the pixels of all rows, then the fragments of pixels that several triangles
///          share.
/// Threads  one at a time. Keeps its memory from band to band.

#include "pipeline/cpu_draw/fragment_shading.h"
#include "pipeline/cpu_draw/visible_band.h"

#include <array>
#include <vector>

namespace stadion {

using Colour3 = std::array<float, 3>;

class BandColours {
public:
  /// The means of all pixels' samples.
  void shade(const PictureShading& picture, VisibleBand& band, const SurfaceBlocks& blocks);

  /// Red, green, blue and alpha of a pixel of the band, and of those to its right.
  float* at(int row, int x) { return colours_.data() + 4 * placeOf(row, x); }
  /// The colour of one sample; `shown`: the triangles of the pixel's samples.
  Colour3 ofSample(int row, int x, const unsigned* shown, int sample) const;

private:
  /// Pixels that have the colour of another one.
  struct Copy {
    unsigned to, from;
  };
  std::size_t placeOf(int row, int x) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  void find(const PictureShading& picture, const VisibleBand& band);
  void findCoarse(const DrawKernels& kernels, FragmentSearch& row);
  unsigned lowerLeft(const FragmentSearch& pixel) const;
  void mix();
  Colour3 colour(std::size_t place) const {
    return {colours_[4 * place], colours_[4 * place + 1], colours_[4 * place + 2]};
  }

  FragmentShading shading_;
  Fragments runs_, ones_;
  int width_ = 0;  ///< padded
  unsigned firstPart_ = 0;
  std::size_t sharedSize_ = 0;
  std::vector<SharedPixel> shared_;
  std::vector<float> weights_;
  std::vector<Copy> copies_;
  std::vector<float> colours_;
};

}  // namespace stadion
