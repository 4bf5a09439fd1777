#pragma once
/// The waits of a thread between two frames. Which frame they were for is known when its stage ends: Cull
/// waits for a list, then for a frame.

#include "profiling/record/span_track.h"

#include <vector>

namespace stadion {

class FrameWaits {
public:
  /// Keeps the last two.
  void add(const SpanRecord& wait) {
    if (waits_.size() == kMost) waits_.erase(waits_.begin());
    waits_.push_back(wait);
  }
  void clear() { waits_.clear(); }
  auto begin() const { return waits_.begin(); }
  auto end() const { return waits_.end(); }

private:
  static constexpr std::size_t kMost = 2;
  std::vector<SpanRecord> waits_;
};

}  // namespace stadion
