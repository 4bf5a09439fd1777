/// A leader and its followers that play live, each started by hand: takeover, end, operator, trackers.

#include "tests/cli/cluster/two_live_hosts.h"
#include "tests/programs/desk.h"

#include <gtest/gtest.h>
#include <lo/lo.h>

#include <csignal>
#include <map>
#include <thread>

namespace stadion {
namespace {

/// Machines of which each is started by hand.
class MachinesByHand {
public:
  MachinesByHand() : file_(fourNodes(folder_)) {}
  pid_t start(const std::string& node, const std::string& as) {
    return startProgram(
        {{stadionPath(), "run",     kKick,   "--cluster", file_,   "--node",  node,   "--out",
          as_(as),       "--size",  "32x24", "--look",    "plain", "--pace",  "lock", "--pictures",
          "none",        "--input", "none",  "--seconds", "600",   "--hashes"}},
        as_(as + ".said"), as_(as + ".told"));
  }
  bool tells(const std::string& as, const std::string& what) const {
    return becomes([&] { return told(as).find(what) != std::string::npos; });
  }
  /// It shows pictures.
  bool show(const std::string& as) const {
    return becomes([&] { return swapTimesOf(as_(as)).size() > 10; });
  }
  std::string told(const std::string& as) const { return fileContent(as_(as + ".told")); }

private:
  std::string as_(const std::string& name) const { return folder_.path() / name; }
  TestFolder folder_;
  std::string file_;
};

TEST(ProgramCluster, OfTwoProgramsOfOneHostTheLaterEndsAndTheLeaderEndsTheShowForAll) {
  MachinesByHand machines;
  std::map<std::string, pid_t> all;
  for (const char* node : kFourNodes) all[node] = machines.start(node, node);
  for (const char* node : kFourNodes) ASSERT_TRUE(machines.show(node)) << machines.told(node);
  const pid_t second = machines.start("left", "second");
  EXPECT_EQ(endOf(second), 2) << machines.told("second");
  EXPECT_TRUE(machines.tells("second", "another program is left already; this one ends"))
      << machines.told("second");
  const pid_t usurper = machines.start("front", "usurper");
  EXPECT_EQ(endOf(usurper), 2) << machines.told("usurper");
  EXPECT_TRUE(machines.tells("usurper", "another program leads as front already; this one ends"))
      << machines.told("usurper");
  EXPECT_EQ(machines.told("usurper").find("the show restarts"), std::string::npos)
      << machines.told("usurper");
  ASSERT_EQ(kill(all.at("front"), SIGTERM), 0);
  for (const auto& [node, process] : all) {
    const int status = endOf(process);
    EXPECT_EQ(status, node == "front" ? 128 + SIGTERM : 0) << node << machines.told(node);
  }
  EXPECT_EQ(machines.told("left").find("another program"), std::string::npos) << "it played first";
  EXPECT_EQ(machines.told("front").find("the others go on"), std::string::npos) << "no host was disturbed\n"
                                                                                << machines.told("front");
}

TEST(ProgramCluster, AHostLeftOutAsTheShowEndsReportsItsMissingPictures) {
  const std::string missing =
      "--out: the show ended before this machine had caught up with it: its last pictures are missing";
  std::string told;
  // The leader waits a second for the answer to its last order. On a busy machine the follower may wake
  // before or after that second, and end otherwise: then the next try.
  for (int tries = 0; tries < 10 && !has(told, missing); ++tries) {
    // The leader does not lose sight of a machine that stands still before two deadlines are over.
    const TwoLive two("", "deadline 2\n");
    const TestFolder folder;
    const std::string out = folder.path() / "floor";
    const auto front = two.start("front", {"--input", "none"});
    const auto floor = two.start("floor", {"--out", out, "--pictures", "none", "--hashes"});
    ASSERT_TRUE(becomes([&] { return swapTimesOf(out).size() > 60; })) << floor->err();
    ASSERT_EQ(kill(floor->pid(), SIGSTOP), 0);
    EXPECT_TRUE(front->says("floor has not been heard of")) << front->err();
    kill(front->pid(), SIGTERM);
    // It has ordered the last frame by then.
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    kill(floor->pid(), SIGCONT);
    EXPECT_EQ(front->status(), 128 + SIGTERM) << front->err();
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (floor->runs() && std::chrono::steady_clock::now() < end)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    told = floor->err();
    if (!has(told, missing)) continue;
    EXPECT_EQ(floor->status(), 2) << told;
  }
  EXPECT_TRUE(has(told, missing)) << told;
}

TEST(ProgramCluster, TheTrackersAreTheLeadersAndTheOthersNeedNotNameThem) {
  const TwoLive two;
  const auto front = two.start("front", {"--tracker", "osc:" + std::to_string(freePort())});
  const auto floor = two.start("floor");
  EXPECT_TRUE(front->says("playing until Ctrl-C")) << front->err();
  EXPECT_TRUE(two.show("front") && two.show("floor")) << front->err() << floor->err();
  EXPECT_EQ(TwoLive::endOf(*front), 130) << front->err();
  EXPECT_TRUE(floor->says("front has ended the show")) << floor->err();
  EXPECT_EQ(floor->status(), 0) << floor->err();
  EXPECT_FALSE(has(front->err(), "without floor")) << front->err();
}

TEST(ProgramCluster, ALeaderThatWasStoppedAndComesBackEnds) {
  const TwoLive two;
  const std::vector<std::string> live{"--input", "none"};
  const auto floor = two.start("floor", live), first = two.start("front", live);
  ASSERT_TRUE(first->says("playing until Ctrl-C")) << first->err();
  ASSERT_TRUE(two.show("front") && two.show("floor")) << first->err() << floor->err();
  ASSERT_EQ(kill(first->pid(), SIGSTOP), 0);
  const auto second = two.start("front", live);
  ASSERT_TRUE(second->says("the show goes on after frame")) << second->err();
  std::this_thread::sleep_for(std::chrono::seconds(1));
  ASSERT_EQ(kill(first->pid(), SIGCONT), 0);
  EXPECT_EQ(first->status(), 2) << first->err();
  EXPECT_TRUE(has(first->err(), "another program leads as front already; this one ends")) << first->err();
  EXPECT_EQ(TwoLive::endOf(*second), 130) << second->err();
  EXPECT_EQ(floor->status(), 0) << floor->err();
}

TEST(ProgramCluster, TheLeaderNamesTheHostsItWaitsForAndTheOperatorNeedNot) {
  const TwoLive two;
  const std::string port = std::to_string(freePort());
  const lo_address desk = lo_address_new("127.0.0.1", port.c_str());
  const auto front = two.start("front", {"--input", "none", "--osc", port});
  EXPECT_TRUE(front->says("cluster, front: waiting for floor, 30 s at most; Start begins without"))
      << front->err();
  lo_send(desk, "/stadion/start", "i", 1);
  EXPECT_TRUE(front->says("the show begins without floor")) << front->err();
  lo_send(desk, "/stadion/end", "i", 1);
  EXPECT_EQ(front->status(), 0) << front->err();
  lo_address_free(desk);
}

TEST(ProgramCluster, WhatTheOperatorDecidedStaysWhenTheLeaderRestarts) {
  const TwoLive two;
  const auto floor = two.start("floor", {"--input", "none"});
  const std::string port = std::to_string(freePort());
  const lo_address desk = lo_address_new("127.0.0.1", port.c_str());
  {
    const auto front = two.start("front", {"--input", "none", "--osc", port});
    ASSERT_TRUE(front->says("playing until Ctrl-C")) << front->err();
    ASSERT_TRUE(two.show("front") && two.show("floor")) << front->err() << floor->err();
    lo_send(desk, "/stadion/black", "i", 1), lo_send(desk, "/stadion/pause", "i", 1);
    ASSERT_TRUE(front->says("operator: paused at")) << front->err();
    front->kill();
  }
  const auto front = two.start("front", {"--input", "none", "--osc", port});
  EXPECT_TRUE(front->says("the show goes on after frame")) << front->err();
  EXPECT_TRUE(front->says("operator: paused at")) << front->err();
  EXPECT_TRUE(front->says("operator: black on")) << front->err();
  lo_address_free(desk);
  EXPECT_EQ(TwoLive::endOf(*front), 130) << front->err();
  EXPECT_EQ(floor->status(), 0) << floor->err();
}

TEST(ProgramCluster, AShowThatWaitsForStartStillDoesWhenTheLeaderRestarts) {
  const TwoLive two;
  const auto floor = two.start("floor", {"--input", "none"});
  const std::string port = std::to_string(freePort());
  const lo_address desk = lo_address_new("127.0.0.1", port.c_str());
  const std::vector<std::string> waiting{"--input", "none", "--osc", port, "--wait"};
  {
    const auto front = two.start("front", waiting);
    ASSERT_TRUE(front->says("waiting for start")) << front->err();
    ASSERT_TRUE(two.show("front") && two.show("floor")) << front->err() << floor->err();
    front->kill();
  }
  const auto front = two.start("front", waiting);
  EXPECT_TRUE(front->says("the show goes on after frame")) << front->err();
  EXPECT_TRUE(front->says("waiting for start")) << front->err();
  std::this_thread::sleep_for(std::chrono::seconds(1));
  EXPECT_FALSE(has(front->err(), "operator: start")) << front->err();
  lo_send(desk, "/stadion/start", "i", 1);
  EXPECT_TRUE(front->says("operator: start")) << front->err();
  lo_address_free(desk);
  EXPECT_EQ(TwoLive::endOf(*front), 130) << front->err();
  EXPECT_FALSE(has(front->err(), "operator: paused")) << front->err();
  EXPECT_EQ(floor->status(), 0) << floor->err();
}

TEST(ProgramCluster, ARecordThatWouldBeginInTheMiddleIsNotWritten) {
  const TestFolder folder;
  const TwoLive two;
  const auto floor = two.start("floor", {"--input", "none"});
  const std::string record = folder.path() / "visitor.input";
  {
    const auto front = two.start("front", {"--input", "none", "--record-input", record});
    ASSERT_TRUE(front->says("playing until Ctrl-C")) << front->err();
    ASSERT_TRUE(two.show("front") && two.show("floor")) << front->err() << floor->err();
    front->kill();
  }
  const auto front = two.start("front", {"--input", "none", "--record-input", record});
  EXPECT_TRUE(front->says("--record-input: nothing is recorded")) << front->err();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  EXPECT_NE(TwoLive::endOf(*front), 0) << front->err();
  EXPECT_FALSE(std::filesystem::exists(record));
}

}  // namespace
}  // namespace stadion
