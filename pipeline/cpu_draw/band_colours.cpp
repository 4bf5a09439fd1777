#include "pipeline/cpu_draw/band_colours.h"

#include <algorithm>

namespace stadion {
namespace {

bool showsOne(const unsigned* shown, int samples) {
  return std::all_of(shown + 1, shown + samples, [&](unsigned s) { return s == shown[0]; });
}

}  // namespace

void BandColours::find(const PictureShading& picture, const VisibleBand& band) {
  const int samples = picture.rung.samples, rows = band.end() - band.low();
  width_ = picture.paddedWidth();
  firstPart_ = static_cast<unsigned>(rows * width_);
  const auto pixels = static_cast<std::size_t>(firstPart_), most = pixels * static_cast<std::size_t>(samples);
  const unsigned sky = band.triangles().size();
  runs_.begin(sky, pixels);
  ones_.begin(sky, most);
  copies_.clear();
  if (shared_.size() < pixels) shared_.resize(pixels);
  if (weights_.size() < most) weights_.resize(most);
  FragmentSearch search{};
  search.samples = samples;
  search.width = picture.width();
  search.sky = sky;
  search.runs = &runs_.list();
  search.ones = &ones_.list();
  search.shared = shared_.data();
  search.weight = weights_.data();
  search.firstPart = firstPart_;
  for (int row = 0; row < rows; ++row) {
    search.shown = band.row(band.low() + row);
    search.y = band.low() + row;
    search.place = static_cast<unsigned>(placeOf(row, 0));
    picture.rung.coarse ? findCoarse(*picture.kernels, search) : picture.kernels->findFragments(search);
  }
  sharedSize_ = search.sharedSize;
  if (const std::size_t size = 4 * (pixels + search.parts); colours_.size() < size) colours_.resize(size);
}

/// Pixels whose triangle fills the lower left one of two by two pixels, too, take its colour.
void BandColours::findCoarse(const DrawKernels& kernels, FragmentSearch& row) {
  const FragmentSearch whole = row;
  const auto x = [&] { return row.x; };
  row.width = 1;
  for (; x() < whole.width; ++row.x, ++row.place, row.shown += row.samples) {
    if (!showsOne(row.shown, row.samples))
      kernels.findFragments(row);
    else if (const unsigned from = lowerLeft(row); from != row.place)
      copies_.push_back({row.place, from});
    else
      ones_.add(std::min(row.shown[0], row.sky),
                static_cast<unsigned>(row.x) | static_cast<unsigned>(row.y) << 16, row.place);
  }
  row.x = whole.x;
  row.width = whole.width;
}

/// The place whose colour serves for a pixel that shows one triangle.
unsigned BandColours::lowerLeft(const FragmentSearch& pixel) const {
  const int left = pixel.x % 2, down = pixel.y % 2, back = down * width_ + left;
  const unsigned* there = pixel.shown - std::ptrdiff_t{back} * pixel.samples;
  const bool serves =
      pixel.shown[0] != kNoTriangle && there[0] == pixel.shown[0] && showsOne(there, pixel.samples);
  return serves ? pixel.place - static_cast<unsigned>(back) : pixel.place;
}

void BandColours::shade(const PictureShading& picture, VisibleBand& band, const SurfaceBlocks& blocks) {
  find(picture, band);
  shading_.shade(picture, band.triangles(), blocks, runs_.list(), true, colours_.data());
  shading_.shade(picture, band.triangles(), blocks, ones_.list(), false, colours_.data());
  mix();
}

void BandColours::mix() {
  for (std::size_t i = 0; i < sharedSize_; ++i) {
    const SharedPixel& p = shared_[i];
    float sum[4]{};
    for (unsigned part = p.first; part < p.first + p.count; ++part) {
      const float* c = colours_.data() + 4 * (std::size_t{firstPart_} + part);
      for (int k = 0; k < 4; ++k) sum[k] += weights_[part] * c[k];
    }
    std::copy_n(sum, 4, colours_.data() + 4 * std::size_t{p.place});
  }
  for (const Copy& c : copies_)
    std::copy_n(colours_.data() + 4 * std::size_t{c.from}, 4, colours_.data() + 4 * std::size_t{c.to});
}

Colour3 BandColours::ofSample(int row, int x, const unsigned* shown, int sample) const {
  const std::size_t place = placeOf(row, x);
  const auto end = shared_.begin() + static_cast<std::ptrdiff_t>(sharedSize_);
  const auto at = std::lower_bound(shared_.begin(), end, place,
                                   [](const SharedPixel& p, std::size_t to) { return p.place < to; });
  if (at == end || at->place != place) return colour(place);
  // Its parts are in the order in which its samples show new triangles.
  unsigned part = at->first;
  for (int s = 0; shown[s] != shown[sample]; ++s) part += std::find(shown, shown + s, shown[s]) == shown + s;
  return colour(firstPart_ + std::size_t{part});
}

}  // namespace stadion
