#include "engine/figure/clip_markers.h"

#include <algorithm>

namespace stadion {

ClipMarkers::ClipMarkers(std::vector<Marker> markers) : markers_(std::move(markers)) {
  for (std::size_t i = 0; i < markers_.size(); ++i) {
    const std::size_t clip = markers_[i].clip;
    if (forwards_.size() <= clip) forwards_.resize(clip + 1), backwards_.resize(clip + 1);
    forwards_[clip].push_back(i);
    backwards_[clip].push_back(i);
  }
  const auto at = [&](std::size_t number) { return markers_[number].at; };
  for (std::vector<std::size_t>& numbers : forwards_) std::ranges::stable_sort(numbers, std::less(), at);
  for (std::vector<std::size_t>& numbers : backwards_) std::ranges::stable_sort(numbers, std::greater(), at);
}

std::span<const std::size_t> ClipMarkers::of(std::uint32_t clip, bool backwards) const {
  const auto& all = backwards ? backwards_ : forwards_;
  return clip < all.size() ? std::span<const std::size_t>(all[clip]) : std::span<const std::size_t>();
}

}  // namespace stadion
