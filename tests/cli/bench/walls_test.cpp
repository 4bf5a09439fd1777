/// `stadion bench walls` as a user calls it: small rooms, wrong options.

#include "tests/programs/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

std::vector<std::string> one(std::vector<std::string> more) {
  std::vector<std::string> words{"bench", "walls",  "--one", "--wall-count", "1", "--width", "32", "--height",
                                 "24",    "--warm", "1",     "--frames",     "2"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(ProgramBenchWalls, EachSceneIsMeasuredInARowOfItsOwn) {
  for (const char* scene : {"a", "b", "c"}) {
    const ProgramResult r = stadionProgram(one({"--scene", scene, "--class", "SUBMIT", "--layout", "grid"}));
    ASSERT_EQ(r.status, 0) << r.err;
    const auto row = nlohmann::json::parse(r.out);
    EXPECT_EQ(row["engine"], "stadion");
    EXPECT_EQ(row["class"], "SUBMIT");
    EXPECT_EQ(row["scene"], scene);
    EXPECT_EQ(row["flat"], 0);
    EXPECT_EQ(row["walls"], 1);
    EXPECT_EQ(row["width"], 32);
    EXPECT_EQ(row["incomplete"], 0);
    for (const char* field :
         {"fps", "frame_ms_median", "frame_ms_p99", "latency_ms_median", "cull_ms_sum", "draw_ms_sum",
          "cpu_cores", "cpu_ms_per_frame", "memory_mb", "held_mb", "draws_per_frame"})
      EXPECT_GT(row[field].get<double>(), 0) << field;
    EXPECT_EQ(row["draws_per_view"].size(), 2u);
  }
}

TEST(ProgramBenchWalls, StrictDrawsEachVisibleNodeByItself) {
  const ProgramResult r = stadionProgram(one({"--scene", "a", "--mode", "sequential"}));
  ASSERT_EQ(r.status, 0) << r.err;
  const auto row = nlohmann::json::parse(r.out);
  EXPECT_NEAR(row["tris_per_frame"].get<double>(), 100 * row["draws_per_frame"].get<double>(), 1e-6);
}

TEST(ProgramBenchWalls, TheNumberOfNodesCanBeChosen) {
  const ProgramResult r =
      stadionProgram(one({"--scene", "c", "--scene-nodes", "2000", "--moving", "2", "--far", "75"}));
  ASSERT_EQ(r.status, 0) << r.err;
  const auto row = nlohmann::json::parse(r.out);
  EXPECT_LT(row["draws_per_view"][0].get<int>(), 1000);
  EXPECT_GT(row["draws_per_view"][0].get<int>(), 50);
}

TEST(ProgramBenchWalls, PicturesAreThoseOfTheFrameAfterTheLast) {
  const TestFolder folder;
  const std::string out = folder.path() / "out", prefix = out + "/picture";
  const ProgramResult r = stadionProgram(one({"--scene", "a", "--out", out}));
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(fileContent(out + "/rows.jsonl"), r.out);
  const std::string left = fileContent(prefix + "_front_L.ppm");
  EXPECT_TRUE(left.starts_with("P6\n32 24\n255\n"));
  EXPECT_EQ(left.size(), 13u + 3 * 32 * 24);
  EXPECT_NE(left, fileContent(prefix + "_front_R.ppm"));
}

TEST(ProgramBenchWalls, PicturesThatCannotBeWrittenAreToldOfBeforeAnythingIsMeasured) {
  const ProgramResult r = stadionProgram(one({"--scene", "a", "--out", "/proc/nowhere"}));
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("picture_front_L.ppm cannot be written"), std::string::npos) << r.err;
}

TEST(ProgramBenchWalls, TicksAreMeasuredWithoutAShow) {
  const ProgramResult r = stadionProgram({"bench", "walls", "--one", "--control", "--frames", "5"});
  ASSERT_EQ(r.status, 0) << r.err;
  const auto row = nlohmann::json::parse(r.out);
  EXPECT_EQ(row["engine"], "control");
  EXPECT_GT(row["frame_ms_median"].get<double>(), 0);
}

TEST(ProgramBenchWalls, WrongOptionsAreToldBeforeAnythingRuns) {
  const std::vector<std::vector<std::string>> wrong{{"--scenes", "d"},
                                                    {"--scenes", "a,x"},
                                                    {"--rounds", "0"},
                                                    {"--minutes", "nan"},
                                                    {"--scene", "a"},
                                                    {"--one", "--scene", "d"},
                                                    {"--one", "--wall-count", "7"},
                                                    {"--one", "--class", "strict"},
                                                    {"--one", "--scene-nodes", "0"},
                                                    {"--one", "--far", "0"},
                                                    {"--control"},
                                                    {"--scaling", "--scenes", "a"},
                                                    {"--one", "--scenes", "a"},
                                                    {"--one", "--rounds", "2"},
                                                    {"--one", "--minutes", "2"},
                                                    {"--one", "--scaling"},
                                                    {"--one", "--record", "rows"},
                                                    {"--one", "--control", "--scene", "a"},
                                                    {"--one", "--control", "--layout", "flat"},
                                                    {"--one", "--without", "unseen"},
                                                    {"--one", "--class", "STRICT", "--without", "small"},
                                                    {"--one", "--mode", "sequential", "--latency", "2"},
                                                    {"--one", "--scene-nodes", "4", "--moving", "9"}};
  for (std::vector<std::string> words : wrong) {
    words.insert(words.begin(), {"bench", "walls"});
    const ProgramResult r = stadionProgram(words);
    EXPECT_EQ(r.status, 2) << words.back() << r.err;
    EXPECT_EQ(r.out, "");
  }
}

TEST(ProgramBenchWalls, ARecordThatIsNoneIsNotWrittenOver) {
  const TestFolder folder;
  const std::string file = folder.write("letter.txt", "dear all,\nthis is no row\n");
  const ProgramResult r = stadionProgram({"bench", "walls", "--scenes", "a", "--record", file});
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("letter.txt:1"), std::string::npos) << r.err;
  EXPECT_EQ(fileContent(file), "dear all,\nthis is no row\n");
}

}  // namespace
}  // namespace stadion
