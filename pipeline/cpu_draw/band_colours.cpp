#include "pipeline/cpu_draw/band_colours.h"

#include <algorithm>

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
  const float share = 1.0f / static_cast<float>(samples);
  for (int y = band.low(); y < band.end(); ++y) {
    const unsigned* shown = band.row(y);
    for (int x = 0; x < picture.width(); ++x, shown += samples) {
      const auto pixel = static_cast<unsigned>(x) | static_cast<unsigned>(y) << 16;
      const bool alike = std::all_of(shown + 1, shown + samples, [&](unsigned t) { return t == shown[0]; });
      if (alike && sharesWithNeighbour(picture, x, y, band.low(), shown[0])) continue;
      const auto first = static_cast<unsigned>(pixels_.size());
      if (alike) {
        add(pixel, shown[0], 1);
      } else {
        for (int s = 0; s < samples; ++s) {
          if (std::find(shown, shown + s, shown[s]) != shown + s) continue;
          add(pixel, shown[s], share * static_cast<float>(std::count(shown + s, shown + samples, shown[s])));
        }
      }
      at_.push_back({first, static_cast<unsigned>(pixels_.size()) - first});
    }
  }
}

void BandColours::shade(const PictureShading& picture, VisibleBand& band, const SurfaceBlocks& blocks) {
  find(picture, band);
  for (auto* values : {&red_, &green_, &blue_}) values->resize(pixels_.size());
  FragmentShading().shade(picture, band.triangles(), blocks, pixels_, triangles_,
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
