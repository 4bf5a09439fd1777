/// `stadion plan`: measured here, planned for elsewhere.

#include "tests/cli/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

const std::string kKick = STADION_SOURCE_DIR "/scripts/kick.evs";

TEST(ProgramPlan, TellsEveryNumberOfWallsInBothModes) {
  const TemporaryFolder folder;
  const std::string svg = folder.path() / "plan.svg";
  const ProgramResult r = stadionProgram(
      {"plan", kKick, "--walls", "3", "--frames", "12", "--size", "64x48", "--json", "--svg", svg});
  ASSERT_EQ(r.status, 0) << r.err;
  const auto plan = nlohmann::json::parse(r.out);
  EXPECT_EQ(plan.at("table").size(), 6U);
  EXPECT_EQ(plan.at("costs").at("walls").size(), 3U);
  EXPECT_EQ(plan.at("costs").at("frames").size(), 12U);
  EXPECT_GT(plan.at("forecast").at("frames_per_second"), 0);
  EXPECT_FALSE(plan.at("forecast").at("bottleneck").get<std::string>().empty());
  for (const auto& frame : plan.at("costs").at("frames"))
    for (const auto& wall : frame.at("walls")) EXPECT_EQ(wall.at("pictures").size(), 2U);
  EXPECT_NE(fileContent(svg).find("</svg>"), std::string::npos);

  // The same costs once more, on a larger machine.
  const std::string costs = folder.write("costs.json", r.out);
  const ProgramResult again = stadionProgram({"plan", "--from", costs, "--cores", "64", "--walls", "6"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.out.find("6 walls, 64 cores"), std::string::npos) << again.out;
  EXPECT_NE(again.out.find("Draw 6"), std::string::npos);
}

TEST(ProgramPlan, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  const ProgramResult none = stadionProgram({"plan"});
  EXPECT_EQ(none.status, 2);
  const ProgramResult many = stadionProgram({"plan", kKick, "--walls", "99"});
  EXPECT_EQ(many.status, 2);
  EXPECT_NE(many.err.find("from 1 to 24"), std::string::npos) << many.err;
  const ProgramResult wrong = stadionProgram({"plan", "--from", folder.write("costs.json", "{}")});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("has no \"format\""), std::string::npos) << wrong.err;
}

}  // namespace
}  // namespace stadion
