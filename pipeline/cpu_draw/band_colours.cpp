#include "pipeline/cpu_draw/band_colours.h"

#include <bit>

namespace stadion {

void BandColours::add(unsigned pixel, unsigned triangle, float weight) {
  pixels_.push_back(pixel), triangles_.push_back(triangle), weights_.push_back(weight);
}

/// Whether the fragment of the lower left pixel of two by two serves.
bool BandColours::sharesWithNeighbour(const PictureShading& picture, int x, int y, int low,
                                      unsigned triangle) {
  const int left = x & ~1, under = y & ~1;
  if (!picture.rung.coarse || triangle == kNoTriangle || (left == x && under == y) || under < low)
    return false;
  const Pixel there = at_[static_cast<std::size_t>((under - low) * picture.width() + left)];
  if (there.count != 1 || triangles_[there.first] != triangle) return false;
  at_.push_back(there);
  return true;
}

void BandColours::find(const PictureShading& picture, VisibleBand& band) {
  at_.clear(), pixels_.clear(), triangles_.clear(), weights_.clear();
  const int samples = picture.rung.samples;
  for (int y = band.low(); y < band.end(); ++y) {
    const unsigned* shown = band.row(y);
    for (int x = 0; x < picture.width(); ++x, shown += samples) {
      const auto pixel = static_cast<unsigned>(x) | static_cast<unsigned>(y) << 16;
      unsigned differs = 0;
      for (int s = 1; s < samples; ++s) differs |= shown[s] ^ shown[0];
      if (differs == 0 && sharesWithNeighbour(picture, x, y, band.low(), shown[0])) continue;
      const auto first = static_cast<unsigned>(pixels_.size());
      if (differs == 0)
        add(pixel, shown[0], 1);
      else
        addEach(pixel, shown, samples);
      at_.push_back({first, static_cast<unsigned>(pixels_.size()) - first});
    }
  }
}

/// The triangles of a pixel, in the order of its samples.
void BandColours::addEach(unsigned pixel, const unsigned* shown, int samples) {
  const float share = 1.0f / static_cast<float>(samples);
  for (unsigned left = (1U << samples) - 1; left != 0;) {
    const unsigned triangle = shown[std::countr_zero(left)];
    unsigned same = 0;
    for (int s = 0; s < samples; ++s) same |= static_cast<unsigned>(shown[s] == triangle) << s;
    add(pixel, triangle, share * static_cast<float>(std::popcount(same)));
    left &= ~same;
  }
}

void BandColours::shade(const PictureShading& picture, VisibleBand& band, const SurfaceBlocks& blocks) {
  find(picture, band);
  for (auto* values : {&red_, &green_, &blue_}) values->resize(pixels_.size());
  shading_.shade(picture, band.triangles(), blocks, pixels_, triangles_,
                 {red_.data(), green_.data(), blue_.data(), nullptr});
}

Colour3 BandColours::mean(std::size_t at) const {
  const Pixel p = at_[at];
  if (p.count == 1) return colour(p.first);
  Colour3 sum{};
  for (unsigned i = p.first; i < p.first + p.count; ++i)
    for (std::size_t k = 0; k < 3; ++k) sum[k] += weights_[i] * colour(i)[k];
  return sum;
}

Colour3 BandColours::ofSample(std::size_t at, const unsigned* shown, int sample) const {
  const Pixel p = at_[at];
  unsigned i = p.first;
  while (i + 1 < p.first + p.count && triangles_[i] != shown[sample]) ++i;
  return colour(i);
}

}  // namespace stadion
