#include "pipeline/loop/frame_loop.h"

#include "engine/base/run_stopped.h"
#include "tests/pipeline/loop/counting_stages.h"

#include <gtest/gtest.h>
#include <mutex>
#include <set>
#include <thread>

namespace stadion {
namespace {

TEST(ThreadsFrameLoop, ShowsEveryFrameOnceInOrderOnAllWalls) {
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined})
    for (const std::size_t walls : {1u, 4u, 6u}) {
      CountingStages stages(walls, kSlots);
      FrameLoopOptions o;
      o.mode = mode, o.walls = walls, o.frames = 200;
      const FrameLoopOutcome outcome = runFrames(stages, o);
      ASSERT_EQ(outcome.framesShown, 200u);
      for (std::uint64_t n = 0; n < 200; ++n) ASSERT_EQ(stages.shown[n], n);
      EXPECT_FALSE(stages.torn);
      EXPECT_EQ(stages.closed, static_cast<int>(walls));
      EXPECT_FALSE(outcome.failure);
    }
}

TEST(ThreadsFrameLoop, LatestDeliveryNeverGoesBackAndNeverTearsAFrame) {
  CountingStages stages(4, kSlots);
  FrameLoopOptions o;
  o.walls = 4, o.frames = 3000, o.delivery = Delivery::Latest;
  runFrames(stages, o);
  EXPECT_TRUE(std::is_sorted(stages.shown.begin(), stages.shown.end()));
  EXPECT_EQ(std::set(stages.shown.begin(), stages.shown.end()).size(), stages.shown.size());
  EXPECT_FALSE(stages.torn);
}

/// Whose head was measured long before the frame began, and whose second wall shows an older picture still.
class OldHeads final : public CountingStages {
public:
  OldHeads() : CountingStages(2, kSlots) {}
  std::optional<std::chrono::steady_clock::time_point> headMeasured() const override {
    return std::chrono::steady_clock::now() - std::chrono::hours(1);
  }
  std::optional<std::chrono::steady_clock::time_point> posed(std::size_t wall) const override {
    if (wall == 0) return {};
    return std::chrono::steady_clock::now() - std::chrono::hours(5);
  }
};

TEST(ThreadsFrameLoop, MotionToImageIsCountedFromTheMeasurementOfThePoseThatEachWallShows) {
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined}) {
    OldHeads stages;
    FrameLoopOptions o;
    o.mode = mode, o.walls = 2, o.frames = 10;
    const std::atomic<bool> stop = false;
    FrameLoop loop(stages, o, stop);
    loop.run();
    constexpr double kHour = 3600e3;
    for (const double ms : loop.times().latency[0].values()) EXPECT_NEAR(ms, kHour, 0.5 * kHour);
    for (const double ms : loop.times().latency[1].values()) EXPECT_NEAR(ms, 5 * kHour, 0.5 * kHour);
    EXPECT_EQ(loop.times().latency[1].count(), 10u);
  }
}

/// Which take their time to get ready, and note what happens meanwhile.
class ColdStages final : public CountingStages {
public:
  explicit ColdStages(std::size_t walls) : CountingStages(walls, kSlots), walls_(walls) {}
  void app(const TimeSignature& now, std::size_t slot) override {
    if (now.frame > firstDrawn && warm < walls_) early = true;
    CountingStages::app(now, slot);
  }
  bool wantsDrawn(const FrameTicket& ticket) const override { return ticket.signature.frame >= firstDrawn; }
  Failure openWall(std::size_t wall) override {
    if (stopsOpening && wall == 1) throw RunStopped();
    return {};
  }
  Failure warmUp(std::size_t wall, const DrawList& list) override {
    if (list.ticket.signature.frame != firstDrawn) early = true;
    if (fails && wall == 1) return "no shader compiles";
    if (stops) throw RunStopped();
    std::this_thread::sleep_for(std::chrono::milliseconds(5 + 5 * wall));
    ++warm;
    return {};
  }
  Failure draw(std::size_t wall, const DrawList& list) override {
    if (warm < walls_) early = true;
    return CountingStages::draw(wall, list);
  }
  Failure swap(const TimeSignature& now) override {
    return now.frame >= firstDrawn ? CountingStages::swap(now) : Failure(kNoFailure);
  }

