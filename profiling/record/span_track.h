#pragma once
/// The spans of one thread, on their way to the thread that collects them.
///
/// Threads  began() and ended() on the thread itself, take() on the collector's; they meet without a lock.

#include "engine/core/frame_probe.h"
#include "profiling/record/allocations.h"
#include "profiling/record/record_ring.h"
#include "profiling/record/run_delay.h"
#include "profiling/record/tick_clock.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <sys/resource.h>
#include <utility>

namespace stadion {

using ProfileClock = std::chrono::steady_clock;

/// The cost of recording a span: the part inside the span's time, and the part outside of it [ns].
struct SpanOverhead {
  double inside = 0, outside = 0;
};

/// The system's figures of a thread.
struct ThreadUse {
  double processor = 0;        ///< [ms]
  std::uint64_t switches = 0;  ///< times that the thread lost its processor to others
  std::uint64_t faults = 0;    ///< pages that had to be fetched
  double delayed = 0;          ///< [ms] ready but without a processor; for Draw also the rasteriser's threads
  double late = 0;             ///< [ms] the same, between the thread's previous stage and this one

  static ThreadUse now() {
    rusage use{};
    getrusage(RUSAGE_THREAD, &use);
    const auto ms = [](const timeval& t) {
      return 1e3 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_usec);
    };
    return {ms(use.ru_utime) + ms(use.ru_stime), static_cast<std::uint64_t>(use.ru_nivcsw),
            static_cast<std::uint64_t>(use.ru_minflt + use.ru_majflt), 0, 0};
  }
  ThreadUse since(const ThreadUse& then) const {
    return {processor - then.processor, switches - then.switches, faults - then.faults, 0, 0};
  }
};

/// A counted amount of work, within a span that is under way.
struct CountRecord {
  Count what = Count::Visits;
  std::uint64_t amount = 0;
  Span within = Span::App;
  std::uint64_t frame = kNoFrame;
  std::uint32_t wall = kNoWall;
  NodeRef node;                   ///< the working node, if there is one
  ProfileClock::time_point when;  ///< start of that span
};

/// A finished span. Within a thread, spans come in the order of their ends: parts before their whole.
struct SpanRecord {
  ProfileClock::time_point began, ended;  ///< as measured, recording included
  std::uint64_t frame = kNoFrame;
  std::uint32_t wall = kNoWall;
  NodeRef node;
  Span what = Span::App;
  std::uint8_t depth = 0;  ///< 0 = in no other
  bool whole = true;  ///< the span belongs to a frame in which every node's spans are recorded (FrameLog)
  double took = 0;    ///< [ms] without recording
  double own = 0;     ///< [ms] of it outside its parts
  ThreadUse use;      ///< resource use of the thread; for stages
  Allocations allocations;  ///< parts included
  bool disturbed = false;   ///< some of these were the probe's own
};

class SpanTrack {
public:
  static constexpr std::size_t kCapacity = 1 << 16, kCountCapacity = 1 << 12;
  static constexpr std::size_t kDeepest = 12;

  explicit SpanTrack(SpanOverhead overhead = {}) : overhead_(overhead) {}

  /// Parts of the span inherit the frame and the wall. Inline always: each node's visit calls it.
  [[gnu::always_inline]] void began(Span what, std::uint64_t frame, std::uint32_t wall, NodeRef node) {
    if (depth_ >= kDeepest) {
      ++depth_;
      return;
    }
    Open& open = open_[depth_++];
    open.what = what;
    open.frame = frame;
    open.wall = wall;
    open.node = node;
    open.within = 0;
    open.spans = 0;
    if (isStage(what)) {
      open.use = ThreadUse::now();
      delayed(open);
    }
    open.allocations = allocationsSoFar();
    open.began = ProfileClock::now();
  }
  void ended() {
    const ProfileClock::time_point now = ProfileClock::now();
    if (depth_ == 0 || --depth_ >= kDeepest) return;
    const Open& open = open_[depth_];
    const double recording = overhead_.inside + open.spans * (overhead_.inside + overhead_.outside);
    const double took = std::max(0.0, nanoseconds(now - open.began) - recording);
    if (depth_ > 0) {
      open_[depth_ - 1].within += took;
      open_[depth_ - 1].spans += open.spans + 1;
    }
    last_[static_cast<std::size_t>(open.what)] = took;
    SpanRecord* next = spans_.claim();
    if (!next) return;
    SpanRecord& r = *next;
    r.began = open.began;
    r.ended = now;
    r.frame = open.frame;
    r.wall = open.wall;
    r.node = open.node;
    r.what = open.what;
    r.depth = static_cast<std::uint8_t>(depth_);
    r.whole = whole_;
    r.allocations = allocationsSoFar() - open.allocations;
    r.disturbed = disturbed_;
    disturbed_ = disturbed_ && depth_ > 0;
    r.use = isStage(open.what) ? ThreadUse::now().since(open.use) : ThreadUse{};
    if (isStage(open.what)) delayed(open, r.use);
    r.took = 1e-6 * took;
    r.own = 1e-6 * std::max(0.0, took - open.within);
    spans_.push();
  }
  /// Marks the spans under way: the probe allocates in them.
  void disturb() { disturbed_ = depth_ > 0; }
  /// Sets whether the following records belong to a frame that is recorded as a whole.
  void setWhole(bool whole) { whole_ = whole; }

