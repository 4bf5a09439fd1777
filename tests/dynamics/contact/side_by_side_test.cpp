/// Dynamics nodes that do not meet simulate side by side: on how many threads changes nothing.

#include "tests/dynamics/nodes/show_nodes.h"

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <stdexcept>
#include <sys/resource.h>
#include <unistd.h>

namespace stadion {
namespace {

using namespace show_nodes;

TEST(ThreadsWorkerPool, EveryPieceIsDoneOnce) {
  for (const std::size_t threads : {1, 2, 5}) {
    WorkerPool pool(threads);
    for (std::size_t count = 0; count < 40; ++count) {
      std::vector<std::atomic<int>> done(count);
      pool.run(count, [&](std::size_t i) { ++done[i]; });
      for (const auto& d : done) EXPECT_EQ(d, 1);
    }
  }
}

TEST(ThreadsWorkerPool, WhatAPieceThrowsIsThrownWhenAllAreDone) {
  for (const std::size_t threads : {1, 4}) {
    WorkerPool pool(threads);
    std::atomic<int> done = 0;
    const auto piece = [&](std::size_t i) {
      ++done;
      if (i % 3 == 1) throw std::runtime_error(std::to_string(i));
    };
    try {
      pool.run(10, piece);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "1");
    }
    EXPECT_EQ(done, 10);
  }
}

/// The address space that this process may have from now on: what it has, and a little.
void closeAddressSpace() {
  std::ifstream statm("/proc/self/statm");
  rlim_t pages = 0;
  statm >> pages;
  rlimit most{};
  getrlimit(RLIMIT_AS, &most);
  most.rlim_cur = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + (1U << 20);
  setrlimit(RLIMIT_AS, &most);
}

// In a process of its own; more threads than the C library keeps stacks for.
TEST(ProgramWorkerPool, WithoutRoomForItsThreadsTheSameIsDone) {
  const auto work = [] {
    closeAddressSpace();
    WorkerPool pool(64);
    std::atomic<int> done = 0;
    pool.run(100, [&](std::size_t) { ++done; });
    std::_Exit(done == 100 ? 0 : 1);
  };
  EXPECT_EXIT(work(), testing::ExitedWithCode(0), "");
}

/// Five heaps, each with a dynamics node of its own; the last two meet: a ball of the fourth is collider of
/// the fifth.
std::vector<std::uint64_t> hashesOn(std::size_t threads) {
  ShowFixture show(threads);
  const MeshId box = show.meshes.add(cube(3)), small = show.meshes.add(cube(0.1));
  show.loader.files["show"] = [&](LoadedScene& load) {
    addNode<Field>(load, "gravity", Vec3(0, 0, -9.81), true);
    for (int heap = 0; heap < 5; ++heap) {
      const std::string own = std::to_string(heap), floor = "floor" + own;
      addNode<Block>(load, floor, box, Vec3(20 * heap, 0, -3));
      std::vector<std::string> balls, colliders{floor};
      for (int i = 0; i < 12; ++i) {
        balls.push_back("ball" + own + "-" + std::to_string(i));
        addNode<Ball>(load, balls.back(), Vec3(20 * heap + 0.11 * (i % 3), 0.13 * (i % 2), 0.3 + 0.25 * i),
                      std::vector<std::string>{"gravity"}, NodeRef{}, heap == 3 && i == 0 ? small : kNoMesh);
      }
      if (heap == 4) colliders.push_back("ball3-0");
      addNode<Sim>(load, "sim" + own, colliders, balls);
    }
  };
  show.scene.open("show");
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 120; ++i) {
    show.frame();
    hashes.push_back(show.scene.stateHash());
  }
  return hashes;
}

TEST(ThreadsDynamics, SideBySideTheStateIsTheSameToTheBitOnAnyNumberOfThreads) {
  const auto alone = hashesOn(1);
  for (const std::size_t threads : {2, 3, 8}) EXPECT_EQ(hashesOn(threads), alone) << threads;
}

/// A plate that another node's ball carries stays on the ball: the second node sees where the first has put
/// it.
TEST(ThreadsDynamics, ANodeThatLooksAtAnothersBodyWaitsForIt) {
  for (const std::size_t threads : {1, 4}) {
    ShowFixture show(threads);
    const MeshId crate = show.meshes.add(cube(0.1));
    const Ball *pushed = nullptr, *far = nullptr;
    show.loader.files["show"] = [&](LoadedScene& load) {
      addNode<Field>(load, "push", Vec3(2, 0, 0), true);
      addNode<Ball>(load, "first", Vec3(0, 0, 0), std::vector<std::string>{"push"}, NodeRef{}, crate);
      pushed = &addNode<Ball>(load, "second", Vec3(1, 0, 0), std::vector<std::string>{});
      far = &addNode<Ball>(load, "third", Vec3(1, 50, 0), std::vector<std::string>{});
      addNode<Sim>(load, "a", std::vector<std::string>{}, std::vector<std::string>{"first"});
      addNode<Sim>(load, "b", std::vector<std::string>{"first"}, std::vector<std::string>{"second"});
      addNode<Sim>(load, "c", std::vector<std::string>{}, std::vector<std::string>{"third"});
    };
    show.scene.open("show");
    show.frames(61);
    // The first is a collider to the second, as heavy as the world: it meets it after 0.8 m, at 1.789 m/s.
    EXPECT_GE(pushed->state().v.x(), 1.78) << threads;
    EXPECT_EQ(far->state().v.norm(), 0) << threads;
  }
}

}  // namespace
}  // namespace stadion
