#include "pipeline/frame_loop.h"

#include "engine/run_stopped.h"
#include "pipeline/list_queue.h"
#include "pipeline/swap_barrier.h"

#include <exception>
#include <new>
#include <thread>
#include <vector>

namespace stadion {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kNoWall = ~std::size_t{0};
constexpr std::uint64_t kNoFrame = ~std::uint64_t{0};

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
    try {
      series_.add(millisecondsSince(start_));
    } catch (const std::bad_alloc&) {
      // One duration less; what else needs memory will say so.
    }
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
      pacer_(options.pace, options.rate), times_(options.walls), clock_(options.rate, options.frameTimes),
      appStart_(kAppStarts) {}

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
  bool well = true;
  for (std::size_t wall = 0; well && wall < options_.walls; ++wall) well = openStage(wall);

  while (well) {
    const auto now = nextFrame();
    if (!now) break;
    well = appStage(*now, 0);
    for (std::size_t wall = 0; well && wall < options_.walls; ++wall)
      well = cullStage(wall, 0, now->frame, lists[wall]);
    for (std::size_t wall = 0; well && wall < options_.walls; ++wall) well = drawStage(wall, lists[wall]);
    well = well && swapStage(*now);
  }

  for (std::size_t wall = 0; wall < options_.walls; ++wall) closeStage(wall);
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

  const auto app = [&](std::size_t) {
    while (const auto now = nextFrame()) {
      const auto slot = slots.beginWrite();
      if (!slot) return;
      if (!appStage(*now, *slot)) break;
      slots.endWrite(*slot, now->frame);
    }
    slots.finish();
  };

  const auto cull = [&](std::size_t wall) {
    while (const auto lease = slots.lease(wall)) {
      DrawList* list = queues[wall].takeEmpty();
      if (!list) return;
      if (!cullStage(wall, lease->slot, lease->frame, *list)) return;
      list->abandoned = !slots.release(*lease);
      queues[wall].giveFilled(list);
    }
    queues[wall].finish();
  };

  const auto draw = [&](std::size_t wall) {
    if (!openStage(wall)) return;
    while (DrawList* list = queues[wall].takeFilled()) {
      if (!list->abandoned && !drawStage(wall, *list)) return;
      const TimeSignature now = list->signature;
      bool shown = true;
      if (!barrier.arrive([&] { shown = swapStage(now); }) || !shown) return;
      queues[wall].giveEmpty(list);
    }
  };

  // Whatever happens in one of the threads, the others must not wait for it.
  const auto started = [&](const char* what, std::size_t wall, const auto& work) {
    return std::thread([this, what, wall, &work, &stopAll] {
      guard(what, wall, kNoFrame, [&]() -> Failure { return work(wall), Failure(); });
      if (failed_) stopAll();
    });
  };
  const auto drawAndClose = [&](std::size_t wall) {
    draw(wall);
    if (failed_) stopAll();
    closeStage(wall);
  };

  std::vector<std::thread> threads;
  threads.reserve(1 + 2 * options_.walls);
  guard("starting the threads", kNoWall, kNoFrame, [&]() -> Failure {
    for (std::size_t wall = 0; wall < options_.walls; ++wall) {
      threads.push_back(started("Cull", wall, cull));
      threads.push_back(started("Draw", wall, drawAndClose));
    }
    threads.push_back(started("App", kNoWall, app));
    return Failure();
  });
  if (failed_) stopAll();
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
  const TimeSignature now = clock_.next(options_.delivery == Delivery::Latest ? ticks : 1);
  if (options_.end > 0 && now.time > options_.end) return std::nullopt;
  ++nextIndex_;
  return now;
}

/// Runs a piece of work; false, with the reason kept, if it did not succeed or threw something.
template <class Work>
bool FrameLoop::guard(const char* what, std::size_t wall, std::uint64_t frame, const Work& work) {
  try {
    Failure f = work();
    return !f || fail(std::move(*f));
  } catch (const RunStopped&) {
    outcome_.stopped = true;  // App alone waits for others, and App alone says so
    return false;
  } catch (const std::bad_alloc&) {
    return fail(what, wall, frame, "out of memory");
  } catch (const std::exception& e) {
    return fail(what, wall, frame, e.what());
  } catch (...) {
    return fail(what, wall, frame, "an unknown exception");
  }
}

bool FrameLoop::fail(const char* what, std::size_t wall, std::uint64_t frame, const char* why) noexcept {
  try {
    std::string text = what;
    if (wall != kNoWall) text += " of wall " + std::to_string(wall + 1);
    if (frame != kNoFrame) text += ", frame " + std::to_string(frame);
    return fail(Reason(text + ": " + why));
  } catch (...) {
    return fail(Reason("out of memory"));  // not even enough for a sentence
  }
}

bool FrameLoop::appStage(const TimeSignature& now, std::size_t slot) {
  appStart_[now.frame % kAppStarts] = Clock::now();
  const StageSpan span(times_.app, probe_, Stage::App, now.frame, 0);
  const bool well =
      guard("App", kNoWall, now.frame, [&]() -> Failure { return stages_.app(now, slot), Failure(); });
  if (well) ++outcome_.framesSimulated;
  return well;
}

bool FrameLoop::cullStage(std::size_t wall, std::size_t slot, std::uint64_t frame, DrawList& list) {
  const StageSpan span(times_.cull[wall], probe_, Stage::Cull, frame, wall);
  return guard("Cull", wall, frame, [&]() -> Failure { return stages_.cull(wall, slot, list), Failure(); });
}

bool FrameLoop::openStage(std::size_t wall) {
  return guard("opening", wall, kNoFrame, [&] { return stages_.openWall(wall); });
}

void FrameLoop::closeStage(std::size_t wall) {
  guard("closing", wall, kNoFrame, [&]() -> Failure { return stages_.closeWall(wall), Failure(); });
}

bool FrameLoop::drawStage(std::size_t wall, const DrawList& list) {
  const std::uint64_t frame = list.signature.frame;
  const StageSpan span(times_.draw[wall], probe_, Stage::Draw, frame, wall);
  return guard("Draw", wall, frame, [&] { return stages_.draw(wall, list); });
}

bool FrameLoop::swapStage(const TimeSignature& now) {
  {
    const StageSpan span(times_.swap, probe_, Stage::Swap, now.frame, 0);
    if (!guard("Swap", kNoWall, now.frame, [&] { return stages_.swap(now); })) return false;
  }
  const Clock::time_point shown = Clock::now();
  if (outcome_.framesShown++ > 0)
    times_.period.add(std::chrono::duration<double, std::milli>(shown - lastSwap_).count());
  lastSwap_ = shown;
  for (DurationSeries& latency : times_.latency)
    latency.add(millisecondsSince(appStart_[now.frame % kAppStarts]));
  return true;
}

bool FrameLoop::fail(Reason why) {
  const std::lock_guard lock(failureMutex_);
  if (!outcome_.failure) outcome_.failure = std::move(why);
  failed_ = true;
  return false;
}

}  // namespace stadion