  std::uint64_t firstDrawn = 0;
  bool fails = false, stops = false, stopsOpening = false;
  std::atomic<std::size_t> warm = 0;
  std::atomic<bool> early = false;

private:
  std::size_t walls_;
};

TEST(ThreadsFrameLoop, NoWallDrawsAndNoFrameBeginsBeforeAllWallsAreWarm) {
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined})
    for (const Delivery delivery : {Delivery::Every, Delivery::Latest})
      for (const std::uint64_t first : {0u, 3u})
        for (const std::size_t walls : {1u, 3u}) {
          ColdStages stages(walls);
          stages.firstDrawn = first;
          FrameLoopOptions o;
          o.mode = mode, o.walls = walls, o.delivery = delivery, o.frames = 20;
          const std::atomic<bool> stop = false;
          FrameLoop loop(stages, o, stop);
          const FrameLoopOutcome outcome = loop.run();
          EXPECT_EQ(stages.warm, walls) << "once each";
          EXPECT_FALSE(stages.early);
          EXPECT_FALSE(outcome.failure);
          EXPECT_EQ(stages.shown.back(), 19u);
          // As long as all of them one after the other, or as the longest.
          EXPECT_GE(loop.times().warmUp, mode == Mode::Sequential && walls == 3 ? 30 : walls == 3 ? 15 : 5);
        }
}

TEST(ThreadsFrameLoop, AWallThatCannotGetReadyEndsTheRunWithItsReason) {
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined})
    for (const bool stops : {false, true}) {
      ColdStages stages(3);
      stages.fails = !stops, stages.stops = stops;
      FrameLoopOptions o;
      o.mode = mode, o.walls = 3, o.frames = 20;
      const FrameLoopOutcome outcome = runFrames(stages, o);
      EXPECT_EQ(outcome.framesShown, 0u);
      EXPECT_EQ(outcome.stopped, stops);
      EXPECT_EQ(outcome.failure.has_value(), !stops);
      EXPECT_EQ(stages.closed, 3);
    }
}

TEST(ThreadsFrameLoop, ARunThatIsStoppedWhileAWallOpensEnds) {
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined}) {
    ColdStages stages(3);
    stages.stopsOpening = true;
    FrameLoopOptions o;
    o.mode = mode, o.walls = 3, o.frames = 20;
    const FrameLoopOutcome outcome = runFrames(stages, o);
    EXPECT_EQ(outcome.framesShown, 0u);
    EXPECT_TRUE(outcome.stopped);
    EXPECT_FALSE(outcome.failure);
  }
}

TEST(FrameLoop, TicksAreLaterByAsLongAsWallsGetReady) {
  Pacer pacer(Pace::Lock, 1000);
  pacer.wait();
  std::this_thread::sleep_for(std::chrono::milliseconds(3));
  EXPECT_TRUE(pacer.behind());
  pacer.hold(std::chrono::hours(1));
  EXPECT_FALSE(pacer.behind());
  EXPECT_EQ(pacer.missed(), 0u);
}

TEST(FrameLoop, TicksThatWereNotShownAreCountedAtMostInARow) {
  CountingStages stages(1, kSlots);
  FrameLoopOptions o;
  o.mode = Mode::Sequential, o.frames = 6, o.rate = 50;
  o.frameTimes = {{2, 100'000'000}, {4, 160'000'000}};  // ticks 1, 5, 6, 8
  EXPECT_EQ(runFrames(stages, o).mostTicksWithoutFrame, 3u);
}

