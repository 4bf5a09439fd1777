#include "pipeline/state/frame_slots.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace stadion {
namespace {

FrameTicket frameOf(std::uint64_t number) {
  FrameTicket ticket;
  ticket.signature.frame = number;
  return ticket;
}

TEST(FrameSlots, EveryFrameIsHandedToEveryWallInOrder) {
  FrameSlots slots(2, Delivery::Every);
  for (std::uint64_t frame = 0; frame < 3; ++frame) slots.endWrite(*slots.beginWrite(), frameOf(frame));
  for (std::uint64_t frame = 0; frame < 3; ++frame)
    for (std::size_t wall = 0; wall < 2; ++wall) EXPECT_EQ(slots.lease(wall)->ticket.signature.frame, frame);
}

TEST(FrameSlots, ASlotUnderLeaseIsNotWritten) {
  FrameSlots slots(1, Delivery::Latest);
  slots.endWrite(*slots.beginWrite(), frameOf(0));
  const auto lease = slots.lease(0);
  for (std::uint64_t frame = 1; frame < 20; ++frame) {
    const auto slot = slots.beginWrite();
    EXPECT_NE(*slot, lease->slot);
    slots.endWrite(*slot, frameOf(frame));
  }
  EXPECT_TRUE(slots.release(*lease));
}

TEST(FrameSlots, LatestDeliveryHandsOutTheNewestFrameToAllWalls) {
  FrameSlots slots(2, Delivery::Latest);
  for (std::uint64_t frame = 0; frame < 7; ++frame) slots.endWrite(*slots.beginWrite(), frameOf(frame));
  const auto first = slots.lease(0);
  EXPECT_EQ(first->ticket.signature.frame, 6u);
  slots.endWrite(*slots.beginWrite(), frameOf(7));
  // The choice was made when the first wall asked: the second one is not given frame 7 in its place.
  EXPECT_EQ(slots.lease(1)->ticket.signature.frame, 6u);
}

TEST(FrameSlots, AHangingReaderLosesItsSlotAfterTheDeadline) {
  FrameSlots slots(3, Delivery::Latest, std::chrono::milliseconds(5));
  std::vector<Lease> held;
  for (std::size_t i = 0; i < 3; ++i) {
    slots.endWrite(*slots.beginWrite(), frameOf(i));
    held.push_back(*slots.lease(0));
  }
  const auto slot = slots.beginWrite();
  ASSERT_TRUE(slot);
  slots.endWrite(*slot, frameOf(3));
  EXPECT_FALSE(slots.release(held[0]));
}

TEST(FrameSlots, AppWaitsWhileAsManyFramesAreUnderWayAsAreAllowed) {
  FrameSlots slots(1, Delivery::Every);
  slots.limitInFlight(1);
  slots.endWrite(*slots.beginWrite(), frameOf(0));
  std::atomic<bool> began = false;
  std::thread app([&] { began = slots.beginWrite().has_value(); });
  EXPECT_TRUE(slots.release(*slots.lease(0)));
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(began);  // a slot is free, but frame 0 is not seen yet
  slots.noteShown();
  app.join();
  EXPECT_TRUE(began);
}

TEST(FrameSlots, OneMoreBeginsWhenOnlyTheLastWallsStillDraw) {
  FrameSlots slots(3, Delivery::Every);
  slots.limitInFlight(1, 1);
  slots.endWrite(*slots.beginWrite(), frameOf(0));
  std::atomic<bool> began = false;
  std::thread app([&] { began = slots.beginWrite().has_value(); });
  slots.noteDrawn();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(began);  // two walls draw
  slots.noteDrawn();
  app.join();
  EXPECT_TRUE(began);
}

TEST(FrameSlots, WhereTheNewestCountsItIsChosenWhenTheOneBeforeIsSeen) {
  FrameSlots slots(1, Delivery::Latest);
  slots.limitInFlight(1);
  slots.endWrite(*slots.beginWrite(), frameOf(0));
  EXPECT_TRUE(slots.release(*slots.lease(0)));
  slots.endWrite(*slots.beginWrite(), frameOf(1));
  std::thread swap([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    for (std::uint64_t frame = 2; frame < 6; ++frame) slots.endWrite(*slots.beginWrite(), frameOf(frame));
    slots.noteShown();
  });
  EXPECT_EQ(slots.lease(0)->ticket.signature.frame, 5u);
  swap.join();
}

TEST(FrameSlots, ALimitThatIsLiftedLetsAppGoOn) {
  FrameSlots slots(1, Delivery::Every);
  slots.limitInFlight(1);
  slots.endWrite(*slots.beginWrite(), frameOf(0));
  std::thread app([&] { EXPECT_TRUE(slots.beginWrite()); });
  slots.limitInFlight(0);
  app.join();
}

TEST(FrameSlots, FinishLetsReadersEmptyTheSlotsAndThenEnds) {
  FrameSlots slots(1, Delivery::Every);
  slots.endWrite(*slots.beginWrite(), frameOf(0));
  slots.finish();
  EXPECT_TRUE(slots.lease(0));
  EXPECT_FALSE(slots.lease(0));
}

TEST(FrameSlots, AFrameThatStandsStillComesAgainTheLatestLast) {
  FrameSlots latest(1, Delivery::Latest), every(1, Delivery::Every);
  std::vector<std::size_t> written;
  for (int i = 0; i < 2; ++i) {
    const auto slot = latest.beginWrite();
    written.push_back(*slot);
    latest.endWrite(*slot, frameOf(7));
    every.endWrite(*every.beginWrite(), frameOf(7));
  }
  latest.finish(), every.finish();
  EXPECT_EQ(latest.lease(0)->slot, written[1]);
  EXPECT_FALSE(latest.lease(0)) << "the older one is not shown after it";
  EXPECT_TRUE(every.lease(0));
  EXPECT_TRUE(every.lease(0));
}

TEST(ThreadsFrameSlots, StopWakesAWaitingReaderAndWriter) {
  FrameSlots slots(1, Delivery::Every);
  std::thread reader([&] { EXPECT_FALSE(slots.lease(0)); });
  std::this_thread::sleep_for(std::chrono::milliseconds(10));
  slots.stop();
  reader.join();
  EXPECT_FALSE(slots.beginWrite());
}

}  // namespace
}  // namespace stadion
