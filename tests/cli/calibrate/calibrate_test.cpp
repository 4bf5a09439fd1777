/// `stadion calibrate`, and that `run` draws by what it remembers: the same pictures in another way.

#include "pipeline/platform/calibration_file.h"
#include "pipeline/platform/machine.h"
#include "tests/programs/program.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace stadion {
namespace {

using nlohmann::json;

/// What is known of rooms with several walls says nothing of one wall.
const std::string kCalibratedWalls = STADION_SOURCE_DIR "/scripts/suites/two.walls";

/// A place for calibrations, and programs that look for them there. The rasteriser's threads are not set.
class Home {
public:
  std::string file() const { return folder_.path() / "config" / "stadion" / "calibration.json"; }

  ProgramResult start(std::vector<std::string> words, std::vector<std::string> environment = {}) const {
    words.insert(words.begin(), stadionPath());
    std::vector<std::string> all{"XDG_CONFIG_HOME=" + std::string(folder_.path() / "config"),
                                 "STADION_CALIBRATION=", "LP_NUM_THREADS="};
    all.insert(all.end(), environment.begin(), environment.end());
    return runProgram({words, all});
  }

  ProgramResult run(std::vector<std::string> more = {}, std::vector<std::string> environment = {},
                    const std::string& walls = kCalibratedWalls) const {
    std::vector<std::string> words{"run",          testShow("moving.evs"),
                                   "--asset-root", assetFolder(),
                                   "--walls",      walls,
                                   "--size",       "64x48",
                                   "--look",       "plain",
                                   "--frames",     "6",
                                   "--json"};
    words.insert(words.end(), more.begin(), more.end());
    if (std::ranges::find(words, "--gl") == words.end()) words.insert(words.end(), {"--gl", "osmesa"});
    return start(words, environment);
  }