/// Whose first picture is not there before App has begun the third frame.
class LongOpening final : public CountingStages {
public:
  LongOpening() : CountingStages(2, kSlots) {}
  void app(const TimeSignature& now, std::size_t slot) override {
    if (now.frame == 2) thirdHasBegun_ = true, thirdHasBegun_.notify_all();
    CountingStages::app(now, slot);
  }
  Failure draw(std::size_t wall, const DrawList& list) override {
    thirdHasBegun_.wait(false);
    return CountingStages::draw(wall, list);
  }

private:
  std::atomic<bool> thirdHasBegun_ = false;
};

TEST(ThreadsFrameLoop, TicksThatPassBeforeTheFirstPictureAreNotPassedOver) {
  LongOpening stages;
  FrameLoopOptions o;
  o.walls = 2, o.frames = 12, o.rate = 50;
  o.frameTimes = {{2, 400'000'000}};  // twenty ticks late
  EXPECT_EQ(runFrames(stages, o).mostTicksWithoutFrame, 0u);
}

TEST(ThreadsFrameLoop, AWallThatFailsStopsTheRunWithItsReason) {
  CountingStages stages(4, kSlots);
  stages.failAt = 20;
  FrameLoopOptions o;
  o.walls = 4, o.frames = 1000;
  const FrameLoopOutcome outcome = runFrames(stages, o);
  ASSERT_TRUE(outcome.failure);
  EXPECT_EQ(outcome.failure->message, "wall 1 is broken");
  EXPECT_LE(outcome.framesShown, 20u);
  EXPECT_EQ(stages.closed, 4);
}

/// Throws in one of its stages, in frame 5 (or when it is opened).
class ThrowingStages final : public CountingStages {
public:
  ThrowingStages(std::string where, bool memory)
      : CountingStages(2, kSlots), where_(std::move(where)), memory_(memory) {}
  void app(const TimeSignature& now, std::size_t slot) override {
    if (now.frame == 5) maybe("App");
    CountingStages::app(now, slot);
  }
  void cull(std::size_t wall, std::size_t slot, DrawList& list) override {
    CountingStages::cull(wall, slot, list);
    if (list.ticket.signature.frame == 5 && wall == 1) maybe("Cull");
  }
  Failure openWall(std::size_t wall) override {
    if (wall == 1) maybe("opening");
    return {};
  }
  Failure draw(std::size_t wall, const DrawList& list) override {
    if (list.ticket.signature.frame == 5 && wall == 1) maybe("Draw");
    return CountingStages::draw(wall, list);
  }
  Failure swap(const TimeSignature& now) override {
    if (now.frame == 5) maybe("Swap");
    return CountingStages::swap(now);
  }
  void closeWall(std::size_t wall) override {
    CountingStages::closeWall(wall);
    if (wall == 1) maybe("closing");
  }

private:
  void maybe(const std::string& stage) const {
    if (stage != where_) return;
    if (memory_) throw std::bad_alloc();
    throw std::runtime_error("a fault of ours");
  }
  std::string where_;
  bool memory_;
};

TEST(ThreadsFrameLoop, WhatAStageThrowsEndsTheRunAndIsNamed) {
  const std::vector<std::pair<const char*, const char*>> places{{"App", "App, frame 5: "},
                                                                {"Cull", "Cull of wall 2, frame 5: "},
                                                                {"Draw", "Draw of wall 2, frame 5: "},
                                                                {"Swap", "Swap, frame 5: "},
                                                                {"opening", "opening of wall 2: "},
                                                                {"closing", "closing of wall 2: "}};
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined})
    for (const auto& [stage, place] : places)
      for (const bool memory : {false, true}) {
        ThrowingStages stages(stage, memory);
        FrameLoopOptions o;
        o.mode = mode, o.walls = 2, o.frames = 20;
        const FrameLoopOutcome outcome = runFrames(stages, o);
        ASSERT_TRUE(outcome.failure) << stage;
        EXPECT_EQ(outcome.failure->message,
                  std::string(place) + (memory ? "out of memory" : "a fault of ours"));
        EXPECT_EQ(outcome.failure->kind, FailureKind::Fault);
        EXPECT_EQ(stages.closed, 2);
        EXPECT_FALSE(outcome.stopped);
      }
}

