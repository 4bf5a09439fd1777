/// Faults of the machine around the program, by a library that is preloaded into it (fault_library/): each
/// has a defined outcome (docs/faults.md).

#include "tests/proc.h"
#include "tests/programs/desk.h"
#include "tests/programs/preloaded_faults.h"

#include <csignal>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// A ball that bounces, and a sub-scene that comes meanwhile: files, messages, dynamics, a log of input.
class ProgramFaults : public ::testing::Test {
protected:
  ProgramFaults() {
    show_ = folder_.write("show.evs",
                          "forcelinear( name=gravity, direction=\"0, 0, -1\" )\n"
                          "object( name=floor, file=plane.3ds )\n"
                          "dynobject( name=ball, file=football.3ds, position=\"0, 6, 3\", density=0.08,\n"
                          "           restitution=0.7, hook=gravity )\n"
                          "dynamics( collider=floor, collidee=ball )\n"
                          "timer( period=0.1, eventmessage=\"timesup, more, load\" )\n"
                          "scene( name=more, file=more.evs, ready=0.1, initstate=off )\n"
                          "light( direction=\"-1, 2, -3\" )\n");
    folder_.write("more.evs", "object( file=football.3ds, position=\"1, 5, 1\" )\n");
    folder_.write("show.input", "stadion-input 1\nkey head 0  0 0 1.7\n"
                                "key head 0.5  0 0.3 1.7  turn 20 0 0  smooth\n");
    fs::create_directory(folder_.path() / "state");
  }

  void SetUp() override {
    if (!fs::exists(faultLibrary())) GTEST_SKIP() << "sanitizers let nothing be preloaded";
  }

  std::string file(const std::string& name) const { return folder_.path() / name; }

  ProgramRun run(const std::string& fault, std::vector<std::string> more = {}) const {
    ProgramRun r{{stadionPath(), "run", show_, "--asset-root", assetFolder(), "--walls", "desktop", "--size",
                  "32x24", "--look", "plain"}};
    r.words.insert(r.words.end(), more.begin(), more.end());
    r.environment = {"XDG_STATE_HOME=" + file("state"), "LP_NUM_THREADS=1"};
    if (!fault.empty()) {
      r.environment.push_back("LD_PRELOAD=" + faultLibrary());
      r.environment.push_back("STADION_FAULT=" + fault);
    }
    return r;
  }

  /// What is left of a file that was not finished.
  std::set<std::string> leftOver() const {
    std::set<std::string> parts;
    for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
      if (entry.path().extension() == ".part") parts.insert(entry.path().filename());
    return parts;
  }

  TestFolder folder_;
  std::string show_;
};

/// Of the last frame, as the text at the end says it.
std::string hashOf(const ProgramResult& r) {
  const std::size_t line = r.out.find("state hash of frame ");
  EXPECT_NE(line, r.out.npos) << r.out << r.err;
  return line == r.out.npos ? "" : r.out.substr(line, r.out.find('\n', line) - line);
}

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// Runs in which there is no memory, once or from then on, somewhere.
class ProgramFaultsWithoutMemory : public ProgramFaults {
protected:
  /// How often a program asks, by what it says at its end.
  long askedBy(const ProgramRun& run) const {
    const ProgramResult r = runProgram(run);
    const std::size_t at = r.err.find("asked for memory: ");
    return at == r.err.npos ? 0 : std::stol(r.err.substr(at + 18));
  }

  /// Ends with what it was, or goes on as if nothing had been; leaves nothing that is not whole.
  void expectDefinedEnd(const ProgramRun& run, const std::string& what, const std::string& hash) {
    const std::string record = file("record.input");
    fs::remove(record);
    const ProgramResult r = runProgram(run);
    EXPECT_TRUE(r.status == 0 || r.status == 2 || r.status == 3) << what << ": " << r.status << "\n" << r.err;
    inFrames_ += has(r.err, "App, frame ") && has(r.err, ": out of memory");
    if (r.status == 0)
      EXPECT_EQ(hashOf(r), hash) << what;
    else
      EXPECT_TRUE(has(r.err, "out of memory")) << what << "\n" << r.err;
    EXPECT_EQ(leftOver(), std::set<std::string>()) << what;
    if (!fs::exists(record)) return;
    const ProgramResult again = runProgram(this->run("", {"--gl", "none", "--input", record}));
    EXPECT_EQ(again.status, 0) << what << ": the record is damaged\n" << again.err;
  }

