/// The show "Ancient Olympia" with its recorded visit, as anybody would start it.

#include "tests/cli/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

std::string olympia() {
  return std::filesystem::path(assetFolder()).parent_path() / "scripts/olympia.evs";
}

TEST(Olympia, TheRecordedVisitEndsTheSameInBothModesAndReportsAllThrows) {
  const TemporaryFolder folder;
  const ProgramResult played =
      stadionProgram({"run", olympia(), "--walls", "cave4", "--size", "64x48", "--out", folder.path()});
  ASSERT_EQ(played.status, 0) << played.err;
  const auto summary = nlohmann::json::parse(fileContent(folder.path() / "summary.json"));

  // Discus, javelin, ball: the visitor's throw, then the athlete's.
  const auto& throws = summary.at("measured");
  ASSERT_EQ(throws.size(), 6u);
  constexpr double kMetres[] = {56.12, 52.68, 59.55, 63.69, 10.58, 30.48};  // as scripts/README.md says
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(throws[i].at("node"), i % 2 == 0 ? "tape" : "rivals_tape");
    EXPECT_NEAR(throws[i].at("metres"), kMetres[i], 0.01);
  }

  const ProgramResult hashed =
      stadionProgram({"hash", olympia(), "--walls", "desktop", "--mode", "sequential", "--app-threads", "1"});
  ASSERT_EQ(hashed.status, 0) << hashed.err;
  const std::size_t last = hashed.out.rfind("5400 ");
  ASSERT_NE(last, hashed.out.npos);
  EXPECT_NE(played.out.find("state hash of frame 5400: " + hashed.out.substr(last + 5, 16)), played.out.npos);
}

TEST(Olympia, IsFoundRightByCheck) {
  const ProgramResult checked = stadionProgram({"check", olympia()});
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_EQ(checked.err.find("warning"), checked.err.npos) << checked.err;
}

TEST(Olympia, APartOfTheShowIsCheckedInIt) {
  const auto part = [](const char* name) {
    return (std::filesystem::path(olympia()).parent_path() / "olympia" / name).string();
  };
  // Its names are of the show around it; an athlete is a part of a part.
  for (const char* name : {"game_discus.evs", "athlete_discus.evs"}) {
    const ProgramResult checked = stadionProgram({"check", part(name)});
    EXPECT_EQ(checked.status, 0) << checked.out;
    EXPECT_NE(checked.out.find(": ok, as a part of "), checked.out.npos) << checked.out;
    EXPECT_NE(checked.out.find("olympia.evs"), checked.out.npos) << checked.out;
  }
}

}  // namespace
}  // namespace stadion
