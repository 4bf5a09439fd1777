/// Overlapping the stages changes nothing that anybody can see: the same pictures, byte for byte, and the
/// same state in every frame, whatever the number of walls.

#include "bench/grid_show.h"
#include "bench/walls/wall_files.h"
#include "tests/programs/program.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace stadion {
namespace {

namespace fs = std::filesystem;

std::string frames() {
  return fullRuns() ? "300" : "60";
}

/// The more walls the fewer frames, so that all take alike long.
std::string framesOn(const std::string& walls) {
  return fullRuns() || walls == "desktop" ? frames() : walls == "cave4" ? "24" : "16";
}

std::vector<std::string> playing(const std::string& mode, const std::string& walls,
                                 const std::string& frames) {
  return {testShow("moving.evs"),
          "--asset-root",
          assetFolder(),
          "--walls",
          walls,
          "--mode",
          mode,
          "--size",
          "64x48",
          "--frames",
          frames};
}

/// By name.
std::map<std::string, std::string> pictureFilesIn(const std::string& folder) {
  std::map<std::string, std::string> pictures;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".png") pictures[entry.path().filename()] = fileContent(entry.path());
  return pictures;
}

/// Plays the show and returns every picture file by name.
std::map<std::string, std::string> picturesOf(const std::string& mode, const std::string& walls,
                                              const std::string& look) {
  const TestFolder folder;
  std::vector<std::string> words = playing(mode, walls, framesOn(walls));
  words.insert(words.begin(), "run");
  words.insert(words.end(), {"--look", look});
  for (const char* w : {"--pictures", "all", "--json", "--out"}) words.push_back(w);
  words.push_back(folder.path());
  const ProgramResult r = stadionProgram(words);
  EXPECT_EQ(r.status, 0) << r.err;
  return pictureFilesIn(folder.path());
}

std::string hashesOf(const std::string& mode, const std::string& walls) {
  std::vector<std::string> words = playing(mode, walls, frames());
  words.insert(words.begin(), "hash");
  const ProgramResult r = stadionProgram(words);
  EXPECT_EQ(r.status, 0) << r.err;
  return r.out;
}

/// Nothing, or which files are not the same in both: how many, the first and the last by name.
std::string differences(const std::map<std::string, std::string>& a,
                        const std::map<std::string, std::string>& b) {
  std::vector<std::string> names;
  for (const auto& [name, bytes] : a)
    if (const auto other = b.find(name); other == b.end() || other->second != bytes) names.push_back(name);
  if (names.empty()) return a.size() == b.size() ? "" : "number of files";
  return std::to_string(names.size()) + " files, from " + names.front() + " to " + names.back();
}

/// Returns the pictures.
std::map<std::string, std::string> expectSamePictures(const std::string& walls, std::size_t count,
                                                      const std::string& look) {
  const auto sequential = picturesOf("sequential", walls, look),
             pipelined = picturesOf("pipelined", walls, look);
  // Two eyes a wall and one contact sheet of the last frame.
  EXPECT_EQ(sequential.size(), 2 * count * std::stoul(framesOn(walls)) + 1);
  EXPECT_EQ(differences(sequential, pipelined), "");
  return pipelined;
}

TEST(ProgramSamePictures, OneWallSequentialAndPipelinedWithEveryFrameAnother) {
  const auto pictures = expectSamePictures("desktop", 1, "full");
  std::map<std::string, int> seen;
  for (const auto& [name, bytes] : pictures) ++seen[bytes];
  EXPECT_EQ(seen.size(), pictures.size()) << "the show moves in every frame";
}
TEST(ProgramSamePictures, FourWallsSequentialAndPipelined) {
  expectSamePictures("cave4", 4, "plain");
}
TEST(ProgramFullSamePictures, FourWallsSequentialAndPipelinedInTheFullLook) {
  expectSamePictures("cave4", 4, "full");
}
TEST(ProgramFullSamePictures, SixWallsSequentialAndPipelined) {
  expectSamePictures("cave6", 6, "full");
}

TEST(ProgramSameState, EveryFrameHasOneHashWhateverTheModeAndTheWalls) {
  const std::string expected = hashesOf("sequential", "cave4");
  EXPECT_EQ(std::count(expected.begin(), expected.end(), '\n'), std::stol(frames()));
  for (const char* walls : {"desktop", "cave4", "cave6"})
    for (const char* mode : {"sequential", "pipelined"})
      EXPECT_EQ(hashesOf(mode, walls), expected) << mode << walls;
}

/// In every mode and with threads and processes: the hash of each frame, and that of a run's last frame.
void expectSameState(const std::vector<std::string>& show) {
  const auto with = [&](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), show.begin(), show.end());
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult r = stadionProgram(words);
    EXPECT_EQ(r.status, 0) << r.err;
    return r.out;
  };
  const std::string all = with({"hash"}, {"--mode", "sequential"});
  EXPECT_EQ(with({"hash"}, {"--mode", "pipelined"}), all);
  const std::string last = all.substr(all.size() - 17, 16);
  const std::vector<std::vector<std::string>> ways{{"--mode", "sequential"},
                                                   {"--mode", "pipelined", "--wall-workers", "thread"},
                                                   {"--mode", "pipelined", "--wall-workers", "process"}};
  for (const auto& way : ways) {
    const auto summary = nlohmann::json::parse(
        with({"run", "--json", "--size", "32x24", "--look", "plain", "--pictures", "none"}, way));
    EXPECT_EQ(summary.at("state_hash"), last) << way.back();
  }
}