  /// `runs` times, between the command line and the end.
  void sweep(const std::vector<std::string>& words, const char* how, int runs) {
    const ProgramResult whole = runProgram(run("", words));
    ASSERT_EQ(whole.status, 0) << whole.err;
    const ProgramRun none{{stadionPath(), "run"}, run("new tell=1").environment};
    const long begin = askedBy(none), end = askedBy(run("new tell=1", words));
    ASSERT_GT(end, begin);
    // Half of them before the first frame, where most of it is asked for; half among the last that ask.
    const long late = end - std::min<long>(1500, (end - begin) / 2);
    for (int i = 0; i < runs; ++i) {
      const long from = i % 2 ? begin : late, to = i % 2 ? late : end;
      const long at = from + 1 + (to - from) * (i / 2) / std::max(1, runs / 2);
      const std::string fault = fmt::format(fmt::runtime(how), at);
      expectDefinedEnd(run(fault, words), fault, hashOf(whole));
      if (HasFailure()) return;
    }
  }

  static int times(int few) { return fullRuns() ? 50 * few : few; }

  int inFrames_ = 0;  ///< runs that ended in one, and said so
};

TEST_F(ProgramFaultsWithoutMemory, OnceTheRunSaysSoOrGoesOn) {
  sweep({"--gl", "none", "--mode", "sequential", "--record-input", file("record.input")}, "new nth={}",
        times(16));
  EXPECT_GT(inFrames_, 0) << "no run said in which frame it was";
}

TEST_F(ProgramFaultsWithoutMemory, FromThenOnTheRunSaysSo) {
  sweep({"--gl", "none", "--mode", "sequential", "--record-input", file("record.input")}, "new from={}",
        times(12));
}

TEST_F(ProgramFaultsWithoutMemory, InThreadsItIsTheSame) {
  sweep({"--gl", "none", "--record-input", file("record.input")}, "new nth={}", times(10));
  sweep({"--gl", "none", "--record-input", file("record.input")}, "new from={}", times(6));
}

TEST_F(ProgramFaults, ReadsThatGiveAFewBytesAtATimeChangeNothing) {
  const ProgramResult whole = runProgram(run("", {"--gl", "none"}));
  for (const char* fault : {"read most=3", "read in=stadion-import most=3"}) {
    const ProgramResult r = runProgram(run(fault, {"--gl", "none"}));
    EXPECT_EQ(r.status, 0) << fault << r.err;
    EXPECT_EQ(hashOf(r), hashOf(whole)) << fault;
    EXPECT_FALSE(has(r.err, "error")) << fault << r.err;
  }
}

TEST_F(ProgramFaults, AScriptThatTheDiskCannotReadIsNamed) {
  const ProgramResult r = runProgram(run("read error=5 path=show.evs", {"--gl", "none"}));
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "show.evs: error: cannot be read: Input/output error")) << r.err;
}

TEST_F(ProgramFaults, APartThatTheDiskCannotReadStaysOutAndTheShowGoesOn) {
  const ProgramResult r = runProgram(run("read error=5 path=more.evs", {"--gl", "none"}));
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(has(r.err, "more.evs: error: cannot be read: Input/output error")) << r.err;
}

TEST_F(ProgramFaults, AModelThatTheDiskCannotReadHasAStandIn) {
  const ProgramResult r =
      runProgram(run("read in=stadion-import error=5 path=football.3ds", {"--gl", "none"}));
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(has(r.err, "football.3ds")) << r.err;
  EXPECT_TRUE(has(r.err, "a stand-in is shown in its place")) << r.err;
}

