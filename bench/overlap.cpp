#include "bench/overlap.h"

#include "engine/maths/median.h"

#include <algorithm>
#include <thread>

namespace stadion {
namespace {

class WaitingStages final : public Stages {
public:
  explicit WaitingStages(const OverlapTimes& times) : times_(times) {}

  void app(const TimeSignature& now, std::size_t slot) override {
    wait(times_.app);
    signatures_[slot] = now;
  }
  void cull(std::size_t, std::size_t slot, DrawList& list) override {
    wait(times_.cull);
    list.ticket.signature = signatures_[slot];
  }
  Failure openWall(std::size_t) override { return {}; }
  Failure draw(std::size_t, const DrawList&) override {
    wait(times_.draw);
    return {};
  }
  void closeWall(std::size_t) override {}
  Failure swap(const TimeSignature&) override { return {}; }

private:
  static void wait(double ms) { std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(ms)); }

  OverlapTimes times_;
  std::array<TimeSignature, kSlots> signatures_;
};

}  // namespace

double overlapPeriod(Mode mode, const OverlapTimes& times) {
  WaitingStages stages(times);
  FrameLoopOptions options;
  options.mode = mode;
  options.walls = times.walls;
  options.frames = times.frames;
  const std::atomic<bool> stop = false;
  FrameLoop loop(stages, options, stop);
  loop.run();
  return median(loop.times().period.values());
}

}  // namespace stadion
