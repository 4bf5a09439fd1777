#pragma once
/// Transparent surfaces of a band, in the right order for every sample.
///
/// Rule     The nearest kExactLayers fragments of a sample are blended one over the other. What lies behind
///          them is one layer more, as draw/passes/glass_layers.h says.
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
  /// Whether a pixel has some. `at`: (y - low) * width + x.
  bool has(std::size_t at) const { return begins_[at] != begins_[at + 1]; }
  /// Blends them over a pixel's samples and returns the mean.
  Colour3 over(std::size_t at, const BandColours& behind, int samples, const unsigned* shown);

private:
  struct Layer {
    float depth;
    unsigned triangle, fragment;
  };
  void collect(const PictureShading& picture, std::size_t band, VisibleBand& visible,
               const SurfaceBlocks& blocks);
  void sortByPixel(const PictureShading& picture, int low, std::size_t pixels);
  Colour3 blended(Colour3 behind) const;
  void findLayers(std::size_t at, int sample, int samples);

  BandTriangles triangles_;
  FragmentShading shading_;
  std::vector<LayerFragment> room_, fragments_;
  std::vector<unsigned> pixels_, numbers_;
  std::vector<float> red_, green_, blue_, alpha_;
  std::vector<unsigned> begins_, byPixel_;  ///< fragments of each pixel
  std::vector<Layer> layers_;               ///< of one sample, nearest first
};

}  // namespace stadion
