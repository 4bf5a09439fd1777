/// `stadion cluster`: hosts that crash, hosts that are asked to end, and the arguments of each host.

#include "cli/terminal.h"
#include "show/cluster/cluster_nodes.h"
#include "tests/proc.h"
#include "tests/programs/played_cluster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <sys/wait.h>
#include <unistd.h>

namespace stadion {
namespace {

namespace fs = std::filesystem;

TerminalReporter terminal;

std::size_t timesIn(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != text.npos; at += part.size()) ++count;
  return count;
}

/// A cluster of four; what is left of it goes with the test.
class PlayingCluster {
public:
  explicit PlayingCluster(const std::vector<std::string>& more)
      : file_(fourNodes(folder_, "deadline 0.3\n")) {
    std::vector<std::string> words{stadionPath(), "cluster", file_,    kKick,
                                   "--size",      "16x12",   "--look", "plain"};
    words.insert(words.end(), more.begin(), more.end());
    program_ = startProgram({words, {}, folder_.path()}, file("said"), file("told"));
  }
  ~PlayingCluster() {
    for (const char* node : kFourNodes)
      for (pid_t process = 0; (process = processOf(file_, node)) > 0;) {
        signalTo(process, SIGKILL);
        becomes([&] { return processOf(file_, node) != process; });
      }
    if (!status_) kill(program_, SIGKILL), endOf(program_);
  }
  PlayingCluster(const PlayingCluster&) = delete;
  PlayingCluster& operator=(const PlayingCluster&) = delete;

