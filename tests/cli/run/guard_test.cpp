/// `--guard` in the real program: a wrong write ends it with an exit code of its own.

#include "tests/programs/desk.h"
#include "tests/programs/preloaded_faults.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <regex>
#include <string>
#include <vector>

namespace stadion {
namespace {

/// Where the model of the first instance stands in a slot.
constexpr const char* kInModel = "3145736";

class ProgramGuard : public ::testing::Test {
protected:
  void SetUp() override {
    if (!std::filesystem::exists(faultLibrary())) GTEST_SKIP() << "sanitizers let nothing be preloaded";
  }
  ProgramResult play(std::vector<std::string> words, bool faulty) const {
    words.insert(words.begin(), stadionPath());
    words.insert(words.end(), {"--walls", "desktop", "--size", "32x24", "--frames", "40"});
    ProgramRun r{words};
    prepare(r, faulty);
    return runProgram(r);
  }
  /// If `faulty`, a write into a slot is planted: in App, or in a thread whose name begins with `thread`.
  void prepare(ProgramRun& r, bool faulty, const std::string& thread = "") const {
    r.environment.insert(r.environment.end(),
                         {"XDG_STATE_HOME=" + std::string(folder_.path()), "LP_NUM_THREADS=1"});
    if (!faulty) return;
    r.environment.push_back("LD_PRELOAD=" + faultLibrary());
    r.environment.push_back(std::string("STADION_FAULT=protect nth=20 offset=") + kInModel +
                            (thread.empty() ? "" : " thread=" + thread));
  }
  std::string kick() const { return STADION_SOURCE_DIR "/scripts/kick.evs"; }

  TestFolder folder_;
};

TEST_F(ProgramGuard, EndsTheRunAtAWrongWriteAndNamesIt) {
  const ProgramResult r =
      play({"run", kick(), "--guard", "--out", folder_.path() / "out", "--look", "plain"}, true);
  EXPECT_EQ(r.status, 5) << r.err;
  EXPECT_NE(r.err.find("App, frame 18: wrote to the published scene, field \"model\", of "), r.err.npos)
      << r.err;
  EXPECT_NE(r.err.find("kick.evs:"), r.err.npos) << r.err;
  EXPECT_NE(fileContent(folder_.path() / "out" / "summary.json").find("wrote to the published scene"),
            std::string::npos);
}

TEST_F(ProgramGuard, NamesAWriteOfAThreadOfTheDrawPool) {
  const std::string out = folder_.path() / "out", box = folder_.path() / "guard.blackbox";
  ProgramRun r{{stadionPath(), "run",   kick(),       "--guard", "--walls",        "cave4",
                "--size",      "64x48", "--frames",   "90",      "--out",          out,
                "--pictures",  "all",   "--renderer", "cpu",     "--draw-threads", "2",
                "--black-box", box}};
  prepare(r, true, "draw-pool");
  const ProgramResult result = runProgram(r);
  EXPECT_EQ(result.status, 5) << result.err;
  EXPECT_TRUE(std::regex_search(
      result.err, std::regex("Draw of wall [1-4], frame [0-9]+: wrote to the published scene, field "
                             "\"model\", of .*kick.evs:")))
      << result.err;
  EXPECT_NE(fileContent(out + "/summary.json").find("wrote to the published scene"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(box)) << result.err;
}

TEST_F(ProgramGuard, MeansTheSameInProfile) {
  const ProgramResult r = play({"profile", kick(), "--guard", "--gl", "none"}, true);
  EXPECT_EQ(r.status, 5) << r.err;
  EXPECT_NE(r.err.find("App, frame 18: wrote to the published scene"), r.err.npos) << r.err;
}

TEST_F(ProgramGuard, MeansTheSameInView) {
  const auto display = Display::open();
  if (!display) GTEST_SKIP() << "needs Xvfb, xdotool and import: apt-get install xvfb xdotool imagemagick";
  ProgramRun run = onDisplay(
      *display, {"view", kick(), "--guard", "--walls", "desktop", "--window", "200x150", "--look", "plain"});
  prepare(run, true);
  RunningProgram view(run);
  EXPECT_EQ(view.status(), 5) << view.err();
  EXPECT_TRUE(std::regex_search(
      view.err(),
      std::regex("App, frame [0-9]+: wrote to the published scene, field \"model\", of .*kick.evs:")))
      << view.err();
}

TEST_F(ProgramGuard, LetsAViewPlayIfNothingIsWritten) {
  const auto display = Display::open();
  if (!display) GTEST_SKIP() << "needs Xvfb, xdotool and import: apt-get install xvfb xdotool imagemagick";
  ProgramRun run = onDisplay(*display, {"view", kick(), "--guard", "--walls", "desktop", "--window",
                                        "200x150", "--look", "plain", "--frames", "60"});
  prepare(run, false);
  RunningProgram view(run);
  EXPECT_EQ(view.status(), 0) << view.err();
}

TEST_F(ProgramGuard, WithoutItNothingIsProtected) {
  const ProgramResult r =
      play({"run", kick(), "--out", folder_.path() / "out", "--pictures", "none", "--look", "plain"}, true);
  EXPECT_EQ(r.status, 0) << r.err;
}

TEST_F(ProgramGuard, RefusesWallProcessesAndNamesTheMend) {
  const ProgramResult r = play({"run", kick(), "--guard", "--wall-workers", "process"}, false);
  EXPECT_EQ(r.status, 2) << r.err;
  EXPECT_NE(r.err.find("say --wall-workers thread"), r.err.npos) << r.err;
}

TEST_F(ProgramGuard, ReportsItsCost) {
  const ProgramResult r = play({"run", kick(), "--guard", "--gl", "none"}, false);
  EXPECT_EQ(r.status, 0) << r.err;
  // Two calls a frame, and those for static objects and at the end.
  EXPECT_TRUE(std::regex_search(r.out + r.err, std::regex("guard: protect calls: 8[0-9]\n")))
      << r.out << r.err;
  EXPECT_NE((r.out + r.err).find("guard: protect calls, percent of App: "), r.out.npos) << r.out << r.err;
}

TEST_F(ProgramGuard, ReportsItsCostInAProfile) {
  const std::string cost = "guard: protect calls, percent of App";
  const ProgramResult text = play({"profile", kick(), "--guard", "--gl", "none"}, false);
  EXPECT_EQ(text.status, 0) << text.err;
  EXPECT_TRUE(std::regex_search(text.out, std::regex("guard: protect calls: 8[0-9]\n"))) << text.out;
  EXPECT_TRUE(has(text.out, cost + ": ")) << text.out;
  const ProgramResult asJson = play({"profile", kick(), "--guard", "--gl", "none", "--json"}, false);
  EXPECT_GT(nlohmann::json::parse(asJson.out).at("counters").at(cost), 0) << asJson.out;
}

TEST_F(ProgramGuard, ShowsTheSamePicturesWithAndWithoutIt) {
  std::vector<std::string> shown;
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--guard"}}) {
    std::vector<std::string> words{"run", kick(), "--out", folder_.path() / "out", "--look", "plain"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult r = play(words, false);
    ASSERT_EQ(r.status, 0) << r.err;
    const std::string summary = fileContent(folder_.path() / "out" / "summary.json");
    const std::size_t hashes = summary.find("\"image_hashes\"");
    ASSERT_NE(hashes, summary.npos) << summary;
    shown.push_back(summary.substr(hashes, summary.find(']', hashes) - hashes));
  }
  EXPECT_EQ(shown[1], shown[0]);
}

}  // namespace
}  // namespace stadion