/// Waits in App for something that will not come, until the run is to stop.
class WaitingStages final : public CountingStages {
public:
  explicit WaitingStages(std::atomic<bool>& stop) : CountingStages(2, kSlots), stop_(stop) {}
  void app(const TimeSignature& now, std::size_t slot) override {
    if (now.frame < 5) return CountingStages::app(now, slot);
    stop_ = true;
    throw RunStopped();
  }

private:
  std::atomic<bool>& stop_;
};

TEST(ThreadsFrameLoop, AFrameThatIsGivenUpDoesNotCount) {
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined}) {
    std::atomic<bool> stop = false;
    WaitingStages stages(stop);
    FrameLoopOptions o;
    o.mode = mode, o.walls = 2;
    FrameLoop loop(stages, o, stop);
    const FrameLoopOutcome outcome = loop.run();
    EXPECT_TRUE(outcome.stopped);
    EXPECT_FALSE(outcome.failure);
    EXPECT_EQ(outcome.framesSimulated, 5u);
    EXPECT_EQ(outcome.framesShown, 5u);
    EXPECT_EQ(stages.closed, 2);
  }
}

TEST(ThreadsFrameLoop, TimesThatWereDecidedAreObeyed) {
  CountingStages stages(1, kSlots);
  FrameLoopOptions o;
  o.mode = Mode::Sequential, o.rate = 10;
  o.frameTimes = {{2, fromSeconds(0.5)}, {4, fromSeconds(1)}};
  o.end = fromSeconds(1);
  const FrameLoopOutcome outcome = runFrames(stages, o);
  EXPECT_EQ(outcome.framesShown, 5u) << "at 0, 0.1, 0.5, 0.6 and 1 s";
}

TEST(ThreadsFrameLoop, StopsCleanlyWhenAsked) {
  CountingStages stages(4, kSlots);
  FrameLoopOptions o;
  o.walls = 4;
  std::atomic<bool> stop = false;
  FrameLoop loop(stages, o, stop);
  std::thread signal([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    stop = true;
  });
  const FrameLoopOutcome outcome = loop.run();
  signal.join();
  EXPECT_TRUE(outcome.stopped);
  EXPECT_EQ(outcome.framesShown, outcome.framesSimulated);
}

/// Draw waits while App begins a hundred further frames, so that a frame that is shown was begun long before
/// the newest one; and it notes how long that was.
class SlowDraw final : public CountingStages {
public:
  explicit SlowDraw(std::size_t walls) : CountingStages(walls, kSlots) {}
  void app(const TimeSignature& now, std::size_t slot) override {
    CountingStages::app(now, slot);
    begun_[now.frame] = std::chrono::steady_clock::now();
    newest_ = now.frame;
    newest_.notify_all();
  }
  Failure draw(std::size_t wall, const DrawList& list) override {
    const std::uint64_t frame = list.ticket.signature.frame;
    while (!list.ticket.last && newest_ < std::min(frame + 100, kFrames - 1)) newest_.wait(newest_);
    return CountingStages::draw(wall, list);
  }
  Failure swap(const TimeSignature& now) override {
    const auto age = std::chrono::steady_clock::now() - begun_[now.frame];
    ages.push_back(std::chrono::duration<double, std::milli>(age).count());
    return CountingStages::swap(now);
  }

  static constexpr std::uint64_t kFrames = 3000;
  std::vector<double> ages;  ///< at each swap, from App to it [ms]

private:
  std::array<std::chrono::steady_clock::time_point, kFrames> begun_;
  std::atomic<std::uint64_t> newest_ = 0;
};

