/// What the program answers when something is wrong with what it was given, and how it ends.

#include "tests/cli/short_run.h"

#include <csignal>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

namespace stadion {
namespace {

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

TEST(ProgramUsage, AReaderThatHasSeenEnoughIsNoFault) {
  const auto ends = [](const std::string& output) {
    return runProgram({{"/bin/bash", "-c", "\"$@\" " + output + "; echo status ${PIPESTATUS[0]} >&2", "bash",
                        stadionPath(), "run", testShow("bodies.evs"), "--asset-root", assetFolder(),
                        "--walls", "desktop", "--size", "32x24", "--look", "plain", "--frames", "2"}})
        .err;
  };
  const std::string closed = ends("| true");
  EXPECT_TRUE(has(closed, "status 141") || has(closed, "status 0")) << closed;
  EXPECT_FALSE(has(closed, "cannot be written")) << closed;
  const std::string full = ends(">/dev/full");
  EXPECT_TRUE(has(full, "the standard output cannot be written: No space left on device")) << full;
  EXPECT_TRUE(has(full, "status 2")) << full;
}

/// Loading them took more than half of a program's start.
TEST(ProgramUsage, AStartLoadsNoLibraryThatOnlySomeShowsNeed) {
  ProgramRun run{{stadionPath(), "--version"}};
  run.environment = {"LD_TRACE_LOADED_OBJECTS=1"};
  const ProgramResult r = runProgram(run);
  ASSERT_TRUE(has(r.out, "libstdc++")) << r.out << r.err;
  for (const char* late : {"libcrypto", "libssl", "libcpp-httplib", "libzip", "libsndfile", "libddsc"})
    EXPECT_FALSE(has(r.out, late)) << r.out;
}

TEST(ProgramUsage, HelpIsNotAnError) {
  const ProgramResult r = stadionProgram({"run", "--help"});
  EXPECT_EQ(r.status, 0);
  EXPECT_TRUE(has(r.out, "--walls"));
}

TEST(ProgramUsage, WhatIsWrongWithAPartThatComesAndGoesIsToldOnce) {
  const ProgramResult r = stadionProgram({"hash", testShow("moving.evs"), "--frames", "300"});
  EXPECT_EQ(r.status, 0);
  const std::size_t first = r.err.find("part.evs:3:14: warning: there is no asset");
  ASSERT_NE(first, std::string::npos) << r.err;
  EXPECT_EQ(r.err.find("part.evs:3:14: warning", first + 1), std::string::npos) << r.err;
}

TEST(ProgramUsage, AMissingScriptIsNamed) {
  for (const char* command : {"run", "hash", "check"}) {
    const ProgramResult r = stadionProgram({command, "/nowhere/missing.evs"});
    EXPECT_EQ(r.status, 2) << command;
    EXPECT_TRUE(has(r.out + r.err, "missing.evs")) << command << r.out << r.err;
    EXPECT_TRUE(has(r.out + r.err, "error")) << command << r.out << r.err;
  }
}

TEST(ProgramUsage, ATraceThatIsNamedTwiceIsRefused) {
  const TestFolder folder;
  const std::string trace = folder.write("trace-a.json", "{}"), merged = folder.path() / "merged.json";
  const ProgramResult r = stadionProgram({"merge-traces", trace, trace, "--trace", merged});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "trace-a.json: error: is named twice")) << r.err;
  EXPECT_FALSE(std::filesystem::exists(merged));
}

TEST(ProgramUsage, AFolderIsNotAScript) {
  for (const char* command : {"run", "hash", "check"})
    EXPECT_EQ(stadionProgram({command, assetFolder()}).status, 2) << command;
}

TEST(ProgramUsage, AWrongScriptIsNotPlayed) {
  const TestFolder folder;
  const std::string script = folder.write("wrong.evs", "dynobject( name=a, densty=2 )\n");
  for (const char* command : {"run", "hash", "check"}) {
    const ProgramResult r = stadionProgram({command, script});
    EXPECT_EQ(r.status, 2) << command;
    EXPECT_TRUE(has(r.out + r.err, "wrong.evs:1:20: error: ")) << command << r.out << r.err;
  }
}

