/// Hosts of a cluster that crash or stop while the show goes on, the leader among them.

#include "tests/programs/played_cluster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

/// A cluster of four at its ticks, which restarts hosts that crash. It plays until it is ended, or for
/// so many seconds. The deadline is short where a test waits for it, and longer than a busy machine makes
/// nodes wait.
class RunningCluster {
public:
  explicit RunningCluster(const std::string& seconds = "600", const std::string& deadline = "1")
      : file_(fourNodes(folder_, "deadline " + deadline + "\n")),
        program_(startProgram(
            {{stadionPath(), "cluster", file_, kKick, "--out", folder_.path() / "out", "--size", "32x24",
              "--look", "plain", "--seconds", seconds, "--pace", "lock", "--pictures", "none", "--hashes"}},
            folder_.path() / "said", folder_.path() / "told")) {}

  std::string told() const { return fileContent(folder_.path() / "told"); }
  bool hasTold(const std::string& what, std::size_t times = 1) const { return timesTold(what) >= times; }
  std::size_t timesTold(const std::string& what) const {
    std::size_t count = 0;
    const std::string text = told();
    for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += what.size()) ++count;
    return count;
  }
  bool tells(const std::string& what, std::size_t times = 1) const {
    return becomes([&] { return hasTold(what, times); });
  }
  /// Once it has shown a second of the show.
  pid_t processOfRunning(const std::string& node) const {
    becomes([&] { return swapTimesOf(out(node)).size() > 60; });
    return processOf(file_, node);
  }
  pid_t processNow(const std::string& node) const { return processOf(file_, node); }
  std::filesystem::path out(const std::string& node) const { return folder_.path() / "out" / node; }
  int end() const { return endOf(program_); }
  /// Asks the leader to end. It ends the show for all hosts in the same frame.
  int stop() const {
    signalTo(processNow("front"), SIGTERM);
    return end();
  }

  /// What it has shown is what one machine shows, and all have the same scene at the end.
  void expectWhatOneShows() const {
    const std::string one = folder_.path() / "one";
    const Json lead = summaryOf(out("front"));
    const std::string frames = std::to_string(lead["last_frame"].get<std::uint64_t>() + 1);
    const ProgramResult r =
        stadionProgram({"run", kKick, "--walls", "cave4", "--out", one, "--size", "32x24", "--look", "plain",
                        "--frames", frames, "--pictures", "none", "--hashes"});
    ASSERT_EQ(r.status, 0) << r.err;
    const std::set<std::string> wanted = hashesBelow(one);
    for (const std::string& line : hashesBelow(folder_.path() / "out"))
      EXPECT_TRUE(wanted.contains(line)) << line;
    for (const char* node : kFourNodes)
      EXPECT_EQ(summaryOf(out(node))["state_hash"], summaryOf(one)["state_hash"]) << node;
  }

private:
  TestFolder folder_;
  std::string file_;
  pid_t program_;
};

TEST(ProgramCluster, AMachineThatDiesIsLeftOutAndComesBackWithTheSameScene) {
  const RunningCluster cluster;
  const pid_t left = cluster.processOfRunning("left");
  const std::size_t heres = cluster.timesTold("left plays with us");
  ASSERT_TRUE(signalTo(left, SIGKILL));
  EXPECT_TRUE(cluster.tells("left was ended by signal 9 and restarts")) << cluster.told();
  EXPECT_TRUE(cluster.tells("the others go on")) << cluster.told();
  EXPECT_TRUE(cluster.tells("left plays with us", heres + 1)) << cluster.told();
  EXPECT_EQ(cluster.stop(), 128 + SIGTERM) << cluster.told();
  const Json lead = summaryOf(cluster.out("front"));
  EXPECT_GE(lead["cluster"]["left_out"], 1);
  EXPECT_EQ(lead["cluster"]["joined"], 3 + lead["cluster"]["left_out"].get<int>());
  EXPECT_EQ(lead["cluster"]["differed"], 0);
  for (const char* node : {"left", "right", "floor"})
    EXPECT_EQ(summaryOf(cluster.out(node))["state_hash"], lead["state_hash"]) << node;
}