  /// As if it had been measured that four walls are drawn fastest like this.
  void remember(const DrawSetting& fastest, Machine machine = thisMachine()) const {
    machine.rasteriser = "llvmpipe of a test";
    const DrawSetting slower{!fastest.processes, 1, false};
    const MeasuredRoom room{4, 800, 600, "plain", {{fastest, 40, 50, 3}, {slower, 20, 50, 3}}};
    EXPECT_FALSE(writeCalibration(file(), {{{machine, "2026-11-23 05:01 UTC", {room}}}}));
  }

private:
  TestFolder folder_;
};

json drawnSummaryOf(const ProgramResult& r) {
  EXPECT_EQ(r.status, 0) << r.err;
  return json::parse(r.out, nullptr, false);
}

TEST(ProgramCalibrate, MeasuresAndRemembersAndRunTakesIt) {
  const Home home;
  const ProgramResult r = home.start({"calibrate", "--walls", "powerwall", "--look", "plain", "--size",
                                      "32x24", "--seconds", "4", "--json"});
  ASSERT_EQ(r.status, 0) << r.err;
  const auto printed = calibrationOf(r.out, "stdout"), kept = readCalibration(home.file());
  ASSERT_TRUE(printed) << r.out;
  ASSERT_TRUE(kept);
  EXPECT_EQ(toJson(printed.value()), toJson(kept.value()));
  const MachineCalibration* mine = kept.value().of(thisMachine());
  ASSERT_TRUE(mine) << r.out;
  EXPECT_TRUE(has(mine->machine.rasteriser, "Mesa")) << mine->machine.rasteriser;
  ASSERT_EQ(mine->rooms.size(), 1u);
  EXPECT_EQ(mine->rooms[0].walls, 1u);
  EXPECT_GE(mine->rooms[0].settings.size(), 1u);
  const MeasuredSetting* fastest = best(mine->rooms[0]);
  ASSERT_TRUE(fastest);
  const json how = drawnSummaryOf(home.run({}, {}, "powerwall"))["how_drawn"];
  EXPECT_EQ(how["wall_workers"], fastest->setting.processes ? "process" : "thread");
  EXPECT_EQ(how["rasteriser_threads"], fastest->setting.rasteriserThreads);
  EXPECT_TRUE(has(how["why"], "calibrated 20")) << how["why"];
}

TEST(ProgramCalibrate, PicturesAndHashesDoNotDependOnIt) {
  const Home home;
  const json before = drawnSummaryOf(home.run({}, {}, "cave4"));
  EXPECT_EQ(before["how_drawn"]["wall_workers"], "thread");
  EXPECT_TRUE(has(before["how_drawn"]["why"], "stadion calibrate")) << before["how_drawn"];
  for (const DrawSetting& setting : {DrawSetting{true, 1, true}, DrawSetting{false, 3, false}}) {
    home.remember(setting);
    const json after = drawnSummaryOf(home.run({}, {}, "cave4"));
    const json& how = after["how_drawn"];
    EXPECT_EQ(how["wall_workers"], setting.processes ? "process" : "thread") << how;
    EXPECT_EQ(how["rasteriser_threads"], setting.rasteriserThreads) << how;
    EXPECT_EQ(how["pinned"], setting.pinned) << how;
    EXPECT_EQ(after["image_hashes"], before["image_hashes"]) << how;
    EXPECT_EQ(after["history_hash"], before["history_hash"]) << how;
  }
}

TEST(ProgramCalibrate, ForABudgetOnWhatIsDrawnThreadsDrawALiveShow) {
  const Home home;
  home.remember({true, 0, false});
  const TestFolder folder;
  folder.write("show.input", "stadion-input 1\nkey head 0  0 0 1.7\nkey head 0.5  0 0 1.7\n");
  const auto play = [&](const std::string& show) {
    return drawnSummaryOf(home.start({"run", folder.write("show.evs", show), "--asset-root", assetFolder(),
                                      "--walls", kCalibratedWalls, "--look", "plain", "--size", "64x48",
                                      "--json", "--no-sound", "--gl", "osmesa"}))["how_drawn"];
  };
  EXPECT_EQ(play("object( file=football.3ds )\n")["wall_workers"], "process");
  const json how = play("object( file=football.3ds, budget=1 )\n");
  EXPECT_EQ(how["wall_workers"], "thread");
  EXPECT_TRUE(has(how["why"], "budgets of what is drawn")) << how;
}

TEST(ProgramCalibrate, WhatIsAskedForCountsMore) {
  const Home home;
  home.remember({true, 0, true});
  const json threads = drawnSummaryOf(home.run({"--wall-workers", "thread", "--pin", "off"}))["how_drawn"];
  EXPECT_EQ(threads["wall_workers"], "thread");
  EXPECT_EQ(threads["pinned"], false);
  const json given = drawnSummaryOf(home.run({}, {"LP_NUM_THREADS=3"}))["how_drawn"];
  EXPECT_EQ(given["rasteriser_threads"], 3);
  const json turns = drawnSummaryOf(home.run({"--mode", "sequential"}))["how_drawn"];
  EXPECT_EQ(turns["wall_workers"], "thread");
  EXPECT_EQ(turns["pinned"], false);
  const json counted = drawnSummaryOf(home.run({"--count-work"}))["how_drawn"];
  EXPECT_EQ(counted["wall_workers"], "thread");
  EXPECT_FALSE(drawnSummaryOf(home.run({"--gl", "none"})).contains("how_drawn"));
}

TEST(ProgramCalibrate, OfAnotherMachineIsToldAndNotUsed) {
  const Home home;
  Machine other = thisMachine();
  other.processor = "Babbage 1837", other.cores = 1;
  home.remember({true, 0, false}, other);
  const ProgramResult r = home.run();
  EXPECT_EQ(drawnSummaryOf(r)["how_drawn"]["wall_workers"], "thread");
  EXPECT_TRUE(has(r.err, home.file() + ": warning: was measured on another machine (Babbage 1837, 1 core"))
      << r.err;
}

TEST(ProgramCalibrate, ThatIsDamagedIsToldAndNotUsedNorOverwritten) {
  const Home home;
  home.remember({true, 0, false});
  const std::string whole = fileContent(home.file());
  EXPECT_FALSE(writeCalibration(home.file(), {}));
  std::filesystem::resize_file(home.file(), 20);
  const ProgramResult r = home.run();
  EXPECT_EQ(drawnSummaryOf(r)["how_drawn"]["wall_workers"], "thread");
  EXPECT_TRUE(has(r.err, home.file() + ":")) << r.err;
  EXPECT_TRUE(has(r.err, "warning: is no JSON; remove the file")) << r.err;
  const ProgramResult again = home.start({"calibrate", "--walls", "powerwall", "--seconds", "1"});
  EXPECT_EQ(again.status, 2);
  EXPECT_EQ(fileContent(home.file()).size(), 20u);
}

TEST(ProgramCalibrate, IsForgottenOnRequest) {
  const Home home;
  home.remember({true, 0, false});
  EXPECT_EQ(home.start({"calibrate", "--forget"}).status, 0);
  EXPECT_FALSE(std::filesystem::exists(home.file()));
  EXPECT_EQ(home.start({"calibrate", "--forget"}).status, 0);
}

TEST(ProgramCalibrate, RefusesWhatCannotBeMeasuredOrKept) {
  const Home home;
  EXPECT_EQ(home.start({"calibrate", "--walls", "nowhere.walls"}).status, 2);
  EXPECT_EQ(home.start({"calibrate", "--size", "0x4"}).status, 2);
  EXPECT_EQ(home.start({"calibrate", "--walls", "desktop,powerwall"}).status, 2);  // as many walls
  const ProgramResult nowhere = home.start({"calibrate"}, {"STADION_CALIBRATION=none"});
  EXPECT_EQ(nowhere.status, 2);
  EXPECT_TRUE(has(nowhere.err, "STADION_CALIBRATION")) << nowhere.err;
  EXPECT_FALSE(std::filesystem::exists(home.file()));
}

TEST(ProgramRun, RefusesToPinWallsThatAreDrawnInTurn) {
  const Home home;
  const ProgramResult r = home.run({"--mode", "sequential", "--pin", "on"});
  EXPECT_EQ(r.status, 2);
  EXPECT_TRUE(has(r.err, "--pin on")) << r.err;
  EXPECT_EQ(drawnSummaryOf(home.run(
                {"--mode", "sequential", "--pin", "on", "--wall-workers", "process"}))["how_drawn"]["pinned"],
            true);
}

}  // namespace
}  // namespace stadion