TEST(ProgramUsage, ABadWallFileIsShownWithItsLine) {
  const TestFolder folder;
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
  for (const char* size : {"0x0", "800", "-1x5", "800x600x2", "99999999999x2", "axb", "4294967297x2",
                           "+80x60", " 80x60", "80x", "nanxnan", "16384x16384"})
    EXPECT_EQ(stadionProgram({"run", testShow("bodies.evs"), "--frames", "2", "--size", size}).status, 2)
        << size;
}

TEST(ProgramUsage, NumbersThatAreNoneAreRefusedAndWhatIsAllowedIsSaid) {
  const std::vector<std::pair<const char*, std::vector<const char*>>> cases{
      {"--rate", {"nan", "inf", "-inf", "0", "1001", "0x40", "60Hz", ""}},
      {"--seconds", {"nan", "inf", "1e300", "0", "-1"}},
      {"--frames", {"nan", "inf", "0", "-1", "1.5", "1e3", "99999999999999999999"}},
  };
  for (const auto& [option, values] : cases)
    for (const char* value : values)
      for (const char* command : {"run", "hash"}) {
        const ProgramResult r = stadionProgram({command, testShow("bodies.evs"), option, value});
        EXPECT_EQ(r.status, 2) << option << " " << value;
        EXPECT_TRUE(has(r.err, option)) << r.err;
        EXPECT_TRUE(*value == 0 || (has(r.err, "from ") && has(r.err, " to "))) << r.err;
      }
  for (const char* every : {"nan", "0", "-3", "1.5"}) {
    const ProgramResult r = stadionProgram({"run", testShow("bodies.evs"), "--pictures", every});
    EXPECT_EQ(r.status, 2) << every;
    EXPECT_TRUE(has(r.err, "whole number")) << r.err;
  }
}

TEST(ProgramUsage, WhereEveryFrameCountsNothingCanBeGivenUp) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"--load-control", "on"}, {"--stress-max", "2"}}) {
    std::vector<std::string> all{"run", testShow("bodies.evs"), "--seconds", "1"};
    all.insert(all.end(), words.begin(), words.end());
    const ProgramResult r = stadionProgram(all);
    EXPECT_EQ(r.status, 2) << words[0];
    EXPECT_TRUE(has(r.err, "is for live runs: leave out")) << r.err;
  }
}

TEST(ProgramUsage, OptionsThatWouldMeanNothingBesideOthersAreRefused) {
  const std::vector<std::vector<std::string>> wrong{{"--gl", "none", "--wall-workers", "process"},
                                                    {"--mode", "sequential", "--latency", "2"},
                                                    {"--mode", "sequential", "--cull-draw", "overlap"},
                                                    {"--mode", "sequential", "--cull-draw", "apart"}};
  for (const auto& words : wrong) {
    const ProgramResult r = stadionProgram(shortRun(testShow("bodies.evs"), words));
    EXPECT_EQ(r.status, 2) << words[2] << " " << r.err;
    EXPECT_TRUE(has(r.err, words[2])) << r.err;
    EXPECT_TRUE(has(r.err, "leave one of them out")) << r.err;
  }
}

TEST(ProgramUsage, WhatIsNoPlainFileIsRefusedWithoutWaiting) {
  const TestFolder folder;
  const std::string fifo = folder.path() / "fifo";
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  ProgramRun run;
  run.limit = std::chrono::seconds(60);
  for (const std::string& file : {fifo, std::string("/dev/zero"), folder.path().string()}) {
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"run", file},
                                               {"hash", file},
                                               {"check", file},
                                               {"walls", file},
                                               {"hash", testShow("bodies.evs"), "--input", file},
                                               {"run", testShow("bodies.evs"), "--walls", file}}) {
      run.words = words;
      run.words.insert(run.words.begin(), stadionPath());
      const ProgramResult r = runProgram(run);
      EXPECT_EQ(r.status, 2) << words[0] << " " << file;
      EXPECT_TRUE(has(r.out + r.err, file)) << r.out << r.err;
    }
  }
  const std::string model = folder.write("show.evs", "object( file=pipe.obj )\n");
  ASSERT_EQ(::mkfifo((folder.path() / "pipe.obj").c_str(), 0600), 0);
  const ProgramResult r = stadionProgram({"check", model});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.out, "show.evs:1:") && has(r.out, "pipe.obj")) << r.out;
}

