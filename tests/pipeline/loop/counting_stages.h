#pragma once
/// Stages that only count, for tests of the loop that runs frames.

#include "pipeline/loop/frame_loop.h"

#include <array>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace stadion {

/// Stages that carry a number through the pipeline, with as many slots as there is real memory for.
class CountingStages : public Stages {
public:
  CountingStages(std::size_t walls, std::size_t memories) : memory_(memories), drawn_(walls) {}

  void app(const TimeSignature& now, std::size_t slot) override {
    // Written byte by byte, as it were: a reader that is let in too early sees a torn frame.
    Cell& c = memory_[slot % memory_.size()];
    for (auto& v : c.values) v.store(now.frame, std::memory_order_relaxed);
    c.signature = now;
  }
  void cull(std::size_t, std::size_t slot, DrawList& list) override {
    const Cell& c = memory_[slot % memory_.size()];
    list.ticket.signature = c.signature;
    for (const auto& v : c.values)
      if (v.load(std::memory_order_relaxed) != c.signature.frame) torn = true;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    for (const auto& v : c.values)
      if (v.load(std::memory_order_relaxed) != list.ticket.signature.frame) torn = true;
  }
  Failure openWall(std::size_t) override { return {}; }
  Failure draw(std::size_t wall, const DrawList& list) override {
    if (list.ticket.signature.frame == failAt && wall == 1) return "wall 1 is broken";
    drawn_[wall].push_back(list.ticket.signature.frame);
    return {};
  }
  void closeWall(std::size_t) override { ++closed; }
  Failure swap(const TimeSignature& now) override {
    for (const auto& d : drawn_)
      if (d.empty() || d.back() != now.frame) torn = true;
    shown.push_back(now.frame);
    return {};
  }

  std::vector<std::uint64_t> shown;
  std::atomic<bool> torn = false;
  std::atomic<int> closed = 0;
  std::uint64_t failAt = ~std::uint64_t{0};

private:
  struct Cell {
    std::array<std::atomic<std::uint64_t>, 64> values{};
    TimeSignature signature;
  };
  std::vector<Cell> memory_;
  std::vector<std::vector<std::uint64_t>> drawn_;
};

inline FrameLoopOutcome runFrames(CountingStages& stages, FrameLoopOptions options) {
  const std::atomic<bool> stop = false;
  FrameLoop loop(stages, options, stop);
  return loop.run();
}

}  // namespace stadion