  /// Begins a light visit instead of its spans: the following time belongs to a node, until endLightly(). The
  /// visit is recorded only if it took `leastTicks`, else its time is returned. It has no parts, and stays
  /// part of the enclosing span. The next visit begins at once.
  void beginLightly() { light_.began = TickClock::now(); }
  void nameLightly(NodeRef node) { light_.node = node; }
  NodeRef namedLightly() const { return light_.node; }
  std::uint64_t endLightly(std::uint64_t frame, std::uint64_t leastTicks, double nanosecondsATick) {
    const std::uint64_t tick = TickClock::now(), ticks = tick - std::exchange(light_.began, tick);
    ++counted_;
    if (ticks < leastTicks) return ticks;
    const ProfileClock::time_point now = ProfileClock::now();
    const auto took = std::chrono::duration_cast<ProfileClock::duration>(
        std::chrono::duration<double, std::nano>(static_cast<double>(ticks) * nanosecondsATick));
    SpanRecord* r = spans_.claim();
    if (!r) return 0;
    *r = {};
    r->began = now - took;
    r->ended = now;
    r->frame = frame;
    r->node = light_.node;
    r->what = Span::Simulate;
    r->depth = static_cast<std::uint8_t>(depth_);
    r->whole = false;
    r->took = r->own = 1e-6 * nanoseconds(took);
    spans_.push();
    return 0;
  }
  /// Counts work within the span that is under way.
  void counted(Count what, std::uint64_t amount, NodeRef node) {
    if (depth_ == 0) return;
    const Open& open = open_[std::min(depth_, kDeepest) - 1];
    if (CountRecord* r = counts_.claim()) {
      *r = {what, amount, open.what, open.frame, open.wall, node, open.began};
      counts_.push();
    }
  }
  /// Counts a visit.
  void count() { ++counted_; }
  std::uint64_t takeCount() { return std::exchange(counted_, 0); }

  std::size_t depth() const { return depth_; }
  /// Returns the frame and wall of the span that is under way.
  std::uint64_t frame() const { return depth_ > 0 ? open_[std::min(depth_, kDeepest) - 1].frame : kNoFrame; }
  std::uint32_t wall() const { return depth_ > 0 ? open_[std::min(depth_, kDeepest) - 1].wall : kNoWall; }
  /// Returns the duration of the last span of that kind [ms].
  double last(Span what) const { return 1e-6 * last_[static_cast<std::size_t>(what)]; }

  RecordRing<SpanRecord>& spans() { return spans_; }
  RecordRing<CountRecord>& counts() { return counts_; }
  const RecordRing<SpanRecord>& spans() const { return spans_; }
  const RecordRing<CountRecord>& counts() const { return counts_; }

private:
  struct Open {
    Span what = Span::App;
    std::uint64_t frame = kNoFrame;
    std::uint32_t wall = kNoWall;
    NodeRef node;
    double within = 0;        ///< [ns] used by its parts
    std::uint32_t spans = 0;  ///< in it and in its parts
    ProfileClock::time_point began;
    ThreadUse use;
    Allocations allocations;
  };
  /// Reads the thread's delays from the system at the start and the end of a stage.
  void delayed(Open& open) {
    if (open.what == Span::Draw) beforeDraw_ = delay_.ofDrawing();
    const double now = open.what == Span::Draw ? beforeDraw_.front() : delay_.own();
    open.use.late = stageEnded_ < 0 ? 0 : now - stageEnded_;
    open.use.delayed = now;
  }
  void delayed(const Open& open, ThreadUse& use) {
    const std::vector<double>* all = open.what == Span::Draw ? &delay_.ofDrawing() : nullptr;
    stageEnded_ = all ? all->front() : delay_.own();
    use.delayed = all ? mostDelayed(beforeDraw_, *all) : stageEnded_ - open.use.delayed;
    use.late = open.use.late;
  }
  static double nanoseconds(ProfileClock::duration d) {
    return std::chrono::duration<double, std::nano>(d).count();
  }

  struct Light {
    NodeRef node;
    std::uint64_t began = 0;  ///< [ticks]
  };

  std::array<Open, kDeepest> open_;
  Light light_;
  RunDelay delay_;
  double stageEnded_ = -1;  ///< delay of the thread at the end of the last stage [ms]; -1 = there was none
  std::vector<double> beforeDraw_;  ///< the delays at that time
  bool whole_ = true, disturbed_ = false;
  std::uint64_t counted_ = 0;
  std::size_t depth_ = 0;
  SpanOverhead overhead_;
  std::array<double, kSpans> last_{};
  RecordRing<SpanRecord> spans_{kCapacity};
  RecordRing<CountRecord> counts_{kCountCapacity};
};

}  // namespace stadion
