/// `stadion regress` with wrong input, interrupted, or in folders that it cannot write.

#include "tests/cli/regress/small_suite.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <csignal>
#include <fcntl.h>
#include <regex>
#include <sys/file.h>
#include <unistd.h>

namespace stadion {
namespace {

/// A baseline for smallSuite() that knows these of its case, too.
void writeBaseline(const TestFolder& folder, const Json& more) {
  ASSERT_EQ(regress({smallSuite(folder), "--update"}).status, 0);
  Json baseline = Json::parse(fileContent(folder.path() / "small.baseline.json"));
  baseline["cases"][kSmallCase].update(more);
  folder.write("small.baseline.json", baseline.dump());
}

/// The program, after which something else is done.
std::string thenDoes(const TestFolder& folder, const std::string& what) {
  const std::string path = folder.write("wrap.sh", "#!/bin/sh\n" + stadionPath() + " \"$@\"\nstatus=$?\n" +
                                                       what + "\nexit $status\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

TEST(ProgramRegress, StoppedJustWhenAProgramHasEndedItSaysSo) {
  const TestFolder folder;
  writeBaseline(folder, {{"times", {{"app", {1, 2, 3}}}}});
  const std::string suite = smallSuite(folder, "  compare state times\n"), mark = folder.path() / "once";
  const std::string program = thenDoes(folder, "mkdir " + mark + " && kill -INT $PPID");
  for (const bool builds : {false, true}) {
    std::filesystem::remove(mark);
    std::vector<std::string> words{suite, "--stadion", program};
    if (builds) words.insert(words.end(), {"--against", stadionPath()});
    const ProgramResult r = regress(words);
    EXPECT_EQ(r.status, 130) << r.out << r.err;
    EXPECT_NE(r.err.find("stopped by SIGINT"), std::string::npos) << r.err;
  }
}

TEST(ProgramRegress, WithoutValgrindItSaysWhatToInstall) {
  const TestFolder folder;
  writeBaseline(folder, {{"instructions", {{"app", 1e6}}}, {"counted_by", "callgrind"}});
  const std::string suite = smallSuite(folder, "  compare instructions\n");
  const ProgramResult r =
      runProgram({{stadionPath(), "regress", suite, "--instructions"}, {"PATH=/nowhere"}});
  EXPECT_EQ(r.status, 2) << r.out << r.err;
  EXPECT_NE(r.out.find("there is no valgrind; install it: apt install valgrind"), std::string::npos) << r.out;
  const ProgramResult bench =
      runProgram({{stadionPath(), "bench", "recording", "--frames", "32", "--rounds", "1", "--size", "32x24"},
                  {"PATH=/nowhere"}});
  EXPECT_EQ(bench.status, 2);
  EXPECT_NE(bench.err.find("there is no valgrind; install it"), std::string::npos) << bench.err;
}

TEST(ProgramRegress, TimesOfABaselineThatSayNothingAreNoPass) {
  const TestFolder folder;
  writeBaseline(folder, {{"times", {{"app", {0, 0, 0}}, {"cull of wall screen", Json::array()}}}});
  const ProgramResult r = regress({smallSuite(folder, "  compare state times\n")});
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_NE(r.out.find("the baseline's times of it cannot be compared with"), std::string::npos) << r.out;
}

TEST(ProgramRegress, AfterHalfALineOfHistoryTheNextRunHasOneOfItsOwn) {
  const TestFolder folder;
  const std::filesystem::path out = folder.path() / "out";
  std::filesystem::create_directory(out);
  const std::string half = "{\"when\": \"2024-";
  folder.write("out/history.jsonl", half);
  ASSERT_EQ(regress({smallSuite(folder), "--update", "--out", out}).status, 0);
  const std::string history = fileContent(out / "history.jsonl");
  ASSERT_TRUE(history.starts_with(half + "\n")) << history;
  EXPECT_TRUE(Json::parse(history.substr(half.size())).contains("cases")) << history;
}

TEST(ProgramRegress, WhatCannotBeWrittenInTheFolderIsToldBeforeAnythingIsPlayed) {
  for (const char* name : {"report.html", "results.json", "junit.xml", "history.jsonl"}) {
    const TestFolder folder;
    const std::filesystem::path out = folder.path() / "out";
    std::filesystem::create_directories(out / name);
    folder.write("out/progress.jsonl", "of before\n");
    const ProgramResult r = regress({smallSuite(folder), "--out", out});
    EXPECT_EQ(r.status, 2) << r.err;
    EXPECT_EQ(r.out, "");
    EXPECT_NE(r.err.find(std::string(name) + ": error: cannot be written"), std::string::npos) << r.err;
    EXPECT_EQ(fileContent(out / "progress.jsonl"), "of before\n");
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(out), {}), 2);
  }
}

TEST(ProgramRegress, WhatWasPlayedIsKeptWhereItCouldNotBeWritten) {
  const TestFolder folder;
  writeBaseline(folder, Json::object());
  const std::filesystem::path out = folder.path() / "out";
  const std::string page = out / "report.html";
  const std::string program = thenDoes(folder, "mkdir " + page), suite = smallSuite(folder);
  const ProgramResult r = regress({suite, "--stadion", program, "--out", out});
  EXPECT_EQ(r.status, 2) << r.out << r.err;
  EXPECT_NE(r.err.find("report.html: error: cannot be written"), std::string::npos) << r.err;
  EXPECT_NE(fileContent(out / "junit.xml").find("<testsuites"), std::string::npos);
  EXPECT_EQ(fileContent(out / "history.jsonl"), "");
  std::filesystem::remove(page);
  const ProgramResult again = regress({suite, "--stadion", program, "--out", out, "--resume"});
  EXPECT_EQ(again.status, 0) << "without being played again" << again.out << again.err;
  EXPECT_TRUE(std::filesystem::is_regular_file(page));
  EXPECT_FALSE(std::filesystem::exists(out / "progress.jsonl"));
}

TEST(ProgramRegress, AnUpdateOfALinkedBaselineWritesTheFileThatItLeadsTo) {
  const TestFolder folder;
  std::filesystem::create_directory(folder.path() / "kept");
  std::filesystem::create_symlink("kept/small.json", folder.path() / "small.baseline.json");
  for (int i = 0; i < 2; ++i) {
    ASSERT_EQ(regress({smallSuite(folder), "--update"}).status, 0);
    EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "small.baseline.json"));
    EXPECT_TRUE(Json::parse(fileContent(folder.path() / "kept/small.json")).contains("cases"));
  }
}

