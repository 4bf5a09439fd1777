#include "pipeline/cpu_draw/transparent_layers.h"

#include "pipeline/cpu_draw/sample_places.h"
#include "pipeline/shader/shaders.h"

#include <algorithm>

namespace stadion {

void TransparentLayers::collect(const PictureShading& picture, std::size_t band, VisibleBand& visible,
                                const SurfaceBlocks& blocks) {
  const DrawKernels& kernels = *picture.kernels;
  const int samples = picture.rung.samples;
  fragments_.clear();
  triangles_.collect(*picture.setup, Transparency::Transparent, band);
  room_.resize(static_cast<std::size_t>(picture.paddedWidth()) * kBandRows);
  visible.forRuns(picture, triangles_, blocks, [&](unsigned first, unsigned count, const int* present) {
    for (unsigned number = first; number < first + count; ++number) {
      const unsigned made = kernels.coverLayer(triangles_.record(number), number, samples, present,
                                               visible.samples(), room_.data());
      fragments_.insert(fragments_.end(), room_.begin(), room_.begin() + made);
    }
  });
}

bool TransparentLayers::shade(const PictureShading& picture, std::size_t band, VisibleBand& visible,
                              const SurfaceBlocks& blocks) {
  collect(picture, band, visible, blocks);
  if (fragments_.empty()) return false;
  list_.begin(triangles_.size(), fragments_.size());
  for (const LayerFragment& f : fragments_) list_.add(f.triangle, f.pixel, list_.list().size);
  colours_.resize(std::max(colours_.size(), 4 * fragments_.size()));
  shading_.shade(picture, triangles_, blocks, list_.list(), false, colours_.data());
  sortByPixel(picture, visible.low(),
              static_cast<std::size_t>(picture.width()) *
                  static_cast<std::size_t>(visible.end() - visible.low()));
  return true;
}

void TransparentLayers::sortByPixel(const PictureShading& picture, int low, std::size_t pixels) {
  const auto place = [&](unsigned pixel) {
    return static_cast<std::size_t>((static_cast<int>(pixel >> 16) - low) * picture.width()) +
           (pixel & 0xffff);
  };
  width_ = picture.width();
  begins_.assign(pixels + 2, 0);
  for (const LayerFragment& f : fragments_) ++begins_[place(f.pixel) + 2];
  for (std::size_t i = 2; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  byPixel_.resize(fragments_.size());
  for (unsigned i = 0; i < fragments_.size(); ++i) byPixel_[begins_[place(fragments_[i].pixel) + 1]++] = i;
}

void TransparentLayers::findLayers(std::size_t at, int sample, int samples) {
  layers_.clear();
  const auto [dx, dy] = samplePlace(samples, sample);
  for (unsigned i = begins_[at]; i < begins_[at + 1]; ++i) {
    const LayerFragment& f = fragments_[byPixel_[i]];
    if (!(f.samples >> sample & 1) || !(alpha(byPixel_[i]) > 0)) continue;
    const TriangleRecord& t = triangles_.record(f.triangle);
    const float right = static_cast<float>(static_cast<int>(f.pixel & 0xffff) - t.left) + dx;
    const float up = static_cast<float>(static_cast<int>(f.pixel >> 16) - t.low) + dy;
    layers_.push_back(
        {std::min(t.depthX * right + (t.depthY * up + t.depth), t.mostDepth), f.triangle, byPixel_[i]});
  }
  std::ranges::sort(layers_, [](const Layer& a, const Layer& b) {
    return a.depth > b.depth || (a.depth == b.depth && a.triangle > b.triangle);
  });
}

Colour3 TransparentLayers::blended(Colour3 behind) const {
  Colour3 sum{};
  float left = 1;
  const auto add = [&](const Colour3& c, float by) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += left * by * c[k];
    left *= 1 - by;
  };
  const std::size_t exact = std::min<std::size_t>(layers_.size(), kExactLayers);
  const auto colourOf = [&](const Layer& l) {
    const float* c = colours_.data() + 4 * std::size_t{l.fragment};
    return Colour3{c[0], c[1], c[2]};
  };
  for (std::size_t i = 0; i < exact; ++i) add(colourOf(layers_[i]), alpha(layers_[i].fragment));
  Colour3 mean{};
  float weight = 0, passed = 1;
  for (std::size_t i = exact; i < layers_.size(); ++i) {
    const float by = alpha(layers_[i].fragment);
    const Colour3 c = colourOf(layers_[i]);
    for (std::size_t k = 0; k < 3; ++k) mean[k] += by * c[k];
    weight += by;
    passed *= 1 - by;
  }
  if (weight > 0) {
    for (float& c : mean) c /= weight;
    add(mean, 1 - passed);
  }
  for (std::size_t k = 0; k < 3; ++k) sum[k] += left * behind[k];
  return sum;
}

/// The mean of a pixel's samples.
Colour3 TransparentLayers::over(int row, int x, const BandColours& behind, int samples,
                                const unsigned* shown) {
  const auto at =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  Colour3 sum{};
  for (int s = 0; s < samples; ++s) {
    findLayers(at, s, samples);
    const Colour3 c = blended(behind.ofSample(row, x, shown, s));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += c[k];
  }
  for (float& c : sum) c *= 1 / static_cast<float>(samples);
  return sum;
}

void TransparentLayers::blend(const PictureShading& picture, const VisibleBand& visible,
                              BandColours& colours) {
  const int samples = picture.rung.samples;
  std::size_t at = 0;
  for (int row = 0; row < visible.end() - visible.low(); ++row)
    for (int x = 0; x < width_; ++x, ++at)
      if (has(at)) {
        const unsigned* shown = visible.row(visible.low() + row) + std::ptrdiff_t{x} * samples;
        std::ranges::copy(over(row, x, colours, samples, shown), colours.at(row, x));
      }
}

}  // namespace stadion