TEST(ProgramUsage, AHugeScriptIsRefusedBeforeItIsRead) {
  const TestFolder folder;
  const std::string script = folder.write("huge.evs", "");
  std::filesystem::resize_file(script, std::uintmax_t{4} << 30);  // takes no room on the disk
  for (const char* command : {"run", "hash", "check"}) {
    // (run and hash reserve addresses for the published scene beforehand.)
    const std::string limit = *command == 'c' ? "ulimit -v 500000; " : "";
    const ProgramResult r =
        runProgram({{"/bin/sh", "-c", limit + "exec \"$@\"", "sh", stadionPath(), command, script}});
    EXPECT_EQ(r.status, 2) << command << r.err;
    EXPECT_TRUE(has(r.out + r.err, "huge.evs: error: cannot be read: it is larger than 64 MiB"))
        << r.out << r.err;
  }
}

TEST(ProgramUsage, WhatHappenedIsCountedWhenItIsTooMuchToTell) {
  const TestFolder folder;
  const std::string show = folder.write("show.evs", "timer( name=tick, period=0.001, repeat=on )\n");
  const ProgramResult text = stadionProgram(shortRun(show, {}, "61"));
  ASSERT_EQ(text.status, 0) << text.err;
  EXPECT_TRUE(has(text.out, "   0.0010 s  timesup    tick  1000 times, until 1.0000 s\n")) << text.out;
  EXPECT_FALSE(has(text.out, " more;")) << text.out;
  const auto summary = nlohmann::json::parse(stadionProgram(shortRun(show, {"--json"}, "61")).out);
  EXPECT_EQ(summary.at("happened_count"), 1000);
  EXPECT_EQ(summary.at("happened").size(), 1000u);
  EXPECT_EQ(summary.at("happened")[0].at("node"), "tick");
}

TEST(ProgramUsage, ErrorsInSubScenesAndModelsNameTheirFile) {
  const TestFolder folder;
  folder.write("parts/inner.evs", "# one line\nobject( file=missing.obj )\ndynobject( file=flat.obj )\n");
  folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string show =
      folder.write("show.evs", "scene( file=\"parts/inner.evs\" )\n# x\nscene( file=gone.evs )\n");
  for (const char* command : {"check", "run", "hash"}) {
    std::vector<std::string> words{command, show};
    if (*command != 'c') words.insert(words.end(), {"--frames", "2"});
    const ProgramResult r = stadionProgram(words);
    const std::string said = r.out + r.err;
    EXPECT_TRUE(has(said, "show.evs:3:13: error: there is no asset \"gone.evs\"")) << command << said;
    EXPECT_TRUE(has(said, folder.path().string() + "/parts/inner.evs:2:14: ")) << command << said;
    EXPECT_TRUE(has(said, folder.path().string() + "/parts/inner.evs:3:17: error: \"flat.obj\" "))
        << command << said;
  }
}

TEST(ProgramUsage, ABadInputLogIsShownWithItsLine) {
  const TestFolder folder;
  const std::string log = folder.write("bad.input", "stadion-input 1\npose head x\n");
  const ProgramResult r = stadionProgram({"run", testShow("bodies.evs"), "--input", log});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "bad.input:2:")) << r.err;
}

