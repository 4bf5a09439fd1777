#include "pipeline/platform/scoped_realtime_priority.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <sched.h>
#include <sys/syscall.h>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

/// [ns] as sched_getattr(2) has it; 0 where the system knows none.
std::uint64_t turnOfThisThread() {
  std::array<std::uint64_t, 6> words{};
  return syscall(SYS_sched_getattr, 0, words.data(), 48, 0) == 0 ? words[3] : 0;
}

void onAThread(void (*work)()) {
  std::thread(work).join();
}

TEST(ScopedRealtimePriority, LastsAsLongAsItsObject) {
  onAThread([] {
    const std::uint64_t turn = turnOfThisThread();
    {
      const ScopedRealtimePriority prompt;
      const bool realTime = sched_getscheduler(0) == (SCHED_RR | SCHED_RESET_ON_FORK);
      EXPECT_TRUE(realTime || turn == 0 || turnOfThisThread() < turn);
    }
    EXPECT_EQ(sched_getscheduler(0) & ~SCHED_RESET_ON_FORK, SCHED_OTHER);
    EXPECT_EQ(turnOfThisThread(), turn);
  });
}

TEST(ScopedRealtimePriority, IsNotHandedDown) {
  onAThread([] {
    const ScopedRealtimePriority prompt;
    onAThread([] { EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER); });
  });
}

TEST(ScopedRealtimePriority, IsHandedDownWhereThatIsAskedFor) {
  onAThread([] {
    const ScopedRealtimePriority prompt(ScopedRealtimePriority::For::ThoseItStarts);
    static int policy;
    policy = sched_getscheduler(0);
    onAThread([] { EXPECT_EQ(sched_getscheduler(0), policy); });
  });
}

TEST(ScopedRealtimePriority, LeavesAnotherPolicy) {
  onAThread([] {
    const sched_param none{};
    ASSERT_EQ(sched_setscheduler(0, SCHED_BATCH, &none), 0);
    { const ScopedRealtimePriority prompt; }
    EXPECT_EQ(sched_getscheduler(0), SCHED_BATCH);
  });
}

}  // namespace
}  // namespace stadion
