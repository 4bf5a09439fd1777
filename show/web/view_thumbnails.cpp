#include "show/web/view_thumbnails.h"

#include "pipeline/platform/idle_priority.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr std::chrono::milliseconds kAskAgain{20};
constexpr std::chrono::seconds kGiveUp{2};  ///< the show stands, or has ended

}  // namespace

Picture madeSmall(const Picture& picture, std::uint32_t width) {
  const std::uint32_t step = std::max(1u, (picture.width + width - 1) / width);
  if (step == 1 || picture.empty()) return picture;
  Picture small(std::max(1u, picture.width / step), std::max(1u, picture.height / step));
  for (std::uint32_t y = 0; y < small.height; ++y)
    for (std::uint32_t x = 0; x < small.width; ++x) {
      std::array<std::uint32_t, 3> sum{};
      std::uint32_t count = 0;
      for (std::uint32_t v = y * step; v < std::min((y + 1) * step, picture.height); ++v)
        for (std::uint32_t u = x * step; u < std::min((x + 1) * step, picture.width); ++u, ++count)
          for (std::size_t c = 0; c < 3; ++c) sum[c] += picture.at(u, v)[c];
      for (std::size_t c = 0; c < 3; ++c)
        small.at(x, y)[c] = static_cast<std::uint8_t>(sum[c] / std::max(1u, count));
    }
  return small;
}

ViewThumbnails::ViewThumbnails(ViewTap& tap) : tap_(tap), thread_([this] { work(); }) {}

ViewThumbnails::~ViewThumbnails() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void ViewThumbnails::setViews(std::vector<std::size_t> views) {
  const std::lock_guard lock(mutex_);
  places_.clear();
  for (std::size_t wall = 0; wall < views.size(); ++wall)
    for (std::size_t view = 0; view < views[wall]; ++view) places_.emplace_back(wall, view);
  turn_ = 0;
}

void ViewThumbnails::look() {
  {
    const std::lock_guard lock(mutex_);
    looked_ = Clock::now();
  }
  changed_.notify_all();
}

std::string ViewThumbnails::png(std::size_t wall, std::size_t view) const {
  const std::lock_guard lock(mutex_);
  const auto found = kept_.find({wall, view});
  return found == kept_.end() ? "" : found->second.png;
}

std::uint64_t ViewThumbnails::version(std::size_t wall, std::size_t view) const {
  const std::lock_guard lock(mutex_);
  const auto found = kept_.find({wall, view});
  return found == kept_.end() ? 0 : found->second.version;
}

/// Waits until the next view has its turn and a page shows the views. Nothing: the end.
std::optional<ViewThumbnails::Place> ViewThumbnails::next() {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kEvery, [&] { return ending_; });
  changed_.wait(lock, [&] { return ending_ || (!places_.empty() && Clock::now() - looked_ < kLooks); });
  if (ending_) return {};
  return places_[turn_++ % places_.size()];
}

void ViewThumbnails::work() {
  yieldToShow("web-views");
  ViewTap::Copy copy;
  while (const auto place = next()) {
    tap_.ask(place->first, place->second);
    const auto asked = Clock::now();
    bool copied = false;
    while (!(copied = tap_.collect(copy)) && Clock::now() - asked < kGiveUp) {
      std::unique_lock lock(mutex_);
      if (changed_.wait_for(lock, kAskAgain, [&] { return ending_; })) return;
    }
    if (!copied || copy.picture.empty()) continue;
    std::string png = pngOf(madeSmall(copy.picture, kWidth));
    const std::lock_guard lock(mutex_);
    Kept& kept = kept_[{copy.wall, copy.view}];
    kept.png = std::move(png);
    ++kept.version;
  }
}

}  // namespace stadion
