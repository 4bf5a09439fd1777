/// What an operator does to the loop: pauses, single steps, slow motion, the next group.

#include "pipeline/operator/operator_controls.h"
#include "tests/pipeline/loop/counting_stages.h"

#include <gtest/gtest.h>
#include <thread>

namespace stadion {
namespace {

/// Stages with an operator: he pauses the show, steps it by single frames, and slows it down.
class PlayedStages final : public CountingStages {
public:
  PlayedStages(Playback& playback) : CountingStages(1, kSlots), playback_(playback) {}
  void app(const TimeSignature& now, std::size_t slot) override {
    CountingStages::app(now, slot);
    times.push_back(now.time);
    if (now.frame == 3) playback_.setPaused(true);
    if (now.frame == 5) playback_.setPaused(false), playback_.setSpeed(0.25);
    if (now.frame == 8) playback_.setSpeed(1);
  }
  void still(const TimeSignature&, std::size_t slot) override {
    ++stills;
    CountingStages::app(signatureAt(times.empty() ? 0 : times.size() - 1, 10), slot);
    if (stills % 5 == 0) playback_.step();
  }
  std::vector<Nanoseconds> times;
  int stills = 0;

private:
  Playback& playback_;
};

/// A show that goes on after frame 4, and is paused.
class PausedStages final : public CountingStages {
public:
  PausedStages(Playback& playback) : CountingStages(1, kSlots), playback_(playback) {}
  void app(const TimeSignature& now, std::size_t slot) override {
    CountingStages::app(now, slot);
    if (stills == 0) tooEarly = true;
  }
  void still(const TimeSignature& now, std::size_t slot) override {
    EXPECT_EQ(now.frame, 4U);
    CountingStages::app(now, slot);
    if (++stills == 3) playback_.setPaused(false);
  }
  int stills = 0;
  bool tooEarly = false;

private:
  Playback& playback_;
};

TEST(ThreadsFrameLoop, AShowThatGoesOnWherePausedStandsStill) {
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined}) {
    Playback playback;
    playback.setPaused(true);
    PausedStages stages(playback);
    FrameLoopOptions o;
    o.mode = mode, o.rate = 10, o.frames = 8, o.playback = &playback, o.after = signatureAt(4, 10);
    const FrameLoopOutcome outcome = runFrames(stages, o);
    EXPECT_FALSE(stages.tooEarly);
    EXPECT_GE(stages.stills, 3);
    EXPECT_EQ(outcome.framesSimulated, 3u) << "5, 6 and 7";
  }
}

/// The player before may have died before that frame was shown.
TEST(ThreadsFrameLoop, AShowThatGoesOnAfterItsLastFrameShowsThisOnceMore) {
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined})
    for (const bool byFrames : {true, false}) {
      Playback playback;
      PlayedStages stages(playback);
      FrameLoopOptions o;
      o.mode = mode, o.rate = 10, o.after = signatureAt(7, 10);
      byFrames ? void(o.frames = 8) : void(o.end = o.after->time);
      const FrameLoopOutcome outcome = runFrames(stages, o);
      EXPECT_EQ(stages.stills, 1);
      EXPECT_EQ(outcome.framesSimulated, 0u);
      EXPECT_EQ(outcome.framesDrawn, 1u);
      EXPECT_FALSE(outcome.stopped || outcome.failure);
    }
}

TEST(ThreadsFrameLoop, APauseThatHoldsFromLaterOnIsCaughtUpWith) {
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined}) {
    Playback playback;
    playback.setPaused(true);
    playback.standFrom(signatureAt(7, 10).time);
    PlayedStages stages(playback);
    FrameLoopOptions o;
    o.mode = mode, o.rate = 10, o.frames = 9, o.playback = &playback, o.after = signatureAt(5, 10);
    runFrames(stages, o);
    EXPECT_EQ(stages.stills, 5) << "before the step to frame 8";
    EXPECT_EQ(stages.times,
              (std::vector{signatureAt(6, 10).time, signatureAt(7, 10).time, signatureAt(8, 10).time}));
  }
}

TEST(ThreadsFrameLoop, APausedShowIsDrawnOnAndGoesByFramesAndSlowly) {
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined}) {
    Playback playback;
    PlayedStages stages(playback);
    FrameLoopOptions o;
    o.mode = mode, o.rate = 10, o.frames = 11, o.playback = &playback;
    const FrameLoopOutcome outcome = runFrames(stages, o);
    EXPECT_EQ(stages.stills, 10) << "five before each of two steps";
    EXPECT_EQ(outcome.framesSimulated, 11u);
    std::vector<Nanoseconds> expected;
    for (const double s : {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.525, 0.55, 0.575, 0.7, 0.8})
      expected.push_back(fromSeconds(s));
    EXPECT_EQ(stages.times, expected) << "on ticks again after slow motion";
  }
}

