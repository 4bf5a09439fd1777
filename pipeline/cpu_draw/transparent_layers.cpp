#include "pipeline/cpu_draw/transparent_layers.h"

#include "pipeline/cpu_draw/sample_places.h"
#include "pipeline/shader/shaders.h"

#include <algorithm>

namespace stadion {

void TransparentLayers::collect(const PictureShading& picture, std::size_t band, VisibleBand& visible,
                                const SurfaceBlocks& blocks) {
  const DrawKernels& kernels = *picture.kernels;
  const int samples = picture.rung.samples;
  triangles_.clear(), fragments_.clear();
  room_.resize(static_cast<std::size_t>(picture.paddedWidth()) * kBandRows);
  picture.setup->forEach(
      Transparency::Transparent, band, [&](const TriangleRecord& r, const TriangleStretch& s) {
        const unsigned number = triangles_.add(r, s);
        const int* present = nullptr;
        if (s.part->masked) {
          const unsigned block = triangles_.block(number, blocks);
          present = visible.cutouts().present(
              kernels, r, triangles_.blocks()[block], *picture.setup->materials()[s.material],
              picture.rung.nearestLevel, {visible.low(), visible.end(), picture.stride(), samples});
        }
        const unsigned made =
            kernels.coverLayer(r, number, samples, present, visible.samples(), room_.data());
        fragments_.insert(fragments_.end(), room_.begin(), room_.begin() + made);
      });
}

bool TransparentLayers::shade(const PictureShading& picture, std::size_t band, VisibleBand& visible,
                              const SurfaceBlocks& blocks) {
  collect(picture, band, visible, blocks);
  if (fragments_.empty()) return false;
  pixels_.clear(), numbers_.clear();
  for (const LayerFragment& f : fragments_) pixels_.push_back(f.pixel), numbers_.push_back(f.triangle);
  for (auto* values : {&red_, &green_, &blue_, &alpha_}) values->resize(fragments_.size());
  shading_.shade(picture, triangles_, blocks, pixels_, numbers_,
                 {red_.data(), green_.data(), blue_.data(), alpha_.data()});
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
  begins_.assign(pixels + 2, 0);
  for (const unsigned p : pixels_) ++begins_[place(p) + 2];
  for (std::size_t i = 2; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  byPixel_.resize(pixels_.size());
  for (unsigned i = 0; i < pixels_.size(); ++i) byPixel_[begins_[place(pixels_[i]) + 1]++] = i;
}

void TransparentLayers::findLayers(std::size_t at, int sample, int samples) {
  layers_.clear();
  const auto [dx, dy] = samplePlace(samples, sample);
  for (unsigned i = begins_[at]; i < begins_[at + 1]; ++i) {
    const LayerFragment& f = fragments_[byPixel_[i]];
    if (!(f.samples >> sample & 1) || !(alpha_[byPixel_[i]] > 0)) continue;
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
  const auto add = [&](const Colour3& c, float alpha) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += left * alpha * c[k];
    left *= 1 - alpha;
  };
  const std::size_t exact = std::min<std::size_t>(layers_.size(), kExactLayers);
  const auto colourOf = [&](const Layer& l) {
    return Colour3{red_[l.fragment], green_[l.fragment], blue_[l.fragment]};
  };
  for (std::size_t i = 0; i < exact; ++i) add(colourOf(layers_[i]), alpha_[layers_[i].fragment]);
  Colour3 mean{};
  float weight = 0, passed = 1;
  for (std::size_t i = exact; i < layers_.size(); ++i) {
    const float alpha = alpha_[layers_[i].fragment];
    const Colour3 c = colourOf(layers_[i]);
    for (std::size_t k = 0; k < 3; ++k) mean[k] += alpha * c[k];
    weight += alpha, passed *= 1 - alpha;
  }
  if (weight > 0) {
    for (float& c : mean) c /= weight;
    add(mean, 1 - passed);
  }
  for (std::size_t k = 0; k < 3; ++k) sum[k] += left * behind[k];
  return sum;
}

Colour3 TransparentLayers::over(std::size_t at, const BandColours& behind, int samples,
                                const unsigned* shown) {
  Colour3 sum{};
  for (int s = 0; s < samples; ++s) {
    findLayers(at, s, samples);
    const Colour3 c = blended(behind.ofSample(at, shown, s));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += c[k];
  }
  for (float& c : sum) c *= 1 / static_cast<float>(samples);
  return sum;
}

}  // namespace stadion
