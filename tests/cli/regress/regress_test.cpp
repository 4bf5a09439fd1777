/// `stadion regress`, as CI uses it: baselines and comparisons.

#include "tests/cli/regress/small_suite.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <regex>

namespace stadion {
namespace {

const std::string kBasic = STADION_SOURCE_DIR "/scripts/suites/basic.suite";

TEST(ProgramRegress, TheShippedSuiteHasTheHashesAndCountsOfItsBaseline) {
  const ProgramResult r = regress({kBasic});
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_NE(r.out.find("kick/pipelined"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find(" 0 failed"), std::string::npos) << r.out;
}

TEST(ProgramRegress, WritesABaselineAndThenAgreesWithIt) {
  const TestFolder folder;
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
  const TestFolder folder;
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
  const TestFolder folder;
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
std::string pairSuite(const TestFolder& folder, const std::string& second = "b") {
  const std::string show = "\n  show " + testShow("bodies.evs") + "\n  frames 5\n";
  return folder.write("pair.suite", "stadion-suite 1\nsize 32x24\nwalls desktop\nlook plain\nasset-root " +
                                        assetFolder() + "\ncase a" + show +
                                        "  modes sequential pipelined\ncase " + second + show);
}

TEST(ProgramRegress, WhatAnUpdateDoesNotCompareStaysInTheBaselineAsItWas) {
  const TestFolder folder;
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
  const TestFolder folder;
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
  const TestFolder folder;
  const std::string thesis = folder.write("thesis.txt", "the only copy");
  const ProgramResult r = regress({smallSuite(folder), "--baseline", thesis, "--update"});
  EXPECT_EQ(r.status, 2) << r.out << r.err;
  EXPECT_NE(r.err.find("is no baseline"), std::string::npos) << r.err;
  EXPECT_EQ(fileContent(thesis), "the only copy");
}

TEST(ProgramRegress, WhatAShowWarnsOfIsToldOnceAndFailsNothing) {
  const TestFolder folder;
  folder.write("w.evs", "rig( position=\"0, -4, 0\" )\nobject( name=a, file=gone.obj )\n");
  const std::string suite =
      folder.write("w.suite", "stadion-suite 1\nsize 16x12\nwalls desktop\nlook plain\nframes 3\n"
                              "modes sequential pipelined\ncase one\n  show w.evs\n"
                              "case two\n  show w.evs\n");
  ASSERT_EQ(regress({suite, "--update"}).status, 0);
  const std::string out = folder.path() / "out", junit = out + "/junit.xml";
  const std::regex warning("w\\.evs:2:[0-9]+: warning: [^\n]*gone\\.obj");
  const auto times = [&](const std::string& text) {
    return std::distance(std::sregex_iterator(text.begin(), text.end(), warning), std::sregex_iterator());
  };
  const ProgramResult table = regress({suite, "--out", out});
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
  const TestFolder folder;
  folder.write("wrong.evs", "object( nmae=a )\n");
  const ProgramResult r =
      regress({folder.write("wrong.suite", "stadion-suite 1\ncase a\n  show wrong.evs\n  frames 3\n")});
  EXPECT_EQ(r.status, 2) << r.out;
  EXPECT_TRUE(std::regex_search(r.out, std::regex("exit status 2: .*wrong\\.evs:1:[0-9]+: error: ")))
      << r.out;
}

TEST(ProgramRegress, AShowThatChangedIsFoundAgainstItsOldBaseline) {
  const TestFolder folder;
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
  const TestFolder folder;
  const std::string suite = smallSuite(folder), out = folder.path() / "out", junit = out + "/junit.xml";
  ASSERT_EQ(regress({suite, "--update"}).status, 0);
  const ProgramResult r = regress({suite, "--json", "--out", out});
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
  const TestFolder folder;
  const std::string suite = smallSuite(folder);
  const ProgramResult r = regress({suite, "--against", stadionPath()});
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_NE(r.out.find("equal to the other build"), std::string::npos) << r.out;
}

TEST(ProgramRegress, SaysInWhichFrameNodeAndFieldStatesBeginToDiffer) {
  const TestFolder folder;
  const std::string here =
      folder.write("a.input", "stadion-input 1\nkey foot 0 1 2 0.5\nkey foot 1 1 2 0.5\n");
  const std::string there =
      folder.write("b.input", "stadion-input 1\nkey foot 0 1 2 0.5\nkey foot 1 1 2.5 0.5\n");
  const std::string suite = folder.write(
      "s.suite", "stadion-suite 1\nsize 32x24\nwalls desktop\nlook plain\ncompare state\nmodes sequential\n"
                 "case kick\n  show " STADION_SOURCE_DIR "/scripts/kick.evs\n  input " +
                     here + "\n  frames 20\n");
  const std::string other = folder.path() / "other";
  folder.write("other", "#!/bin/sh\nexec " + stadionPath() + " $(echo \"$@\" | sed 's#" + here + "#" + there +
                            "#')\n");
  std::filesystem::permissions(other, std::filesystem::perms::owner_all);

  const ProgramResult builds = regress({suite, "--against", other});
  EXPECT_EQ(builds.status, 1) << builds.out << builds.err;
  const std::regex place("first in frame [1-3]: [^;]*kick\\.evs:[0-9]+\\), [^;]* now, [^;]* before");
  EXPECT_TRUE(std::regex_search(builds.out, place)) << builds.out;

  ASSERT_EQ(regress({suite, "--update", "--stadion", other}).status, 0);
  const ProgramResult since = regress({suite});
  EXPECT_EQ(since.status, 1) << since.out << since.err;
  EXPECT_TRUE(std::regex_search(
      since.out, std::regex("first in frame [1-3]; after frame 4: [^;]*kick\\.evs:[0-9]+\\), [^;]* is [^;]* "
                            "now, [^;]* before")))
      << since.out;
}

/// A show whose ball begins `more` metres farther up, and in a later line.
std::string ballShow(const TestFolder& folder, const std::string& file, double more) {
  return folder.write(
      file, (more > 0 ? "# a remark\n" : "") +
                std::string("forcelinear( name=gravity, direction=\"0, 0, -1\" )\n"
                            "usertrigger( sphere=\"0, 0, 0, 5\", eventmessage=\"enter, gravity, enable\" )\n"
                            "object( name=floor, file=plane.3ds )\n"
                            "dynobject( name=ball, file=football.3ds, position=\"0, 6, ") +
                std::to_string(3 + more) +
                "\", density=0.08, hook=gravity )\ndynamics( collider=floor, collidee=ball )\n");
}

/// The files differ, too: that must not hide the node.
TEST(ProgramRegress, ABallThatWasMovedInTheScriptIsNamedInTheFirstFrame) {
  const TestFolder folder;
  ballShow(folder, "show.evs", 0);
  const std::string suite = folder.write(
      "s.suite", "stadion-suite 1\nsize 32x24\nwalls desktop\nlook plain\ncompare state\nmodes sequential\n"
                 "case ball\n  show show.evs\n  asset-root " +
                     assetFolder() + "\n  frames 20\n  input none\n");
  ASSERT_EQ(regress({suite, "--update"}).status, 0);
  ballShow(folder, "show.evs", 0.001);
  const std::regex place(
      "first in frame 0: ball \\([^;]*:5\\), place\\.position is 0 6 3\\.00[01][0-9]* now, "
      "0 6 3 before");
  const ProgramResult since = regress({suite});
  EXPECT_EQ(since.status, 1) << since.err;
  EXPECT_TRUE(std::regex_search(since.out, place)) << since.out;

  const std::string old = ballShow(folder, "old.evs", 0), other = folder.path() / "other";
  folder.write("other", "#!/bin/sh\nexec " + stadionPath() + " $(echo \"$@\" | sed 's#show.evs#old.evs#')\n");
  std::filesystem::permissions(other, std::filesystem::perms::owner_all);
  const ProgramResult builds = regress({suite, "--against", other});
  EXPECT_EQ(builds.status, 1) << builds.err;
  EXPECT_TRUE(std::regex_search(builds.out, place)) << builds.out;
}

TEST(ProgramHash, ADamagedStateEndsWithTwo) {
  const TestFolder folder;
  const std::string state = folder.path() / "state", show = ballShow(folder, "ball.evs", 0);
  const auto hash = [&](const std::string& option) {
    return stadionProgram({"hash", show, "--asset-root", assetFolder(), "--input", "none", "--frames", "2",
                           "--json", option, state});
  };
  ASSERT_EQ(hash("--save-state").status, 0);
  ASSERT_EQ(hash("--compare-state").status, 0);
  std::filesystem::resize_file(state, std::filesystem::file_size(state) * 2 / 3);
  const ProgramResult r = hash("--compare-state");
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, state + ": error: is damaged")) << r.err;
  EXPECT_TRUE(has(r.out, "{\"error\":")) << r.out;
}

TEST(ProgramHash, NamesAnAddedNode) {
  const TestFolder folder;
  const std::string state = folder.path() / "state", show = ballShow(folder, "ball.evs", 0);
  const auto hash = [&](const std::string& option) {
    return stadionProgram(
        {"hash", show, "--asset-root", assetFolder(), "--input", "none", "--frames", "1", option, state});
  };
  ASSERT_EQ(hash("--save-state").status, 0);
  folder.write("ball.evs", "group( name=extra )\n" + fileContent(show));
  const ProgramResult r = hash("--compare-state");
  EXPECT_EQ(r.status, 1);
  EXPECT_TRUE(std::regex_search(
      r.out, std::regex("difference: the number of nodes \"extra\" \\(.*ball.evs:1\\) is 1 here and 0 in ")))
      << r.out;
}

TEST(ProgramHash, ComparesTheStateOfAnEditedShowAndTellsOtherFramesApart) {
  const TestFolder folder;
  const std::string state = folder.path() / "state";
  const auto hash = [&](const std::string& show, const std::string& frames, const std::string& option) {
    return stadionProgram(
        {"hash", show, "--asset-root", assetFolder(), "--input", "none", "--frames", frames, option, state});
  };
  const std::string old = ballShow(folder, "old.evs", 0), edited = ballShow(folder, "new.evs", 0.001);
  ASSERT_EQ(hash(old, "1", "--save-state").status, 0);
  EXPECT_EQ(hash(old, "1", "--compare-state").status, 0);
  const ProgramResult moved = hash(edited, "1", "--compare-state");
  EXPECT_EQ(moved.status, 1);
  EXPECT_TRUE(
      std::regex_search(moved.out, std::regex("difference: ball \\(.*new.evs:5\\), place\\.position is ")))
      << moved.out;
  const ProgramResult later = hash(old, "4", "--compare-state");
  EXPECT_EQ(later.status, 1);
  EXPECT_NE(later.out.find("difference: the frame is 3 here and 0 in "), std::string::npos) << later.out;
}

}  // namespace
}  // namespace stadion
