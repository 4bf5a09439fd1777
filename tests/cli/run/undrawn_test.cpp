/// Runs without a rasteriser, and hashes of runs without a folder.

#include "tests/programs/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <regex>
#include <set>

namespace stadion {
namespace {

const std::string kKickScript = STADION_SOURCE_DIR "/scripts/kick.evs";

TEST(ProgramUndrawn, ATrackNeedsNoRasteriser) {
  const TestFolder folder;
  const auto run = [&](const std::string& out, std::vector<std::string> more) {
    more.insert(more.begin(), {"run", kKickScript, "--frames", "30", "--walls", "desktop", "--size", "32x24",
                               "--look", "plain", "--track", "ball", "--out", folder.path() / out});
    return stadionProgram(more);
  };
  const ProgramResult undrawn = run("undrawn", {"--gl", "none", "--pictures", "none"});
  ASSERT_EQ(undrawn.status, 0) << undrawn.err;
  const ProgramResult drawn = run("drawn", {});
  ASSERT_EQ(drawn.status, 0) << drawn.err;
  const std::string track = fileContent(folder.path() / "undrawn/track-ball.csv");
  EXPECT_EQ(std::ranges::count(track, '\n'), 31) << track;
  EXPECT_EQ(track, fileContent(folder.path() / "drawn/track-ball.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "undrawn/contact-sheet.png"));

  const ProgramResult byDefault = run("default", {"--gl", "none"});
  EXPECT_EQ(byDefault.status, 0) << byDefault.err;
  EXPECT_EQ(track, fileContent(folder.path() / "default/track-ball.csv"));
  const ProgramResult refused = run("refused", {"--gl", "none", "--pictures", "last"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("that --pictures could keep"), std::string::npos) << refused.err;
  for (const char* option : {"--hashes", "--video", "--sheets"}) {
    const ProgramResult r = run("refused", {"--gl", "none", "--pictures", "none", option});
    EXPECT_EQ(r.status, 2) << option;
    EXPECT_NE(r.err.find(std::string(option) + " needs pictures"), std::string::npos) << r.err;
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "refused"));
}

std::vector<std::string> hashedRun(std::vector<std::string> more) {
  more.insert(more.begin(), {stadionPath(), "run", kKickScript, "--walls", "powerwall", "--size", "32x24",
                             "--look", "plain", "--no-sound", "--hashes"});
  return more;
}

TEST(ProgramUndrawn, HashesWithoutAFolderAreLinesOnStdout) {
  const TestFolder folder;
  const ProgramResult lines = runProgram({hashedRun({"--frames", "12"})});
  ASSERT_EQ(lines.status, 0) << lines.err;
  ASSERT_EQ(
      runProgram({hashedRun({"--frames", "12", "--out", folder.path() / "o", "--pictures", "none"})}).status,
      0);
  EXPECT_EQ(lines.out, fileContent(folder.path() / "o/picture-hashes.txt"));
  EXPECT_NE(lines.err.find("frames"), std::string::npos) << "the summary is on stderr";

  const ProgramResult asJson = runProgram({hashedRun({"--frames", "12", "--json"})});
  EXPECT_TRUE(nlohmann::json::accept(asJson.out)) << asJson.out;
  EXPECT_NE(asJson.err.find(lines.out.substr(0, lines.out.find('\n'))), std::string::npos) << asJson.err;
}

TEST(ProgramUndrawn, ALiveRunTellsWhatItsWallsShowed) {
  const ProgramResult whole = runProgram({hashedRun({"--frames", "240"})});
  ASSERT_EQ(whole.status, 0) << whole.err;
  ProgramRun live;
  live.words = hashedRun({"--rate", "60", "--pace", "lock"});
  live.signal = SIGINT;
  live.signalWhen = [](const std::string& out, const std::string&) {
    return std::ranges::count(out, '\n') > 20;
  };
  const ProgramResult r = runProgram(live);
  EXPECT_EQ(r.status, 130) << r.err;
  std::istringstream shown(r.out);
  std::set<std::string> known;
  std::istringstream all(whole.out);
  for (std::string line; std::getline(all, line);) known.insert(line);
  std::size_t found = 0;
  for (std::string line; std::getline(shown, line); ++found) {
    EXPECT_TRUE(std::regex_match(line, std::regex("[0-9]+ screen (left|right) [0-9a-f]{16}"))) << line;
    if (std::stoi(line) < 240 && found < 20) {
      EXPECT_TRUE(known.contains(line)) << line;
    }
  }
  EXPECT_GE(found, 20U);
}

}  // namespace
}  // namespace stadion