/// A suite that is interrupted once it has kept something of what it has measured.
ProgramResult interrupted(const std::string& suite, const std::string& out) {
  ProgramRun run{{stadionPath(), "regress", suite, "--out", out}};
  run.signal = SIGINT, run.signalAfter = {};
  run.signalWhen = [&](const std::string&, const std::string&) {
    return std::ranges::count(fileContent(std::filesystem::path(out) / "progress.jsonl"), '\n') > 1;
  };
  return runProgram(run);
}

TEST(ProgramRegress, AnInterruptedSuiteGoesOnWhereItWas) {
  const TestFolder folder;
  std::string text =
      "stadion-suite 1\nsize 16x12\nwalls desktop\nlook plain\ncompare state\nmodes sequential "
      "pipelined\nasset-root " +
      assetFolder() + "\n";
  for (int i = 0; i < 3; ++i)
    text += "case c" + std::to_string(i) + "\n  show " + testShow("bodies.evs") + "\n  frames 3\n";
  const std::string suite = folder.write("many.suite", text), out = folder.path() / "out";
  const ProgramResult stopped = interrupted(suite, out);
  ASSERT_EQ(stopped.status, 130) << stopped.out << stopped.err;
  const std::string progress = fileContent(std::filesystem::path(out) / "progress.jsonl");
  const ProgramResult r = regress({suite, "--out", out, "--resume", "--json"});
  EXPECT_EQ(r.status, 2) << "there is no baseline" << r.err;
  EXPECT_EQ(r.err.find("starts from the beginning"), std::string::npos) << progress;
  EXPECT_EQ(Json::parse(r.out)["benchmarks"].size(), 6u);
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::path(out) / "progress.jsonl"));
  EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(out) / "report.html"));
}