TEST(ProgramCluster, TheLeaderMayDieAndTheShowGoesOn) {
  const RunningCluster cluster;
  ASSERT_TRUE(signalTo(cluster.processOfRunning("front"), SIGKILL));
  EXPECT_TRUE(cluster.tells("the show goes on after frame")) << cluster.told();
  // The new leader has shown something, too.
  const std::size_t shown = swapTimesOf(cluster.out("left")).size();
  EXPECT_TRUE(becomes([&] { return swapTimesOf(cluster.out("left")).size() > shown + 60; }))
      << cluster.told();
  EXPECT_EQ(cluster.stop(), 128 + SIGTERM) << cluster.told();
  EXPECT_FALSE(cluster.hasTold("goes on without")) << cluster.told();
  cluster.expectWhatOneShows();
  // The others held the last picture; none was shown again.
  const auto times = swapTimesOf(cluster.out("left"));
  EXPECT_EQ(times.begin()->first, 0U);
  EXPECT_EQ(times.rbegin()->first, summaryOf(cluster.out("front"))["last_frame"].get<std::uint64_t>());
}

/// A frame a second: one machine holds the last one up until the leader is dead.
TEST(ProgramCluster, TheLeaderMayDieInTheLastFrame) {
  const TestFolder folder;
  const std::string file =
      folder.write("two.cluster", "walls cave4\nnode front front left right\nnode floor floor\ndeadline 6\n"
                                  "partition l" +
                                      std::to_string(getpid()) + "\n");
  const std::filesystem::path out = folder.path() / "out", one = folder.path() / "one";
  const std::vector<std::string> show{kKick,   "--rate", "1",     "--frames", "6",    "--size",
                                      "16x12", "--look", "plain", "--input",  "none", "--hashes"};
  std::vector<std::string> cluster{stadionPath(), "cluster", file, "--pace", "lock", "--out", out},
      alone{"run", "--walls", "cave4", "--out", one};
  cluster.insert(cluster.end(), show.begin(), show.end());
  alone.insert(alone.end(), show.begin(), show.end());
  const std::string told = folder.path() / "told";
  const pid_t program = startProgram({cluster}, folder.path() / "said", told);
  ASSERT_TRUE(becomes([&] { return swapTimesOf(out / "floor").contains(4); })) << fileContent(told);
  const pid_t floor = processOf(file, "floor"), front = processOf(file, "front");
  ASSERT_TRUE(signalTo(floor, SIGSTOP));
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  signalTo(front, SIGKILL), signalTo(floor, SIGCONT);
  EXPECT_EQ(endOf(program), 0) << fileContent(told);
  EXPECT_NE(fileContent(told).find("the show goes on after frame 5"), std::string::npos) << fileContent(told);
  ASSERT_EQ(stadionProgram(alone).status, 0);
  const std::set<std::string> wanted = hashesBelow(one);
  EXPECT_EQ(hashesBelow(out), wanted);
  EXPECT_EQ(picturesIn(out), picturesIn(one)) << "of the last frame";
  for (const char* node : {"front", "floor"})
    EXPECT_EQ(summaryOf(out / node)["state_hash"], summaryOf(one)["state_hash"]) << node;
}

TEST(ProgramCluster, AMachineThatIsStoppedIsLeftOutAndComesBack) {
  const RunningCluster cluster;
  const pid_t left = cluster.processOfRunning("left");
  const std::size_t heres = cluster.timesTold("left plays with us");
  ASSERT_TRUE(signalTo(left, SIGSTOP));
  EXPECT_TRUE(cluster.tells("left has not been heard of for 1 s; the others go on")) << cluster.told();
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  ASSERT_TRUE(signalTo(left, SIGCONT));
  EXPECT_TRUE(cluster.tells("left plays with us", heres + 1)) << cluster.told();
  EXPECT_EQ(cluster.stop(), 128 + SIGTERM) << cluster.told();
  cluster.expectWhatOneShows();
}

