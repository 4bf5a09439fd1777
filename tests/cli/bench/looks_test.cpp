/// `stadion bench looks`: the rungs of the ladder of pictures on a scene of a show.

#include "tests/programs/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <sstream>

namespace stadion {
namespace {

std::map<std::string, nlohmann::json> rowsByRung(const std::string& out) {
  std::map<std::string, nlohmann::json> rows;
  std::istringstream lines(out);
  for (std::string line; std::getline(lines, line);) {
    const auto row = nlohmann::json::parse(line);
    EXPECT_EQ(row["bench"], "looks");
    if (row.contains("rung") && row["wall"] == "front") rows[row["rung"]] = row;
  }
  return rows;
}

TEST(ProgramBenchLooks, MoreSamplesAreNearerToTheReference) {
  const ProgramResult r =
      stadionProgram({"bench", "looks", "--scenes", "kick", "--rungs", "8,4,1,opengl", "--size", "160x120",
                      "--rounds", "1", "--frames", "2", "--no-perception", "--json"});
  ASSERT_LE(r.status, 1) << r.err;  // 1: a limit is missed, for example that of a cost
  auto rows = rowsByRung(r.out);
  ASSERT_EQ(rows.size(), 4u) << r.out;
  for (const auto& [rung, row] : rows) {
    EXPECT_EQ(row["scene"], "kick");
    EXPECT_GT(row["ms"].get<double>(), 0) << rung;
    EXPECT_GE(row["ms"], row["ms_least"]) << rung;
    EXPECT_GT(row["flicker"].get<double>(), 0) << rung;
    EXPECT_GE(row["max"], row["p99"]) << rung;
    EXPECT_TRUE(row["butteraugli"].is_null());
  }
  EXPECT_LT(rows["8"]["mean"], rows["4"]["mean"]);
  EXPECT_LT(rows["4"]["mean"], rows["1"]["mean"]);
  EXPECT_LT(rows["opengl"]["mean"].get<double>(), 3) << "OpenGL draws the same picture";
}

TEST(ProgramBenchLooks, WritesPlotAndPictures) {
  const TestFolder folder;
  const std::string out = folder.path() / "out";
  const ProgramResult r =
      stadionProgram({"bench", "looks", "--scenes", "crowd", "--rungs", "4", "--size", "80x60", "--rounds",
                      "1", "--frames", "1", "--no-perception", "--out", out});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(fileContent(out + "/looks.svg").starts_with("<svg "));
  for (const char* name : {"reference", "4", "side-by-side"})
    EXPECT_TRUE(std::filesystem::exists(out + "/crowd-front-" + name + ".png")) << name;
}

}  // namespace
}  // namespace stadion