/// In every mode and with threads and processes: the same files, byte for byte.
void expectSamePicturesInEveryMode(const std::vector<std::string>& show) {
  const std::vector<std::vector<std::string>> ways{{"--mode", "sequential"},
                                                   {"--mode", "pipelined", "--wall-workers", "thread"},
                                                   {"--mode", "pipelined", "--wall-workers", "process"}};
  std::map<std::string, std::string> expected;
  for (const auto& way : ways) {
    const TestFolder folder;
    std::vector<std::string> words{"run", "--json", "--pictures", "2", "--out", folder.path()};
    words.insert(words.end(), show.begin(), show.end());
    words.insert(words.end(), way.begin(), way.end());
    const ProgramResult r = stadionProgram(words);
    ASSERT_EQ(r.status, 0) << r.err;
    const auto pictures = pictureFilesIn(folder.path());
    if (expected.empty()) expected = pictures;
    EXPECT_GT(pictures.size(), 4U) << "two frames of two eyes at least, and a sheet";
    EXPECT_EQ(differences(expected, pictures), "") << show[0] << " " << way.back();
  }
}

TEST(ProgramFullSamePictures, OfTheBenchsScenesInEveryMode) {
  for (const char name : {'a', 'b', 'c'}) {
    const TestFolder folder;
    bench::WallScene scene;
    scene.letter = name;
    ASSERT_EQ(bench::writeWallScene(folder.path().string(), scene, 4, true, 12), "");
    const std::string at = folder.path().string();
    expectSamePicturesInEveryMode({at + "/show.evs", "--walls", at + "/room.walls", "--input",
                                   at + "/show.input", "--frames", "4", "--look", "plain", "--size",
                                   "200x150"});
  }
}

void expectSamePicturesOf(const char* script, const char* frames, const std::string& walls) {
  for (const char* look : {"full", "plain"})
    expectSamePicturesInEveryMode({std::string(STADION_SOURCE_DIR) + "/scripts/" + script, "--frames", frames,
                                   "--look", look, "--size", "64x48", "--walls", walls});
}

TEST(ProgramSamePictures, OfAShowInEveryMode) {
  expectSamePicturesOf("kick.evs", "5", STADION_SOURCE_DIR "/scripts/suites/two.walls");
}

TEST(ProgramFullSamePictures, OfShowsOnFourWallsInEveryMode) {
  expectSamePicturesOf("kick.evs", "5", "cave4");
  expectSamePicturesOf("olympia.evs", "3", "cave4");
}

/// Ten thousand nodes.
void expectSamePicturesOfAGrid(const char* walls) {
  const TestFolder folder;
  const std::string script = folder.write("grid.evs", gridScript());
  for (const char* look : {"full", "plain"})
    expectSamePicturesInEveryMode({script, "--asset-root", std::string(STADION_SOURCE_DIR) + "/scripts",
                                   "--frames", "4", "--look", look, "--size", "64x48", "--walls", walls});
}

TEST(ProgramSamePictures, OfAGridOfTenThousandInEveryMode) {
  expectSamePicturesOfAGrid("desktop");
}

TEST(ProgramFullSamePictures, OfAGridOfTenThousandOnFourWallsInEveryMode) {
  expectSamePicturesOfAGrid("cave4");
}

TEST(ProgramSameState, OfACrowdOfPathsAndBallsInEveryMode) {
  expectSameState(
      {std::string(STADION_SOURCE_DIR) + "/scripts/crowd.evs", "--walls", "cave4", "--frames", frames()});
}

TEST(ProgramSameState, OfHundredsThatSwayInEveryMode) {
  const TestFolder folder;
  bench::WallScene scene{'b', 1000};
  ASSERT_EQ(bench::writeWallScene(folder.path().string(), scene, 4, true, 62), "");
  expectSameState({folder.path().string() + "/show.evs", "--walls", folder.path().string() + "/room.walls",
                   "--input", folder.path().string() + "/show.input", "--frames", "60"});
}

TEST(ProgramSameState, RunAndHashAgreeOnTheLastFrame) {
  std::vector<std::string> words = playing("pipelined", "desktop", frames());
  words.insert(words.begin(), "run");
  words.insert(words.end(), {"--json", "--look", "plain"});
  const ProgramResult r = stadionProgram(words);
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string hash = nlohmann::json::parse(r.out).at("state_hash");
  const std::string all = hashesOf("sequential", "desktop");
  const std::string last = std::to_string(std::stoul(frames()) - 1) + " ";
  EXPECT_EQ(all.substr(all.rfind("\n", all.size() - 2) + 1), last + hash + "\n");
}

}  // namespace
}  // namespace stadion
