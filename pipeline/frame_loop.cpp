#include "pipeline/frame_loop.h"

#include "pipeline/list_queue.h"
#include "pipeline/swap_barrier.h"

#include <memory>
#include <thread>
#include <vector>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Times one stage of one frame, and tells the probe if there is one.
class StageSpan {
public:
  StageSpan(DurationSeries& series, FrameProbe* probe, Stage stage, std::uint64_t frame, std::size_t wall)
      : series_(series), probe_(probe), stage_(stage), frame_(frame),
        wall_(static_cast<std::uint32_t>(wall)) {
    if (probe_) probe_->stageBegan(stage_, frame_, wall_);
  }
  ~StageSpan() {
    if (probe_) probe_->stageEnded(stage_, frame_, wall_);
    series_.add(millisecondsSince(start_));
  }
  StageSpan(const StageSpan&) = delete;
  StageSpan& operator=(const StageSpan&) = delete;

private:
  DurationSeries& series_;
  FrameProbe* probe_;
  Stage stage_;
  std::uint64_t frame_;
  std::uint32_t wall_;
  Clock::time_point start_ = Clock::now();
};

}  // namespace

FrameLoop::FrameLoop(Stages& stages, const FrameLoopOptions& options, const std::atomic<bool>& stopRequested,
                     FrameProbe* probe)
    : stages_(stages), options_(options), stopRequested_(stopRequested), probe_(probe),
      pacer_(options.pace, options.rate), times_(options.walls), appStart_(kAppStarts) {}

FrameLoopOutcome FrameLoop::run() {
  if (options_.mode == Mode::Sequential)
    runSequential();
  else
    runPipelined();
  outcome_.missedTicks = pacer_.missed();
  return outcome_;
}

// One frame after the other, one stage after the other.
void FrameLoop::runSequential() {
  std::vector<DrawList> lists(options_.walls);
  for (std::size_t wall = 0; wall < options_.walls; ++wall)
    if (Failure f = stages_.openWall(wall)) fail(*f);

  while (const auto now = nextFrame()) {
    appStage(*now, 0);
    for (std::size_t wall = 0; wall < options_.walls; ++wall) cullStage(wall, 0, now->frame, lists[wall]);
    bool drawn = true;
    for (std::size_t wall = 0; drawn && wall < options_.walls; ++wall) drawn = drawStage(wall, lists[wall]);
    if (drawn) swapStage(*now);
  }

  for (std::size_t wall = 0; wall < options_.walls; ++wall) stages_.closeWall(wall);
}

// The same stages, overlapped: App fills slots, Cull turns slots into lists, Draw draws lists, all walls swap
// together.
void FrameLoop::runPipelined() {
  FrameSlots slots(options_.walls, options_.delivery);
  std::vector<ListQueue> queues(options_.walls);
  SwapBarrier barrier(options_.walls);
  const auto stopAll = [&] {
    slots.stop();
    for (ListQueue& q : queues) q.stop();
    barrier.stop();
  };

  const auto app = [&] {
    while (const auto now = nextFrame()) {
      const auto slot = slots.beginWrite();
      if (!slot) return;
      appStage(*now, *slot);
      slots.endWrite(*slot, now->frame);
    }
    slots.finish();
  };

  const auto cull = [&](std::size_t wall) {
    while (const auto lease = slots.lease(wall)) {
      DrawList* list = queues[wall].takeEmpty();
      if (!list) return;
      cullStage(wall, lease->slot, lease->frame, *list);
      list->abandoned = !slots.release(*lease);
      queues[wall].giveFilled(list);
    }
    queues[wall].finish();
  };

  const auto draw = [&](std::size_t wall) {
    if (Failure f = stages_.openWall(wall)) {
      fail(*f);
      stopAll();
    }
    while (DrawList* list = queues[wall].takeFilled()) {
      const bool drawn = list->abandoned || drawStage(wall, *list);
      const TimeSignature now = list->signature;
      bool shown = true;
      if (!drawn || !barrier.arrive([&] { shown = swapStage(now); }) || !shown) {
        stopAll();
        break;
      }
      queues[wall].giveEmpty(list);
    }
    stages_.closeWall(wall);
  };

  std::vector<std::thread> threads;
  threads.emplace_back(app);
  for (std::size_t wall = 0; wall < options_.walls; ++wall) {
    threads.emplace_back(cull, wall);
    threads.emplace_back(draw, wall);
  }
  for (std::thread& t : threads) t.join();
}

std::optional<TimeSignature> FrameLoop::nextFrame() {
  const bool all = options_.frames != 0 && nextIndex_ >= options_.frames;
  if (all || ending_ || failed_) return std::nullopt;
  if (stopRequested_) {
    outcome_.stopped = true;
    return std::nullopt;
  }
  const std::uint64_t ticks = pacer_.wait();
  // Where every frame counts, time goes by frames; where the newest counts, by the clock's ticks.
  if (nextIndex_ > 0) tick_ += options_.delivery == Delivery::Latest ? ticks : 1;
  TimeSignature now = signatureAt(tick_, options_.rate);
  now.frame = nextIndex_++;
  now.step = now.frame == 0 ? 0 : now.time - showTime_;
  showTime_ = now.time;
  return now;
}

void FrameLoop::appStage(const TimeSignature& now, std::size_t slot) {
  appStart_[now.frame % kAppStarts] = Clock::now();
  const StageSpan span(times_.app, probe_, Stage::App, now.frame, 0);
  stages_.app(now, slot);
  ++outcome_.framesSimulated;
}

void FrameLoop::cullStage(std::size_t wall, std::size_t slot, std::uint64_t frame, DrawList& list) {
  const StageSpan span(times_.cull[wall], probe_, Stage::Cull, frame, wall);
  stages_.cull(wall, slot, list);
}

bool FrameLoop::drawStage(std::size_t wall, const DrawList& list) {
  const StageSpan span(times_.draw[wall], probe_, Stage::Draw, list.signature.frame, wall);
  Failure f = stages_.draw(wall, list);
  if (f) fail(*f);
  return !f;
}

bool FrameLoop::swapStage(const TimeSignature& now) {
  Failure f;
  {
    const StageSpan span(times_.swap, probe_, Stage::Swap, now.frame, 0);
    f = stages_.swap(now);
  }
  if (f) {
    fail(*f);
    return false;
  }
  const Clock::time_point shown = Clock::now();
  if (outcome_.framesShown++ > 0)
    times_.period.add(std::chrono::duration<double, std::milli>(shown - lastSwap_).count());
  lastSwap_ = shown;
  for (DurationSeries& latency : times_.latency)
    latency.add(millisecondsSince(appStart_[now.frame % kAppStarts]));
  return true;
}

void FrameLoop::fail(std::string why) {
  const std::lock_guard lock(failureMutex_);
  if (!outcome_.failure) outcome_.failure = std::move(why);
  failed_ = true;
}

}  // namespace stadion
