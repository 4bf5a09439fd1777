/// Files that a run writes: where they cannot be written, and files that it must not write over.

#include "tests/cli/short_run.h"

#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

namespace stadion {
namespace {

TEST(ProgramUsage, APictureThatCannotBeWrittenIsNamedOnce) {
  const TestFolder folder;
  // A folder is in the place of a picture.
  std::filesystem::create_directory(folder.path() / "screen-left-000002.png");
  const ProgramResult r =
      stadionProgram(shortRun(testShow("bodies.evs"), {"--out", folder.path(), "--pictures", "1", "--json"}));
  EXPECT_EQ(r.status, 2) << r.err;
  const std::string complaint = "screen-left-000002.png: cannot be written";
  const std::size_t first = r.err.find(complaint);
  ASSERT_NE(first, std::string::npos) << r.err;
  EXPECT_EQ(r.err.find(complaint, first + 1), std::string::npos) << r.err;
  EXPECT_TRUE(has(nlohmann::json::parse(r.out).at("failure"), complaint)) << r.out;
}

TEST(ProgramUsage, AFurtherRunRemovesTheFilesOfTheRunBeforeAndNoOthers) {
  const TestFolder folder;
  folder.write("screen-left-000099.png", "somebody's own");
  const auto run = [&](const char* frames) {
    return stadionProgram(
        shortRun(testShow("bodies.evs"), {"--out", folder.path(), "--pictures", "all"}, frames));
  };
  const auto exists = [&](const char* name) { return std::filesystem::exists(folder.path() / name); };
  ASSERT_EQ(run("5").status, 0);
  EXPECT_TRUE(exists("screen-left-000004.png"));
  folder.write("notes.txt", "somebody's own");
  const ProgramResult second = run("3");
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_TRUE(has(second.err, "removed 12 files of an earlier run")) << second.err;
  EXPECT_TRUE(exists("screen-left-000002.png"));
  EXPECT_FALSE(exists("screen-left-000003.png"));
  EXPECT_FALSE(exists("screen-right-000004.png"));
  EXPECT_TRUE(exists("screen-left-000099.png"));
  EXPECT_TRUE(exists("notes.txt"));
}

TEST(ProgramUsage, AListOfFilesDoesNotReachOutOfItsFolder) {
  const TestFolder folder;
  const std::string outside = folder.write("outside.txt", "somebody's own");
  const std::string out = folder.path() / "out";
  folder.write("out/.stadion-files", "stadion-files 1\n../outside.txt\n" + outside + "\n..\n");
  ASSERT_EQ(stadionProgram(shortRun(testShow("bodies.evs"), {"--out", out})).status, 0);
  EXPECT_TRUE(std::filesystem::exists(outside));
  // And a list that is none is left alone.
  folder.write("out/.stadion-files", "shopping\n");
  const ProgramResult r = stadionProgram(shortRun(testShow("bodies.evs"), {"--out", out}));
  EXPECT_EQ(r.status, 2);
  EXPECT_EQ(fileContent(out + "/.stadion-files"), "shopping\n");
}

TEST(ProgramUsage, AnOutputFolderThatCannotBeMadeIsBadInput) {
  const TestFolder folder;
  const std::string file = folder.write("file", "in the way");
  for (const std::string& out : {file, file + "/below", std::string("/proc/stadion-pictures")}) {
    const ProgramResult r = stadionProgram(shortRun(testShow("bodies.evs"), {"--out", out}));
    EXPECT_EQ(r.status, 2) << out << r.err;
    EXPECT_TRUE(has(r.err, out)) << r.err;
  }
}

TEST(ProgramUsage, AnOutputFolderThatTakesNoFilesIsFoundOutBeforePlaying) {
  // A folder that exists, but in which even root makes no file.
  const ProgramResult r = stadionProgram({"run", testShow("bodies.evs"), "--asset-root", assetFolder(),
                                          "--size", "32x24", "--frames", "10000000", "--out", "/proc/self"});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "/proc/self")) << r.err;
  EXPECT_LT(r.seconds, 60) << "so many frames take minutes";
}

TEST(ProgramUsage, ForAVideoThatCannotBeMadeNothingIsDrawn) {
  const TestFolder folder;
  const ProgramResult r = runProgram(
      {{stadionPath(), "run", testShow("moving.evs"), "--input", "none", "--walls", "desktop", "--size",
        "64x48", "--frames", "2000", "--json", "--video", "--out", folder.path() / "out"},
       {"PATH=/nowhere"}});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(has(r.out, "ffmpeg is not installed")) << r.out << r.err;
  EXPECT_LT(nlohmann::json::parse(r.out).at("frames_drawn"), 1000);
}

