/// What a player and its supervisor share, and how a show goes on after a crash.

#include "pipeline/loop/frame_loop.h"
#include "pipeline/supervision/hang_watch.h"
#include "pipeline/supervision/recovery.h"
#include "pipeline/supervision/shared_progress.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

using Way = Recovery::Way;

TEST(Recovery, FirstGoesOnAtOnceThenAfterGrowingPausesThenRestartsThenGivesUp) {
  Recovery recovery;
  std::vector<Way> ways;
  std::chrono::milliseconds before{-1};
  for (std::size_t n = 1; n <= Recovery::kMost; ++n) {
    const bool restarted = n > Recovery::kFromScene;
    const Recovery::Step step = recovery.died(fromSeconds(restarted ? 0.3 : 17), fromSeconds(0.3));
    ways.push_back(step.way);
    if (step.way == Way::GiveUp) break;
    EXPECT_GT(step.pause, before) << n;
    before = step.pause;
    EXPECT_EQ(step.pause.count() == 0, n == 1);
  }
  const Way on = Way::GoOn, again = Way::Restart;
  EXPECT_EQ(ways, (std::vector{on, on, on, on, again, again, again, again, again, Way::GiveUp}));
}

TEST(Recovery, APlayerBeyondThePlaceOfTheLastCrashCrashesForTheFirstTime) {
  Recovery recovery;
  EXPECT_EQ(recovery.died(fromSeconds(17), fromSeconds(17)).way, Way::GoOn);
  for (Nanoseconds at = fromSeconds(22); at < fromSeconds(150); at += Recovery::kSteady) {
    EXPECT_EQ(recovery.died(at, Recovery::kSteady).way, Way::GoOn);
    EXPECT_EQ(recovery.deaths(), 1U) << at;
  }
  // The show has restarted since, and has played for long.
  recovery.died(fromSeconds(0.3), Recovery::kLong);
  EXPECT_EQ(recovery.deaths(), 1U);
}

TEST(Recovery, TheSamePlaceCountsHoweverLongAfterTheKeptSceneItLies) {
  Recovery recovery;
  const Nanoseconds at = fromSeconds(83), played = fromSeconds(6);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(recovery.died(at, played).way, Way::GoOn);
  EXPECT_EQ(recovery.died(at, played).way, Way::Restart);
}

std::vector<std::uint8_t> sceneOf(std::uint8_t value, std::size_t bytes) {
  return std::vector<std::uint8_t>(bytes, value);
}

