/// What the program answers when something is wrong with what it was given, and how it ends.

#include "tests/cli/program.h"

#include <csignal>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Arguments for a short, small run of one of the test shows.
std::vector<std::string> shortRun(const std::string& show, std::vector<std::string> more = {}) {
  std::vector<std::string> words{"run",     show,     "--asset-root", assetFolder(), "--walls",
                                 "desktop", "--size", "32x24",        "--frames",    "5"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(ProgramUsage, AnUnknownOptionIsNamedAndIsBadUsage) {
  const ProgramResult r = stadionProgram({"run", testShow("bodies.evs"), "--wals", "cave4"});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "--wals")) << r.err;
  EXPECT_EQ(r.out, "");
}

TEST(ProgramUsage, AnUnknownSubcommandIsBadUsage) {
  const ProgramResult r = stadionProgram({"chekc"});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "\"chekc\"; did you mean \"check\"?")) << r.err;
}

TEST(ProgramUsage, NoArgumentsAtAllIsBadUsage) {
  EXPECT_EQ(stadionProgram({}).status, 2);
}

TEST(ProgramUsage, HelpIsNotAnError) {
  const ProgramResult r = stadionProgram({"run", "--help"});
  EXPECT_EQ(r.status, 0);
  EXPECT_TRUE(has(r.out, "--walls"));
}

TEST(ProgramUsage, AMissingScriptIsNamed) {
  for (const char* command : {"run", "hash", "check"}) {
    const ProgramResult r = stadionProgram({command, "/nowhere/missing.evs"});
    EXPECT_EQ(r.status, 2) << command;
    EXPECT_TRUE(has(r.out + r.err, "missing.evs")) << command << r.out << r.err;
    EXPECT_TRUE(has(r.out + r.err, "error")) << command << r.out << r.err;
  }
}

TEST(ProgramUsage, AFolderIsNotAScript) {
  for (const char* command : {"run", "hash", "check"})
    EXPECT_EQ(stadionProgram({command, assetFolder()}).status, 2) << command;
}

TEST(ProgramUsage, AWrongScriptIsNotPlayed) {
  const TemporaryFolder folder;
  const std::string script = folder.write("wrong.evs", "dynobject( name=a, densty=2 )\n");
  for (const char* command : {"run", "hash", "check"}) {
    const ProgramResult r = stadionProgram({command, script});
    EXPECT_EQ(r.status, 2) << command;
    EXPECT_TRUE(has(r.out + r.err, "wrong.evs:1:20: error: ")) << command << r.out << r.err;
  }
}

TEST(ProgramUsage, ABadWallFileIsShownWithItsLine) {
  const TemporaryFolder folder;
  const std::string walls = folder.write("bad.walls", "unit m\nwall front lower-left 0 0\n");
  const ProgramResult r = stadionProgram({"run", testShow("bodies.evs"), "--walls", walls, "--frames", "2"});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "bad.walls:2:")) << r.err;
  EXPECT_EQ(stadionProgram({"walls", walls}).status, 2);
}

TEST(ProgramUsage, AnUnknownWallSetIsNamed) {
  const ProgramResult r =
      stadionProgram({"run", testShow("bodies.evs"), "--walls", "cave5", "--frames", "2"});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "cave5")) << r.err;
}

TEST(ProgramUsage, SizesThatMakeNoSenseAreRefused) {
  for (const char* size : {"0x0", "800", "-1x5", "800x600x2", "99999999999x2", "axb"})
    EXPECT_EQ(stadionProgram({"run", testShow("bodies.evs"), "--frames", "2", "--size", size}).status, 2)
        << size;
}

TEST(ProgramUsage, ABadInputLogIsShownWithItsLine) {
  const TemporaryFolder folder;
  const std::string log = folder.write("bad.input", "stadion-input 1\npose head x\n");
  const ProgramResult r = stadionProgram({"run", testShow("bodies.evs"), "--input", log});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "bad.input:2:")) << r.err;
}

TEST(ProgramUsage, AnOutputFolderThatCannotBeMadeIsBadInput) {
  const TemporaryFolder folder;
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
                                          "--size", "32x24", "--frames", "100000", "--out", "/proc/self"});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "/proc/self")) << r.err;
  EXPECT_LT(r.seconds, 10);
}

TEST(ProgramUsage, AMissingModelIsAStandInInRunAndAnErrorInCheck) {
  const TemporaryFolder folder;
  const std::string script =
      folder.write("show.evs", "object( file=nothing_here.obj )\nobject( file=football.3ds )\n");
  const ProgramResult run = stadionProgram(shortRun(script, {"--json"}));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(has(run.err, "show.evs:1:")) << run.err;
  EXPECT_TRUE(has(run.err, "warning")) << run.err;
  EXPECT_TRUE(has(run.err, "nothing_here.obj")) << run.err;
  EXPECT_TRUE(has(run.err, "stand-in")) << run.err;

  const ProgramResult check = stadionProgram({"check", script, "--asset-root", assetFolder()});
  EXPECT_EQ(check.status, 2);
  EXPECT_TRUE(has(check.out, "show.evs:1:")) << check.out;
  EXPECT_TRUE(has(check.out, "error")) << check.out;
}

TEST(ProgramUsage, JsonIsOneObjectOnStdoutAndNothingElse) {
  const TemporaryFolder folder;
  const std::string pictures = folder.path() / "pictures";
  const ProgramResult r =
      stadionProgram(shortRun(testShow("moving.evs"), {"--json", "--profile", "--out", pictures}));
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(std::count(r.out.begin(), r.out.end(), '\n'), 1);
  const auto summary = nlohmann::json::parse(r.out);  // throws on anything behind the object
  EXPECT_TRUE(summary.is_object());
  EXPECT_EQ(summary.at("frames"), 5);
  // The same summary lies beside the pictures.
  EXPECT_EQ(nlohmann::json::parse(fileContent(pictures + "/summary.json")).at("state_hash"),
            summary.at("state_hash"));
}

TEST(ProgramUsage, InterruptsEndTheShowWithItsSummary) {
  for (const int signal : {SIGINT, SIGTERM})
    for (const char* mode : {"sequential", "pipelined"}) {
      ProgramRun run;
      run.words = {stadionPath(),  "run",         testShow("reload_with.evs"),
                   "--asset-root", assetFolder(), "--size",
                   "64x48",        "--walls",     "desktop",
                   "--json",       "--mode",      mode};
      run.signal = signal;
      run.signalAfter = std::chrono::milliseconds(1500);
      run.limit = std::chrono::seconds(30);
      const ProgramResult r = runProgram(run);
      ASSERT_EQ(r.status, 0) << mode << r.err;
      const auto summary = nlohmann::json::parse(r.out);
      EXPECT_GT(summary.at("frames"), 1);
      EXPECT_TRUE(has(r.out, "stopped by request")) << r.out;
      EXPECT_LT(r.seconds, 10);
      // The importer is a child in its own process group: it must not have been torn down with a complaint.
      EXPECT_FALSE(has(r.err, "importer")) << r.err;
    }
}

TEST(ProgramUsage, CheckSaysNothingWrongOfTheTestShows) {
  const ProgramResult r = stadionProgram({"check", testShow("moving.evs"), testShow("bodies.evs"),
                                          testShow("reload_with.evs"), "--asset-root", assetFolder()});
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_FALSE(has(r.out, "warning")) << r.out;
}

}  // namespace
}  // namespace stadion