TEST_F(ProgramFaults, ADiskThatIsFullWhileInputIsRecordedCostsTheRestOfTheRecordAndNothingElse) {
  const ProgramResult whole = runProgram(run("", {"--gl", "none"}));
  const std::string record = folder_.write("record.input", "stadion-input 1\nkey head 0  0 0 1.7\n");
  const std::string before = fileContent(record);
  const ProgramResult r = runProgram(
      run("write error=28 after=600 path=record.input", {"--gl", "none", "--record-input", record}));
  EXPECT_EQ(r.status, 2) << r.err;
  EXPECT_TRUE(has(r.err, "record.input: cannot be written: No space left on device")) << r.err;
  EXPECT_EQ(hashOf(r), hashOf(whole));
  EXPECT_EQ(fileContent(record), before);
  EXPECT_TRUE(has(r.err, "what could be written is in")) << r.err;
  EXPECT_GT(fileContent(record + ".partial").size(), 500U);
  EXPECT_EQ(runProgram(run("", {"--gl", "none", "--input", record + ".partial"})).status, 0);
  EXPECT_EQ(leftOver(), std::set<std::string>());
}

TEST_F(ProgramFaults, ADiskThatIsFullOfPicturesEndsTheRunWithThoseThatAreWhole) {
  const std::string out = file("out");
  const ProgramResult r =
      runProgram(run("write error=28 after=2000 path=.png", {"--out", out, "--pictures", "1"}));
  EXPECT_EQ(r.status, 2) << r.err;
  EXPECT_TRUE(has(r.err, ".png: cannot be written: No space left on device")) << r.err;
  EXPECT_EQ(leftOver(), std::set<std::string>());
  int pictures = 0;
  for (const auto& entry : fs::directory_iterator(out))
    if (entry.path().extension() == ".png") {
      ++pictures;
      EXPECT_TRUE(has(fileContent(entry.path()), "IEND")) << entry.path();
    }
  EXPECT_GT(pictures, 0);
  EXPECT_TRUE(has(json::parse(fileContent(out + "/summary.json")).at("failure"), "No space left on device"));
}

TEST_F(ProgramFaults, ADiskThatIsFullWhenTheLastFramesAreToBeKeptIsToldAndTheShowIsPlayedWithout) {
  const ProgramResult whole = runProgram(run("", {"--gl", "none"}));
  const ProgramResult r = runProgram(run("write error=28 path=.frames", {"--gl", "none"}));
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(has(r.err, "the last frames cannot be kept here: No space left on device")) << r.err;
  EXPECT_TRUE(has(r.err, "the show is played without")) << r.err;
  EXPECT_EQ(hashOf(r), hashOf(whole));
}

TEST_F(ProgramFaults, ADiskThatIsFullWhileASoakIsRecordedIsToldAndTheSoakGoesOn) {
  const std::string record = file("soak.record");
  const std::vector<std::string> words{stadionPath(), "soak",        "--frames", "1000", "--visit",
                                       "1000",        "--no-memory", "--record", record};
  ProgramRun full = run("write error=28 after=150 path=soak.record");
  full.words = words;
  const ProgramResult r = runProgram(full);
  EXPECT_EQ(r.status, 2) << r.err;
  const std::string told = "soak.record: cannot be written: No space left on device";
  EXPECT_TRUE(has(r.err, told)) << r.err;
  EXPECT_EQ(r.err.find(told), r.err.rfind(told)) << "once: " << r.err;
  EXPECT_TRUE(has(r.out, "1000 frames in 1 visits")) << r.out;
  const std::string text = fileContent(record);
  EXPECT_TRUE(text.ends_with("}\n")) << "no half line: " << text;
  // A run that finds room goes on with it; a check that fails counts for more than the record.
  EXPECT_EQ(runProgram({words}).status, 0);
  const std::size_t history = fileContent(record).find("\"history\":") + 10;
  folder_.write("soak.record", fileContent(record).insert(history, "1").substr(0, text.size() + 200));
  EXPECT_EQ(runProgram(full).status, 1);
}

