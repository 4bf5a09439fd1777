/// A hall of 64 views: run, profile and wall processes show and report all of them.

#include "tests/programs/program.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace stadion {
namespace {

using nlohmann::json;

/// Walls in a ring about the visitor, seen from inside.
std::string ringOf(std::size_t count) {
  std::ostringstream text;
  const auto corner = [&](std::size_t i) {
    const double turn = 2 * 3.14159265358979 * static_cast<double>(i) / static_cast<double>(count);
    return std::to_string(5 * std::sin(turn)) + " " + std::to_string(5 * std::cos(turn));
  };
  for (std::size_t i = 0; i < count; ++i)
    text << "wall w" << i << "  lower-left " << corner(i) << " 0  lower-right " << corner(i + 1)
         << " 0  upper-left " << corner(i) << " 3\n";
  return text.str();
}

/// Plays a few frames of small pictures on the walls of the file.
ProgramResult played(const std::string& how, const std::string& walls, const std::vector<std::string>& more) {
  std::vector<std::string> words{how,
                                 testShow("moving.evs"),
                                 "--asset-root",
                                 assetFolder(),
                                 "--walls",
                                 walls,
                                 "--size",
                                 "16x12",
                                 "--frames",
                                 "2",
                                 "--look",
                                 "plain",
                                 "--json"};
  words.insert(words.end(), more.begin(), more.end());
  return stadionProgram(words);
}

/// The hash of the last picture of each view.
std::map<std::string, std::string> hashesOf(const ProgramResult& run) {
  std::map<std::string, std::string> hashes;
  if (run.status != 0) return hashes;
  const json summary = json::parse(run.out);
  for (const json& picture : summary.at("image_hashes"))
    hashes[picture["wall"].get<std::string>() + " " + picture["eye"].get<std::string>()] = picture["hash"];
  return hashes;
}

/// 32 walls with two eyes. Opening a wall is what takes most of the time.
class ManyStereoViews {
public:
  std::map<std::string, std::string> hashes(const std::vector<std::string>& how) {
    std::vector<std::string> words = how;
    words.insert(words.end(), {"--out", folder_.path() / "pictures"});
    const ProgramResult run = played("run", walls_, words);
    EXPECT_EQ(run.status, 0) << run.err;
    return hashesOf(run);
  }

private:
  TestFolder folder_;
  std::string walls_ = folder_.write("hall.walls", ringOf(32));
};

TEST(ProgramManyViews, AreTheSameInBothModes) {
  ManyStereoViews views;
  const auto hashes = views.hashes({"--mode", "sequential"});
  EXPECT_EQ(hashes.size(), 64U);
  std::set<std::string> different;
  for (const auto& [view, hash] : hashes) different.insert(hash);
  EXPECT_GT(different.size(), 8U) << "the show is to be seen";
  EXPECT_EQ(views.hashes({"--mode", "pipelined"}), hashes);
}

TEST(ProgramFullManyViews, AreTheSameFromWallProcesses) {
  ManyStereoViews views;
  EXPECT_EQ(views.hashes({"--wall-workers", "process"}), views.hashes({"--mode", "sequential"}));
}

TEST(ProgramFullManyViews, OfMonoWallsAreProfiledOneByOne) {
  const TestFolder folder;
  const std::string walls = folder.write("hall.walls", ringOf(64));
  const ProgramResult profile = played("profile", walls, {"--stereo", "off", "--out", folder.path()});
  ASSERT_EQ(profile.status, 0) << profile.err;
  EXPECT_EQ(json::parse(profile.out)["walls"].size(), 64U);
  const std::string page = fileContent(folder.path() / "profile.html");
  for (const char* last : {"Cull w63", "Draw w63"}) EXPECT_TRUE(has(page, last)) << last;
}

}  // namespace
}  // namespace stadion
