#pragma once
/// Colours of the fragments of a band: the triangles that the samples of a pixel show, each shaded once.
///
/// Threads  one at a time. Keeps its memory from band to band.

#include "pipeline/cpu_draw/visible_band.h"

#include <array>
#include <vector>

namespace stadion {

using Colour3 = std::array<float, 3>;

/// Shades fragments by material. A triangle kNoTriangle is the sky.
class FragmentShading {
public:
  struct Colours {
    float *red, *green, *blue, *alpha;
  };
  void shade(const PictureShading& picture, BandTriangles& triangles, const SurfaceBlocks& blocks,
             const std::vector<unsigned>& pixels, const std::vector<unsigned>& of, const Colours& out);

private:
  std::vector<unsigned> surface_, material_, order_, ends_;
};

class BandColours {
public:
  /// Fragments of a pixel lie next to each other.
  struct Pixel {
    unsigned first;
    unsigned count;
  };

  void shade(const PictureShading& picture, VisibleBand& band, const SurfaceBlocks& blocks);

  /// The mean of a pixel's samples. `at`: (y - low) * width + x.
  Colour3 mean(std::size_t at) const;
  /// The colour of one sample; `shown`: the triangles of the pixel's samples.
  Colour3 ofSample(std::size_t at, const unsigned* shown, int sample) const;

private:
  void find(const PictureShading& picture, VisibleBand& band);
  void add(unsigned pixel, unsigned triangle, float weight);
  void addEach(unsigned pixel, const unsigned* shown, int samples);
  bool sharesWithNeighbour(const PictureShading& picture, int x, int y, int low, unsigned triangle);
  Colour3 colour(std::size_t fragment) const { return {red_[fragment], green_[fragment], blue_[fragment]}; }

  FragmentShading shading_;
  std::vector<Pixel> at_;
  std::vector<unsigned> pixels_, triangles_;  ///< of fragments
  std::vector<float> weights_, red_, green_, blue_;
};

}  // namespace stadion