TEST_F(ProgramFaults, ADiskThatIsFullWhenTheJournalIsWrittenIsToldAndTheShowGoesOn) {
  const ProgramResult whole = runProgram(run("", {"--gl", "none"}));
  const std::string journal = file("run.log");
  const ProgramResult r =
      runProgram(run("write error=28 after=100 path=run.log", {"--gl", "none", "--journal", journal}));
  EXPECT_EQ(r.status, 2) << r.err;
  const std::string told = "run.log: cannot be written: No space left on device";
  EXPECT_TRUE(has(r.err, told)) << r.err;
  EXPECT_EQ(r.err.find(told), r.err.rfind(told)) << "once: " << r.err;
  EXPECT_EQ(hashOf(r), hashOf(whole));
  const std::string text = fileContent(journal);
  EXPECT_TRUE(text.empty() || text.ends_with("\n")) << "no half line: " << text;
}

/// The player and its supervisor have the same fault.
TEST_F(ProgramFaults, AWatchedShowWhoseJournalIsOnAFullDiskIsPlayedOnce) {
  const std::string journal = file("run.log");
  ProgramRun watched = run("write error=28 path=run.log", {"--gl", "none", "--pace", "lock", "--seconds", "6",
                                                           "--supervise", "--journal", journal});
  RunningProgram program(watched);
  ASSERT_TRUE(program.says("stadion: --journal: "));
  ASSERT_TRUE(program.waitUntil([&] { return procChild(program.pid()) > 0; }));
  ::kill(procChild(program.pid()), SIGKILL);
  ASSERT_TRUE(
      program.says("supervise: --journal: " + journal + ": cannot be written: No space left on device"));
  ASSERT_TRUE(program.says("stadion: --journal: ", 2)) << "the second player";
  EXPECT_EQ(program.status(), 2) << program.err();
  const std::string err = program.err();
  EXPECT_EQ(err.find("supervise: --journal: "), err.rfind("supervise: --journal: ")) << "once: " << err;
  EXPECT_FALSE(has(err, "exit code 2")) << "a show that is over is not played again: " << err;
  EXPECT_EQ(fileContent(journal), "");
}

TEST_F(ProgramFaults, AClockThatIsSetChangesNothing) {
  const std::vector<std::string> words{"--gl", "none", "--pace", "lock", "--seconds", "1"};
  const ProgramResult whole = runProgram(run("", words));
  for (const char* fault : {"clock jump=36000 after=300", "clock jump=-36000 after=300"}) {
    const ProgramResult r = runProgram(run(fault, words));
    EXPECT_EQ(r.status, 0) << fault << r.err;
    EXPECT_EQ(hashOf(r), hashOf(whole)) << fault;
  }
}

/// The sockets of the program and of those that it has started, as they stand in /proc/net.
std::string socketsOf(pid_t program) {
  std::set<std::string> inodes;
  for (const pid_t process : procNumbers()) {
    if (::getpgid(process) != program) continue;
    const std::string files = "/proc/" + std::to_string(process) + "/fd/";
    for (const std::string& f : procNames(files)) {
      std::error_code gone;
      const std::string link = fs::read_symlink(files + f, gone).string();
      if (link.starts_with("socket:[")) inodes.insert(link.substr(8, link.size() - 9));
    }
  }
  std::string found;
  for (const char* table : {"tcp", "udp", "tcp6", "udp6", "raw", "packet"}) {
    std::ifstream lines(std::string("/proc/net/") + table);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream in(line);
      const std::vector<std::string> words{std::istream_iterator<std::string>(in), {}};
      for (const std::string& w : words)
        if (inodes.contains(w)) found += std::string(table) + " " + words[1] + "\n";
    }
  }
  return found;
}

class ProgramFaultsLive : public ProgramFaults {
protected:
  /// A show without input: it plays until it is told to end.
  ProgramRun live(std::vector<std::string> more) const {
    return run("", with({"--input", "none", "--gl", "none", "--pace", "lock", "--rate", "20"}, more));
  }
};

TEST_F(ProgramFaultsLive, NothingListensToTheNetworkUnlessAsked) {
  const ProgramRun quiet = live({"--record-input", file("r.input")});
  const auto socketsWhilePlaying = [](const ProgramRun& run) {
    RunningProgram program(run);
    EXPECT_TRUE(program.says("playing until Ctrl-C"));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const std::string sockets = socketsOf(program.pid());
    return sockets;
  };
  EXPECT_EQ(socketsWhilePlaying(quiet), "");
  const std::string port = std::to_string(freePort());
  EXPECT_TRUE(has(socketsWhilePlaying(live({"--osc", port})), "udp"));  // else nothing would be found at all
}