TEST(ThreadsFrameLoop, TheNextGroupEndsTheRunInOrderAndASecondRunBegins) {
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined}) {
    OperatorControls controls(false, 0.064);
    CountingStages stages(2, 3);
    FrameLoopOptions o;
    o.mode = mode, o.walls = 2, o.frames = 1000, o.controls = &controls, o.playback = &controls.playback();
    const std::atomic<bool> never = false;
    FrameLoop loop(stages, o, never);
    controls.queue().post({OperatorAction::NextGroup});
    const FrameLoopOutcome outcome = loop.run();
    EXPECT_TRUE(outcome.nextGroup);
    EXPECT_FALSE(outcome.failure);
    EXPECT_EQ(outcome.framesSimulated, 0u);
    EXPECT_EQ(stages.closed, 2);
    controls.beginGroup();
    EXPECT_EQ(controls.groups(), 2u);
    controls.queue().post({OperatorAction::End});
    FrameLoop again(stages, o, never);
    EXPECT_FALSE(again.run().nextGroup);
    EXPECT_EQ(stages.shown, std::vector<std::uint64_t>{0}) << "the frame that was begun is the last one";
  }
}

TEST(ThreadsFrameLoop, WhatTheOperatorSaysOfAFrameTravelsWithIt) {
  /// Notes how each frame was to be shown.
  struct NotingStages : CountingStages {
    using CountingStages::CountingStages;
    Failure draw(std::size_t wall, const DrawList& list) override {
      if (wall == 0) black.push_back(list.ticket.presentation.black);
      return CountingStages::draw(wall, list);
    }
    std::vector<bool> black;
  };
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined}) {
    OperatorControls controls(false, 0.064);
    controls.replay({{2, {OperatorAction::Black, 1, false}}, {4, {OperatorAction::Black, 0, false}}});
    NotingStages stages(2, 3);
    FrameLoopOptions o;
    o.mode = mode, o.walls = 2, o.frames = 6, o.controls = &controls, o.playback = &controls.playback();
    const std::atomic<bool> never = false;
    FrameLoop(stages, o, never).run();
    EXPECT_EQ(stages.black, (std::vector<bool>{false, false, true, true, false, false}));
  }
}

/// Keeps each order that the loop gives to the machines of a cluster.
class KeptOrders final : public FrameOrders {
public:
  bool leads() const override { return true; }
  void issue(FrameOrder& order) override { orders.push_back(order); }
  std::optional<FrameOrder> next() override { return std::nullopt; }
  bool mayShow(const TimeSignature&) override { return true; }

  std::vector<FrameOrder> orders;
};

/// An operator that gives start once the show waits, pauses in frame 3, takes a single step, and ends the
/// show.
class OperatedStages final : public CountingStages {
public:
  explicit OperatedStages(OperatorQueue& queue) : CountingStages(1, kSlots), queue_(queue) {}
  void app(const TimeSignature& now, std::size_t slot) override {
    CountingStages::app(now, slot);
    if (now.frame == 3) queue_.post({OperatorAction::Pause, 1, false});
  }
  void still(const TimeSignature& now, std::size_t slot) override {
    CountingStages::app(now, slot);
    const OperatorAction next[] = {OperatorAction::Start, OperatorAction::Step, OperatorAction::End};
    if (stills_ < std::size(next)) queue_.post({next[stills_++], {}, false});
  }

private:
  OperatorQueue& queue_;
  std::size_t stills_ = 0;
};

/// A machine may take the leader's place after any of them.
TEST(ThreadsFrameLoop, EachOrderSaysWhetherShowTimeStandsAfterIt) {
  OperatorControls controls(true, 0.064);
  OperatedStages stages(controls.queue());
  KeptOrders kept;
  FrameLoopOptions o;
  o.mode = Mode::Sequential, o.rate = 100, o.frames = 1000, o.orders = &kept;
  o.controls = &controls, o.playback = &controls.playback();
  runFrames(stages, o);
  struct Said {
    std::uint64_t frame;
    Standstill still, after;
    bool operator==(const Said&) const = default;
  };
  std::vector<Said> said;
  for (const FrameOrder& order : kept.orders)
    said.push_back({order.signature.frame, order.still, order.standsAfter});
  constexpr Standstill none = Standstill::None, waits = Standstill::Waiting, paused = Standstill::Paused;
  EXPECT_EQ(said, (std::vector<Said>{{0, none, waits},
                                     {0, waits, waits},
                                     {1, none, none},
                                     {2, none, none},
                                     {3, none, none},
                                     {3, paused, paused},
                                     {4, none, paused},
                                     {4, paused, paused},
                                     {4, paused, paused}}))
      << "the end is asked for in the one before the last";
  EXPECT_TRUE(kept.orders.back().last);
}

}  // namespace
}  // namespace stadion