TEST(SharedProgress, WhatAProcessKeptIsThereAfterItWasKilled) {
  auto made = SharedProgress::create();
  ASSERT_TRUE(made) << made.error().message;
  const SharedProgress& here = *made.value();
  EXPECT_FALSE(here.kept());
  EXPECT_EQ(here.newest().clock, 0);
  const pid_t player = fork();
  if (player == 0) {
    const auto there = SharedProgress::attach(dup(here.descriptor()));
    if (!there) _exit(1);
    OperatorState desk;
    desk.presentation.black = true, desk.volume = 0.5;
    there->setOperatorState(desk);
    there->enter(SharedProgress::Phase::Playing);
    for (std::uint8_t n = 1; n <= 5; ++n) {
      there->simulated({n, n * 1000, 1000, {}}, 0);
      there->shown();
      there->keep({n, n * 1000, 77}, sceneOf(n, 100'000 - 10'000 * n));
    }
    _exit(0);
  }
  int status = -1;
  waitpid(player, &status, 0);
  ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  ASSERT_TRUE(here.kept());
  EXPECT_EQ(here.kept()->frame, 5U);
  EXPECT_EQ(here.kept()->history, 77U);
  EXPECT_EQ(here.scene(), sceneOf(5, 50'000));
  EXPECT_EQ(here.newest().frame, 5U);
  EXPECT_EQ(here.framesShown(), 5U);
  EXPECT_EQ(here.phase(), SharedProgress::Phase::Playing);
  EXPECT_TRUE(here.operatorState().presentation.black);
  EXPECT_EQ(here.operatorState().volume, 0.5);
  EXPECT_GE(here.timeNow(), 5000) << "show time would have gone on";
}

TEST(SharedProgress, APlayerThatStillCatchesUpHasNotPlayed) {
  auto made = SharedProgress::create();
  ASSERT_TRUE(made);
  SharedProgress& p = *made.value();
  p.countStart();
  p.shown();
  EXPECT_EQ(p.played(), 0) << "it has not even begun";
  p.catchesUpUntil(machineClock() + fromSeconds(3600));
  p.shown();
  EXPECT_EQ(p.played(), 0);
  const Nanoseconds caughtUp = machineClock() - fromSeconds(7);
  p.catchesUpUntil(caughtUp);
  p.shown();
  EXPECT_EQ(p.played(), p.lastShown() - caughtUp);
  p.countStart();
  EXPECT_EQ(p.played(), 0) << "that was the one before";
}

TEST(SharedProgress, ASceneThatIsBeingWrittenIsNotTheNewest) {
  auto made = SharedProgress::create();
  ASSERT_TRUE(made);
  SharedProgress& p = *made.value();
  ASSERT_EQ(p.keep({1, 0, 0}, sceneOf(1, 5000)), 0);
  ASSERT_EQ(p.keep({2, 0, 0}, sceneOf(2, 5000)), 0);
  // As a writer does that dies before the end: where the first one lay, half of it.
  const std::vector<std::uint8_t> half = sceneOf(3, 2500);
  ASSERT_EQ(pwrite(p.descriptor(), half.data(), half.size(), 4096), 2500);
  EXPECT_EQ(p.kept()->frame, 2U);
  EXPECT_EQ(p.scene(), sceneOf(2, 5000));
}

TEST(SharedProgress, ScenesOfWhateverSizeLieCloseTogether) {
  auto made = SharedProgress::create();
  ASSERT_TRUE(made);
  SharedProgress& p = *made.value();
  std::size_t most = 0;
  for (std::size_t n = 1; n < 300; ++n) {
    const std::size_t bytes = 1000 + (n < 150 ? 17 * n : 997 * n % 4000);
    const auto value = static_cast<std::uint8_t>(n);
    const auto before = p.kept();
    ASSERT_EQ(p.keep({n, 0, 0}, sceneOf(value, bytes)), 0);
    EXPECT_EQ(p.scene(), sceneOf(value, bytes)) << n;
    const SharedProgress::Kept now = *p.kept();
    const bool apart = !before || now.at + now.bytes <= before->at || before->at + before->bytes <= now.at;
    EXPECT_TRUE(apart) << n << ": it is written over the one before";
    most = std::max(most, bytes);
  }
  struct stat about {};
  ASSERT_EQ(fstat(p.descriptor(), &about), 0);
  EXPECT_LE(static_cast<std::size_t>(about.st_size), 4096 + 3 * most);
}

TEST(SharedProgress, WhyASceneCannotBeKeptIsKnownAndTheOneBeforeIsThere) {
  auto made = SharedProgress::create();
  ASSERT_TRUE(made);
  SharedProgress& p = *made.value();
  ASSERT_EQ(p.keep({1, 0, 0}, sceneOf(1, 5000)), 0);
  const pid_t player = fork();
  if (player == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit few{20'000, 20'000};
    setrlimit(RLIMIT_FSIZE, &few);
    const bool fits = p.keep({2, 0, 0}, sceneOf(2, 5000)) == 0;
    _exit(fits && p.keep({3, 0, 0}, sceneOf(3, 50'000)) == EFBIG ? 0 : 1);
  }
  int status = -1;
  waitpid(player, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(p.scene(), sceneOf(2, 5000));
}

/// A clock that a test sets.
Nanoseconds testTime = 0;

TEST(HangWatch, APlayerThatShowsNothingHangsAndOneThatOpensMayTakeLonger) {
  auto made = SharedProgress::create();
  ASSERT_TRUE(made);
  SharedProgress& p = *made.value();
  constexpr Nanoseconds kAfter = fromSeconds(0.5);
  // Asks every tenth of a second, as the watcher does: one that asks more seldom was stopped itself.
  const auto askUntil = [](HangWatch& watch, Nanoseconds end) {
    std::optional<Nanoseconds> silent;
    while (!silent && testTime < end) {
      testTime = std::min(testTime + fromSeconds(0.1), end);
      silent = watch.hangs();
    }
    return silent;
  };
  testTime = machineClock();
  HangWatch opens(p, kAfter, [] { return testTime; });
  const Nanoseconds longer = testTime + HangWatch::kLonger * kAfter;
  EXPECT_FALSE(askUntil(opens, longer)) << "it may open for twelve times as long";
  EXPECT_FALSE(opens.shows());
  EXPECT_EQ(askUntil(opens, longer + 1), HangWatch::kLonger * kAfter);
  testTime = machineClock();
  HangWatch plays(p, kAfter, [] { return testTime; });
  p.enter(SharedProgress::Phase::Playing);
  p.shown();
  EXPECT_TRUE(plays.shows());
  testTime = p.lastShown();
  EXPECT_FALSE(plays.hangs());
  const Nanoseconds limit = testTime + kAfter;
  EXPECT_FALSE(askUntil(plays, limit));
  EXPECT_EQ(askUntil(plays, limit + 1), kAfter);
}

TEST(HangWatch, AWatcherThatDidNotAskForASecondWasStoppedItselfAndAsksAgain) {
  auto made = SharedProgress::create();
  ASSERT_TRUE(made);
  SharedProgress& p = *made.value();
  testTime = machineClock();
  HangWatch watch(p, fromSeconds(0.5), [] { return testTime; });
  p.enter(SharedProgress::Phase::Playing);
  p.shown();
  testTime = p.lastShown();
  EXPECT_FALSE(watch.hangs());
  testTime += fromSeconds(3600);
  EXPECT_FALSE(watch.hangs());
  testTime += fromSeconds(0.6);
  EXPECT_EQ(watch.hangs(), fromSeconds(0.5));
}

TEST(SharedProgress, AShowThatBeginsHasNoSceneOfBefore) {
  auto made = SharedProgress::create();
  ASSERT_TRUE(made);
  SharedProgress& p = *made.value();
  p.simulated({9, 9, 1, {}}, 0);
  ASSERT_EQ(p.keep({9, 9, 0}, sceneOf(1, 50)), 0);
  p.forget();
  EXPECT_FALSE(p.kept());
  EXPECT_TRUE(p.scene().empty());
  EXPECT_EQ(p.timeNow(), 0);
}

TEST(SharedProgress, AShowThatStandsStillIsNotLate) {
  auto made = SharedProgress::create();
  ASSERT_TRUE(made);
  SharedProgress& p = *made.value();
  p.simulated({9, 9000, 1, {}}, 0);
  OperatorState desk;
  desk.paused = true;
  p.setOperatorState(desk);
  EXPECT_EQ(p.timeNow(), 9000);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const Nanoseconds before = machineClock();
  desk.paused = false;
  p.setOperatorState(desk);
  const Nanoseconds due = p.timeNow();  // read before the clock, whose reading is its limit
  EXPECT_LE(due, 9000 + machineClock() - before) << "it has gone on since then alone";
}

TEST(SharedProgress, AShowThatCatchesUpIsDueWhereItWouldBe) {
  auto made = SharedProgress::create();
  ASSERT_TRUE(made);
  SharedProgress& p = *made.value();
  p.simulated({9, 9000, 1, {}}, fromSeconds(7));
  EXPECT_EQ(p.newest().time, 9000);
  EXPECT_GE(p.timeNow(), fromSeconds(7));
  OperatorState desk;
  desk.paused = true;
  p.setOperatorState(desk);
  EXPECT_EQ(p.timeNow(), fromSeconds(7));
}

TEST(SharedProgress, AnotherDescriptorIsRefused) {
  EXPECT_EQ(SharedProgress::attach(-1), nullptr);
  EXPECT_EQ(SharedProgress::attach(dup(2)), nullptr);
  const FileDescriptor other = makeMemoryFile();
  ASSERT_EQ(ftruncate(other.get(), 8192), 0);
  EXPECT_EQ(SharedProgress::attach(dup(other.get())), nullptr);
}

/// Notes what it is to simulate.
class NotedStages final : public Stages {
public:
  std::vector<TimeSignature> frames;

  void app(const TimeSignature& now, std::size_t) override { frames.push_back(now); }
  void cull(std::size_t, std::size_t, DrawList&) override {}
  Failure openWall(std::size_t) override { return {}; }
  void closeWall(std::size_t) override {}
  Failure draw(std::size_t, const DrawList&) override { return {}; }
  Failure swap(const TimeSignature&) override { return {}; }
};

TEST(LateStart, TheLoopGoesOnAfterTheFrameAndCatchesUpTickByTick) {
  NotedStages stages;
  FrameLoopOptions o;
  o.mode = Mode::Sequential, o.pace = Pace::Lock, o.delivery = Delivery::Latest, o.rate = 60;
  o.after = signatureAt(600, 60), o.late = fromSeconds(1);
  o.frames = 601 + 70;
  const std::atomic<bool> never = false;
  const FrameLoopOutcome outcome = FrameLoop(stages, o, never).run();
  EXPECT_FALSE(outcome.failure);
  ASSERT_GE(stages.frames.size(), 60U);
  for (std::size_t i = 0; i < 50; ++i) {
    const TimeSignature want = signatureAt(601 + i, 60);
    EXPECT_EQ(stages.frames[i].frame, want.frame);
    EXPECT_EQ(stages.frames[i].time, want.time);
    EXPECT_EQ(stages.frames[i].step, want.step);
  }
}

}  // namespace
}  // namespace stadion