TEST(ProgramRegress, AnInterruptedSuiteStartsFromTheBeginningWhenAShowHasChanged) {
  const TestFolder folder;
  const std::string show = folder.write("show.evs", "group( name=a )\n");
  std::string text =
      "stadion-suite 1\nsize 16x12\nwalls desktop\nlook plain\ncompare state\nmodes sequential pipelined\n";
  for (int i = 0; i < 3; ++i) text += "case c" + std::to_string(i) + "\n  show show.evs\n  frames 3\n";
  const std::string suite = folder.write("many.suite", text), out = folder.path() / "out";
  const ProgramResult stopped = interrupted(suite, out);
  ASSERT_EQ(stopped.status, 130) << stopped.out << stopped.err;
  folder.write("show.evs", "group( name=b )\n");
  const ProgramResult r = regress({suite, "--out", out, "--resume"});
  EXPECT_EQ(r.status, 2) << "there is no baseline" << r.err;
  EXPECT_NE(r.err.find("starts from the beginning"), std::string::npos) << r.err;
}

TEST(ProgramRegress, WrongUseAndWrongSuitesAreToldWithTheFix) {
  const TestFolder folder;
  const std::string suite = smallSuite(folder);
  const auto refused = [](const ProgramResult& r, const std::string& why) {
    EXPECT_EQ(r.status, 2) << r.out << r.err;
    EXPECT_NE(r.err.find(why), std::string::npos) << r.err;
  };
  refused(regress({folder.write("w.suite", "stadion-suite 1\ncase a\n  shwo a.evs\n")}),
          "w.suite:3:3: error: \"shwo\" does not begin a statement; did you mean \"show\"?");
  refused(regress({suite, "--case", "bodeis"}), "there is no case \"bodeis\"; did you mean \"bodies\"?");
  refused(regress({suite, "--against", "/there/is/none"}), "--against: there is no program /there/is/none");
  refused(regress({suite, "--against", "/bin/true", "--update"}), "leave one of them out");
  refused(regress({suite, "--baseline", folder.write("b.json", "{}")}), "is no baseline");
  refused(regress({folder.write("e.suite", "stadion-suite 1\ncase a\n  show e.evs\n  frames 9\n" +
                                               (folder.write("e.evs", "nonsense("), std::string()))}),
          "");
}

TEST(ProgramRegress, AFolderThatAnotherOneWritesIsLeftAlone) {
  const TestFolder folder;
  const std::string out = folder.path() / "out";
  std::filesystem::create_directories(out);
  const int other = ::open(out.c_str(), O_RDONLY | O_DIRECTORY);
  ASSERT_EQ(flock(other, LOCK_EX), 0);
  const ProgramResult r = regress({smallSuite(folder, "  modes sequential pipelined\n"), "--out", out});
  EXPECT_EQ(r.status, 2) << r.out;
  EXPECT_NE(r.err.find("another regress is writing there"), std::string::npos) << r.err;
  EXPECT_TRUE(std::filesystem::is_empty(out));
  close(other);
  EXPECT_EQ(regress({smallSuite(folder), "--out", out, "--update"}).status, 0);
}