TEST_F(ProgramFaultsLive, AProgramThatStoodStillGoesOnByTheClock) {
  RunningProgram program(live({"--json"}));
  ASSERT_TRUE(program.says("playing until Ctrl-C"));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  const pid_t pid = program.pid();
  ::kill(-pid, SIGSTOP);
  std::this_thread::sleep_for(std::chrono::seconds(2));
  ::kill(-pid, SIGCONT);
  EXPECT_TRUE(program.says("late: "));
  ::kill(-pid, SIGINT);
  EXPECT_EQ(program.status(), 130);
  const json summary = json::parse(program.out(), nullptr, false);
  ASSERT_TRUE(summary.is_object()) << program.out();
  EXPECT_GE(summary.value("most_passed_over", 0), 20);  // of forty ticks that could not be shown
  EXPECT_GT(summary.value("seconds", 0.0), 1.5);        // the show's time went on with the clock
}

/// By SIGKILL or a power cut, nothing is tidied up.
TEST_F(ProgramFaults, ARunThatIsKilledLeavesARecordThatTheNextOneTellsOf) {
  const std::string record = file("visit.input");
  const std::string hour =
      folder_.write("hour.input", "stadion-input 1\nkey head 0  0 0 1.7\nkey head 3600  0 9 1.7  smooth\n");
  RunningProgram program(
      run("", {"--gl", "none", "--pace", "lock", "--input", hour, "--record-input", record}));
  ASSERT_TRUE(program.waitUntil([&] {
    for (const std::string& name : leftOver())
      if (fs::file_size(folder_.path() / name) > 4000) return true;
    return false;
  }));
  const std::string name = fmt::format(".visit.input.{}-0.part", program.pid());
  program.kill();
  EXPECT_EQ(leftOver(), std::set<std::string>{name});
  const ProgramResult next = runProgram(run("", {"--gl", "none", "--record-input", record}));
  EXPECT_EQ(next.status, 0) << next.err;
  EXPECT_TRUE(has(next.err, name + ": warning: ")) << next.err;
  EXPECT_EQ(leftOver(), std::set<std::string>{name}) << "it is kept";
  // As docs/faults.md says: without its last line, half or not, it can be played.
  std::string text = fileContent(folder_.path() / name);
  const std::string kept = folder_.write("kept.input", text.substr(0, text.rfind('\n') + 1));
  const ProgramResult again = runProgram(run("", {"--gl", "none", "--input", kept}));
  EXPECT_EQ(again.status, 0) << again.err;
}

/// Where a script may name a file, it names one that is not the show's.
TEST_F(ProgramFaults, FilesOutsideOfTheShowsFoldersAreNotOpened) {
  const TestFolder outside;
  const std::string secret = outside.write("secret.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  outside.write("secret.evs", "object( name=told )\n");
  fs::create_symlink(outside.path(), folder_.path() / "way");
  fs::create_symlink(secret, folder_.path() / "link.obj");
  const std::string up = "../" + outside.path().filename().string();
  for (const std::string& name :
       {secret, up + "/secret.obj", std::string("way/secret.obj"), std::string("link.obj"),
        std::string("/etc/passwd"), std::string("../../etc/passwd"), std::string("/dev/zero"),
        std::string("/proc/self/environ")})
    for (const std::string& line :
         {fmt::format("object( file=\"{}\" )", name), fmt::format("sound( file=\"{}\", initstate=on )", name),
          fmt::format("scene( file=\"{}\", initstate=on )", name)}) {
      const std::string script = folder_.write("hostile.evs", line + "\n");
      const ProgramResult r = stadionProgram({"check", script});
      EXPECT_EQ(r.status, 2) << line << r.out;
      EXPECT_TRUE(has(r.out, "is an absolute path") || has(r.out, "leads out of the")) << line << r.out;
    }
}

}  // namespace
}  // namespace stadion
