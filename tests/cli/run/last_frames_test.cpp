/// A run keeps its last frames in a file, and harms no other file.

#include "tests/programs/desk.h"

#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <thread>

namespace stadion {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> live(const std::vector<std::string>& more) {
  std::vector<std::string> words = {stadionPath(), "run",       STADION_SOURCE_DIR "/scripts/kick.evs",
                                    "--walls",     "desktop",   "--gl",
                                    "none",        "--no-sound"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

bool plays(const std::string&, const std::string& err) {
  return has(err, "playing ");
}

ProgramResult played(const std::vector<std::string>& more, const std::vector<std::string>& environment = {}) {
  ProgramRun run;
  run.words = live(more), run.environment = environment;
  run.signal = SIGINT, run.signalWhen = plays;
  return runProgram(run);
}

TEST(ProgramLastFrames, AFileOfSomethingElseIsNotTouched) {
  const TestFolder folder;
  const std::string thesis = folder.write("thesis.txt", "the only copy");
  const ProgramResult r = played({"--black-box", thesis});
  EXPECT_EQ(r.status, 2) << r.err;
  EXPECT_NE(r.err.find("name a file that is not there yet"), std::string::npos) << r.err;
  EXPECT_EQ(fileContent(thesis), "the only copy");
  const std::string pipe = folder.path() / "pipe";  // no device: a fault would take it from everybody
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const ProgramResult refused = played({"--black-box", pipe});
  EXPECT_EQ(refused.status, 2) << refused.err;
  EXPECT_NE(refused.err.find("no plain file"), std::string::npos) << refused.err;
  EXPECT_TRUE(fs::is_fifo(pipe));
}

/// Nothing can be made there.
const std::string kNoState = "XDG_STATE_HOME=/dev/null";

TEST(ProgramLastFrames, WithoutAFolderForThemTheShowIsPlayedWithout) {
  const TestFolder folder;
  const std::string none = "TMPDIR=" + (folder.path() / "not there").string();
  const ProgramResult r = played({}, {none, kNoState});
  EXPECT_EQ(r.status, 130) << r.err;
  EXPECT_NE(r.err.find("the show is played without"), std::string::npos) << r.err;
  EXPECT_NE(r.out.find("frames"), std::string::npos) << r.out;
  const ProgramResult asked =
      played({"--black-box", (folder.path() / "not there" / "box").string()}, {none, kNoState});
  EXPECT_EQ(asked.status, 2) << asked.err;
}

TEST(ProgramLastFrames, WhatIsDamagedIsSaidToBe) {
  const TestFolder folder;
  const std::string box = folder.path() / "box";
  RunningProgram run({live({"--black-box", box, "--input", "none"})});
  ASSERT_TRUE(run.says("playing until Ctrl-C"));
  // It stands still for so long that a frame is late.
  for (int tries = 0; tries < 100 && !has(run.err(), "late: "); ++tries) {
    kill(-run.pid(), SIGSTOP);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    kill(-run.pid(), SIGCONT);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
  ASSERT_TRUE(run.says("late: "));
  kill(run.pid(), SIGINT);
  ASSERT_EQ(run.status(), 130) << run.err();
  const std::string bytes = fileContent(box);
  ASSERT_FALSE(bytes.empty());
  const auto told = [&](const std::string& content) {
    return stadionProgram({"profile", "--black-box", folder.write("damaged", content)});
  };
  EXPECT_EQ(told(bytes).status, 0);
  for (std::size_t at = 16; at < 1500; at += 37) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(~damaged[at]);
    const ProgramResult wrong = told(damaged);
    EXPECT_TRUE(wrong.status == 0 || wrong.status == 2) << at << ": " << wrong.err;
    EXPECT_EQ(wrong.status == 2, wrong.err.find("error") != std::string::npos) << at << ": " << wrong.err;
  }
}

TEST(ProgramLastFrames, ACrashedRunReportsItsLastFramesAlsoWhileAnotherOneWaits) {
  const TestFolder folder;
  ProgramRun run;
  run.words = live({"--frames", "10000000", "--input", "none"});
  run.environment = {kNoState, "TMPDIR=" + folder.path().string()};
  run.signal = SIGSEGV, run.signalAfter = std::chrono::milliseconds(2000);
  run.signalWhen = [&](const std::string& out, const std::string& err) {
    return plays(out, err) && !fs::is_empty(folder.path());
  };
  const ProgramResult r = runProgram(run);
  EXPECT_EQ(r.status, 128 + SIGSEGV) << r.err;
  const std::string command = "stadion profile --black-box ";
  const std::size_t at = r.err.find(command + folder.path().string());
  ASSERT_NE(at, std::string::npos) << r.err;
  const std::size_t from = at + command.size();
  const std::string file = r.err.substr(from, r.err.find('\n', from) - from);
  const ProgramResult told = stadionProgram({"profile", "--black-box", file});
  EXPECT_EQ(told.status, 0) << told.err;
  EXPECT_NE(told.out.find("600"), std::string::npos) << told.out;
}

TEST(ProgramLastFrames, ARunInWhichEveryFrameCountsLeavesNothingIfItEndsWell) {
  const TestFolder folder;
  ProgramRun run;
  run.words = live({"--frames", "30", "--input", "none"});
  run.environment = {"XDG_STATE_HOME=" + folder.path().string()};
  const ProgramResult r = runProgram(run);
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(fs::is_empty(folder.path() / "stadion/last-frames"));
}

TEST(ProgramLastFrames, AKilledRunsAreFoundWithoutTheirNameAndOldOnesGo) {
  const TestFolder folder;
  const std::string state = "XDG_STATE_HOME=" + folder.path().string();
  const fs::path boxes = folder.path() / "stadion/last-frames";
  const auto told = [&] { return runProgram({{stadionPath(), "profile", "--black-box"}, {state}}); };
  const ProgramResult none = told();
  EXPECT_EQ(none.status, 2) << none.out;
  EXPECT_NE(none.err.find("no run has left its last frames in " + boxes.string()), std::string::npos)
      << none.err;
  for (int n = 10; n < 30; ++n)
    std::ofstream(boxes / ("2001-01-01T00-00-" + std::to_string(n) + ".frames")) << "stadion frames0 of old";
  ProgramRun run;
  run.words = live({}), run.environment = {state};
  run.signal = SIGKILL, run.signalAfter = std::chrono::milliseconds(1000), run.signalWhen = plays;
  ASSERT_EQ(runProgram(run).status, 128 + SIGKILL);
  EXPECT_EQ(std::distance(fs::directory_iterator(boxes), fs::directory_iterator()), 16);
  EXPECT_FALSE(fs::exists(boxes / "2001-01-01T00-00-14.frames"));
  EXPECT_TRUE(fs::exists(boxes / "2001-01-01T00-00-15.frames"));
  const ProgramResult r = told();
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.err.find("the newest of 16 there"), std::string::npos) << r.err;
  EXPECT_NE(r.out.find(" frames: "), std::string::npos) << r.out;
}

TEST(ProgramLastFrames, ThatBudgetsDoNotKnowWhatProcessesDrawIsTold) {
  const TestFolder folder;
  const std::string show = folder.write("show.evs", "object( name=ball, file=football.3ds, budget=1 )\n");
  ProgramRun run;
  run.words = {stadionPath(), "run",   show,         "--asset-root", assetFolder(),    "--walls", "desktop",
               "--size",      "32x24", "--no-sound", "--json",       "--wall-workers", "process"};
  const std::string told = "the budget of \"ball\" " + show + ":1 counts App and Cull only";
  run.signal = SIGINT;
  run.signalWhen = [&](const std::string& out, const std::string& err) {
    return plays(out, err) && has(err, told);
  };
  const ProgramResult r = runProgram(run);
  ASSERT_EQ(r.status, 130) << r.err;
  EXPECT_EQ(r.err.find(told), r.err.rfind(told)) << r.err;
  EXPECT_NE(r.err.find(told), std::string::npos) << r.err;
  EXPECT_EQ(nlohmann::json::parse(r.out).at("budgets").at(0).at("draw_counted"), false) << r.out;
}

TEST(ProgramLastFrames, WhatIsDrawnOfAFileThatComesLaterKeepsItsBudgetToo) {
  const TestFolder folder;
  folder.write("stone.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 2\nf 1 2 3\nf 1 3 4\n");
  folder.write("arena.evs", "object( name=stone, file=stone.obj, budget=0.0001, position=\"0, 4, 0\" )\n");
  const std::string show =
      folder.write("late.evs", "rig( name=stand, position=\"0, -4, 0\" )\n"
                               "light( name=sun, direction=\"-0.4, 0.5, -0.8\", shadows=off )\n"
                               "scene( name=arena, file=arena.evs, initstate=off )\n"
                               "timer( period=0.5, eventmessage=\"timesup, arena, load\" )\n");
  ProgramRun run;
  run.words = {stadionPath(), "run", show, "--walls", "desktop", "--size", "32x24", "--no-sound", "--json"};
  run.signal = SIGINT, run.signalWhen = plays;
  // On a busy machine the file may come later still: then it plays longer.
  double mean = 0;
  for (int seconds = 2; mean == 0 && seconds < 100; seconds *= 4) {
    run.signalAfter = std::chrono::seconds(seconds);
    const ProgramResult r = runProgram(run);
    ASSERT_EQ(r.status, 130) << r.err;
    const auto summary = nlohmann::json::parse(r.out);
    const auto budgets = summary.value("budgets", nlohmann::json::array());
    ASSERT_LE(budgets.size(), 1U) << r.out;
    if (!budgets.empty()) mean = budgets[0].at("mean_ms").get<double>();
  }
  EXPECT_GT(mean, 0);
}

}  // namespace
}  // namespace stadion
