/// The same script and input give the same scene, whatever plays them.

#include "tests/programs/played_cluster.h"

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <map>
#include <random>
#include <span>
#include <sstream>
#include <unistd.h>

namespace stadion {
namespace {

struct Show {
  const char* name;  ///< of tests/corpus/hashes/NAME.txt
  const char* script;
};
constexpr Show kShows[] = {{"kick", "scripts/kick.evs"},
                           {"olympia", "scripts/olympia.evs"},
                           {"crowd", "scripts/crowd.evs"},
                           {"bodies", "tests/corpus/shows/bodies.evs"},
                           {"moving", "tests/corpus/shows/moving.evs"},
                           {"paper_impacts", "tests/corpus/shows/paper_impacts.evs"}};

std::string pathOf(const Show& show) {
  return std::string(STADION_SOURCE_DIR "/") + show.script;
}

/// The environment in which the C library's mathematics uses neither FMA nor AVX2.
const std::string kPlainMaths = "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-AVX2_Usable,-FMA_Usable";

ProgramResult play(std::vector<std::string> words, std::vector<std::string> environment = {}) {
  words.insert(words.begin(), stadionPath());
  ProgramRun run{std::move(words), std::move(environment)};
  run.limit = std::chrono::minutes(9);
  return runProgram(run);
}

/// What `stadion hash` says, each so manyth frame.
std::string hashesOf(const Show& show, const std::string& frames, std::uint64_t each,
                     std::vector<std::string> more = {}, std::vector<std::string> environment = {}) {
  std::vector<std::string> words{"hash", pathOf(show), "--frames", frames};
  words.insert(words.end(), more.begin(), more.end());
  const ProgramResult r = play(std::move(words), std::move(environment));
  EXPECT_EQ(r.status, 0) << show.name << "\n" << r.err;
  std::istringstream in(r.out);
  std::string chosen;
  for (std::string line; std::getline(in, line);)
    if (std::stoull(line) % each == 0) chosen += line + "\n";
  return chosen;
}

// A change that is meant to move bodies elsewhere, or adds to a scene's state, changes these files:
//   stadion hash SHOW --frames 1001 | awk '$1 % 100 == 0' > tests/corpus/hashes/NAME.txt
TEST(ProgramDeterminism, ScenesAreThoseOfTheFilesThatAreKept) {
  for (const Show& show : kShows)
    EXPECT_EQ(hashesOf(show, "1001", 100),
              fileContent(std::string(STADION_SOURCE_DIR "/tests/corpus/hashes/") + show.name + ".txt"))
        << show.name;
}

TEST(ProgramDeterminism, ThreadsAndTheLibrarysVectorsChangeNothing) {
  const std::string frames = fullRuns() ? "600" : "300";
  for (const Show& show : kShows) {
    const std::string one = hashesOf(show, frames, 1, {"--app-threads", "1"});
    EXPECT_EQ(hashesOf(show, frames, 1, {"--app-threads", "3"}), one) << show.name;
    EXPECT_EQ(hashesOf(show, frames, 1, {}, {kPlainMaths}), one) << show.name;
  }
}

/// The history of all states, as `run` tells it.
std::string historyOf(const Show& show, const std::string& frames, const std::vector<std::string>& how,
                      std::vector<std::string> environment) {
  std::vector<std::string> words{"run",     pathOf(show), "--frames", frames,  "--size", "32x24",
                                 "--walls", "powerwall",  "--look",   "plain", "--json"};
  words.insert(words.end(), how.begin(), how.end());
  const ProgramResult r = play(std::move(words), std::move(environment));
  EXPECT_EQ(r.status, 0) << show.name << "\n" << r.err;
  if (r.status != 0) return {};
  return Json::parse(r.out)["history_hash"].get<std::string>();
}

/// Beside one reference, in which nothing is drawn, each axis by itself, then some corners of all of them. Of
/// all these ways each show is played in one of `share`, the next show in others.
void expectOneHistory(const std::string& frames, int corners, std::size_t share) {
  using Words = std::vector<std::string>;
  const std::vector<Words> modes{
      {"--gl", "none"}, {"--mode", "pipelined"}, {"--mode", "sequential"}, {"--wall-workers", "process"}};
  const std::vector<Words> threads{{"--app-threads", "1"}, {"--app-threads", "2"}, {"--app-threads", "5"}};
  const std::vector<Words> environments{{}, {kPlainMaths}, {"LP_NUM_THREADS=0"}};
  std::mt19937 random(20260711);
  const auto any = [&](const std::vector<Words>& of) { return of[random() % of.size()]; };
  std::vector<std::pair<Words, Words>> ways;
  for (const Words& mode : std::span(modes).subspan(1)) ways.emplace_back(mode, Words{});
  for (const Words& count : threads) ways.emplace_back(count, Words{});
  for (const Words& e : std::span(environments).subspan(1)) ways.emplace_back(Words{}, e);
  for (int i = 0; i < corners; ++i) {
    Words how = any(modes);
    const Words count = any(threads);
    how.insert(how.end(), count.begin(), count.end());
    ways.emplace_back(how, any(environments));
  }
  std::size_t first = 0;
  for (const Show& show : kShows) {
    const std::string reference = historyOf(show, frames, modes[0], {});
    ASSERT_FALSE(reference.empty());
    for (std::size_t i = first++ % share; i < ways.size(); i += share) {
      const auto& [how, environment] = ways[i];
      EXPECT_EQ(historyOf(show, frames, how, environment), reference)
          << fmt::format("{}, {} {}", show.name, fmt::join(how, " "), fmt::join(environment, " "));
    }
  }
}

/// Each machine of clusters of one to four has the history that one program has. Each show is played on one
/// of `share` clusters, the next show on others.
void expectOneHistoryOnMachines(const std::string& frames, std::size_t share) {
  const char* const clusters[] = {"node front front left right floor\n",
                                  "node front front left\nnode right right floor\n",
                                  "node front front left\nnode right right\nnode floor floor\n",
                                  "node front front\nnode left left\nnode right right\nnode floor floor\n"};
  std::size_t first = 0;
  for (const Show& show : kShows) {
    const std::string reference = historyOf(show, frames, {"--gl", "none"}, {});
    ASSERT_FALSE(reference.empty());
    for (std::size_t i = first++ % share; i < std::size(clusters); i += share) {
      const char* nodes = clusters[i];
      const TestFolder folder;
      const std::string file =
          folder.write("some.cluster", std::string("walls cave4\n") + nodes + "deadline 5\npartition h" +
                                           std::to_string(getpid()) + "\n");
      const ProgramResult r = play({"cluster", file, pathOf(show), "--frames", frames, "--size", "32x24",
                                    "--look", "plain", "--pictures", "none", "--out", folder.path() / "out"});
      ASSERT_EQ(r.status, 0) << show.name << "\n" << nodes << r.err;
      for (const auto& node : std::filesystem::directory_iterator(folder.path() / "out")) {
        if (!node.is_directory()) continue;
        EXPECT_EQ(summaryOf(node.path())["history_hash"], reference) << show.name << "\n"
                                                                     << nodes << node.path();
      }
    }
  }
}

TEST(ProgramDeterminism, MachinesOfAClusterHaveTheSameHistory) {
  expectOneHistoryOnMachines("120", 4);
}

TEST(ProgramFullDeterminism, TenThousandFramesHaveTheSameHistoryOnOneToFourMachines) {
  expectOneHistoryOnMachines("10000", 1);
}

TEST(ProgramDeterminism, EveryWayToPlayAShowHasTheSameHistory) {
  expectOneHistory("120", 2, 5);
}

TEST(ProgramFullDeterminism, TenThousandFramesHaveTheSameHistoryInEveryWay) {
  expectOneHistory("10000", 10, 1);
}

}  // namespace
}  // namespace stadion