TEST(ProgramUsage, NothingButAnInputLogIsReplacedByAnInputLog) {
  const TestFolder folder;
  const std::string show = folder.write("show.evs", "group( name=a )\n"),
                    log = folder.write("old.input", "stadion-input 1\npose head 0  0 0 1.7  1 0 0 0\n");
  const auto record = [&](const std::string& file, const std::string& input) {
    return stadionProgram({"run", show, "--input", input, "--frames", "1", "--size", "64x48", "--walls",
                           "desktop", "--record-input", file});
  };
  ProgramResult r = record(show, "none");
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "name the same file")) << r.err;
  EXPECT_EQ(fileContent(show), "group( name=a )\n");
  r = record(log, log);
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "name the same file")) << r.err;
  EXPECT_EQ(record(log, "none").status, 0);
  EXPECT_FALSE(has(fileContent(log), "1.7"));
}

/// A folder for --out in which the file `name` is a link to `file`.
std::string outLinkedTo(const TestFolder& folder, const std::string& name, const std::string& file) {
  static int made = 0;
  const std::filesystem::path out = folder.path() / ("linked" + std::to_string(++made));
  std::filesystem::create_directory(out);
  std::filesystem::create_symlink(file, out / name);
  return out;
}

TEST(ProgramUsage, WhatIsReadIsNotWrittenOver) {
  const TestFolder folder;
  const std::string show = folder.write("a.evs", "group( name=a )\n"),
                    suite = folder.write("a.suite", "case( name=a, show=a.evs )\n");
  for (const ProgramResult& r :
       {stadionProgram({"plan", show, "--out", outLinkedTo(folder, "plan.svg", show)}),
        stadionProgram({"regress", suite, "--out", outLinkedTo(folder, "junit.xml", suite)})}) {
    EXPECT_EQ(r.status, 2) << r.err;
    EXPECT_TRUE(has(r.err, "name the same file")) << r.err;
  }
  EXPECT_EQ(fileContent(show), "group( name=a )\n");
  EXPECT_EQ(fileContent(suite), "case( name=a, show=a.evs )\n");
}

TEST(ProgramUsage, WhatIsReadWithoutBeingNamedIsNotWrittenOver) {
  const TestFolder folder;
  const auto at = [&](const std::string& name) { return (folder.path() / name).string(); };
  const std::string walls = fileContent(STADION_SOURCE_DIR "/walls/desktop.walls"),
                    log = fileContent(STADION_SOURCE_DIR "/scripts/kick.input");
  const std::map<std::string, std::string> files = {
      {"a.evs", "group( name=a )\n"},
      {"a.input", log},
      {"my.walls", walls},
      {"a.suite", "stadion-suite 1\ncase one\n  show a.evs\n  walls my.walls\n  frames 3\n"},
      {"a.baseline.json", "{}\n"}};
  for (const auto& [name, content] : files) folder.write(name, content);
  std::filesystem::create_symlink("a.input", at("linked"));
  const std::string show = at("a.evs"), suite = at("a.suite");
  std::vector<std::vector<std::string>> all;
  for (const std::string output : {"a.input", "./my.walls", "linked", "a.evs"}) {
    const auto linked = [&](const char* name) { return outLinkedTo(folder, name, at(output)); };
    for (const auto& [option, value] : {std::pair{"--out", linked("profile.html")}, {"--trace", at(output)}})
      all.push_back(
          {"profile", show, "--frames", "9", "--gl", "none", "--walls", at("my.walls"), option, value});
    for (const char* option : {"--trace", "--black-box", "--record-input", "--spans"})
      all.push_back(
          {"run", show, "--frames", "9", "--gl", "none", "--walls", at("my.walls"), option, at(output)});
    all.push_back({"plan", show, "--walls", at("my.walls"), "--frames", "3", "--out", linked("plan.svg")});
    all.push_back({"regress", suite, "--out", linked("junit.xml")});
  }
  const std::string overBaseline = outLinkedTo(folder, "junit.xml", at("a.baseline.json"));
  all.push_back({"regress", suite, "--out", overBaseline});
  all.push_back({"regress", suite, "--against", stadionPath(), "--out", overBaseline});
  all.push_back({"regress", suite, "--update", "--baseline", at("o/results.json"), "--out", at("o")});
  all.push_back({"run", show, "--frames", "9", "--walls", "desktop", "--out", at("o"), "--trace",
                 at("o/summary.json")});
  for (const auto& words : all) {
    const ProgramResult r = stadionProgram(words);
    EXPECT_EQ(r.status, 2) << words.at(0) << r.out;
    EXPECT_TRUE(has(r.err, "name the same file")) << words.at(0) << " " << words.back() << "\n" << r.err;
  }
  for (const auto& [name, content] : files) EXPECT_EQ(fileContent(at(name)), content) << name;
}

/// A show with a sub-scene that names a model, which names materials, which name a picture; and a sound.
std::map<std::string, std::string> filesWithFilesInThem() {
  return {{"show/main.evs", "rig( name=stand )\nscene( name=part, file=parts/part.evs )\n"},
          {"show/parts/part.evs", "object( name=a, file=ball/ball.obj )\nsound( name=s, file=hiss.wav )\n"},
          {"assets/ball/ball.obj", "mtllib ball.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"},
          {"assets/ball/ball.mtl", "newmtl m\nmap_Kd skins/leather.png\n"},
          {"assets/ball/skins/leather.png", "a picture"},
          {"assets/ball/skins/leather.pn", "unrelated"},
          {"assets/hiss.wav", "a sound"},
          {"show/main.suite", "stadion-suite 1\ncase one\n  show main.evs\n  frames 3\n"},
          {"show/out/walls-left-000012.png", "unrelated"}};
}