TEST(ProgramCluster, AMachineWhoseLastPicturesAreMissingHasFailed) {
  const RunningCluster cluster("8");
  const pid_t left = cluster.processOfRunning("left");
  ASSERT_TRUE(signalTo(left, SIGSTOP));
  EXPECT_TRUE(cluster.tells("left has not been heard of for 1 s; the others go on")) << cluster.told();
  EXPECT_TRUE(becomes([&] { return cluster.processNow("front") < 0; })) << "the show is over";
  ASSERT_TRUE(signalTo(left, SIGCONT));
  EXPECT_EQ(cluster.end(), 2) << cluster.told();
  // Whether it hears of the end, which it was not there for, the network knows.
  EXPECT_TRUE(
      cluster.hasTold("cluster: left was not done when the show was over: what it has written may not "
                      "be whole") ||
      cluster.hasTold("--out: the show ended before this machine had caught up with it: its last "
                      "pictures are missing"))
      << cluster.told();
}

/// Kills or stops one machine after the other, so many times; says how long the others waited, and how long
/// it took to come back.
void disturb(const RunningCluster& cluster, int times, int signal) {
  std::vector<double> back;
  using Clock = std::chrono::steady_clock;
  using Milliseconds = std::chrono::duration<double, std::milli>;
  for (int i = 0; i < times; ++i) {
    const std::string node = kFourNodes[1 + i % 3];
    std::this_thread::sleep_for(std::chrono::milliseconds(200 + 37 * (i % 7)));
    const pid_t process = cluster.processOfRunning(node);
    const std::string gone = node + " has not been heard of", here = node + " plays with us";
    const std::size_t gones = cluster.timesTold(gone), heres = cluster.timesTold(here);
    auto begin = Clock::now();
    ASSERT_TRUE(signalTo(process, signal)) << node;
    if (signal == SIGSTOP) {
      ASSERT_TRUE(cluster.tells(gone, gones + 1)) << cluster.told();
      kill(process, SIGCONT);
      begin = Clock::now();
    }
    ASSERT_TRUE(cluster.tells(here, heres + 1)) << cluster.told();
    back.push_back(Milliseconds(Clock::now() - begin).count());
  }
  std::vector<double> gaps;
  std::int64_t before = 0;
  for (const auto& [frame, at] : swapTimesOf(cluster.out("front"))) {
    if (before != 0) gaps.push_back(static_cast<double>(at - before) * 1e-6);
    before = at;
  }
  std::ranges::sort(back), std::ranges::sort(gaps);
  std::printf("%d times: the others held a picture for %.0f ms at most (deadline 300), the %zu gaps after "
              "that %.1f at "
              "most; back after %.0f ms, %.0f at most\n",
              times, gaps.back(), gaps.size() - back.size(), gaps[gaps.size() - back.size() - 1],
              back[back.size() / 2], back.back());
  EXPECT_LE(gaps.back(), 300 + 100) << cluster.told();
  EXPECT_LE(back.back(), 2000) << cluster.told();
}

TEST(ProgramFullCluster, AHundredMachinesDie) {
  const RunningCluster cluster("280", "0.3");
  disturb(cluster, 100, SIGKILL);
  EXPECT_EQ(cluster.end(), 0) << cluster.told();
  cluster.expectWhatOneShows();
}

TEST(ProgramFullCluster, AHundredMachinesAreStopped) {
  const RunningCluster cluster("200", "0.3");
  disturb(cluster, 100, SIGSTOP);
  EXPECT_EQ(cluster.end(), 0) << cluster.told();
  cluster.expectWhatOneShows();
}

}  // namespace
}  // namespace stadion
