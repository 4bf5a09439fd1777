/// The pool draws each piece once, and passes on what a piece throws.

#include "pipeline/platform/draw_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace stadion {
namespace {

TEST(DrawPool, DoesEachPieceOnceForSeveralCallersAtATime) {
  DrawPool pool(3);
  std::vector<std::atomic<int>> done(4 * 200);
  std::vector<std::thread> callers;
  for (std::size_t c = 0; c < 4; ++c)
    callers.emplace_back([&, c] { pool.run(200, [&, c](std::size_t i) { ++done[200 * c + i]; }); });
  for (std::thread& t : callers) t.join();
  for (const auto& times : done) EXPECT_EQ(times, 1);
}

TEST(DrawPool, LetsNoMoreThreadsWorkThanItHas) {
  DrawPool pool(2);
  std::atomic<int> working = 0, most = 0;
  const auto piece = [&](std::size_t) {
    const int now = ++working;
    int before = most;
    while (before < now && !most.compare_exchange_weak(before, now)) {
    }
    std::this_thread::yield();
    --working;
  };
  std::thread other([&] { pool.run(100, piece); });
  pool.run(100, piece);
  other.join();
  EXPECT_LE(most, 2);
}

TEST(DrawPool, CallersThatWaitDoNoPieces) {
  for (const std::size_t threads : {1, 3}) {
    DrawPool pool(threads, DrawPool::Callers::Wait);
    std::mutex mutex;
    std::set<std::thread::id> workers;
    pool.run(50, [&](std::size_t) {
      const std::lock_guard lock(mutex);
      workers.insert(std::this_thread::get_id());
    });
    EXPECT_FALSE(workers.contains(std::this_thread::get_id()));
    EXPECT_LE(workers.size(), threads);
  }
}

TEST(DrawPool, ThrowsWhatTheFirstPieceThrewAndLeavesLaterOnesOut) {
  DrawPool pool(2);
  std::atomic<int> done = 0;
  const auto thirdThrows = [&](std::size_t i) {
    if (i >= 3) throw std::runtime_error(std::to_string(i));
    ++done;
  };
  try {
    pool.run(1000, thirdThrows);
    FAIL() << "it threw nothing";
  } catch (const std::runtime_error& e) {
    EXPECT_EQ(std::string(e.what()), "3");
  }
  EXPECT_EQ(done, 3);
  pool.run(3, thirdThrows);
  EXPECT_EQ(done, 6) << "the pool goes on";
}

}  // namespace
}  // namespace stadion
