#include "bench/looks/picture_errors.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace stadion::bench {
namespace {

constexpr std::size_t kAlpha = 3;

}  // namespace

void PictureErrors::add(const Picture& picture, const Picture& reference) {
  const std::size_t bytes = std::min(picture.rgba.size(), reference.rgba.size());
  for (std::size_t i = 0; i < bytes; ++i) {
    if (i % 4 == kAlpha) continue;
    ++counts_[static_cast<std::size_t>(std::abs(int{picture.rgba[i]} - int{reference.rgba[i]}))];
    ++channels_;
  }
}

double PictureErrors::mean() const {
  double sum = 0;
  for (std::size_t by = 0; by < counts_.size(); ++by)
    sum += static_cast<double>(by) * static_cast<double>(counts_[by]);
  return channels_ == 0 ? 0 : sum / static_cast<double>(channels_);
}

int PictureErrors::quantile(double part) const {
  const double wanted = std::ceil(part * static_cast<double>(channels_));
  double seen = 0;
  for (std::size_t by = 0; by < counts_.size(); ++by)
    if ((seen += static_cast<double>(counts_[by])) >= wanted) return static_cast<int>(by);
  return static_cast<int>(counts_.size()) - 1;
}

int PictureErrors::most() const {
  for (std::size_t by = counts_.size(); by-- > 0;)
    if (counts_[by] > 0) return static_cast<int>(by);
  return 0;
}

double PictureErrors::within(int difference) const {
  std::uint64_t near = 0;
  for (int by = 0; by <= difference && by < 256; ++by) near += counts_[static_cast<std::size_t>(by)];
  return channels_ == 0 ? 1 : static_cast<double>(near) / static_cast<double>(channels_);
}

double flicker(const PictureStep& picture, const PictureStep& reference) {
  double sum = 0;
  std::size_t channels = 0;
  for (std::size_t i = 0; i < picture.after.rgba.size(); ++i) {
    if (i % 4 == kAlpha) continue;
    const int change = picture.after.rgba[i] - picture.before.rgba[i];
    const int expected = reference.after.rgba[i] - reference.before.rgba[i];
    sum += std::abs(change - expected);
    ++channels;
  }
  return channels == 0 ? 0 : sum / static_cast<double>(channels);
}

}  // namespace stadion::bench
