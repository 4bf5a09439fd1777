/// Several machines that play one show, here as processes over the loopback interface.

#include "tests/cli/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <regex>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

using Json = nlohmann::json;

const std::string kKick = STADION_SOURCE_DIR "/scripts/kick.evs";

/// Tests run side by side: each cluster has a partition of its own.
std::string fourNodes(const TemporaryFolder& folder, const std::string& more = {}) {
  return folder.write("four.cluster",
                      "walls cave4\nnode front front\nnode left left\nnode right right\nnode floor floor\n"
                      "partition p" +
                          std::to_string(getpid()) + "\n" + more);
}

std::map<std::string, std::string> picturesIn(const std::filesystem::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".png" && entry.path().filename() != "contact-sheet.png")
      all[entry.path().filename()] = fileContent(entry.path());
  return all;
}

Json summaryOf(const std::filesystem::path& folder) {
  return Json::parse(fileContent(folder / "summary.json"));
}

TEST(ProgramCluster, FourMachinesShowWhatOneShows) {
  const TemporaryFolder folder;
  const std::string out = folder.path() / "four", one = folder.path() / "one";
  const std::vector<std::string> same{"--size", "64x48", "--frames", "40", "--pictures", "4"};
  std::vector<std::string> cluster{"cluster", fourNodes(folder), kKick, "--out", out},
      alone{"run", kKick, "--walls", "cave4", "--out", one};
  cluster.insert(cluster.end(), same.begin(), same.end());
  alone.insert(alone.end(), same.begin(), same.end());
  const ProgramResult r = stadionProgram(cluster);
  ASSERT_EQ(r.status, 0) << r.out << r.err;
  ASSERT_EQ(stadionProgram(alone).status, 0);
  const auto wanted = picturesIn(one);
  EXPECT_GE(wanted.size(), 80U);
  EXPECT_EQ(picturesIn(out), wanted);
  for (const char* node : {"front", "left", "right", "floor"}) {
    const Json s = summaryOf(out + "/" + node);
    EXPECT_EQ(s["state_hash"], summaryOf(one)["state_hash"]) << node;
    EXPECT_EQ(s["frames"], 40) << node;
    EXPECT_EQ(s["cluster"]["node"], node);
  }
  const Json lead = summaryOf(out + "/front")["cluster"];
  EXPECT_EQ(lead["leads"], true);
  EXPECT_EQ(lead["orders"], 40);
  EXPECT_LE(lead["most_order_bytes"], 1024) << "what travels a frame";
  EXPECT_EQ(lead["joined"], 3);
  EXPECT_EQ(lead["left_out"], 0) << r.err;
  EXPECT_GE(lead["compared"], 3);
  EXPECT_EQ(lead["differed"], 0);
}

/// The process that plays that node of that cluster.
pid_t processOf(const std::string& clusterFile, const std::string& node) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string number = entry.path().filename();
    if (number.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream in(entry.path() / "cmdline");
    const std::string words((std::istreambuf_iterator<char>(in)), {});
    const std::string run = std::string("run") + '\0', is = std::string("--node") + '\0' + node + '\0';
    if (words.find(run) != words.npos && words.find(clusterFile) != words.npos &&
        words.find(is) != words.npos)
      return std::stoi(number);
  }
  return -1;
}

/// Waits until what is asked for is so, for a minute at most.
template <class Asked>
bool becomes(const Asked& asked) {
  for (int i = 0; i < 3000; ++i) {
    if (asked()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

int endOf(pid_t child) {
  int status = -1;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

TEST(ProgramCluster, AMachineThatDiesIsLeftOutAndComesBackWithTheSameScene) {
  const TemporaryFolder folder;
  const std::string cluster = fourNodes(folder, "deadline 0.3\n"), out = folder.path() / "out";
  const std::string said = folder.path() / "said", told = folder.path() / "told";
  ProgramRun run{{stadionPath(), "cluster", cluster, kKick, "--out", out, "--size", "32x24", "--look",
                  "plain", "--input", "none", "--seconds", "12", "--pace", "lock", "--pictures", "none"}};
  const pid_t program = startProgram(run, said, told);
  const auto hasTold = [&](const std::string& what) {
    return fileContent(told).find(what) != std::string::npos;
  };
  pid_t left = -1;
  ASSERT_TRUE(becomes([&] { return (left = processOf(cluster, "left")) > 0; }));
  std::this_thread::sleep_for(std::chrono::seconds(3));
  ASSERT_EQ(kill(left, SIGKILL), 0);
  EXPECT_TRUE(becomes([&] { return hasTold("left was ended by signal 9 and begins again"); }))
      << fileContent(told);
  EXPECT_TRUE(becomes([&] { return hasTold("the others go on"); })) << fileContent(told);
  EXPECT_TRUE(becomes([&] { return hasTold("left plays with us"); })) << fileContent(told);
  EXPECT_EQ(endOf(program), 0) << fileContent(said) << fileContent(told);
  const Json lead = summaryOf(out + "/front");
  EXPECT_EQ(lead["cluster"]["left_out"], 1);
  EXPECT_EQ(lead["cluster"]["joined"], 4);
  EXPECT_EQ(lead["cluster"]["differed"], 0);
  for (const char* node : {"left", "right", "floor"})
    EXPECT_EQ(summaryOf(out + "/" + node)["state_hash"], lead["state_hash"]) << node;
}

TEST(ProgramCluster, ABitThatDiffersIsNamedAndTheSceneTakenOver) {
  const TemporaryFolder folder;
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

TEST(ProgramCluster, WhatIsWrongIsToldAtTheStart) {
  const TemporaryFolder folder;
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
  refused({"cluster", cluster, "nowhere.evs"}, "there is no show nowhere.evs");
  const std::string other = folder.write("other.cluster", "walls cave4\nnode a fromt\n");
  refused({"run", kKick, "--cluster", other, "--node", "a"},
          "has no wall \"fromt\"; did you mean \"front\"?");
  const std::string nowhere = folder.write("net.cluster", "walls cave4\nnode a front\ninterface nowhere7\n");
  refused({"run", kKick, "--cluster", nowhere, "--node", "a", "--frames", "5"}, "nowhere7");
}

}  // namespace
}  // namespace stadion
