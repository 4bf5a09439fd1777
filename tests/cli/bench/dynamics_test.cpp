/// `stadion bench dynamics`, on Stadion alone or beside what other engines are built.

#include "tests/programs/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>

namespace stadion {
namespace {

namespace fs = std::filesystem;

std::vector<nlohmann::json> linesOf(const std::string& text) {
  std::vector<nlohmann::json> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

TEST(ProgramBenchDynamics, PrintsOneObjectALineWithStadionFirst) {
  // A case without a limit on cost: whether others are there changes nothing.
  const ProgramResult r = stadionProgram({"bench", "dynamics", "C13_far", "--rounds", "1", "--json"});
  EXPECT_EQ(r.status, 0) << r.err;
  const auto lines = linesOf(r.out);
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines[0]["engine"], "stadion");
  EXPECT_EQ(lines[0]["n"], 1);
  for (const auto& line : lines) {
    EXPECT_EQ(line["case"], "C13_far");
    EXPECT_GT(line["ns_per_body_frame"].get<double>(), 0);
    EXPECT_TRUE(line["m"].contains("err"));
  }
  EXPECT_LE(lines[0]["m"]["err"].get<double>(), 1e-8);
}

TEST(ProgramBenchDynamics, WritesPlotsAndResults) {
  const TestFolder folder;
  const std::string out = folder.path() / "out";
  const ProgramResult r =
      stadionProgram({"bench", "dynamics", "C13_far", "C13_nan", "--rounds", "1", "--out", out});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.out.find("limits met, 0 missed"), std::string::npos) << r.out;
  const auto results = nlohmann::json::parse(fileContent(out + "/results.json"));
  ASSERT_EQ(results.size(), 2u);
  EXPECT_EQ(results[0]["case"], "C13_far");
  EXPECT_EQ(results[0]["limits"][0]["verdict"], "met");
  EXPECT_TRUE(fileContent(out + "/C13_far.svg").starts_with("<svg "));
}

TEST(ProgramBenchDynamics, ACaseThatIsNoneIsToldBeforeAnythingRuns) {
  const ProgramResult r = stadionProgram({"bench", "dynamics", "C13_fat"});
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("there is no case \"C13_fat\""), std::string::npos) << r.err;
  EXPECT_EQ(r.out, "");
}

}  // namespace
}  // namespace stadion