  pid_t program() const { return program_; }
  pid_t node(const std::string& name) const { return processOf(file_, name); }
  /// All nodes show pictures, and write into `out` when.
  bool plays() const {
    return becomes([&] {
      return std::ranges::all_of(kFourNodes,
                                 [&](auto n) { return swapTimesOf(folder_.path() / "out" / n).size() > 10; });
    });
  }
  bool allHaveEnded() const {
    return becomes([&] { return std::ranges::all_of(kFourNodes, [&](auto n) { return node(n) < 0; }); });
  }
  bool tells(const std::string& what) const {
    return becomes([&] { return has(told(), what); });
  }
  /// In the folder in which it plays.
  std::string file(const std::string& name) const { return folder_.path() / name; }
  std::string told() const { return fileContent(file("told")); }
  std::string said() const { return fileContent(file("said")); }
  /// The coordinator's exit status, or 128 + signal; nothing if it does not end.
  std::optional<int> end() {
    int status = 0;
    if (becomes([&] { return waitpid(program_, &status, WNOHANG) == program_; }))
      status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return status_;
  }

private:
  TestFolder folder_;
  std::string file_;
  pid_t program_ = -1;
  std::optional<int> status_{};
};

/// Words with which it plays until it is ended.
std::vector<std::string> forLong(std::vector<std::string> more = {}) {
  more.insert(more.end(),
              {"--seconds", "600", "--pace", "lock", "--out", "out", "--pictures", "none", "--hashes"});
  return more;
}

TEST(ProgramClusterProcesses, TheLeaderDiesForGoodAndTheOthersEnd) {
  PlayingCluster cluster(forLong({"--once"}));
  ASSERT_TRUE(cluster.plays()) << cluster.told();
  ASSERT_TRUE(signalTo(cluster.node("front"), SIGKILL));
  EXPECT_EQ(cluster.end(), 128 + SIGKILL) << cluster.told();
  EXPECT_TRUE(has(cluster.told(), "cluster: front was ended by signal 9\n")) << cluster.told();
  EXPECT_TRUE(has(cluster.told(), "cluster: front, which leads, is gone; the others end")) << cluster.told();
}

TEST(ProgramClusterProcesses, ACrashIsReportedAlsoWithoutARestart) {
  PlayingCluster cluster(forLong({"--once"}));
  ASSERT_TRUE(cluster.plays()) << cluster.told();
  ASSERT_TRUE(signalTo(cluster.node("left"), SIGKILL));
  EXPECT_TRUE(cluster.tells("cluster: left was ended by signal 9\n")) << cluster.told();
  EXPECT_TRUE(cluster.tells("the others go on")) << cluster.told();
  EXPECT_LT(cluster.node("left"), 0);
  kill(cluster.program(), SIGTERM);
  EXPECT_EQ(cluster.end(), 128 + SIGKILL) << "the exit code is that of the host that died";
}

TEST(ProgramClusterProcesses, TheSoundsAreHeardOnce) {
  PlayingCluster cluster(forLong());
  ASSERT_TRUE(cluster.plays()) << cluster.told();
  for (const char* node : kFourNodes) {
    const std::string words = procText(cluster.node(node), "cmdline");
    EXPECT_EQ(has(words, "--no-sound"), node != std::string("front")) << words;
  }
  kill(cluster.program(), SIGTERM);
  cluster.end();
}

TEST(ProgramClusterProcesses, HostsDoNotOutliveTheirLauncher) {
  PlayingCluster cluster(forLong());
  ASSERT_TRUE(cluster.plays()) << cluster.told();
  ASSERT_TRUE(signalTo(cluster.program(), SIGKILL));
  EXPECT_EQ(cluster.end(), 128 + SIGKILL);
  EXPECT_TRUE(cluster.allHaveEnded()) << cluster.told();
}

TEST(ProgramClusterProcesses, TheSignalThatStopsThemIsTheOneThatCame) {
  for (const int signal : {SIGTERM, SIGINT}) {
    PlayingCluster cluster(forLong({"--json"}));
    ASSERT_TRUE(cluster.plays()) << cluster.told();
    ASSERT_TRUE(signalTo(cluster.program(), signal));
    EXPECT_EQ(cluster.end(), 128 + signal) << cluster.told();
    EXPECT_FALSE(has(cluster.told(), "restarts")) << cluster.told();
    const Json said = Json::parse(cluster.said(), nullptr, false);
    ASSERT_TRUE(said.is_object()) << cluster.said();
    EXPECT_EQ(said["front"]["stopped"], signal == SIGTERM ? "SIGTERM" : "SIGINT");
  }
}

TEST(ProgramClusterProcesses, ANodeThatIsAskedToEndIsNotRestarted) {
  PlayingCluster cluster(forLong());
  ASSERT_TRUE(cluster.plays()) << cluster.told();
  ASSERT_TRUE(signalTo(cluster.node("left"), SIGTERM));
  EXPECT_TRUE(cluster.tells("the others go on")) << cluster.told();
  EXPECT_TRUE(becomes([&] { return cluster.node("left") < 0; }));
  ASSERT_TRUE(signalTo(cluster.node("front"), SIGTERM));
  EXPECT_EQ(cluster.end(), 128 + SIGTERM) << "and the leader ends the show for all: " << cluster.told();
  EXPECT_FALSE(has(cluster.told(), "restarts")) << cluster.told();
}

/// A cluster of two of which the first one leads.
ClusterFile twoNodes() {
  ClusterFile cluster;
  cluster.nodes.resize(2);
  return cluster;
}

/// A program that ends with that exit code so many times, and well from then on.
std::vector<std::string> failing(const fs::path& count, int code, int times) {
  return {"sh", "-c",
          "echo >>" + count.string() + "; [ $(wc -l <" + count.string() + ") -gt " + std::to_string(times) +
              " ] || exit " + std::to_string(code)};
}

std::size_t startsIn(const fs::path& count) {
  const std::string lines = fileContent(count);
  return static_cast<std::size_t>(std::ranges::count(lines, '\n'));
}

TEST(ProgramClusterProcesses, ANodeWithoutMemoryOrOpenGlRestartsAfterAPauseIfItFailsAtOnce) {
  const TestFolder folder;
  ClusterNodes nodes(twoNodes(), false, terminal);
  // The leader plays until the other one has begun for the third time, half a minute at most.
  nodes.add("front", {"sh", "-c",
                      "for i in $(seq 300); do [ $(wc -l <" + (folder.path() / "left").string() +
                          ") -lt 3 ] || break; sleep 0.1; done"});
  nodes.add("left", failing(folder.path() / "left", 3, 2));
  folder.write("left", "");
  testing::internal::CaptureStderr();
  EXPECT_EQ(nodes.play(), 0);
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_EQ(startsIn(folder.path() / "left"), 3U);
  EXPECT_TRUE(has(told, "cluster: left ended with exit code 3 and restarts\n")) << told;
  EXPECT_TRUE(has(told, "cluster: left ended with exit code 3, 2 times in a row, and restarts after a pause"))
      << told;
}

TEST(ProgramClusterProcesses, AFaultInTheShowIsNoReasonToRestart) {
  const TestFolder folder;
  for (const int code : {1, 2}) {
    const std::string name = "starts" + std::to_string(code);
    ClusterNodes nodes(twoNodes(), false, terminal);
    nodes.add("front", failing(folder.path() / name, code, 1));
    nodes.add("left", {"sleep", "600"});
    EXPECT_EQ(nodes.play(), code) << "the others end with the leader";
    EXPECT_EQ(startsIn(folder.path() / name), 1U);
  }
}

constexpr std::chrono::milliseconds kShort{300};  // patience

TEST(ProgramClusterProcesses, AFollowerThatFindsOtherFilesComesBackOnceTheyAreAlike) {
  const TestFolder folder;
  const std::string starts = folder.write("starts", "");
  ClusterNodes nodes(twoNodes(), false, terminal);
  nodes.add("front",
            {"sh", "-c",
             "for i in $(seq 300); do [ $(wc -l <" + starts + ") -lt 4 ] || break; " + "sleep 0.1; done"});
  // It dies, comes back twice to other files, then plays to the end.
  nodes.add(
      "left",
      {"sh", "-c", "echo >>" + starts + "; case $(wc -l <" + starts + ") in 1) exit 3;; 2|3) exit 4;; esac"});
  testing::internal::CaptureStderr();
  EXPECT_EQ(nodes.play(), 0);
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_EQ(startsIn(starts), 4U) << told;
  EXPECT_EQ(timesIn(told, "left has other files than front, and comes again until they are alike\n"), 1U)
      << told;
}

TEST(ProgramClusterProcesses, ALeaderThatHangsIsReplaced) {
  const TestFolder folder;
  const std::string starts = folder.write("starts", "");
  ClusterNodes nodes(twoNodes(), false, terminal);
  nodes.add("front", {"sh", "-c", "echo >>" + starts + "; [ $(wc -l <" + starts + ") -gt 1 ] || sleep 600"});
  nodes.add("left", {"sh", "-c", "until [ $(wc -l <" + starts + ") -ge 2 ]; do sleep 0.1; done"});
  nodes.watchLead(std::move(SharedProgress::create().value()), fromSeconds(0.2));
  testing::internal::CaptureStderr();
  EXPECT_EQ(nodes.play(), 0);
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(has(told, "cluster: front has shown nothing for 2.4 s, and is killed\n")) << told;
  EXPECT_TRUE(has(told, "cluster: front was ended by signal 9 and restarts\n")) << told;
}

TEST(ProgramClusterProcesses, OnlyTheOneThatLeadsAndIsStoppedIsTakenForHanging) {
  PlayingCluster cluster(forLong());
  ASSERT_TRUE(cluster.plays()) << cluster.told();
  ASSERT_TRUE(signalTo(cluster.node("front"), SIGSTOP));
  EXPECT_TRUE(cluster.tells("cluster: front has shown nothing for 13 s, and is killed\n")) << cluster.told();
  EXPECT_TRUE(cluster.tells("cluster, front: the show goes on after frame")) << cluster.told();
  EXPECT_EQ(timesIn(cluster.told(), "has shown nothing"), 1U) << cluster.told();
  kill(cluster.program(), SIGTERM);
  EXPECT_EQ(cluster.end(), 128 + SIGTERM) << cluster.told();
}

TEST(ProgramClusterProcesses, AHostThatFindsTheShowAtItsEndHasNotFailed) {
  ClusterNodes nodes(twoNodes(), false, terminal, kShort);
  nodes.add("front", {"true"});
  nodes.add("left", {"sh", "-c", "exec sleep 600"});
  EXPECT_EQ(nodes.play(), 0) << "it waits for the host that has gone, and is asked to end";
}

TEST(ProgramClusterProcesses, WherePicturesAreKeptAHostThatDiedAndIsNotBackHasFailed) {
  for (const bool needed : {false, true}) {
    const TestFolder folder;
    const std::string starts = folder.write("starts", "");
    ClusterNodes nodes(twoNodes(), false, terminal, kShort);
    if (needed) nodes.needAll();
    nodes.add("front", {"sh", "-c", "until [ $(wc -l <" + starts + ") -ge 2 ]; do sleep 0.1; done"});
    nodes.add(
        "left",
        {"sh", "-c", "echo >>" + starts + "; [ $(wc -l <" + starts + ") -gt 1 ] || exit 3; exec sleep 600"});
    EXPECT_EQ(nodes.play(), needed ? 3 : 0);
  }
}

TEST(ProgramClusterProcesses, WherePicturesAreKeptAHostThatWasNotDoneHasFailed) {
  ClusterNodes nodes(twoNodes(), false, terminal, kShort);
  nodes.needAll();
  nodes.add("front", {"true"});
  nodes.add("left", {"sleep", "600"});
  testing::internal::CaptureStderr();
  EXPECT_EQ(nodes.play(), 2);
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(
      has(told, "cluster: left was not done when the show was over: what it has written may not be whole\n"))
      << told;
}

/// The others wait for the leader, which was asked to end before there was a show.
TEST(ProgramClusterProcesses, AShowThatIsOverForTheOthersIsNotPlayedAgainByTheLeaderAlone) {
  for (const bool endsFirst : {true, false}) {
    const TestFolder folder;
    const std::string starts = folder.write("starts", "");
    ClusterNodes nodes(twoNodes(), false, terminal);
    nodes.add("front", {"sh", "-c",
                        "echo >>" + starts + "; [ $(wc -l <" + starts + ") -eq 1 ] || sleep 600; " +
                            (endsFirst ? "" : "sleep 0.3; ") + "exit 3"});
    nodes.add("left", {"sh", "-c", endsFirst ? "sleep 0.3" : "true"});
    nodes.watchLead(std::move(SharedProgress::create().value()), fromSeconds(60));
    testing::internal::CaptureStderr();
    EXPECT_EQ(nodes.play(), 3);
    const std::string told = testing::internal::GetCapturedStderr();
    EXPECT_TRUE(has(told, "cluster: front does not play again: the show is over\n")) << told;
  }
}

TEST(ProgramClusterProcesses, OfAShowThatWasStoppedNoPictureIsMissed) {
  ClusterNodes nodes(twoNodes(), false, terminal, kShort);
  nodes.needAll();
  nodes.add("front", {"sh", "-c", "exit 143"});
  nodes.add("left", {"sleep", "600"});
  EXPECT_EQ(nodes.play(), 128 + SIGTERM);
}

TEST(ProgramClusterProcesses, AShowThatEndsForADifferenceDoesNotRestart) {
  const TestFolder folder;
  ClusterFile cluster = twoNodes();
  cluster.stopOnDifference = true;
  ClusterNodes nodes(cluster, false, terminal);
  nodes.add("front", failing(folder.path() / "front", 3, 1));
  nodes.add("left", {"true"});
  EXPECT_EQ(nodes.play(), 3);
  EXPECT_EQ(startsIn(folder.path() / "front"), 1U);
}

TEST(ProgramClusterProcesses, AHostThatHangsIsKilledOnceTheLeaderHasEnded) {
  for (const char* lead : {"exit 0", "exit 1"}) {
    const TestFolder folder;
    const std::string hangs = folder.path() / "hangs";
    ClusterNodes nodes(twoNodes(), false, terminal, kShort);
    nodes.add("front", {"sh", "-c", "until [ -e " + hangs + " ]; do sleep 0.1; done; " + lead});
    nodes.add("left", {"sh", "-c", "trap '' INT; echo >" + hangs + "; sleep 600"});
    testing::internal::CaptureStderr();
    EXPECT_EQ(nodes.play(), lead == std::string("exit 1") ? 1 : 128 + SIGKILL);
    const std::string told = testing::internal::GetCapturedStderr();
    EXPECT_EQ(timesIn(told, "cluster: left has not ended 0.3 s after it was asked to, and is killed\n"), 1U)
        << told;
    EXPECT_EQ(timesIn(told, "cluster: left "), 1U) << told;
  }
}

TEST(ProgramClusterProcesses, AHostThatHangsIsKilledAfterASignal) {
  const auto play = [] {
    ClusterNodes nodes(twoNodes(), false, terminal, kShort);
    nodes.add("front", {"sleep", "600"});
    nodes.add("left", {"sh", "-c", "trap '' TERM; kill -TERM $PPID; sleep 600"});
    std::exit(nodes.play());
  };
  EXPECT_EXIT(play(), testing::ExitedWithCode(128 + SIGKILL),
              "left has not ended 0.3 s after it was asked to");
}

TEST(ProgramClusterProcesses, WhatBecomesOfANodeIsToldInItsJournal) {
  const TestFolder folder;
  const auto file = [&](const char* node) { return (folder.path() / node).string(); };
  ClusterNodes nodes(twoNodes(), false, terminal);
  nodes.add("front", {"sh", "-c", "until [ $(wc -l <" + file("starts") + ") = 2 ]; do sleep 0.1; done"},
            std::move(Journal::open(file("front")).value()));
  nodes.add("left", failing(file("starts"), 3, 1), std::move(Journal::open(file("left")).value()));
  folder.write("starts", "");
  EXPECT_EQ(nodes.play(), 0);
  EXPECT_TRUE(fileContent(file("left")).ends_with("  -  cluster: left ended with exit code 3 and restarts\n"))
      << fileContent(file("left"));
  EXPECT_EQ(fileContent(file("front")), "") << "nothing became of it";
}

TEST(ProgramClusterProcesses, WhatANodeSaysIsOneValueOfTheJsonWhateverItIs) {
  ClusterNodes nodes(twoNodes(), false, terminal);
  nodes.add("front", {"sh", "-c", "echo '{\"frames\":3}'"});
  nodes.add("left", {"sh", "-c", "echo '{\"frames\":'"});
  EXPECT_EQ(nodes.play(), 0);
  EXPECT_EQ(nodes.saidAsJson(), "{\"front\": {\"frames\":3},\n\"left\": null}\n");
  EXPECT_EQ(nodes.said(), "-- front\n{\"frames\":3}\n-- left\n{\"frames\":\n");
}

std::vector<std::string> shortCluster(const std::string& file, const std::vector<std::string>& more) {
  std::vector<std::string> words{"cluster", file, kKick, "--size", "16x12", "--look", "plain"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(ProgramClusterProcesses, FilesGetTheNodesNamesAndWhatTheInputWasIsWrittenOnce) {
  const TestFolder folder;
  const auto file = [&](const std::string& name) { return (folder.path() / name).string(); };
  const ProgramResult r = stadionProgram(
      shortCluster(fourNodes(folder), {"--frames", "5", "--trace=" + file("trace.json"), "--journal",
                                       file("journal"), "--record-input", file("said.input")}));
  ASSERT_EQ(r.status, 0) << r.out << r.err;
  for (const std::string node : kFourNodes) {
    EXPECT_TRUE(Json::accept(fileContent(file("trace-" + node + ".json")))) << node;
    EXPECT_EQ(timesIn(fileContent(file("journal-" + node)), "exit code 0"), 1U)
        << fileContent(file("journal-" + node));
  }
  EXPECT_TRUE(has(fileContent(file("said.input")), "stadion-input 1"));
  for (const char* name : {"journal", "said-front.input", "said-left.input"})
    EXPECT_FALSE(fs::exists(file(name))) << name;
  const Json merged = Json::parse(fileContent(file("trace.json")));
  std::set<std::string> hosts;
  for (const Json& e : merged["traceEvents"])
    if (e["name"] == "process_name") hosts.insert(e["args"]["name"]);
  EXPECT_EQ(hosts, std::set<std::string>(std::begin(kFourNodes), std::end(kFourNodes)));
  // A trace begins with the first frame after the pipeline is full.
  for (const Json& host : merged["otherData"]["hosts"]) EXPECT_GE(host["common frames"], 1) << host;
}

TEST(ProgramClusterProcesses, TrackersAndOperatorAreTheLeaders) {
  PlayingCluster cluster({"--tracker", "osc:0", "--osc", "0", "--predict", "10", "--no-sound", "--journal",
                          "journal", "--black-box", "box"});
  const auto plays = [&](const std::string& node) {
    return has(fileContent(cluster.file("journal-" + node)), "first picture");
  };
  ASSERT_TRUE(becomes([&] { return std::ranges::all_of(kFourNodes, plays); })) << cluster.told();
  EXPECT_EQ(timesIn(cluster.told(), "trackers: OSC on UDP port"), 1U) << cluster.told();
  EXPECT_EQ(timesIn(cluster.told(), "operator: OSC on UDP port"), 1U) << cluster.told();
  for (const std::string node : kFourNodes)
    EXPECT_TRUE(fs::is_regular_file(cluster.file("box-" + node))) << node;
  ASSERT_TRUE(signalTo(cluster.program(), SIGTERM));
  EXPECT_EQ(cluster.end(), 128 + SIGTERM) << cluster.told();
}

TEST(ProgramClusterProcesses, TheJournalOfANodeSaysThatItDied) {
  PlayingCluster cluster(forLong({"--journal", "journal"}));
  ASSERT_TRUE(cluster.plays()) << cluster.told();
  ASSERT_TRUE(signalTo(cluster.node("left"), SIGKILL));
  const auto journal = [&] { return fileContent(cluster.file("journal-left")); };
  EXPECT_TRUE(becomes([&] {
    return has(journal(), "  -  cluster: left was ended by signal 9 and restarts\n");
  })) << journal();
  EXPECT_TRUE(becomes([&] { return timesIn(journal(), "started: stadion") == 2; })) << journal();
  EXPECT_FALSE(has(fileContent(cluster.file("journal-right")), "signal 9"));
  kill(cluster.program(), SIGTERM);
  EXPECT_EQ(cluster.end(), 128 + SIGTERM) << cluster.told();
}

TEST(ProgramClusterProcesses, WithJsonTheStandardOutputIsOneObject) {
  const TestFolder folder;
  const ProgramResult r = stadionProgram(shortCluster(fourNodes(folder), {"--frames", "3", "--json"}));
  ASSERT_EQ(r.status, 0) << r.err;
  const Json said = Json::parse(r.out, nullptr, false);
  ASSERT_TRUE(said.is_object()) << r.out;
  EXPECT_EQ(said.size(), 4U);
  for (const char* node : kFourNodes) EXPECT_EQ(said[node]["frames"], 3) << node;
}

TEST(ProgramClusterProcesses, WhatEachNodeWouldRefuseIsToldOnceBeforeAnyIsStartedAsRunTellsIt) {
  const TestFolder folder;
  const std::string four = fourNodes(folder);
  const auto expectAsRun = [&](const std::vector<std::string>& words) {
    std::vector<std::string> run{"run"}, cluster{"cluster", four};
    run.insert(run.end(), words.begin(), words.end());
    cluster.insert(cluster.end(), words.begin(), words.end());
    const ProgramResult wanted = stadionProgram(run), r = stadionProgram(cluster);
    EXPECT_EQ(r.status, 2) << words.back();
    EXPECT_EQ(wanted.status, 2) << words.back();
    EXPECT_EQ(r.err, wanted.err) << words.back();
    EXPECT_EQ(r.out, "") << words.back();
  };
  expectAsRun({kKick, "--frmes", "3"});
  expectAsRun({kKick, "--frames", "-3"});
  expectAsRun({kKick, "--size", "many"});
  expectAsRun({folder.path()});
  expectAsRun({"nowhere.evs"});
  expectAsRun({folder.write("wrong.evs", "dynobject( name=a, densty=2 )\n")});
  const auto refused = [&](const std::vector<std::string>& words, const std::string& why) {
    const ProgramResult r = stadionProgram(words);
    EXPECT_EQ(r.status, 2) << r.out;
    EXPECT_EQ(timesIn(r.err, why), 1U) << r.err;
    EXPECT_EQ(r.out, "");
  };
  refused(shortCluster(four, {"--walls", "cave6"}),
          "--walls is not for clusters: " + four + " says which walls there are");
  refused(shortCluster(four, {"--node", "front"}), "--node");
  refused(shortCluster(four, {"--frames", "3", "--late-latch"}), "--late-latch is not for clusters");
  refused(shortCluster(four, {"--frames", "3", "--spans", folder.path() / "spans"}),
          "--spans and --count-work are not for clusters");
  refused(shortCluster(folder.write("walls.cluster", "walls cave4\nnode a front\nnode b fromt\n"), {}),
          "walls.cluster:3:8: error: cave4 has no wall \"fromt\"");
  refused(shortCluster(folder.write("net.cluster", "node a front\nnode b left\ninterface nosuch0\n"), {}),
          "net.cluster:3:11: error: this machine has no network interface \"nosuch0\"");
}

TEST(ProgramClusterProcesses, FilesThatCannotBeWrittenAreToldOnceBeforeAnyNodeIsStarted) {
  const TestFolder folder;
  const std::string four = fourNodes(folder), nowhere = folder.path() / "nowhere" / "x.log";
  std::filesystem::create_directory(folder.path() / "there-front");
  const auto refused = [&](const std::string& option, const std::string& file, const std::string& why) {
    const ProgramResult r = stadionProgram(shortCluster(four, {option + "=" + file, "--frames", "3"}));
    EXPECT_EQ(r.status, 2) << option;
    EXPECT_EQ(r.err, "error: " + option + ": " + why + "\n");
    EXPECT_EQ(r.out, "") << option;
  };
  const std::string ofFront = folder.path() / "nowhere" / "x-front.log";
  const std::string gone = " cannot be written: No such file or directory";
  for (const char* option : {"--journal", "--trace", "--black-box"}) refused(option, nowhere, ofFront + gone);
  refused("--record-input", nowhere, nowhere + gone);
  refused("--journal", folder.path() / "there",
          (folder.path() / "there-front").string() + " cannot be written: Is a directory");
  refused("--out", four, "cannot make the folder " + four + "/front: Not a directory");
}

TEST(ProgramClusterProcesses, WhatAllNodesWouldWarnOfIsToldOnce) {
  const TestFolder folder;
  const std::string three = folder.write("three.cluster", "node a front left\nnode b right\npartition w" +
                                                              std::to_string(getpid()) + "\n");
  const ProgramResult r = stadionProgram(shortCluster(three, {"--frames", "3", "--gl", "none"}));
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(timesIn(r.err, "warning: no host shows the wall \"floor\" of cave4"), 1U) << r.err;
}

TEST(ProgramClusterProcesses, OptionsMayStandWhereverTheyLike) {
  const TestFolder folder;
  const ProgramResult r = stadionProgram(
      {"cluster", "--frames", "3", fourNodes(folder), "--size", "16x12", kKick, "--no-sound", "--json"});
  EXPECT_EQ(r.status, 0) << r.err;
}

TEST(ProgramClusterProcesses, HelpSaysWhatGoesWhere) {
  const ProgramResult r = stadionProgram({"cluster", "--help"});
  EXPECT_EQ(r.status, 0);
  for (const char* word : {"--record-input", "--trace", "--tracker", "trace-NODE.json", "exit code 3"})
    EXPECT_TRUE(has(r.out, word)) << r.out;
  EXPECT_FALSE(has(r.out, "ClusterOptions"));
}

}  // namespace
}  // namespace stadion
