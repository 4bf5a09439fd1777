/// `stadion bench plan`: rooms, and walls that processes draw.

#include "tests/programs/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

TEST(ProgramBenchPlan, ARoomWithFewerWallsIsToldBeforeAnythingIsPlayed) {
  const ProgramResult r = stadionProgram({"bench", "plan", "--walls", "powerwall", "--counts", "1,9"});
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("--counts 9: powerwall has 1 wall;"), std::string::npos) << r.err;
  EXPECT_EQ(r.out, "");
}

// It measures processes for as long as many tests take.
TEST(ProgramFullBenchPlan, AHallIsPlayedByAProcessForEachProjector) {
  const ProgramResult r =
      stadionProgram({"bench", "plan", testShow("moving.evs"), "--walls", "cylinder-180", "--processes",
                      "--rounds", "1", "--frames", "12", "--size", "16x12", "--within", "1000", "--json"});
  ASSERT_EQ(r.status, 0) << r.err;
  const auto line = nlohmann::json::parse(r.out);
  EXPECT_EQ(line["room"], "cylinder-180");
  EXPECT_EQ(line["walls"], 3);
  EXPECT_EQ(line["processes"], true);
  EXPECT_GT(line["measured_ms"], 0);
}

}  // namespace
}  // namespace stadion