TEST(ProgramUsage, AMissingModelIsAStandInInRunAndAnErrorInCheck) {
  const TestFolder folder;
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

TEST(ProgramUsage, OptionsThatMayBeRepeatedMayStandBeforeTheScript) {
  const TestFolder folder;
  const std::string script = folder.write("show.evs", "object( name=a, file=football.3ds )\n");
  for (const char* command : {"check", "run", "hash"}) {
    std::vector<std::string> words{command,        "--asset-root", folder.path(),
                                   "--asset-root", assetFolder(),  script};
    if (words[0] != "check") words.insert(words.end(), {"--frames", "2", "--walls", "desktop"});
    if (words[0] == "run")
      words.insert(words.end(), {"--size", "32x24", "--pictures", "none", "--out", folder.path() / "out"});
    const ProgramResult r = stadionProgram(words);
    EXPECT_EQ(r.status, 0) << command << ": " << r.err << r.out;
    EXPECT_FALSE(has(r.err + r.out, "stand-in")) << command;
  }
  const ProgramResult traced =
      stadionProgram({"run", "--out", folder.path() / "out", "--track", "a", script, "--asset-root",
                      assetFolder(), "--frames", "2", "--size", "32x24", "--walls", "desktop"});
  EXPECT_EQ(traced.status, 0) << traced.err;
  const ProgramResult nowhere = stadionProgram({"check", "--asset-root", "/nowhere", script});
  EXPECT_EQ(nowhere.status, 2);
  EXPECT_TRUE(has(nowhere.out, "--asset-root: cannot open the folder /nowhere")) << nowhere.out;
}

TEST(ProgramUsage, JsonIsOneObjectOnStdoutAndNothingElse) {
  const TestFolder folder;
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

TEST(ProgramUsage, OnlyDrawnFramesAreCountedAndTimed) {
  const TestFolder folder;
  const std::string pictures = folder.path() / "pictures";
  const auto run = [&](const std::vector<std::string>& more) {
    std::vector<std::string> options{"--out", pictures};
    options.insert(options.end(), more.begin(), more.end());
    return stadionProgram(shortRun(testShow("moving.evs"), options));
  };
  const ProgramResult last = run({"--json"}), all = run({"--json", "--pictures", "all"}), text = run({});
  ASSERT_EQ(last.status + all.status, 0) << last.err << all.err;
  for (const auto& [result, drawn] : {std::pair(last, 1), std::pair(all, 5)}) {
    const auto summary = nlohmann::json::parse(result.out);
    EXPECT_EQ(summary.at("frames"), 5);
    EXPECT_EQ(summary.at("frames_drawn"), drawn);
    for (const auto& stage : summary.at("stages"))
      EXPECT_EQ(stage.at("ms").at("count"), stage.at("stage") == "app" ? 5 : drawn);
    for (const auto& wall : summary.at("motion_to_image_ms")) EXPECT_EQ(wall.at("count"), drawn);
  }
  EXPECT_EQ(nlohmann::json::parse(last.out).at("image_hashes"),
            nlohmann::json::parse(all.out).at("image_hashes"));
  EXPECT_TRUE(has(text.out, "drawn 1 of 5 frames")) << text.out;
  EXPECT_FALSE(has(text.out, "frames/s")) << text.out;
}

TEST(ProgramUsage, ASubSceneThatLoadsItselfStaysOutWithAWarning) {
  const TestFolder folder;
  const std::string show = folder.write("self.evs", "scene( name=me, file=self.evs )\n");
  const ProgramResult r = stadionProgram({"hash", show, "--frames", "3"});
  EXPECT_EQ(r.status, 0);
  EXPECT_TRUE(has(r.err, "warning: this sub-scene is loaded by itself")) << r.err;
  EXPECT_FALSE(has(r.err, "error")) << r.err;
}

TEST(ProgramUsage, ASubSceneFileThatIsRefusedIsToldOnce) {
  const TestFolder folder;
  const std::string show = folder.write("outside.evs", "scene( file=\"/etc/passwd\" )\n");
  const ProgramResult r = stadionProgram({"check", show});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.out, "is an absolute path")) << r.out;
  EXPECT_EQ(r.out.find("error"), r.out.rfind("error")) << r.out;
}