TEST(ThreadsFrameLoop, LatencyCountsFromTheAppOfTheFrameThatIsShown) {
  SlowDraw stages(2);
  FrameLoopOptions o;
  o.walls = 2, o.frames = SlowDraw::kFrames, o.rate = 10'000;
  o.pace = Pace::Float, o.delivery = Delivery::Latest;
  const std::atomic<bool> never = false;
  FrameLoop loop(stages, o, never);
  EXPECT_FALSE(loop.run().failure);
  ASSERT_GT(stages.ages.size(), 2u);
  for (const DurationSeries& latency : loop.times().latency) {
    ASSERT_EQ(latency.values().size(), stages.ages.size());
    // The warm-up is left out of the first frame's latency.
    for (std::size_t i = 1; i < stages.ages.size(); ++i) EXPECT_GE(latency.values()[i], stages.ages[i]);
  }
}

/// Stages that show few of their frames.
class SeldomSeen : public CountingStages {
public:
  explicit SeldomSeen(std::uint64_t every) : CountingStages(2, kSlots), every_(every) {}
  bool wantsDrawn(const FrameTicket& t) const override {
    return t.last || (every_ > 0 && t.signature.frame % every_ == 0);
  }
  Failure draw(std::size_t wall, const DrawList& list) override {
    if (wall == 0) drawn.push_back(list.ticket.signature.frame);
    return {};
  }
  Failure swap(const TimeSignature& now) override { return shown.push_back(now.frame), kNoFailure; }
  std::vector<std::uint64_t> drawn;

private:
  std::uint64_t every_;
};

TEST(ThreadsFrameLoop, OnlyFramesThatAreLookedAtAreDrawnAndTimed) {
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined})
    for (const std::uint64_t every : {0, 1, 10}) {
      SeldomSeen stages(every);
      FrameLoopOptions o;
      o.mode = mode, o.walls = 2, o.frames = 35;
      const std::atomic<bool> never = false;
      FrameLoop loop(stages, o, never);
      const FrameLoopOutcome outcome = loop.run();
      const std::uint64_t drawn = every == 0 ? 1 : every == 1 ? 35 : 5;
      EXPECT_EQ(outcome.framesShown, 35u);
      EXPECT_EQ(outcome.framesDrawn, drawn);
      EXPECT_EQ(stages.drawn.size(), drawn);
      EXPECT_EQ(stages.drawn.back(), 34u) << "the last one is always drawn";
      EXPECT_EQ(loop.times().app.count(), 35u);
      EXPECT_EQ(loop.times().period.count(), every == 1 ? 34u : 0u);
      for (std::size_t wall = 0; wall < 2; ++wall) {
        EXPECT_EQ(loop.times().cull[wall].count(), drawn);
        EXPECT_EQ(loop.times().draw[wall].count(), drawn);
        EXPECT_EQ(loop.times().latency[wall].count(), drawn);
      }
    }
}

/// Asks the run to stop when some frames have been shown, none of which was drawn.
class StopsWhileShown final : public SeldomSeen {
public:
  explicit StopsWhileShown(std::atomic<bool>& stop) : SeldomSeen(0), stop_(stop) {}
  Failure swap(const TimeSignature& now) override {
    if (now.frame >= 10) stop_ = true;
    return SeldomSeen::swap(now);
  }

private:
  std::atomic<bool>& stop_;
};

TEST(ThreadsFrameLoop, TheFrameInWhichAStopIsSeenIsTheLastOneAndDrawn) {
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined}) {
    std::atomic<bool> stop = false;
    StopsWhileShown stages(stop);
    FrameLoopOptions o;
    o.mode = mode, o.walls = 2, o.rate = 1000, o.pace = Pace::Lock;
    FrameLoop loop(stages, o, stop);
    const FrameLoopOutcome outcome = loop.run();
    EXPECT_TRUE(outcome.stopped);
    ASSERT_EQ(stages.drawn.size(), 1u);
    EXPECT_EQ(stages.drawn.back(), outcome.framesSimulated - 1);
  }
}

/// Draw finds, on one wall, that it is to give up.
class GivingUp final : public CountingStages {
public:
  GivingUp() : CountingStages(3, kSlots) {}
  Failure draw(std::size_t wall, const DrawList& list) override {
    if (wall == 1 && list.ticket.signature.frame == 4) throw RunStopped();
    return CountingStages::draw(wall, list);
  }
};

