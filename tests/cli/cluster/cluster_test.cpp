/// Several machines that play one show, here as processes over the loopback interface.

#include "tests/programs/desk.h"
#include "tests/programs/played_cluster.h"

#include <gtest/gtest.h>
#include <lo/lo.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <regex>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

std::map<std::string, std::string> picturesIn(const std::filesystem::path& folder) {
  std::map<std::string, std::string> all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".png" && entry.path().filename() != "contact-sheet.png")
      all[entry.path().filename()] = fileContent(entry.path());
  return all;
}

TEST(ProgramCluster, FourMachinesShowWhatOneShows) {
  const TemporaryFolder folder;
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
  std::size_t last = 0;
  for (const char* node : {"front", "left", "right", "floor"}) {
    const Json s = summaryOf(out + "/" + node);
    EXPECT_EQ(s["state_hash"], summaryOf(one)["state_hash"]) << node;
    EXPECT_EQ(s["frames"], 16) << node;
    EXPECT_EQ(s["cluster"]["node"], node);
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

/// A cluster of four at its ticks, whose nodes begin again when they die. It plays until it is ended, or for
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
  TemporaryFolder folder_;
  std::string file_;
  pid_t program_;
};

TEST(ProgramCluster, AMachineThatDiesIsLeftOutAndComesBackWithTheSameScene) {
  const RunningCluster cluster;
  const pid_t left = cluster.processOfRunning("left");
  const std::size_t heres = cluster.timesTold("left plays with us");
  ASSERT_TRUE(signalTo(left, SIGKILL));
  EXPECT_TRUE(cluster.tells("left was ended by signal 9 and begins again")) << cluster.told();
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
  const TemporaryFolder folder;
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
  TemporaryFolder folder_;
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
  EXPECT_EQ(machines.told("usurper").find("begins anew"), std::string::npos) << machines.told("usurper");
  ASSERT_EQ(kill(all.at("front"), SIGTERM), 0);
  for (const auto& [node, process] : all) {
    const int status = endOf(process);
    EXPECT_EQ(status, node == "front" ? 128 + SIGTERM : 0) << node << machines.told(node);
  }
  EXPECT_EQ(machines.told("left").find("another program"), std::string::npos) << "it played first";
  EXPECT_EQ(machines.told("front").find("the others go on"), std::string::npos) << "no host was disturbed\n"
                                                                                << machines.told("front");
}

/// Two machines with a wall each that play live, each started by hand.
class TwoLive {
public:
  explicit TwoLive(const std::string& script = "", const std::string& more = "")
      : script_(script.empty() ? kKick : folder_->write("show.evs", script)),
        file_(folder_->write("two.cluster", "walls two.walls\nnode front front\nnode floor floor\n"
                                            "partition live" +
                                                std::to_string(getpid()) + "\n" + more)) {
    folder_->write("two.walls",
                   "wall front  lower-left -1.5  1.5 0  lower-right 1.5  1.5 0  upper-left -1.5 1.5 3\n"
                   "wall floor  lower-left -1.5 -1.5 0  lower-right 1.5 -1.5 0  upper-left -1.5 1.5 0\n");
  }
  std::unique_ptr<RunningProgram> start(const std::string& node, std::vector<std::string> more = {}) const {
    ProgramRun run{{stadionPath(), "run", script_, "--cluster", file_, "--node", node, "--size", "32x24",
                    "--look", "plain", "--asset-root", assetFolder(), "--journal", journal(node)}};
    run.words.insert(run.words.end(), more.begin(), more.end());
    return std::make_unique<RunningProgram>(run);
  }
  /// So many programs of that node have shown a picture.
  bool show(const std::string& node, std::size_t times = 1) const {
    return becomes([&] {
      const std::string text = fileContent(journal(node));
      std::size_t count = 0;
      for (std::size_t at = 0; (at = text.find("the first picture", at)) != text.npos; ++at) ++count;
      return count >= times;
    });
  }
  /// The same, with another copy of the script.
  std::unique_ptr<RunningProgram> startWith(const std::string& script, const std::string& node,
                                            std::vector<std::string> more) const {
    TwoLive other(*this);
    other.script_ = script;
    return other.start(node, std::move(more));
  }
  static int endOf(RunningProgram& program) {
    kill(program.pid(), SIGINT);
    return program.status();
  }

private:
  std::string journal(const std::string& node) const { return folder_->path() / (node + ".log"); }

  std::shared_ptr<const TemporaryFolder> folder_ = std::make_shared<TemporaryFolder>();
  std::string script_, file_;
};

TEST(ProgramCluster, AHostLeftOutAsTheShowEndsReportsItsMissingPictures) {
  const std::string missing =
      "--out: the show ended before this machine had caught up with it: its last pictures are missing";
  std::string told;
  // The leader waits a second for the answer to its last order. On a busy machine the follower may wake before
  // or after that second, and end otherwise: then the next try.
  for (int tries = 0; tries < 10 && !has(told, missing); ++tries) {
    // The leader does not lose sight of a machine that stands still before two deadlines are over.
    const TwoLive two("", "deadline 2\n");
    const TemporaryFolder folder;
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

TEST(ProgramCluster, ANetworkThatCannotServeIsNamed) {
  const TemporaryFolder folder;
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
  const TemporaryFolder folder;
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

TEST(ProgramCluster, WhereAScriptLiesIsEachMachinesAffair) {
  const TemporaryFolder ours, theirs;
  const TwoLive two;
  const std::string script = fileContent(kKick);
  const std::vector<std::string> play{"--input", "none", "--rate", "60", "--pace", "lock", "--seconds", "2"};
  const auto floor = two.startWith(theirs.write("kick.evs", script), "floor", play);
  const auto front = two.startWith(ours.write("kick.evs", script), "front", play);
  EXPECT_EQ(front->status(), 0) << front->err();
  EXPECT_EQ(floor->status(), 0) << floor->err();
  EXPECT_FALSE(has(front->err(), "differs")) << front->err();
}

TEST(ProgramCluster, AScriptThatIsSavedIsComparedForTheNextGroup) {
  const TemporaryFolder ours, theirs;
  const TwoLive two;
  const std::string script = fileContent(kKick), port = std::to_string(freePort());
  const lo_address desk = lo_address_new("127.0.0.1", port.c_str());
  const std::string file = ours.write("kick.evs", script);
  const auto floor = two.startWith(theirs.write("kick.evs", script), "floor", {"--input", "none"});
  const auto front = two.startWith(file, "front", {"--input", "none", "--osc", port});
  ASSERT_TRUE(front->says("playing until Ctrl-C")) << front->err();
  ASSERT_TRUE(two.show("front") && two.show("floor")) << front->err() << floor->err();
  ours.write("kick.evs", script + "# saved\n");
  lo_send(desk, "/stadion/next-group", "i", 1);
  EXPECT_EQ(floor->status(), 4) << floor->err();
  EXPECT_TRUE(has(floor->err(), "front plays another script")) << floor->err();
  lo_address_free(desk);
  EXPECT_EQ(TwoLive::endOf(*front), 130) << front->err();
}

TEST(ProgramCluster, ABitOfABodyThatHasNotMovedYetIsFoundInTime) {
  const TwoLive two;
  const std::vector<std::string> play{"--rate", "60", "--pace", "lock", "--seconds", "3"};
  std::vector<std::string> planted = play;
  planted.insert(planted.end(), {"--plant-difference", "5"});
  const auto floor = two.start("floor", planted);
  const auto front = two.start("front", play);
  EXPECT_EQ(front->status(), 0) << front->err();
  std::smatch since;
  const std::string told = front->err();
  ASSERT_TRUE(std::regex_search(told, since, std::regex("floor differs from ours since frame ([0-9]+)")))
      << told;
  EXPECT_LE(std::stoi(since[1]), 65);
  EXPECT_TRUE(has(told, "ball (") && has(told, "), path.c is ")) << told;
}

TEST(ProgramCluster, OtherModelsAreNamedAndNotPlayed) {
  const TemporaryFolder ours, theirs;
  const char* const triangle = "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n";
  ours.write("thing.obj", triangle), theirs.write("thing.obj", std::string("v 0 0 2\n") + triangle);
  const TwoLive two("object( file=thing.obj, position=\"0, 3, 1\" )\nobject( name=named, file=thing.obj )\n");
  const std::vector<std::string> play{"--input", "none", "--rate", "60", "--pace", "lock", "--seconds", "4"};
  const auto with = [&](const TemporaryFolder& assets) {
    std::vector<std::string> words = play;
    words.insert(words.end(), {"--asset-root", assets.path()});
    return words;
  };
  const auto floor = two.start("floor", with(theirs));
  const auto front = two.start("front", with(ours));
  EXPECT_EQ(floor->status(), 4) << floor->err();
  EXPECT_TRUE(has(floor->err(), "put the same files on all machines")) << floor->err();
  EXPECT_TRUE(has(floor->err(), "the scene, files is ")) << floor->err();
  EXPECT_EQ(front->status(), 0) << front->err();
  EXPECT_TRUE(has(front->err(), "the scene of floor differs from ours")) << front->err();
}

/// Two copies of a show, of which one has another model, or a sub-scene with a node more.
class OtherFiles {
public:
  OtherFiles() {
    for (const TemporaryFolder* folder : {&ours_, &models_, &scenes_}) {
      folder->write("show.evs", kShow);
      folder->write("thing.obj", std::string(folder == &models_ ? "v 0 0 -1\n" : "v 0 0 0\n") + kRest);
      folder->write("sub.evs", std::string("object( name=one, file=thing.obj )\n") +
                                   (folder == &scenes_ ? "object( name=two, file=thing.obj )\n" : ""));
    }
  }
  std::string ours() const { return ours_.path() / "show.evs"; }
  std::vector<std::string> others() const {
    return {models_.path() / "show.evs", scenes_.path() / "show.evs"};
  }
  static std::vector<std::string> play(const std::string& seconds) {
    return {"--input", "none", "--rate", "60", "--pace", "lock", "--seconds", seconds};
  }

private:
  static constexpr const char* kShow =
      "dynobject( name=ball, file=thing.obj, position=\"0, 3, 1\", density=1 )\n"
      "scene( name=sub, file=sub.evs )\n";
  static constexpr const char* kRest = "v 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  TemporaryFolder ours_, models_, scenes_;
};

TEST(ProgramCluster, ALateHostWithOtherModelsOrSubScenesMayComeAgain) {
  const OtherFiles files;
  const TwoLive two;
  const auto front = two.startWith(files.ours(), "front", OtherFiles::play("600"));
  {
    const auto floor = two.startWith(files.ours(), "floor", OtherFiles::play("600"));
    EXPECT_TRUE(two.show("front") && two.show("floor")) << front->err() << floor->err();
    EXPECT_EQ(TwoLive::endOf(*floor), 130) << floor->err();
  }
  for (const std::string& other : files.others()) {
    const auto floor = two.startWith(other, "floor", OtherFiles::play("600"));
    EXPECT_EQ(floor->status(), 4) << floor->err();
    EXPECT_TRUE(has(floor->err(), "that front has loaded are others than ours; put the same files on all"))
        << floor->err();
  }
  EXPECT_EQ(TwoLive::endOf(*front), 130) << front->err();
}

TEST(ProgramCluster, ALeaderThatComesBackWithOtherFilesRestartsTheShow) {
  const OtherFiles files;
  for (const std::string& other : files.others()) {
    const TwoLive two;
    auto front = two.startWith(files.ours(), "front", OtherFiles::play("600"));
    const auto floor = two.startWith(files.ours(), "floor", OtherFiles::play("600"));
    EXPECT_TRUE(two.show("front") && two.show("floor")) << front->err() << floor->err();
    ASSERT_EQ(kill(front->pid(), SIGKILL), 0);
    EXPECT_EQ(front->status(), 128 + SIGKILL) << front->err();
    front = two.startWith(other, "front", OtherFiles::play("600"));
    EXPECT_TRUE(front->says("the show goes on after frame")) << front->err();
    EXPECT_TRUE(front->says("are others than ours: it begins anew")) << front->err();
    EXPECT_TRUE(front->says("the scene of floor differs from ours")) << front->err() << floor->err();
    EXPECT_EQ(floor->status(), 4) << floor->err();
    EXPECT_EQ(TwoLive::endOf(*front), 130) << front->err();
  }
}

TEST(ProgramCluster, WhereFilesOrDeadlinesDifferTheFollowerSaysWhichAndEnds) {
  const TemporaryFolder folder;
  const auto file = [&](const std::string& name, const std::string& more) {
    return folder.write(name, "walls cave4\npartition files" + std::to_string(getpid()) + "\n" + more);
  };
  const std::string nodes = "node front front left right\nnode floor floor\n";
  const std::string lead = file("lead.cluster", nodes);
  RunningProgram front({{stadionPath(), "run", kKick, "--cluster", lead, "--node", "front", "--gl", "none"}});
  for (const std::string& other :
       {file("deadline.cluster", nodes + "deadline 2\n"), file("hash.cluster", nodes + "hash-every 7\n"),
        file("order.cluster", "lead front\nnode floor floor\nnode front front left right\n")}) {
    const ProgramResult r =
        stadionProgram({"run", kKick, "--cluster", other, "--node", "floor", "--gl", "none"});
    EXPECT_EQ(r.status, 4) << other << r.err;
    EXPECT_TRUE(has(r.err, "front has another cluster file; put the same file on all machines")) << r.err;
  }
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
