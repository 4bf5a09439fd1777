#include "pipeline/projection/pattern_pictures.h"

#include "pipeline/platform/idle_priority.h"

namespace stadion {

PatternPictures::~PatternPictures() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  asked_.notify_all();
  if (thread_.joinable()) thread_.join();
}

std::vector<Picture> PatternPictures::make(const Place& place) {
  const std::lock_guard lock(making_);
  if (!patterns_ && !failed_) {
    auto patterns = HallPatterns::create(walls_, stereo_);
    failed_ = !patterns;
    if (patterns) patterns_ = std::move(patterns.value());
  }
  if (!patterns_ || place.wall >= walls_.walls.size()) return {};
  return patterns_->pictures(place.wall, HallPattern::Room, place.width, place.height);
}

bool PatternPictures::copyTo(std::vector<Picture>& pictures, std::size_t wall, std::uint32_t width,
                             std::uint32_t height, bool waits) {
  const Place place{wall, width, height};
  std::unique_lock lock(mutex_, std::defer_lock);
  if (waits)
    lock.lock();
  else if (!lock.try_lock())
    return false;
  auto found = made_.find(place);
  if (found == made_.end() && waits) {
    lock.unlock();
    std::vector<Picture> made = make(place);
    lock.lock();
    found = made_.insert_or_assign(place, std::move(made)).first;
  }
  if (found != made_.end()) {
    if (!found->second.empty()) pictures = found->second;
    return !found->second.empty();
  }
  wanted_.insert(place);
  if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
  lock.unlock();
  asked_.notify_one();
  return false;
}

void PatternPictures::work() {
  yieldToShow("test-pattern");
  std::unique_lock lock(mutex_);
  for (;;) {
    asked_.wait(lock, [&] { return ending_ || !wanted_.empty(); });
    if (ending_) return;
    const Place place = *wanted_.begin();
    lock.unlock();
    std::vector<Picture> made = make(place);
    lock.lock();
    made_.insert_or_assign(place, std::move(made));
    wanted_.erase(place);
  }
}

}  // namespace stadion