TEST(ThreadsFrameLoop, ADrawThatIsGivenUpEndsTheRunAndIsNoFailure) {
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined}) {
    GivingUp stages;
    FrameLoopOptions o;
    o.mode = mode, o.walls = 3;  // without end
    const FrameLoopOutcome outcome = runFrames(stages, o);
    EXPECT_TRUE(outcome.stopped);
    EXPECT_FALSE(outcome.failure);
    EXPECT_EQ(outcome.framesShown, 4u);
    EXPECT_EQ(stages.closed, 3);
  }
}

// The tests above would notice a pipeline with too few slots: with the memory of one, frames tear.
TEST(FrameLoop, TooFewSlotsAreNoticed) {
  CountingStages stages(4, 1);
  FrameLoopOptions o;
  o.walls = 4, o.frames = 200;
  runFrames(stages, o);
  EXPECT_TRUE(stages.torn);
}

TEST(FrameLoop, LockedPaceKeepsToTheTicks) {
  Pacer pacer(Pace::Lock, 200);
  const auto start = std::chrono::steady_clock::now();
  pacer.wait();
  std::uint64_t ticks = 0, now = 0;
  // Where nothing else takes the processor the next tick comes first; on a busy machine that may take some.
  while (now != 1 && ticks < 100'000) ticks += now = pacer.wait();
  EXPECT_EQ(now, 1u);
  const std::uint64_t missedBefore = pacer.missed();
  std::this_thread::sleep_for(std::chrono::milliseconds(12));  // two ticks of 5 ms go by unused
  now = pacer.wait();
  EXPECT_GE(now, 3u);
  EXPECT_GE(pacer.missed(), missedBefore + 2);
  const double ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  EXPECT_GE(ms, 5.0 * static_cast<double>(ticks + now) - 0.1);
}

TEST(FrameLoop, WhereEveryTickCountsWhatIsLateIsCaughtUpWith) {
  Pacer pacer(Pace::Lock, 200, true);
  const auto start = std::chrono::steady_clock::now();
  pacer.wait();
  std::this_thread::sleep_for(std::chrono::milliseconds(22));
  EXPECT_TRUE(pacer.behind());
  int ticks = 0;
  for (; pacer.behind() && ticks < 1'000'000; ++ticks) EXPECT_EQ(pacer.wait(), 1u);
  EXPECT_GE(ticks, 4);
  EXPECT_LT(ticks, 1'000'000) << "it has caught up";
  const double ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  EXPECT_GE(ms, 5 * ticks - 0.1);
  EXPECT_GE(pacer.missed(), 4u);
}

TEST(FrameLoop, ALateSequentialShowSimulatesEveryTickAndDrawsWhatItCan) {
  struct Slow final : CountingStages {
    using CountingStages::CountingStages;
    std::uint64_t drawn = 0;
    Failure draw(std::size_t wall, const DrawList& list) override {
      ++drawn;
      std::this_thread::sleep_for(std::chrono::milliseconds(25));
      return CountingStages::draw(wall, list);
    }
  } stages(1, 1);
  FrameLoopOptions o;
  o.mode = Mode::Sequential, o.pace = Pace::Lock, o.delivery = Delivery::Latest, o.rate = 200, o.frames = 60;
  o.everyTick = true;
  const auto outcome = runFrames(stages, o);
  EXPECT_FALSE(outcome.failure);
  EXPECT_EQ(outcome.framesSimulated, 60u);
  EXPECT_GE(stages.drawn, 2u) << "the first and the last, at least";
  EXPECT_LT(stages.drawn, 40u);
}

TEST(FrameLoop, SignaturesDoNotAccumulateRounding) {
  EXPECT_EQ(signatureAt(60ull * 3600 * 24, 60).time, 86400ll * 1000000000);
  EXPECT_EQ(signatureAt(0, 60).step, 0);
  EXPECT_EQ(signatureAt(1, 60).step, 16666667);
}

}  // namespace
}  // namespace stadion
