#pragma once
/// How far App has come, for walls that are slow on purpose, and whether it waits for one of them.

#include "engine/core/frame_probe.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace stadion {

class AppProgress final : public FrameProbe {
public:
  /// `frames` is how many App simulates.
  explicit AppProgress(std::uint64_t frames) : last_(frames - 1) {}

  void reached(std::uint64_t frame) { newest_ = frame; }
  /// For the Cull of a slow wall: waits until App has begun `more` further frames, or the last one. False:
  /// App has waited for a slot all the while, for nearly a second. A busy machine alone is no reason.
  bool goesOn(std::uint64_t more) const {
    const std::uint64_t wanted = std::min(newest_ + more, last_);
    std::uint64_t wait = 0;
    for (int ms = 0; newest_ < wanted; std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
      const std::uint64_t now = waits_;
      ms = now % 2 == 1 && now == wait ? ms + 1 : 0;
      wait = now;
      if (ms > 900) return false;
    }
    return true;
  }

  void began(Span what, std::uint64_t, std::uint32_t) override { note(what); }
  void began(Span, NodeRef) override {}
  void ended(Span what) override { note(what); }

private:
  /// Odd while App waits.
  void note(Span what) {
    if (what == Span::ForSlot) ++waits_;
  }

  std::uint64_t last_;
  std::atomic<std::uint64_t> newest_ = 0, waits_ = 0;
};

}  // namespace stadion
