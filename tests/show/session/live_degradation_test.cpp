/// What a live run reports about its stress and its budgets.

#include "tests/programs/program.h"

#include <csignal>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

/// Plays until its standard error says `until`, and then a while longer.
ProgramResult playLive(const std::string& show, const std::vector<std::string>& more,
                       const std::string& until, std::chrono::milliseconds longer) {
  ProgramRun run;
  run.words = {stadionPath(), "run",     show,     "--asset-root", assetFolder(),
               "--walls",     "desktop", "--size", "32x24",        "--no-sound"};
  run.words.insert(run.words.end(), more.begin(), more.end());
  run.signal = SIGINT, run.signalAfter = longer;
  run.signalWhen = [&](const std::string&, const std::string& err) { return has(err, until); };
  return runProgram(run);
}

TEST(ProgramLiveDegradation, StressIsToldAlsoOfAShowWithoutBudgets) {
  const TestFolder folder;
  const std::string show =
      folder.write("show.evs", "lod( name=tree, ranges=\"5, 20\", position=\"0, 9, 0\" )\n"
                               "object( file=football.3ds, parent=tree )\n");
  const std::vector<std::string> stressed{"--stress-frac", "0.01", "--stress-low", "0", "--stress-high", "0"};
  const std::string kMost = "counts as 4 times farther away, the most it may";
  const ProgramResult text = playLive(show, stressed, kMost, {});
  ASSERT_EQ(text.status, 130) << text.err;
  EXPECT_NE(text.err.find("under stress: from frame "), std::string::npos) << text.err;
  EXPECT_NE(text.err.find(kMost), std::string::npos) << text.err;
  EXPECT_NE(text.out.find("counted as up to 4 times farther away, 4 at the end"), std::string::npos)
      << text.out;
  std::vector<std::string> asJson = stressed;
  asJson.push_back("--json");
  const ProgramResult j = playLive(show, asJson, kMost, {});
  ASSERT_EQ(j.status, 130) << j.err;
  const auto summary = nlohmann::json::parse(j.out);
  EXPECT_FALSE(summary.contains("budgets")) << j.out;
  EXPECT_EQ(summary.at("stress").at("highest"), 4) << j.out;
  EXPECT_EQ(summary["stress"].at("at_end"), 4) << j.out;
  EXPECT_GE(summary["stress"].at("changes"), 1) << j.out;
}

TEST(ProgramLiveDegradation, ASkyKeepsItsBudgetOrNot) {
  const TestFolder folder;
  const std::string show =
      folder.write("show.evs", "sky( name=dusk, zenith=\"0.1, 0.1, 0.3\", budget=0.0001 )\n");
  // On a busy machine the first frames may come late: then it plays longer.
  double mean = 0;
  for (int seconds = 1; mean == 0 && seconds < 100; seconds *= 4) {
    const ProgramResult r = playLive(show, {"--json"}, "playing until Ctrl-C", std::chrono::seconds(seconds));
    ASSERT_EQ(r.status, 130) << r.err;
    const auto summary = nlohmann::json::parse(r.out);
    ASSERT_EQ(summary.at("budgets").size(), 1U) << r.out;
    mean = summary["budgets"][0].at("mean_ms").get<double>();
  }
  EXPECT_GT(mean, 0);
}

}  // namespace
}  // namespace stadion
