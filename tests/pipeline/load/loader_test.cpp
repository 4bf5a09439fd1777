#include "pipeline/load/loader.h"

#include "engine/base/run_stopped.h"
#include "engine/build/builder.h"
#include "pipeline/state/scene_state.h"
#include "tests/fresh_folder.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <new>
#include <unistd.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;

std::atomic<bool> released = false;

std::unique_ptr<Node> throwFault(const NodeRequest&) {
  throw std::runtime_error("a fault of ours");
}
std::unique_ptr<Node> throwMemory(const NodeRequest&) {
  throw std::bad_alloc();
}
std::unique_ptr<Node> waitForRelease(const NodeRequest&) {
  while (!released) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return nullptr;
}

using MakeNode = std::unique_ptr<Node> (*)(const NodeRequest&);

/// A loader for a show of one timer, which `make` makes.
class OneTimer {
public:
  explicit OneTimer(MakeNode make) : type_{.name = "timer", .help = "", .make = make} {
    fs::create_directories(folder_);
    std::ofstream(file()) << "timer( )\n";
    types_.add(type_, "this test");
    roots_.add(folder_);
    loader = std::make_unique<Loader>(LoaderParts{meshes_, state_.arena(), importer_, roots_, types_,
                                                  services_, [](const Diagnostics&) {}, &stop});
  }
  ~OneTimer() {
    released = true;
    loader.reset();
    fs::remove_all(folder_);
  }
  std::string file() const { return folder_ / "timer.evs"; }
  void request(std::uint32_t number) { loader->request(number, file(), {}, Affine::Identity()); }

  std::atomic<bool> stop = false;
  std::unique_ptr<Loader> loader;

private:
  fs::path folder_ = makeFreshFolder();
  MeshStore meshes_;
  SceneState state_;
  AssetRoots roots_;
  NodeType type_;
  NodeRegistry types_;
  NodeServices services_;
  Importer importer_{"/nowhere/stadion-import", AssetRoots()};
};

std::string thrownBy(MakeNode make) {
  OneTimer show(make);
  show.request(1);
  try {
    show.loader->take(1);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "nothing";
}

TEST(ThreadsLoader, WhatThePreparationThrowsIsThrownAgainWithTheFilesName) {
  const std::string fault = thrownBy(throwFault), memory = thrownBy(throwMemory);
  EXPECT_NE(fault.find("timer.evs: a fault of ours"), std::string::npos) << fault;
  EXPECT_NE(memory.find("timer.evs: out of memory"), std::string::npos) << memory;
}

TEST(ThreadsLoader, NoThreadWaitsForALoadWhenTheRunIsToStop) {
  released = false;
  OneTimer show(waitForRelease);
  show.request(1);
  std::thread signal([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    show.stop = true;
  });
  EXPECT_THROW(show.loader->take(1), RunStopped);
  signal.join();
}

TEST(ThreadsLoader, ALiveShowGoesOnAndTheDecisionIsTold) {
  released = false;
  OneTimer show(waitForRelease);
  std::vector<std::pair<std::uint32_t, Nanoseconds>> told;
  show.loader->tellLateLoads([&](std::uint32_t load, Nanoseconds time) { told.emplace_back(load, time); });
  show.loader->playLive();
  show.request(1);
  EXPECT_TRUE(show.loader->takesEffect(1, 0)) << "at the start everything is waited for";
  EXPECT_FALSE(show.loader->takesEffect(1, 10));
  EXPECT_FALSE(show.loader->takesEffect(1, 20));
  EXPECT_EQ(show.loader->overdue(), std::vector<std::uint32_t>{1});
  released = true;
  show.request(2);
  show.loader->take(2);  // the loader thread has done both
  EXPECT_FALSE(show.loader->takesEffect(1, 20)) << "decided for this frame";
  Nanoseconds now = 30;
  for (; !show.loader->takesEffect(1, now); ++now) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0], std::pair(std::uint32_t{1}, now));
}

TEST(ThreadsLoader, AWaitForFilesIsReportedAndItsEnd) {
  released = false;
  OneTimer show(waitForRelease);
  std::vector<bool> told;
  show.loader->tellWaiting([&](bool waits) {
    told.push_back(waits);
    released = true;
  });
  show.request(1);
  show.loader->take(1);
  EXPECT_EQ(told, (std::vector<bool>{true, false}));
  show.request(2);
  show.request(3);
  show.loader->take(3);
  told.clear();
  show.loader->take(2);
  EXPECT_EQ(told, std::vector<bool>{}) << "it is there";
}

TEST(ThreadsLoader, AReplayObeysTheDecision) {
  released = true;
  OneTimer show(waitForRelease);
  show.loader->replay({{1, 25}});
  show.request(1);
  EXPECT_FALSE(show.loader->takesEffect(1, 20));
  EXPECT_TRUE(show.loader->takesEffect(1, 30));
  EXPECT_TRUE(show.loader->takesEffect(2, 20)) << "the others are waited for";
}

}  // namespace
}  // namespace stadion
