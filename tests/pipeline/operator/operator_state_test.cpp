#include "pipeline/operator/operator_queue.h"
#include "pipeline/operator/operator_state.h"

#include <gtest/gtest.h>
#include <limits>
#include <thread>

namespace stadion {
namespace {

TEST(OperatorState, ACommandWithoutValueTurnsOverWhatIs) {
  OperatorState s;
  EXPECT_TRUE(s.apply({OperatorAction::Pause}));
  EXPECT_TRUE(s.paused);
  EXPECT_TRUE(s.apply({OperatorAction::Pause}));
  EXPECT_FALSE(s.paused);
  EXPECT_TRUE(s.apply({OperatorAction::Black, 1}));
  EXPECT_TRUE(s.apply({OperatorAction::Black, 1}));
  EXPECT_TRUE(s.presentation.black) << "told twice to be black it is black";
}

TEST(OperatorState, StepsAreForPausedShowsAlone) {
  OperatorState s;
  EXPECT_FALSE(s.apply({OperatorAction::Step}));
  s.apply({OperatorAction::Pause, 1});
  EXPECT_TRUE(s.still());
  EXPECT_TRUE(s.apply({OperatorAction::Step}));
  s.apply({OperatorAction::Pause, 0});
  EXPECT_FALSE(s.still());
}

TEST(OperatorState, AShowThatWaitsStandsStillUntilTheStart) {
  OperatorState s;
  s.waiting = true;
  s.apply({OperatorAction::Pause, 0});
  EXPECT_TRUE(s.still());
  s.apply({OperatorAction::Start});
  EXPECT_FALSE(s.still());
}

TEST(OperatorState, EyesBeginAtTheWallFilesSeparationAndStopAtTheEnds) {
  OperatorState s;
  s.wallsEyeSeparation = 0.063;
  EXPECT_DOUBLE_EQ(s.eyeSeparation(), 0.063);
  EXPECT_TRUE(s.apply({OperatorAction::EyeSeparation, 0.002, true}));
  EXPECT_DOUBLE_EQ(s.eyeSeparation(), 0.065);
  EXPECT_TRUE(s.apply({OperatorAction::EyeSeparation, -1, true}));
  EXPECT_DOUBLE_EQ(s.eyeSeparation(), 0);
  EXPECT_TRUE(s.apply({OperatorAction::EyeSeparation, 0.07}));
  EXPECT_DOUBLE_EQ(s.eyeSeparation(), 0.07);
}

TEST(OperatorState, WhatMakesNoSenseChangesNothing) {
  OperatorState s;
  EXPECT_FALSE(s.apply({OperatorAction::Volume, std::numeric_limits<double>::quiet_NaN()}));
  EXPECT_FALSE(s.apply({OperatorAction::Volume, 1.5}));
  EXPECT_FALSE(s.apply({OperatorAction::Volume}));
  EXPECT_FALSE(s.apply({OperatorAction::EyeSeparation, -0.01}));
  EXPECT_DOUBLE_EQ(s.volume, 1);
  EXPECT_DOUBLE_EQ(s.eyeSeparation(), 0.064);
}

TEST(OperatorState, EveryActionHasItsName) {
  for (std::size_t i = 0; i < kOperatorActionNames.size(); ++i)
    EXPECT_EQ(operatorActionNamed(kOperatorActionNames[i]), static_cast<OperatorAction>(i));
  EXPECT_EQ(operatorActionNamed("explode"), std::nullopt);
}

TEST(ThreadsOperatorQueue, CommandsOfOneThreadArriveInTheirOrderAndNoneIsLost) {
  OperatorQueue queue;
  std::thread poster([&] {
    for (int i = 0; i < 1000;)
      if (queue.post({OperatorAction::Volume, i / 1000.0})) ++i;
  });
  int seen = 0;
  while (seen < 1000)
    for (const OperatorCommand& c : queue.take()) EXPECT_DOUBLE_EQ(*c.value, seen++ / 1000.0);
  poster.join();
}

TEST(OperatorState, LatencyIsAWholeNumberOfFramesFromOneToFour) {
  OperatorState s;
  EXPECT_TRUE(s.apply({OperatorAction::Latency, 2}));
  EXPECT_EQ(s.mostInFlight, 2);
  for (const double wrong : {0.0, 5.0, 1.5, -1.0})
    EXPECT_FALSE(s.apply({OperatorAction::Latency, wrong})) << wrong;
  EXPECT_EQ(s.mostInFlight, 2);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(s.apply({OperatorAction::Latency, -1, true}));
  EXPECT_EQ(s.mostInFlight, 1);
  OperatorState started;
  started.runMostInFlight = 3;
  EXPECT_TRUE(started.apply({OperatorAction::Latency, -1, true}));
  EXPECT_EQ(started.mostInFlight, 2);
}

}  // namespace
}  // namespace stadion
