#pragma once
/// Transparent surfaces of a band, in the right order for every sample.
///
/// Rule     The nearest kExactLayers fragments of a sample are blended one over the other. What lies behind
///          them is one layer more, as gl_draw/passes/glass_layers.h says.
/// Ties     at the same depth the later triangle of the list lies in front.
/// Threads  one at a time. Keeps its memory from band to band.

#include "pipeline/cpu_draw/band_colours.h"

#include <vector>

namespace stadion {

class TransparentLayers {
public:
  /// Finds and shades the fragments that nothing opaque hides; false: there are none.
  bool shade(const PictureShading& picture, std::size_t band, VisibleBand& visible,
             const SurfaceBlocks& blocks);
  /// Blends them over the pixels that have some.
  void blend(const PictureShading& picture, const VisibleBand& visible, BandColours& colours);

private:
  struct Layer {
    float depth;
    unsigned triangle, fragment;
  };
  void collect(const PictureShading& picture, std::size_t band, VisibleBand& visible,
               const SurfaceBlocks& blocks);
  /// Returns true if a pixel has some. `at`: (y - low) * width + x.
  bool has(std::size_t at) const { return begins_[at] != begins_[at + 1]; }
  Colour3 over(int row, int x, const BandColours& behind, int samples, const unsigned* shown);
  void sortByPixel(const PictureShading& picture, int low, std::size_t pixels);
  float alpha(unsigned fragment) const { return colours_[4 * std::size_t{fragment} + 3]; }
  Colour3 blended(Colour3 behind) const;
  void findLayers(std::size_t at, int sample, int samples);

  BandTriangles triangles_;
  FragmentShading shading_;
  std::vector<LayerFragment> room_, fragments_;
  Fragments list_;
  std::vector<float> colours_;  ///< red, green, blue and alpha of each
  int width_ = 0;
  std::vector<unsigned> begins_, byPixel_;  ///< fragments of each pixel
  std::vector<Layer> layers_;               ///< layers of the current sample, nearest first
};

}  // namespace stadion
