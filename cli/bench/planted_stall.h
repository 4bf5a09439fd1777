#pragma once
/// A probe that passes everything on, and makes one node wait on purpose while it simulates: to see whether
/// that is noticed. Only `stadion bench budgets` uses it.
///
/// Threads  as FrameProbe; the window is set before the run.

#include "engine/core/frame_probe.h"

#include <atomic>
#include <chrono>
#include <thread>

namespace stadion {

class PlantedStall final : public FrameProbe {
public:
  struct Where {
    NodeRef node;
    std::uint64_t from = 0, to = 0;  ///< frames, the last one excluded
    std::chrono::milliseconds length{50};
  };

  PlantedStall(FrameProbe& inner, Where where) : inner_(inner), where_(where) {}

  void began(Span what, std::uint64_t frame, std::uint32_t wall) override {
    inner_.began(what, frame, wall);
    if (what == Span::App) frame_ = frame;
  }
  void began(Span what, NodeRef node) override {
    inner_.began(what, node);
    // A node's cycle may simulate in two parts: once is enough.
    const bool hit = what == Span::Simulate && node == where_.node && frame_ >= where_.from &&
                     frame_ < where_.to && stalled_.exchange(frame_) != frame_;
    if (hit) std::this_thread::sleep_for(where_.length);
  }
  void ended(Span what) override { inner_.ended(what); }
  bool wantsShares(std::uint64_t frame, std::uint32_t wall) const override {
    return inner_.wantsShares(frame, wall);
  }
  void shared(Span what, std::uint64_t frame, std::uint32_t wall, std::span<const NodeRef> among) override {
    inner_.shared(what, frame, wall, among);
  }
  DrawSample drawSample(std::uint64_t frame, std::uint32_t wall) override {
    return inner_.drawSample(frame, wall);
  }
  bool wantsAlone(std::span<const NodeRef> owners) const override { return inner_.wantsAlone(owners); }
  std::size_t nextBatch(std::uint32_t wall, std::uint32_t eye, std::size_t batches) override {
    return inner_.nextBatch(wall, eye, batches);
  }
  void drewAlone(const IsolatedDrawTime& drawn, std::span<const NodeShare> nodes) override {
    inner_.drewAlone(drawn, nodes);
  }
  /// The frame that App is at.
  std::uint64_t frame() const { return frame_; }

private:
  FrameProbe& inner_;
  Where where_;
  std::atomic<std::uint64_t> frame_ = 0, stalled_ = kNoFrame;
};

}  // namespace stadion