// Within a limit that comparing every pair would not keep.
TEST(ProgramUsage, CheckFindsTheOneOverlapAmongTenThousandBodies) {
  const TestFolder folder;
  std::string cube, show = "object( name=field, file=plane.3ds )\n", bodies;
  for (int i = 0; i < 8; ++i)
    cube += fmt::format("v {} {} {}\n", i & 1 ? 0.1 : -0.1, i & 2 ? 0.1 : -0.1, i & 4 ? 0.1 : -0.1);
  folder.write("cube.obj", cube + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
  for (int i = 0; i < 10'000; ++i) {
    // The last one stands two centimetres from the place of the one before it.
    const double x = 0.5 * (i % 100) - (i == 9'999 ? 0.48 : 0);
    show += fmt::format("dynobject( name=b{}, file=cube.obj, position=\"{:.2f} {:.2f} 1\" )\n", i, x,
                        0.5 * (i / 100));
    bodies += fmt::format(", collidee=b{}", i);
  }
  show += "dynamics( collider=field" + bodies + " )\nlight( direction=\"-1 2 -3\" )\n";
  ProgramRun run;
  run.words = {stadionPath(), "check", folder.write("many.evs", show), "--asset-root", assetFolder()};
  const ProgramResult r = runProgram(run);
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(has(r.out, "\"b9999\" and \"b9998\" overlap by ")) << r.out;
  EXPECT_EQ(r.out.find(" overlap by "), r.out.rfind(" overlap by ")) << r.out;
}

TEST(ProgramUsage, InterruptsEndTheShowWithItsSummary) {
  for (const int signal : {SIGINT, SIGTERM})
    for (const char* mode : {"sequential", "pipelined"}) {
      const TestFolder out;
      ProgramRun run;
      run.words = {stadionPath(),  "run",         testShow("reload_with.evs"),
                   "--asset-root", assetFolder(), "--size",
                   "64x48",        "--walls",     "desktop",
                   "--look",       "plain",       "--json",
                   "--mode",       mode,          "--out",
                   out.path(),     "--pictures",  "100"};
      run.signal = signal;
      run.signalWhen = [&](const std::string&, const std::string& err) {
        return has(err, "playing until") && std::filesystem::exists(out.path() / "screen-left-000000.png");
      };
      const ProgramResult r = runProgram(run);
      ASSERT_EQ(r.status, 128 + signal) << mode << r.err;
      const auto summary = nlohmann::json::parse(r.out);
      EXPECT_GT(summary.at("frames"), 1);
      EXPECT_EQ(summary.at("stopped"), signal == SIGINT ? "SIGINT" : "SIGTERM");
      EXPECT_TRUE(summary.at("failure").is_null());
      EXPECT_EQ(nlohmann::json::parse(fileContent(out.path() / "summary.json")).at("stopped"),
                summary.at("stopped"));
      EXPECT_TRUE(std::filesystem::exists(out.path() / "screen-left-000000.png"));
      EXPECT_TRUE(std::filesystem::exists(out.path() / "contact-sheet.png"));
      // The importer is a child in its own process group: it must not have been torn down with a complaint.
      EXPECT_FALSE(has(r.err, "importer")) << r.err;
    }
}

TEST(ProgramUsage, ACrashSaysWhereItWas) {
  ProgramRun run;
  run.words = {stadionPath(), "hash",   testShow("reload_with.evs"), "--asset-root", assetFolder(),
               "--frames",    "1000000"};
  run.signal = SIGSEGV;
  run.signalWhen = [](const std::string& out, const std::string&) { return !out.empty(); };
  const ProgramResult r = runProgram(run);
  EXPECT_EQ(r.status, 128 + SIGSEGV);
  EXPECT_TRUE(has(r.err, "stadion: crashed with SIGSEGV")) << r.err;
  EXPECT_TRUE(has(r.err, "bin/stadion")) << "some function of the program: " << r.err;
}

TEST(ProgramUsage, CheckSaysNothingWrongOfTheTestShows) {
  const ProgramResult r = stadionProgram({"check", testShow("moving.evs"), testShow("bodies.evs"),
                                          testShow("reload_with.evs"), "--asset-root", assetFolder()});
  EXPECT_EQ(r.status, 0) << r.out << r.err;
  EXPECT_FALSE(has(r.out, "warning")) << r.out;
}

}  // namespace
}  // namespace stadion
