/// Several machines that play one show, here as processes over the loopback interface.

#include "tests/programs/played_cluster.h"

#include <gtest/gtest.h>

#include <regex>
#include <unistd.h>

namespace stadion {
namespace {

TEST(ProgramCluster, FourMachinesShowWhatOneShows) {
  const TestFolder folder;
  const std::string out = folder.path() / "four", one = folder.path() / "one";
  const std::vector<std::string> same{"--size", "64x48", "--frames", "16", "--pictures", "4"};
  std::vector<std::string> cluster{"cluster", fourNodes(folder), kKick, "--out", out},
      alone{"run", kKick, "--walls", "cave4", "--out", one};
  cluster.insert(cluster.end(), same.begin(), same.end());
  alone.insert(alone.end(), same.begin(), same.end());
  const ProgramResult r = stadionProgram(cluster);
  ASSERT_EQ(r.status, 0) << r.out << r.err;
  ASSERT_EQ(stadionProgram(alone).status, 0);
  const auto wanted = picturesIn(one);
  EXPECT_GE(wanted.size(), 32U);
  EXPECT_EQ(picturesIn(out), wanted);
  const Json together = Json::parse(fileContent(out + "/summaries.json"));
  std::size_t last = 0;
  for (const char* node : {"front", "left", "right", "floor"}) {
    const Json s = summaryOf(out + "/" + node);
    EXPECT_EQ(s["state_hash"], summaryOf(one)["state_hash"]) << node;
    EXPECT_EQ(s["frames"], 16) << node;
    EXPECT_EQ(s["cluster"]["node"], node);
    EXPECT_EQ(together[node], s);
    last += s["cluster"]["barriers"].get<std::size_t>();
  }
  EXPECT_GT(last, 0U);
  EXPECT_LE(last, 16U) << "of a frame all others wait for one machine";
  const Json lead = summaryOf(out + "/front")["cluster"];
  EXPECT_EQ(lead["leads"], true);
  EXPECT_EQ(lead["orders"], 16);
  EXPECT_LE(lead["most_order_bytes"], 1024) << "what travels a frame";
  EXPECT_EQ(lead["joined"], 3);
  EXPECT_EQ(lead["left_out"], 0) << r.err;
  EXPECT_GE(lead["compared"], 3);
  EXPECT_EQ(lead["differed"], 0);
}

TEST(ProgramCluster, ABitThatDiffersIsNamedAndTheSceneTakenOver) {
  const TestFolder folder;
  const std::string cluster =
      folder.write("two.cluster", "walls cave4\nnode front front left right\nnode floor floor\n"
                                  "hash-every 10\npartition d" +
                                      std::to_string(getpid()) + "\n");
  const std::vector<std::string> play{stadionPath(), "run",    kKick,   "--cluster",  cluster, "--size",
                                      "32x24",       "--look", "plain", "--seconds",  "8",     "--rate",
                                      "60",          "--pace", "lock",  "--pictures", "none"};
  std::vector<std::string> lead = play, other = play;
  lead.insert(lead.end(), {"--node", "front", "--out", folder.path() / "front"});
  other.insert(other.end(),
               {"--node", "floor", "--out", folder.path() / "floor", "--plant-difference", "200"});
  const std::string toldThere = folder.path() / "there";
  const pid_t there = startProgram({other}, folder.path() / "said", toldThere);
  const ProgramResult here = runProgram({lead});
  EXPECT_EQ(endOf(there), 0) << fileContent(toldThere);
  EXPECT_EQ(here.status, 0) << here.err;
  std::smatch since;
  ASSERT_TRUE(std::regex_search(here.err, since,
                                std::regex("the scene of floor differs from ours since frame ([0-9]+)")))
      << here.err;
  EXPECT_GE(std::stoi(since[1]), 200);
  EXPECT_LE(std::stoi(since[1]), 260) << "within 60 frames";
  const std::string saidThere = fileContent(toldThere);
  for (const std::string* told : {&here.err, &saidThere})
    EXPECT_TRUE(std::regex_search(
        *told, std::regex("after frame [0-9]+: ball \\(.*kick.evs:27\\), [a-z. ]+ is .* and ")))
        << *told;
  EXPECT_NE(here.err.find("floor plays with us"), std::string::npos) << here.err;
  EXPECT_EQ(summaryOf(folder.path() / "floor")["state_hash"],
            summaryOf(folder.path() / "front")["state_hash"]);
}

TEST(ProgramCluster, ANetworkThatCannotServeIsNamed) {
  const TestFolder folder;
  const std::string file =
      folder.write("va.cluster", "walls cave4\nnode front front left right floor\ninterface va\n");
  const std::string play =
      stadionPath() + " run " + kKick + " --cluster " + file + " --node front --gl none --frames 3; ";
  const ProgramResult r = runProgram(
      {{"unshare", "-n", "sh", "-c",
        "ip link add va type veth peer name vb && ip link set va multicast off && ip link set va up && "
        "ip addr add 10.9.0.1/24 dev va && echo made; " +
            play + "ip link set lo up; " + play + "ip link set va multicast on; " + play}});
  if (!has(r.out, "made")) GTEST_SKIP() << "network namespaces cannot be made here (that takes root)";
  EXPECT_TRUE(has(r.err, "this machine's loopback interface is not up: `ip link set lo up`")) << r.err;
  EXPECT_TRUE(has(r.err, "the network interface \"va\" has no multicast")) << r.err;
  EXPECT_TRUE(has(r.err, "`ip link set va multicast on`")) << r.err;
  EXPECT_EQ(r.status, 0) << "and then it can: " << r.err;
}

TEST(ProgramCluster, WhatIsWrongIsToldAtTheStart) {
  const TestFolder folder;
  const std::string cluster = fourNodes(folder);
  const auto refused = [&](std::vector<std::string> words, const std::string& why) {
    const ProgramResult r = stadionProgram(std::move(words));
    EXPECT_EQ(r.status, 2) << r.out;
    EXPECT_NE(r.err.find(why), std::string::npos) << r.err;
  };
  refused({"run", kKick, "--cluster", cluster, "--node", "lefft"},
          "has no node \"lefft\"; did you mean \"left\"?");
  refused({"run", kKick, "--cluster", cluster}, "--node");
  refused({"run", kKick, "--cluster", "nowhere.cluster", "--node", "left"}, "nowhere.cluster");
  refused({"run", kKick, "--cluster", cluster, "--node", "left", "--walls", "cave6"}, "--walls");
  refused({"cluster", cluster, "nowhere.evs"}, "nowhere.evs: error: cannot be read");
  const std::string other = folder.write("other.cluster", "walls cave4\nnode a fromt\n");
  refused({"run", kKick, "--cluster", other, "--node", "a"},
          "has no wall \"fromt\"; did you mean \"front\"?");
  const std::string nowhere = folder.write("net.cluster", "walls cave4\nnode a front\ninterface nowhere7\n");
  refused({"run", kKick, "--cluster", nowhere, "--node", "a", "--frames", "5"},
          "net.cluster:3:11: error: this machine has no network interface \"nowhere7\"");
}

}  // namespace
}  // namespace stadion
