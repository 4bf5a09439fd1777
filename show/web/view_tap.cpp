#include "show/web/view_tap.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace stadion {

bool ViewTap::ask(std::size_t wall, std::size_t view) {
  if (step_.load(std::memory_order_acquire) != Step::Idle) return false;
  copy_.wall = wall;
  wall_ = wall;
  copy_.view = view;
  step_.store(Step::Asked, std::memory_order_release);
  return true;
}

bool ViewTap::collect(Copy& copy) {
  if (step_.load(std::memory_order_acquire) != Step::Copied) return false;
  std::swap(copy, copy_);
  step_.store(Step::Idle, std::memory_order_release);
  return true;
}

bool ViewTap::wants(const TimeSignature& now) const {
  return step_.load(std::memory_order_acquire) == Step::Asked || (next_ && next_->wants(now));
}

bool ViewTap::wantsWall(const TimeSignature& now, std::size_t wall) const {
  const bool asked = step_.load(std::memory_order_acquire) == Step::Asked && wall_ == wall;
  return asked || (next_ && next_->wantsWall(now, wall));
}

Failure ViewTap::take(const TimeSignature& now, const std::vector<EyePictures>& walls) {
  if (step_.load(std::memory_order_acquire) == Step::Asked) copyView(walls, now.frame);
  return next_ && next_->wants(now) ? next_->take(now, walls) : kNoFailure;
}

void ViewTap::copyView(const std::vector<EyePictures>& walls, std::uint64_t frame) {
  copy_.frame = frame;
  const bool isThere = copy_.wall < walls.size() && copy_.view < walls[copy_.wall].eyes.size();
  if (copy_.wall < walls.size()) {
    // It may have been asked for after this wall had been drawn: then its picture is an old one.
    if (walls[copy_.wall].frame != frame) return;
  }
  if (!isThere) {
    copy_.picture = {};
    return step_.store(Step::Copied, std::memory_order_release);
  }
  const Picture& from = walls[copy_.wall].eyes[copy_.view];
  const std::uint32_t step = std::max(1u, (from.width + kWidest - 1) / kWidest);
  const std::uint32_t width = from.width / step, height = std::max(1u, from.height / step);
  Picture& to = copy_.picture;
  if (to.width != width || to.height != height) to = Picture(width, height);
  for (std::uint32_t y = 0; y < height; ++y) {
    const std::uint8_t* pixel = from.at(0, std::min(y * step, from.height - 1));
    std::uint8_t* out = to.at(0, y);
    for (std::uint32_t x = 0; x < width; ++x, pixel += 4 * step, out += 4) std::memcpy(out, pixel, 4);
  }
  step_.store(Step::Copied, std::memory_order_release);
}

}  // namespace stadion
