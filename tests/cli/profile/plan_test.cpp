/// `stadion plan`: measured here, planned for elsewhere.

#include "tests/programs/program.h"

#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

const std::string kKick = STADION_SOURCE_DIR "/scripts/kick.evs";

TEST(ProgramPlan, TellsEveryNumberOfWallsInBothModes) {
  const TestFolder folder;
  const std::string out = folder.path() / "plan";
  const ProgramResult r = stadionProgram(
      {"plan", kKick, "--wall-count", "3", "--frames", "12", "--size", "64x48", "--json", "--out", out});
  ASSERT_EQ(r.status, 0) << r.err;
  const auto plan = nlohmann::json::parse(r.out);
  EXPECT_EQ(plan.at("table").size(), 6U);
  EXPECT_EQ(plan.at("costs").at("walls").size(), 3U);
  EXPECT_EQ(plan.at("costs").at("frames").size(), 12U);
  EXPECT_GT(plan.at("forecast").at("frames_per_second"), 0);
  EXPECT_FALSE(plan.at("forecast").at("bottleneck").get<std::string>().empty());
  for (const auto& frame : plan.at("costs").at("frames"))
    for (const auto& wall : frame.at("walls")) EXPECT_EQ(wall.at("pictures").size(), 2U);
  EXPECT_NE(fileContent(out + "/plan.svg").find("</svg>"), std::string::npos);
  EXPECT_EQ(fileContent(out + "/plan.json"), r.out);

  // The same costs once more, on a larger machine.
  const ProgramResult again =
      stadionProgram({"plan", "--from", out + "/plan.json", "--cores", "64", "--wall-count", "6"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.out.find("6 walls, 64 cores"), std::string::npos) << again.out;
  EXPECT_NE(again.out.find("Draw 6"), std::string::npos);
}

TEST(ProgramPlan, SaysWhatIsWrong) {
  const TestFolder folder;
  const ProgramResult none = stadionProgram({"plan"});
  EXPECT_EQ(none.status, 2);
  const ProgramResult many = stadionProgram({"plan", kKick, "--wall-count", "257"});
  EXPECT_EQ(many.status, 2);
  EXPECT_NE(many.err.find("from 1 to 256"), std::string::npos) << many.err;
  const ProgramResult wrong = stadionProgram({"plan", "--from", folder.write("costs.json", "{}")});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("has no \"format\""), std::string::npos) << wrong.err;
  const ProgramResult nowhere = stadionProgram({"plan", kKick, "--out", "/proc/nowhere"});
  EXPECT_EQ(nowhere.status, 2);
  EXPECT_EQ(nowhere.out, "") << "before anything is measured";
  EXPECT_NE(nowhere.err.find("/proc/nowhere/plan.svg"), std::string::npos) << nowhere.err;
  const std::string free =
      R"({"format": "stadion-plan-costs 1", "show": "free", "size": "1x1", "eyes": 1, "walls": ["a"], "cores": 1,
          "raster_threads": 1, "waits_in_turn": false, "frames": [{"app": 0, "app_helpers": 0, "swap": 0,
          "walls": [{"cull": 0, "pictures": [[0, 0, 1]]}]}]})";
  const ProgramResult nothing = stadionProgram({"plan", "--from", folder.write("free.json", free)});
  EXPECT_EQ(nothing.status, 2) << nothing.out;
  EXPECT_NE(nothing.err.find("cost nothing"), std::string::npos) << nothing.err;

  auto costs = nlohmann::json::parse(free);
  costs["frames"][0]["swap"] = 2;
  EXPECT_EQ(stadionProgram({"plan", "--from", folder.write("swap.json", costs.dump())}).status, 0)
      << "what swaps costs something";
  costs["show"] = costs["size"] = costs["walls"][0] = "\033[2Jgone";
  const ProgramResult raw = stadionProgram({"plan", "--from", folder.write("raw.json", costs.dump())});
  EXPECT_EQ(raw.status, 0) << raw.err;
  EXPECT_EQ(raw.out.find('\033'), std::string::npos);
  EXPECT_NE(raw.out.find("?[2Jgone"), std::string::npos) << raw.out;
}

TEST(ProgramPlan, MeasuresTheLookThatIsAskedForAndSaysWhichItWas) {
  const TestFolder folder;
  const auto measured = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"plan", kKick,    "--wall-count", "1",     "--frames",
                                   "6",    "--size", "32x24",        "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult r = stadionProgram(words);
    EXPECT_EQ(r.status, 0) << r.err;
    return r.out;
  };
  const auto told = [&](const std::string& costs) {
    return stadionProgram({"plan", "--from", folder.write("costs.json", costs)});
  };
  const std::string plain = measured({"--look", "plain"});
  EXPECT_EQ(nlohmann::json::parse(plain).at("costs").at("look"), "plain");
  EXPECT_NE(told(plain).out.find("plain look"), std::string::npos);

  EXPECT_EQ(nlohmann::json::parse(plain).at("costs").at("renderer"), "cpu");
  EXPECT_EQ(nlohmann::json::parse(measured({"--gl", "osmesa"})).at("costs").at("renderer"), "gl");

  auto full = nlohmann::json::parse(measured({})).at("costs");
  EXPECT_EQ(full.at("look"), "full");
  full.erase("look");
  EXPECT_NE(told(full.dump()).out.find("full look"), std::string::npos) << "as older files were measured";
  full["look"] = "plian";
  EXPECT_NE(told(full.dump()).err.find("\"look\" is \"plian\", neither full nor plain"), std::string::npos);
}

TEST(ProgramPlan, BesideMeasuredCostsWallsAreObeyedAndWhatMeasuresIsRefused) {
  const TestFolder folder;
  const ProgramResult measured =
      stadionProgram({"plan", kKick, "--wall-count", "2", "--frames", "6", "--size", "32x24", "--json"});
  ASSERT_EQ(measured.status, 0) << measured.err;
  const std::string costs = folder.write("costs.json", measured.out);
  const auto planned = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"plan", "--from", costs});
    return stadionProgram(std::move(more));
  };
  const auto refused = [&](const std::vector<std::string>& more, const std::string& why) {
    const ProgramResult r = planned(more);
    EXPECT_EQ(r.status, 2) << r.out;
    EXPECT_NE(r.err.find(why), std::string::npos) << r.err;
  };
  EXPECT_NE(planned({}).out.find("2 walls,"), std::string::npos) << "as measured";
  for (const auto& [option, six] : std::vector<std::pair<const char*, const char*>>{
           {"--wall-count", "6"},
           {"--walls", "cave6"},
           {"--walls", STADION_SOURCE_DIR "/walls/cave6.walls"}}) {
    const ProgramResult r = planned({option, six});
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_NE(r.out.find("6 walls,"), std::string::npos) << six << r.out;
  }
  for (const char* count : {"-3", "0", "2.5", "", "99999999999999999999999"})
    refused({"--wall-count", count}, "is not a whole number from 1 to 256");
  refused({"--walls", "nonsense"}, "there are no walls named");
  for (const auto& [option, value] : std::map<std::string, std::string>{{"--size", "64x48"},
                                                                        {"--stereo", "off"},
                                                                        {"--look", "plain"},
                                                                        {"--frames", "9"},
                                                                        {"--seconds", "1"},
                                                                        {"--gl", "egl"},
                                                                        {"--renderer", "gl"},
                                                                        {"--draw-threads", "2"},
                                                                        {"--input", "none"},
                                                                        {"--asset-root", "."},
                                                                        {"--app-threads", "2"}})
    refused({option, value}, option + " is for measuring; --from has measured costs");
}

}  // namespace
}  // namespace stadion
