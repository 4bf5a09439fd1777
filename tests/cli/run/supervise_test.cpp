/// `stadion run --supervise`: players are killed and stopped, and the show goes on.

#include "pipeline/supervision/shared_progress.h"
#include "tests/proc.h"
#include "tests/programs/becomes.h"
#include "tests/programs/desk.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <lo/lo.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <optional>
#include <regex>
#include <sstream>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

using Json = nlohmann::json;

const std::string kKick = STADION_SOURCE_DIR "/scripts/kick.evs";

/// A supervised run beside the test.
class Supervised {
public:
  explicit Supervised(std::vector<std::string> more) {
    std::vector<std::string> words{stadionPath(), "run",       kKick,    "--supervise",
                                   "--json",      "--journal", journal()};
    words.insert(words.end(), more.begin(), more.end());
    pid_ = startProgram({words, {"ALSOFT_DRIVERS=null"}}, said(), told());
  }
  ~Supervised() {
    if (pid_ <= 0) return;
    kill(-pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Supervised(const Supervised&) = delete;
  Supervised& operator=(const Supervised&) = delete;

  std::string journal() const { return journals_.path() / "run.log"; }
  std::string told() const { return folder_.path() / "told"; }
  std::string said() const { return folder_.path() / "said"; }
  pid_t pid() const { return pid_; }

  /// The process that plays at the moment; 0 = none.
  pid_t player() const { return procChild(pid_); }
  /// The scene that is kept for the next player; nothing yet: none.
  std::optional<SharedProgress::Kept> kept() const {
    const std::string files = "/proc/" + std::to_string(pid_) + "/fd/";
    for (const std::string& name : procNames(files)) {
      std::error_code gone;
      if (!std::filesystem::read_symlink(files + name, gone).string().starts_with("/memfd:")) continue;
      const int file = open((files + name).c_str(), O_RDWR | O_CLOEXEC);
      const auto progress = SharedProgress::attach(file);
      if (!progress) close(file);
      if (progress && progress->kept()) return progress->kept();
    }
    return {};
  }
  /// Waits until a scene is kept that is later than this one.
  bool keepsAfter(Nanoseconds time) const {
    return becomes([&] {
      const auto now = kept();
      return now && now->time > time;
    });
  }
  bool hasTold(const std::string& what) const { return fileContent(told()).find(what) != std::string::npos; }
  bool hasNoted(const std::string& what) const {
    return fileContent(journal()).find(what) != std::string::npos;
  }
  int end() {
    int status = -1;
    waitpid(std::exchange(pid_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

private:
  TestFolder folder_, journals_;
  pid_t pid_ = -1;
};

/// The number behind those words.
std::optional<double> secondsAfter(const std::string& text, const std::string& words) {
  std::smatch found;
  if (!std::regex_search(text, found, std::regex(words + "([0-9.]+[0-9])"))) return {};
  return std::stod(found[1]);
}

TEST(ProgramSupervise, AShowGoesOnAfterItsPlayerWasKilledAndAfterItWasStopped) {
  const std::vector<std::string> play{"--walls", "desktop", "--size", "32x24",     "--look",
                                      "plain",   "--rate",  "60",     "--seconds", "15"};
  std::vector<std::string> alone{"run", kKick, "--pace", "free", "--json"}, watched = play;
  alone.insert(alone.end(), play.begin(), play.end());
  const ProgramResult reference = stadionProgram(alone);
  ASSERT_EQ(reference.status, 0) << reference.err;

  watched.insert(watched.end(), {"--pace", "lock", "--hang-after", "2"});
  Supervised run(watched);
  ASSERT_TRUE(becomes([&] { return run.hasNoted("the first picture"); })) << fileContent(run.told());
  ASSERT_TRUE(run.keepsAfter(0)) << fileContent(run.told());
  const pid_t first = run.player();
  ASSERT_GT(first, 0);
  ASSERT_EQ(kill(first, SIGKILL), 0);
  ASSERT_TRUE(becomes([&] { return run.hasTold("pictures again"); })) << fileContent(run.told());
  const pid_t second = run.player();
  EXPECT_NE(second, first);
  ASSERT_EQ(kill(second, SIGSTOP), 0);
  EXPECT_TRUE(becomes([&] { return run.hasTold("showed nothing for 2 s and was killed"); }))
      << fileContent(run.told());
  ASSERT_EQ(run.end(), 0) << fileContent(run.told());

  const std::string told = fileContent(run.told());
  EXPECT_NE(told.find("the player was ended by signal 9 (Killed) at frame"), std::string::npos) << told;
  const auto from = secondsAfter(told, "goes on from frame [0-9]+, "),
             to = secondsAfter(told, "catches up to ");
  ASSERT_TRUE(from && to) << told;
  EXPECT_GT(*from, 0) << "the scene that was kept";
  EXPECT_GE(*to, *from) << "where the show was when its player died, and the time since";
  const Json wanted = Json::parse(reference.out), has = Json::parse(fileContent(run.said()));
  for (const char* figure : {"state_hash", "history_hash", "last_frame"})
    EXPECT_EQ(has[figure], wanted[figure]) << figure << '\n' << told;
  EXPECT_EQ(has["image_hashes"], wanted["image_hashes"]);
  EXPECT_FALSE(wanted["image_hashes"].empty());
  EXPECT_NE(has["remarks"].dump().find("replaced 2 times"), std::string::npos) << has["remarks"];
  for (const char* line :
       {"started: stadion", "machine: ", "loaded ", "was ended by signal 9", "goes on from frame",
        "pictures again", "showed nothing for 2 s", "ended with exit code 0"})
    EXPECT_TRUE(run.hasNoted(line)) << line << '\n' << fileContent(run.journal());
}

TEST(ProgramSupervise, TheSummarySaysWhatKeepingTheSceneTook) {
  const ProgramResult r =
      stadionProgram({"run", kKick, "--supervise", "--json", "--seconds", "8", "--pace", "lock", "--size",
                      "32x24", "--look", "plain", "--walls", "desktop"});
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string remarks = Json::parse(r.out)["remarks"].dump();
  EXPECT_TRUE(
      std::regex_search(remarks, std::regex("bytes\\) was kept (once|[0-9]+ times) for the next player")))
      << remarks;
}

/// Else each would have to catch up from further back than the one before.
TEST(ProgramSupervise, APlayerThatIsKilledSoonAfterItWentOnHasKeptTheSceneForTheNextOne) {
  Supervised run({"--gl", "none", "--rate", "240", "--pace", "lock", "--input", "none"});
  ASSERT_TRUE(becomes([&] { return run.hasNoted("plays; nothing is drawn"); })) << fileContent(run.told());
  ASSERT_TRUE(run.keepsAfter(0)) << fileContent(run.told());
  std::vector<double> from;
  for (int n = 1; n <= 2; ++n) {
    const auto toldTimes = [&](const std::string& what) {
      const std::string told = fileContent(run.told());
      int times = 0;
      for (std::size_t at = told.find(what); at != told.npos; at = told.find(what, at + 1)) ++times;
      return times;
    };
    ASSERT_EQ(kill(run.player(), SIGKILL), 0);
    ASSERT_TRUE(becomes([&] { return toldTimes("pictures again") == n; })) << fileContent(run.told());
    const std::string told = fileContent(run.told());
    const auto at = secondsAfter(told.substr(told.rfind("the show ")), "from frame [0-9]+, ");
    ASSERT_TRUE(at) << told;
    from.push_back(*at);
    ASSERT_TRUE(run.keepsAfter(fromSeconds(*at) + 1'000'000)) << fileContent(run.told());
  }
  EXPECT_GT(from[1], from[0]) << fileContent(run.told());
  ASSERT_EQ(kill(run.pid(), SIGTERM), 0);
  EXPECT_EQ(run.end(), 128 + SIGTERM) << fileContent(run.told());
  EXPECT_NE(fileContent(run.said()).find("replaced 2 times"), std::string::npos);
}

/// Where it was paused, not where the scene was kept: also if the next player dies as well.
TEST(ProgramSupervise, AShowThatIsPausedStandsStillAtTheSameFrameForEveryPlayer) {
  const std::uint16_t port = freePort();
  Supervised run({"--gl", "none", "--no-sound", "--input", "none", "--osc", std::to_string(port)});
  const auto send = [to = std::to_string(port)](const char* path, double value) {
    const lo_address address = lo_address_new("127.0.0.1", to.c_str());
    lo_send(address, path, "d", value);
    lo_address_free(address);
  };
  const auto timesTold = [&](const std::string& what) {
    const std::string told = fileContent(run.told());
    int times = 0;
    for (std::size_t at = told.find(what); at != told.npos; at = told.find(what, at + 1)) ++times;
    return times;
  };
  ASSERT_TRUE(becomes([&] { return run.hasNoted("plays; nothing is drawn"); })) << fileContent(run.told());
  ASSERT_TRUE(run.keepsAfter(0)) << fileContent(run.told());
  const double kept = toSeconds(run.kept()->time);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  send("/stadion/pause", 1);
  send("/stadion/black", 1);
  ASSERT_TRUE(becomes([&] { return run.hasTold("black on"); })) << fileContent(run.told());
  const auto at = secondsAfter(fileContent(run.told()), "paused at ");
  ASSERT_TRUE(at) << fileContent(run.told());
  EXPECT_GT(*at, kept);
  const std::string paused = fmt::format("operator: paused at {:.3f} s", *at);
  for (int n = 1; n <= 2; ++n) {
    ASSERT_EQ(kill(run.player(), SIGKILL), 0);
    ASSERT_TRUE(becomes([&] { return timesTold("pictures again") == n; })) << fileContent(run.told());
    EXPECT_EQ(timesTold(paused), 1 + n) << fileContent(run.told());
    EXPECT_EQ(timesTold("black on"), 1 + n) << fileContent(run.told());
  }
  send("/stadion/pause", 0);
  EXPECT_TRUE(becomes([&] { return run.hasTold("operator: going on at"); }));
  EXPECT_TRUE(run.hasTold(fmt::format("operator: going on at {:.3f} s", *at))) << fileContent(run.told());
  ASSERT_EQ(kill(run.pid(), SIGTERM), 0);
  EXPECT_EQ(run.end(), 128 + SIGTERM) << fileContent(run.told());
}

TEST(ProgramSupervise, AJournalWhoseFolderIsGoneIsNoReasonForDarkWalls) {
  Supervised run({"--gl", "none", "--no-sound", "--input", "none"});
  ASSERT_TRUE(becomes([&] { return run.hasNoted("plays; nothing is drawn"); })) << fileContent(run.told());
  std::filesystem::remove_all(std::filesystem::path(run.journal()).parent_path());
  ASSERT_EQ(kill(run.player(), SIGKILL), 0);
  ASSERT_TRUE(becomes([&] { return run.hasTold("pictures again"); })) << fileContent(run.told());
  EXPECT_TRUE(run.hasTold("stadion: --journal: " + run.journal() +
                          ": cannot be written: No such file or directory; lines are lost, the show goes on"))
      << fileContent(run.told());
  std::filesystem::create_directory(std::filesystem::path(run.journal()).parent_path());
  ASSERT_EQ(kill(run.pid(), SIGTERM), 0);
  EXPECT_EQ(run.end(), 2) << fileContent(run.told());
  EXPECT_TRUE(run.hasNoted("lines before this one could not be written")) << fileContent(run.journal());
}

TEST(ProgramSupervise, TheOptionIsNotThePlayers) {
  const ProgramResult r =
      stadionProgram({"run", kKick, "--supervise", "--gl", "none", "--frames", "10", "--hang-after", "20"});
  EXPECT_EQ(r.status, 0) << r.err;
}

TEST(ProgramSupervise, ALiveShowEndsWithItsSupervisor) {
  Supervised run({"--walls", "desktop", "--size", "32x24", "--look", "plain", "--input", "none"});
  ASSERT_TRUE(becomes([&] { return run.hasNoted("the first picture"); })) << fileContent(run.told());
  const pid_t first = run.player();
  // Before a scene was saved: the show restarts, and catches up.
  ASSERT_EQ(kill(first, SIGKILL), 0);
  ASSERT_TRUE(becomes([&] { return run.hasTold("pictures again"); })) << fileContent(run.told());
  EXPECT_TRUE(run.hasTold("restarts, and catches up to")) << fileContent(run.told());
  const pid_t second = run.player();
  ASSERT_EQ(kill(run.pid(), SIGTERM), 0);
  EXPECT_EQ(run.end(), 128 + SIGTERM) << fileContent(run.told());
  EXPECT_NE(kill(second, 0), 0) << "the player is gone, too";
  const Json said = Json::parse(fileContent(run.said()));
  EXPECT_EQ(said["stopped"], "SIGTERM");
  EXPECT_NE(said["remarks"].dump().find("replaced once;"), std::string::npos) << said["remarks"];
}

TEST(ProgramSupervise, APlayerDoesNotOutliveItsSupervisor) {
  Supervised run({"--walls", "desktop", "--size", "32x24", "--look", "plain", "--input", "none"});
  ASSERT_TRUE(becomes([&] { return run.hasNoted("the first picture"); })) << fileContent(run.told());
  const pid_t player = run.player();
  ASSERT_GT(player, 0);
  ASSERT_EQ(kill(run.pid(), SIGKILL), 0);
  EXPECT_EQ(run.end(), 128 + SIGKILL);
  EXPECT_TRUE(becomes([&] { return run.hasNoted("ended with exit code 143"); }))
      << fileContent(run.journal());
}

TEST(ProgramSupervise, OutputWithoutAReaderIsNoEnd) {
  const TestFolder folder;
  const std::string journal = folder.path() / "run.log";
  // The reader of its messages is gone at once; the watcher and the player say something all the same.
  const pid_t watcher = startProgram({{"bash",        "-c",        "exec \"$0\" \"$@\" 2> >(exec true)",
                                       stadionPath(), "run",       kKick,
                                       "--supervise", "--journal", journal,
                                       "--walls",     "desktop",   "--size",
                                       "32x24",       "--look",    "plain",
                                       "--input",     "none",      "--rate",
                                       "60",          "--seconds", "6",
                                       "--pace",      "lock"}},
                                     folder.path() / "said", folder.path() / "told");
  const auto noted = [&](const std::string& what) {
    return becomes([&] { return fileContent(journal).find(what) != std::string::npos; });
  };
  ASSERT_TRUE(noted("the first picture")) << fileContent(journal);
  std::istringstream children(procText(watcher, "task/" + std::to_string(watcher) + "/children"));
  for (pid_t child = 0; children >> child;) kill(child, SIGKILL);
  EXPECT_TRUE(noted("was ended by signal 9 (Killed)")) << fileContent(journal);
  EXPECT_TRUE(noted("pictures again")) << fileContent(journal);
  int status = -1;
  waitpid(watcher, &status, 0);
  EXPECT_EQ(status, 0) << fileContent(journal);
}

TEST(ProgramSupervise, APlayerWhoseWatcherDiedBeforeItCouldAskToBeToldEndsToo) {
  Supervised run({"--gl", "none", "--input", "none"});
  pid_t player = 0;
  while (player == 0) player = run.player();
  ASSERT_EQ(kill(player, SIGSTOP), 0);  // it has hardly begun
  ASSERT_EQ(kill(run.pid(), SIGKILL), 0);
  EXPECT_EQ(run.end(), 128 + SIGKILL);
  ASSERT_EQ(kill(player, SIGCONT), 0);
  EXPECT_TRUE(becomes([&] { return !procRuns(player); }));
  if (procRuns(player)) kill(player, SIGKILL);
}

TEST(ProgramSupervise, WhatIsWrongWithTheShowIsNoReasonToTryAgain) {
  const ProgramResult none = stadionProgram({"run", "/nowhere/show.evs", "--supervise", "--seconds", "1"});
  EXPECT_EQ(none.status, 2) << none.err;
  EXPECT_EQ(none.err.find("supervise: "), std::string::npos) << none.err;
}

TEST(ProgramSupervise, WhatBelongsToOneProcessIsRefused) {
  const TestFolder folder;
  const auto refused = [&](std::vector<std::string> more, const std::string& why) {
    std::vector<std::string> words{"run", kKick, "--supervise", "--seconds", "1"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult r = stadionProgram(words);
    EXPECT_EQ(r.status, 2) << why;
    EXPECT_NE(r.err.find(why), std::string::npos) << r.err;
  };
  refused({"--out", folder.path() / "out"}, "--out and --supervise");
  refused({"--record-input", folder.path() / "visit.input"}, "--record-input and --supervise");
  refused({"--profile"}, "what is measured is one process's");
  const ProgramResult unwatched = stadionProgram({"run", kKick, "--hang-after", "2", "--seconds", "1"});
  EXPECT_EQ(unwatched.status, 2);
  EXPECT_NE(unwatched.err.find("needs --supervise"), std::string::npos) << unwatched.err;
  const ProgramResult alone = stadionProgram({"run", kKick, "--supervised", "2", "--seconds", "1"});
  EXPECT_EQ(alone.status, 2);
  EXPECT_NE(alone.err.find("is for players that"), std::string::npos) << alone.err;
}

}  // namespace
}  // namespace stadion