TEST(ProgramRegress, WhereNothingWasComparedItIsNotGreen) {
  const TestFolder folder;
  const std::string suite = smallSuite(folder);
  const auto refused = [](const ProgramResult& r, const std::string& why) {
    EXPECT_EQ(r.status, 2) << r.out << r.err;
    EXPECT_NE(r.err.find(why), std::string::npos) << r.err;
  };
  refused(regress({suite, "--baseline", "nowhere.json"}),
          "there is no file nowhere.json; --update writes it");
  refused(regress({suite}), "nothing was compared\nstadion: error: there is no baseline");
  refused(regress({suite, "--compare", "times"}),
          "no case compares times; say so in its \"compare\" statement");
  const std::string counted = folder.write("counted.suite", fileContent(suite) + "  compare instructions\n");
  ASSERT_EQ(regress({counted, "--update"}).status, 0);
  refused(regress({counted}), "nothing was compared; the table says why");
}

TEST(ProgramRegress, ModesThatAgreeAreNotGreenWhereTheBaselineSaysNothing) {
  const TestFolder folder;
  const std::string suite = smallSuite(folder, "  modes sequential pipelined\n  compare state\n");
  ASSERT_EQ(regress({suite, "--update"}).status, 0);
  const std::string file = folder.path() / "small.baseline.json";
  Json baseline = Json::parse(fileContent(file));
  for (Json& c : baseline["cases"]) c["state"] = Json::object();
  folder.write("small.baseline.json", baseline.dump());
  const ProgramResult r = regress({suite});
  EXPECT_NE(r.status, 0) << r.out << r.err;
}

/// As `env` would read it, it says what the environment is.
TEST(ProgramRegress, AProgramsPathMayHoldAnEqualsSign) {
  const TestFolder folder;
  const std::string build = folder.path() / "build=release";
  std::filesystem::create_directory(build);
  std::filesystem::create_symlink(stadionPath(), build + "/stadion");
  const std::string suite = smallSuite(folder, "  compare times\n  rounds 12\n");
  const ProgramResult r = regress({suite, "--stadion", build + "/stadion", "--update"});
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_TRUE(
      Json::parse(fileContent(folder.path() / "small.baseline.json"))["cases"][kSmallCase].contains("times"));
}

TEST(ProgramRegress, WhatCannotBeWrittenIsToldBeforeAnythingIsPlayed) {
  const TestFolder folder;
  const std::string suite = smallSuite(folder);
  const ProgramResult r = regress({suite, "--update", "--baseline", "nowhere/b.json"});
  EXPECT_EQ(r.status, 2) << r.err;
  EXPECT_NE(r.err.find("cannot be written"), std::string::npos) << r.err;
  EXPECT_EQ(r.out, "");
}

TEST(ProgramRegress, EverythingThatIsCountedIsCompared) {
  const TestFolder folder;
  const std::string suite = smallSuite(folder);
  ASSERT_EQ(regress({suite, "--update"}).status, 0);
  const std::string file = folder.path() / "small.baseline.json";
  Json baseline = Json::parse(fileContent(file));
  Json& counts = baseline["cases"][kSmallCase]["counts"];
  EXPECT_EQ(counts["pixels screen left"], std::to_string(12 * 32 * 24) + ".0") << counts;
  for (const char* name :
       {"tested screen", "seen screen", "casters screen", "impacts", "contacts", "substeps"})
    EXPECT_TRUE(counts.contains(name)) << name << counts;
  counts["substeps"] = "1.0";
  folder.write("small.baseline.json", baseline.dump());
  const ProgramResult r = regress({suite});
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_TRUE(std::regex_search(r.out, std::regex("substeps: [0-9.]+, was 1.0"))) << r.out;
}

TEST(ProgramRegress, AProgramThatFailsIsAFaultNotADifference) {
  const TestFolder folder;
  const ProgramResult r = regress({smallSuite(folder), "--stadion", "/bin/false"});
  EXPECT_EQ(r.status, 3) << r.out << r.err;
  EXPECT_NE(r.out.find("/bin/false: exit status 1"), std::string::npos) << r.out;
}

}  // namespace
}  // namespace stadion