TEST(ProgramUsage, WhatSubScenesAndModelsReadIsNotWrittenOver) {
  const TestFolder folder;
  const auto at = [&](const std::string& name) { return (folder.path() / name).string(); };
  const std::map<std::string, std::string> files = filesWithFilesInThem();
  for (const auto& [name, content] : files) folder.write(name, content);
  std::filesystem::create_symlink("ball/ball.obj", at("assets/linked"));
  const std::string show = at("show/main.evs");
  const std::map<std::string, std::string> read = {
      {"show/parts/part.evs", "main.evs:2:24 and "}, {"assets/ball/ball.obj", "part.evs:1:22 and "},
      {"assets/linked", "part.evs:1:22 and "},       {"assets/hiss.wav", "part.evs:2:21 and "},
      {"assets/ball/ball.mtl", "ball.obj and "},     {"assets/ball/skins/leather.png", "ball.obj and "}};
  const auto refused = [&](const std::vector<std::string>& words, const std::string& why) {
    const ProgramResult r = stadionProgram(words);
    EXPECT_EQ(r.status, 2) << words.back() << r.out;
    EXPECT_TRUE(has(r.err, why) && has(r.err, "name the same file")) << words.back() << "\n" << r.err;
  };
  for (const auto& [name, why] : read) {
    const auto linked = [&](const char* output) { return outLinkedTo(folder, output, at(name)); };
    refused({"profile", show, "--frames", "9", "--gl", "none", "--trace", at(name)}, why + "--trace");
    refused({"profile", show, "--frames", "9", "--gl", "none", "--out", linked("profile.html")},
            why + "--out's profile.html");
    for (const char* option : {"--trace", "--black-box", "--record-input", "--spans"})
      refused({"run", show, "--frames", "9", "--gl", "none", option, at(name)}, why + option);
    refused({"plan", show, "--frames", "3", "--out", linked("plan.svg")}, why + "--out's plan.svg");
    refused({"regress", at("show/main.suite"), "--out", linked("junit.xml")}, why + "--out's junit.xml");
  }
  for (const auto& [name, content] : files) EXPECT_EQ(fileContent(at(name)), content) << name;
  const ProgramResult beside = stadionProgram({"profile", show, "--frames", "9", "--gl", "none", "--walls",
                                               "desktop", "--trace", at("assets/ball/skins/leather.pn")});
  EXPECT_EQ(beside.status, 0) << "the show does not read that one\n" << beside.err;
}

TEST(ProgramUsage, PicturesWhoseNamesAModelWritesInPercentsAreNotWrittenOver) {
  const TestFolder folder;
  const std::string picture = folder.write("leaf gold.png", "a picture");
  folder.write("a.gltf", R"({"asset": {"version": "2.0"}, "images": [{"uri": "leaf%20gold.png"}]})");
  const std::string show = folder.write("a.evs", "rig( name=r )\nobject( name=a, file=a.gltf )\n");
  const ProgramResult r =
      stadionProgram({"plan", show, "--frames", "3", "--out", outLinkedTo(folder, "plan.svg", picture)});
  EXPECT_EQ(r.status, 2) << r.out;
  EXPECT_TRUE(has(r.err, "a.gltf and --out's plan.svg name the same file")) << r.err;
  EXPECT_EQ(fileContent(picture), "a picture");
}

TEST(ProgramUsage, PicturesThatAShowReadsAreNotWrittenOverByThoseOfARun) {
  const TestFolder folder;
  const std::string picture = folder.write("skins/screen-left-000002.png", "a picture");
  folder.write("a.mtl", "newmtl m\nmap_Kd skins/screen-left-000002.png\n");
  folder.write("a.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string show = folder.write("a.evs", "rig( name=r )\nobject( name=a, file=a.obj )\n");
  const ProgramResult r = stadionProgram(shortRun(show, {"--out", folder.path() / "skins"}));
  EXPECT_EQ(r.status, 2) << r.out;
  EXPECT_TRUE(has(r.err, "a.obj and --out's screen-left-000002.png name the same file")) << r.err;
  EXPECT_EQ(fileContent(picture), "a picture");
}

TEST(ProgramUsage, AnEmptyWordIsNoFolder) {
  const ProgramResult r = stadionProgram(shortRun(testShow("moving.evs"), {"--out", ""}));
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "--out")) << r.err;
}

TEST(ProgramUsage, AnInputLogThatCannotBeWrittenIsRefusedAtTheStart) {
  const ProgramResult r = stadionProgram(shortRun(testShow("moving.evs"), {"--record-input", "/nope/x"}));
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "--record-input: /nope/x cannot be written")) << r.err;
  EXPECT_EQ(r.out, "");
}

}  // namespace
}  // namespace stadion
