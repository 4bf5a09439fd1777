#pragma once
/// The newest frame's pictures, for a thread that shows them at its own pace.
///
/// Draw leaves them here and goes on. The next frame replaces pictures that were not fetched.
///
/// Threads  take() on the Draw threads, fetch() on any one other.

#include "pipeline/loop/show_stages.h"

#include <mutex>
#include <utility>
#include <vector>

namespace stadion {

class PictureMailbox final : public PictureSink {
public:
  bool wants(const TimeSignature&) const override { return true; }
  Failure take(const TimeSignature& now, const std::vector<EyePictures>& walls) override {
    const std::lock_guard lock(mutex_);
    if (closed_) return closed_;
    walls_ = walls;
    time_ = now;
    fresh_ = true;
    return {};
  }

  /// Reports that no pictures can be shown any more. Later take() calls fail with this reason.
  void close(Reason why) {
    const std::lock_guard lock(mutex_);
    closed_ = std::move(why);
  }

  /// If there are newer pictures than those fetched last, puts them into `walls` and returns true.
  bool fetch(std::vector<EyePictures>& walls, TimeSignature& time) {
    const std::lock_guard lock(mutex_);
    if (!fresh_) return false;
    std::swap(walls, walls_);
    time = time_;
    fresh_ = false;
    return true;
  }

private:
  std::mutex mutex_;
  std::vector<EyePictures> walls_;
  TimeSignature time_;
  bool fresh_ = false;
  Failure closed_;
};

}  // namespace stadion
