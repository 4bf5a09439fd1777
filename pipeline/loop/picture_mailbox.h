#pragma once
/// The newest frame's pictures, for whoever shows them at a pace of their own.
///
/// Draw leaves them here and goes on; what nobody has fetched by the next frame is replaced.
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

  /// Nobody can show anything any more: who draws on is told why.
  void close(Reason why) {
    const std::lock_guard lock(mutex_);
    closed_ = std::move(why);
  }

  /// True, and the pictures in the place of `walls`, if there are newer ones than those fetched last.
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
