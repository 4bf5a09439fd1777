#pragma once
/// Draws the bands of a picture, one after the other or several at a time.
///
/// Threads  a PictureBand serves one thread at a time and keeps its memory; BandMemory lends them to any
///          number of threads. What a band looks like does not depend on the one that draws it.

#include "pipeline/cpu_draw/band_colours.h"
#include "pipeline/cpu_draw/picture_shading.h"
#include "pipeline/cpu_draw/transparent_layers.h"
#include "pipeline/cpu_draw/visible_band.h"

#include <memory>
#include <mutex>
#include <vector>

namespace stadion {

class PictureBand {
public:
  void draw(const PictureShading& picture, std::size_t band);

private:
  void encode(const PictureShading& picture);

  VisibleBand visible_;
  BandColours colours_;
  TransparentLayers layers_;
};

class BandMemory {
public:
  /// Draws a band with memory that is free, or new.
  void draw(const PictureShading& picture, std::size_t band);

private:
  std::unique_ptr<PictureBand> take();
  void giveBack(std::unique_ptr<PictureBand> band);

  std::mutex mutex_;
  std::vector<std::unique_ptr<PictureBand>> free_;
};

}  // namespace stadion
