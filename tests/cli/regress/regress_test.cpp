/// `stadion regress`, as CI uses it.

#include "tests/programs/program.h"

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

using Json = nlohmann::json;

const std::string kBasic = STADION_SOURCE_DIR "/scripts/suites/basic.suite";

/// A suite of one small case, in the look that costs less.
std::string smallSuite(const TemporaryFolder& folder, const std::string& more = {},
                       const std::string& look = "plain") {
  return folder.write("small.suite", "stadion-suite 1\nsize 32x24\nwalls desktop\nlook " + look +
                                         "\ncase bodies\n  show " + testShow("bodies.evs") +
                                         "\n  asset-root " + assetFolder() + "\n  frames 12\n" + more);
}
const std::string kSmallCase = "bodies/sequential/plain";

ProgramResult regress(std::vector<std::string> words) {
  words.insert(words.begin(), {stadionPath(), "regress"});
  ProgramRun run{std::move(words)};
  run.limit = std::chrono::seconds(600);  // callgrind on a busy machine
  return runProgram(run);
}

TEST(ProgramRegress, TheShippedSuiteHasTheHashesAndCountsOfItsBaseline) {
  const ProgramResult r = regress({kBasic});
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_NE(r.out.find("kick/pipelined"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find(" 0 failed"), std::string::npos) << r.out;
}

TEST(ProgramRegress, WritesABaselineAndThenAgreesWithIt) {
  const TemporaryFolder folder;
  const std::string suite = smallSuite(folder, "  modes sequential pipelined\n");
  const ProgramResult without = regress({suite});
  EXPECT_EQ(without.status, 2) << "the modes agree, but with what was before?" << without.out << without.err;
  EXPECT_NE(without.err.find("error: there is no baseline"), std::string::npos) << without.err;
  EXPECT_NE(without.err.find("--update writes it"), std::string::npos) << without.err;
  EXPECT_NE(without.out.find("state as sequential"), std::string::npos) << without.out;

  EXPECT_EQ(regress({suite, "--update"}).status, 0);
  const ProgramResult again = regress({suite});
  EXPECT_EQ(again.status, 0) << again.out << again.err;
  EXPECT_NE(again.out.find("equal to the baseline"), std::string::npos) << again.out;
}

TEST(ProgramRegress, NamesWhatIsNotAsInTheBaseline) {
  const TemporaryFolder folder;
  const std::string suite = smallSuite(folder);
  ASSERT_EQ(regress({suite, "--update"}).status, 0);
  const std::string file = folder.path() / "small.baseline.json";
  Json baseline = Json::parse(fileContent(file));
  Json& found = baseline["cases"][kSmallCase];
  found["counts"]["triangles screen left"] = "7";
  found["state"]["state hash"] = "0123456789abcdef";
  folder.write("small.baseline.json", baseline.dump());

  const ProgramResult r = regress({suite});
  EXPECT_EQ(r.status, 1) << r.err;
  EXPECT_NE(r.out.find("was 0123456789abcdef"), std::string::npos) << r.out;
  EXPECT_TRUE(std::regex_search(r.out, std::regex("triangles screen left: [0-9]+, was 7"))) << r.out;
  EXPECT_NE(r.out.find("1 comparisons passed, 2 failed"), std::string::npos) << r.out;
  EXPECT_EQ(regress({suite, "--compare", "images"}).status, 0) << "what differs was not asked for";
}

/// The figures of one look say nothing of the other.
TEST(ProgramRegress, ABaselineOfAnotherLookIsNotComparedWith) {
  const TemporaryFolder folder;
  const std::string file = folder.path() / "small.baseline.json";
  ASSERT_EQ(regress({smallSuite(folder, {}, "full"), "--update"}).status, 0);
  const Json full = Json::parse(fileContent(file))["cases"]["bodies/sequential"];

  const std::string suite = smallSuite(folder);
  const ProgramResult r = regress({suite});
  EXPECT_EQ(r.status, 1) << r.out;
  EXPECT_NE(r.out.find("knows the case in the look full alone (bodies/sequential)"), std::string::npos)
      << r.out;
  EXPECT_NE(r.out.find("--update adds bodies/sequential/plain"), std::string::npos) << r.out;
  EXPECT_EQ(r.out.find("equal to"), std::string::npos) << r.out;

  ASSERT_EQ(regress({suite, "--update", "--compare", "images"}).status, 0);
  EXPECT_EQ(regress({suite}).status, 0);
  const Json cases = Json::parse(fileContent(file))["cases"];
  ASSERT_TRUE(cases.contains("bodies/sequential/plain")) << cases;
  EXPECT_EQ(cases.size(), 1u) << "what the suite has no more is gone";
  const Json& plain = cases["bodies/sequential/plain"];
  EXPECT_EQ(plain["state"], full["state"]);
  EXPECT_NE(plain["images"], full["images"]) << "it was drawn in the plain look";
}

/// Two cases, one of them in both modes.
std::string pairSuite(const TemporaryFolder& folder, const std::string& second = "b") {
  const std::string show = "\n  show " + testShow("bodies.evs") + "\n  frames 5\n";
  return folder.write("pair.suite", "stadion-suite 1\nsize 32x24\nwalls desktop\nlook plain\nasset-root " +
                                        assetFolder() + "\ncase a" + show +
                                        "  modes sequential pipelined\ncase " + second + show);
}

TEST(ProgramRegress, WhatAnUpdateDoesNotCompareStaysInTheBaselineAsItWas) {
  const TemporaryFolder folder;
  const std::string suite = pairSuite(folder);
  ASSERT_EQ(regress({suite, "--update"}).status, 0);
  const std::string file = folder.path() / "pair.baseline.json";
  const Json whole = Json::parse(fileContent(file));
  Json spoilt = whole;
  for (Json& c : spoilt["cases"]) c["counts"]["frames"] = "7", c["state"]["state hash"] = "0";
  spoilt["cases"]["b/sequential/plain"]["times"]["app"] = {1, 2, 3};
  folder.write("pair.baseline.json", spoilt.dump());
  ASSERT_EQ(regress({suite, "--update", "--compare", "state", "--case", "a"}).status, 0);
  Json expected = spoilt;
  for (const char* name : {"a/sequential/plain", "a/pipelined/plain"})
    expected["cases"][name]["state"] = whole["cases"][name]["state"];
  EXPECT_EQ(Json::parse(fileContent(file)), expected);
  ASSERT_EQ(regress({suite, "--update"}).status, 0);
  EXPECT_EQ(Json::parse(fileContent(file)), whole)
      << "times that the suite does not compare are gone as well";
}

TEST(ProgramRegress, CasesThatTheSuiteNoLongerHasAreToldAndRemoved) {
  const TemporaryFolder folder;
  ASSERT_EQ(regress({pairSuite(folder), "--update"}).status, 0);
  const std::string suite = pairSuite(folder, "renamed"), file = folder.path() / "pair.baseline.json";
  const ProgramResult compared = regress({suite});
  EXPECT_EQ(compared.status, 1) << compared.out;
  EXPECT_NE(compared.err.find("has a case b/sequential/plain, which the suite has not; --update removes it"),
            std::string::npos)
      << compared.err;
  const ProgramResult updated = regress({suite, "--update", "--case", "a"});
  EXPECT_EQ(updated.status, 0) << updated.err;
  EXPECT_NE(updated.err.find("b/sequential/plain is removed: the suite has no such case"), std::string::npos)
      << updated.err;
  const Json cases = Json::parse(fileContent(file))["cases"];
  EXPECT_FALSE(cases.contains("b/sequential/plain"));
  EXPECT_EQ(cases.size(), 2u) << cases;
  ASSERT_EQ(regress({suite, "--update", "--compare", "state"}).status, 0);
  EXPECT_EQ(regress({suite}).status, 0) << "of a new case everything is kept";
}

TEST(ProgramRegress, AnUpdateWritesOverNothingThatIsNoBaseline) {
  const TemporaryFolder folder;
  const std::string thesis = folder.write("thesis.txt", "the only copy");
  const ProgramResult r = regress({smallSuite(folder), "--baseline", thesis, "--update"});
  EXPECT_EQ(r.status, 2) << r.out << r.err;
  EXPECT_NE(r.err.find("is no baseline"), std::string::npos) << r.err;
  EXPECT_EQ(fileContent(thesis), "the only copy");
}

TEST(ProgramRegress, WhatAShowWarnsOfIsToldOnceAndFailsNothing) {
  const TemporaryFolder folder;
  folder.write("w.evs", "rig( position=\"0, -4, 0\" )\nobject( name=a, file=gone.obj )\n");
  const std::string suite =
      folder.write("w.suite", "stadion-suite 1\nsize 16x12\nwalls desktop\nlook plain\nframes 3\n"
                              "modes sequential pipelined\ncase one\n  show w.evs\n"
                              "case two\n  show w.evs\n");
  ASSERT_EQ(regress({suite, "--update"}).status, 0);
  const std::string junit = folder.path() / "r.xml", out = folder.path() / "out";
  const std::regex warning("w\\.evs:2:[0-9]+: warning: [^\n]*gone\\.obj");
  const auto times = [&](const std::string& text) {
    return std::distance(std::sregex_iterator(text.begin(), text.end(), warning), std::sregex_iterator());
  };
  const ProgramResult table = regress({suite, "--junit", junit, "--out", out});
  EXPECT_EQ(table.status, 0) << table.out << table.err;
  EXPECT_EQ(times(table.out), 1) << table.out;
  EXPECT_NE(table.out.find("1 warnings of shows"), std::string::npos) << table.out;
  const std::string xml = fileContent(junit), page = fileContent(std::filesystem::path(out) / "report.html");
  EXPECT_EQ(times(xml), 1) << xml;
  EXPECT_NE(xml.find("<system-err>"), std::string::npos) << xml;
  EXPECT_EQ(times(page), 1);
  const Json j = Json::parse(regress({suite, "--json"}).out);
  ASSERT_EQ(j["warnings"].size(), 1u) << j["warnings"];
  EXPECT_EQ(j["warnings"][0]["case"], "one/sequential/plain");
  EXPECT_EQ(times(j["warnings"][0]["said"]), 1);
}

TEST(ProgramRegress, AShowWithMistakesIsToldByItsMistakeNotByTheCaretBelowIt) {
  const TemporaryFolder folder;
  folder.write("wrong.evs", "object( nmae=a )\n");
  const ProgramResult r =
      regress({folder.write("wrong.suite", "stadion-suite 1\ncase a\n  show wrong.evs\n  frames 3\n")});
  EXPECT_EQ(r.status, 2) << r.out;
  EXPECT_TRUE(std::regex_search(r.out, std::regex("exit status 2: .*wrong\\.evs:1:[0-9]+: error: ")))
      << r.out;
}

TEST(ProgramRegress, AShowThatChangedIsFoundAgainstItsOldBaseline) {
  const TemporaryFolder folder;
  const auto suiteOf = [&](const std::string& height) {
    folder.write("drop.evs", "rig( position=\"0, -4, 0\" )\nforcelinear( name=g, direction=\"0, 0, -1\" )\n"
                             "dynobject( name=a, file=football.3ds, position=\"0, 0, " +
                                 height + "\", hook=g )\ndynamics( collidee=a )\n");
    return folder.write("drop.suite",
                        "stadion-suite 1\nlook plain\ncase drop\n  show drop.evs\n  frames 5\n  size 16x12\n"
                        "  walls desktop\n  asset-root " +
                            assetFolder() + "\n");
  };
  ASSERT_EQ(regress({suiteOf("2"), "--update"}).status, 0);
  const ProgramResult r = regress({suiteOf("2.001"), "--compare", "state,counts"});
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_NE(r.out.find("history hash"), std::string::npos) << r.out;
}

TEST(ProgramRegress, ReportsForMachinesAreWhatTheyClaimToBe) {
  const TemporaryFolder folder;
  const std::string suite = smallSuite(folder), junit = folder.path() / "r.xml";
  ASSERT_EQ(regress({suite, "--update"}).status, 0);
  const ProgramResult r = regress({suite, "--json", "--junit", junit});
  ASSERT_EQ(r.status, 0) << r.err;
  const Json j = Json::parse(r.out);
  EXPECT_TRUE(j["context"].contains("num_cpus"));
  ASSERT_GE(j["benchmarks"].size(), 1u);
  const Json& b = j["benchmarks"][0];
  EXPECT_EQ(b["name"], kSmallCase);
  EXPECT_EQ(b["time_unit"], "ms");
  ASSERT_TRUE(b["real_time"].is_number() && b["cpu_time"].is_number());
  EXPECT_NE(b["real_time"], b["cpu_time"]) << "one is of the clock, the other of the processor";
  EXPECT_GT(b["cpu_time"], 0);
  EXPECT_TRUE(b["triangles screen left"].is_number());
  EXPECT_TRUE(b["state hash"].is_string());
  const std::string xml = fileContent(junit);
  EXPECT_NE(xml.find("<testsuites name="), std::string::npos) << xml;
  EXPECT_NE(xml.find("tests=\"3\" failures=\"0\" errors=\"0\""), std::string::npos) << xml;
}

TEST(ProgramRegress, ComparesWithAnotherBuild) {
  const TemporaryFolder folder;
  const std::string suite = smallSuite(folder);
  const ProgramResult r = regress({suite, "--against", stadionPath()});
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_NE(r.out.find("equal to the other build"), std::string::npos) << r.out;
}

/// A "build" in which something costs more than in ours.
std::string spoilt(const TemporaryFolder& folder, const std::string& planted) {
  const std::string path =
      folder.write("stadion", "#!/bin/sh\nfor word; do [ \"$word\" = --spans ] && set -- \"$@\" --plant " +
                                  planted + "; done\nexec " + stadionPath() + " \"$@\"\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

std::string crowdSuite(const TemporaryFolder& folder, const std::string& compare) {
  return folder.write("crowd.suite",
                      "stadion-suite 1\nsize 32x24\nstereo off\ncase crowd\n  show " STADION_SOURCE_DIR
                      "/scripts/crowd.evs\n  walls " STADION_SOURCE_DIR
                      "/scripts/suites/two.walls\n  input none\n  frames 40\n  rounds 12\n  compare " +
                          compare + "\n");
}

// Not five percent but several times as much, so that the test does not depend on the machine.
TEST(ProgramFullRegress, ANodeThatBecameDearerIsNamedByItsTime) {
  const TemporaryFolder folder;
  const ProgramResult r = regress({crowdSuite(folder, "times"), "--against", stadionPath(), "--stadion",
                                   spoilt(folder, "simulate:lane_07=2000000")});
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_TRUE(std::regex_search(r.out, std::regex("moved: lane_07 \\(.*crowd.evs:[0-9]+\\) in app")))
      << r.out;
}

/// The typical frame is the same. Three kinds, so that work, sleep, a node and a wall are among them.
TEST(ProgramFullRegress, HitchesAreFoundAndNamedWithTheirFrames) {
  const struct {
    const char *planted, *frames, *moved;
  } kinds[] = {{"simulate:lane_07=sleep20ms/10", "frames 0, 10, 20, 30 longer by 2",
                "moved: lane_07 \\(.*crowd.evs:[0-9]+\\) in app"},
               {"draw:west=20ms/20+3", "frames 3, 23 longer by 2", "moved: draw of wall west"},
               {"frame:=sleep20ms/100+9", "frame 9 longer by 2", "moved: frame, between the stages"}};
  for (const auto& kind : kinds) {
    const TemporaryFolder folder;
    const ProgramResult r = regress(
        {crowdSuite(folder, "times"), "--against", stadionPath(), "--stadion", spoilt(folder, kind.planted)});
    EXPECT_EQ(r.status, 1) << kind.planted << r.out << r.err;
    EXPECT_NE(r.out.find(kind.frames), std::string::npos) << r.out;
    EXPECT_TRUE(std::regex_search(r.out, std::regex(kind.moved))) << r.out;
    EXPECT_NE(r.out.find("again in 12 more rounds"), std::string::npos) << r.out;
  }
}

TEST(ProgramFullRegress, AWallWhoseCullingBecameDearerIsNamedByItsInstructions) {
  if (runProgram({{"valgrind", "--version"}}).status != 0) GTEST_SKIP() << "there is no valgrind";
  const TemporaryFolder folder;
  const ProgramResult r = regress({crowdSuite(folder, "instructions"), "--instructions", "--against",
                                   stadionPath(), "--stadion", spoilt(folder, "cull:west=20000")});
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_NE(r.out.find("moved: cull of wall west"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("4 comparisons passed, 1 failed"), std::string::npos) << r.out;
}

TEST(ProgramFullRegress, AgainstABaselineTheNodeThatMovedIsNamedToo) {
  if (runProgram({{"valgrind", "--version"}}).status != 0) GTEST_SKIP() << "there is no valgrind";
  const TemporaryFolder folder;
  const std::string suite = crowdSuite(folder, "instructions");
  ASSERT_EQ(regress({suite, "--instructions", "--update"}).status, 0);
  const ProgramResult r =
      regress({suite, "--instructions", "--stadion", spoilt(folder, "simulate:lane_07=20000")});
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_TRUE(std::regex_search(r.out, std::regex("moved: lane_07 \\(.*crowd.evs:[0-9]+\\) in app")))
      << r.out;
}

TEST(ProgramFullRegress, AgainstABaselinesTimesTheNodeThatMovedIsNamedToo) {
  const TemporaryFolder folder;
  const std::string suite = crowdSuite(folder, "times");
  ASSERT_EQ(regress({suite, "--update"}).status, 0);
  const ProgramResult r = regress({suite, "--stadion", spoilt(folder, "simulate:lane_07=2000000")});
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_TRUE(std::regex_search(r.out, std::regex("moved: lane_07 \\(.*crowd.evs:[0-9]+\\) in app")))
      << r.out;
}

TEST(ProgramFullRegress, AProgramMayHaveAnyNameWhereInstructionsAreCounted) {
  if (runProgram({{"valgrind", "--version"}}).status != 0) GTEST_SKIP() << "there is no valgrind";
  const TemporaryFolder folder;
  const std::string other = folder.path() / "before the change", link = folder.path() / "now";
  std::filesystem::copy_file(stadionPath(), other);
  std::filesystem::create_symlink(stadionPath(), link);
  const ProgramResult r =
      regress({crowdSuite(folder, "instructions"), "--instructions", "--against", other, "--stadion", link});
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_NE(r.out.find("instructions of app"), std::string::npos) << r.out;
}

/// A baseline for smallSuite() that knows these of its case, too.
void writeBaseline(const TemporaryFolder& folder, const Json& more) {
  ASSERT_EQ(regress({smallSuite(folder), "--update"}).status, 0);
  Json baseline = Json::parse(fileContent(folder.path() / "small.baseline.json"));
  baseline["cases"][kSmallCase].update(more);
  folder.write("small.baseline.json", baseline.dump());
}

/// The program, after which something else is done.
std::string thenDoes(const TemporaryFolder& folder, const std::string& what) {
  const std::string path = folder.write("wrap.sh", "#!/bin/sh\n" + stadionPath() + " \"$@\"\nstatus=$?\n" +
                                                       what + "\nexit $status\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

TEST(ProgramRegress, StoppedJustWhenAProgramHasEndedItSaysSo) {
  const TemporaryFolder folder;
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
  const TemporaryFolder folder;
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
  const TemporaryFolder folder;
  writeBaseline(folder, {{"times", {{"app", {0, 0, 0}}, {"cull of wall screen", Json::array()}}}});
  const ProgramResult r = regress({smallSuite(folder, "  compare state times\n")});
  EXPECT_EQ(r.status, 1) << r.out << r.err;
  EXPECT_NE(r.out.find("the baseline's times of it cannot be compared with"), std::string::npos) << r.out;
}

TEST(ProgramRegress, AfterHalfALineOfHistoryTheNextRunHasOneOfItsOwn) {
  const TemporaryFolder folder;
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
    const TemporaryFolder folder;
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
  const TemporaryFolder folder;
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
  const TemporaryFolder folder;
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
  const TemporaryFolder folder;
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
  EXPECT_EQ(r.err.find("begins anew"), std::string::npos) << progress;
  EXPECT_EQ(Json::parse(r.out)["benchmarks"].size(), 6u);
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::path(out) / "progress.jsonl"));
  EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(out) / "report.html"));
}

TEST(ProgramRegress, AnInterruptedSuiteBeginsAnewWhenAShowHasChangedMeanwhile) {
  const TemporaryFolder folder;
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
  EXPECT_NE(r.err.find("begins anew"), std::string::npos) << r.err;
}

TEST(ProgramRegress, WrongUseAndWrongSuitesAreToldWithTheFix) {
  const TemporaryFolder folder;
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
  const TemporaryFolder folder;
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
  const TemporaryFolder folder;
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
  const TemporaryFolder folder;
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
  const TemporaryFolder folder;
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
  const TemporaryFolder folder;
  const std::string suite = smallSuite(folder);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--junit", "nowhere/results.xml"},
                                                {"--update", "--baseline", "nowhere/b.json"}}) {
    std::vector<std::string> all{suite};
    all.insert(all.end(), words.begin(), words.end());
    const ProgramResult r = regress(all);
    EXPECT_EQ(r.status, 2) << r.err;
    EXPECT_NE(r.err.find("cannot be written"), std::string::npos) << r.err;
    EXPECT_EQ(r.out, "");
  }
}

TEST(ProgramRegress, EverythingThatIsCountedIsCompared) {
  const TemporaryFolder folder;
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
  const TemporaryFolder folder;
  const ProgramResult r = regress({smallSuite(folder), "--stadion", "/bin/false"});
  EXPECT_EQ(r.status, 3) << r.out << r.err;
  EXPECT_NE(r.out.find("/bin/false: exit status 1"), std::string::npos) << r.out;
}

}  // namespace
}  // namespace stadion
