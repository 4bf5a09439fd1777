#include "pipeline/platform/calibration_file.h"
#include "pipeline/platform/setting_trials.h"
#include "tests/fresh_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace stadion {
namespace {

constexpr DrawSetting kThreads{false, 2, false}, kProcesses{true, 0, false}, kPinned{true, 0, true};

MeasuredRoom roomOf(std::size_t walls, std::vector<MeasuredSetting> settings, const char* look = "full") {
  return {walls, 800, 600, look, std::move(settings)};
}

Machine machine(std::uint32_t cores = 2) {
  return {"Processor of \"Test\"", cores, cores, "0123456789abcdef", "llvmpipe, Mesa 22.3.6"};
}

Calibration calibration() {
  return {{{machine(),
            "2026-11-23 05:01 UTC",
            {roomOf(4, {{kThreads, 12.25, 130, 3}, {kProcesses, 17.5, 108.125, 4}, {kPinned, 17, 110, 2}}),
             roomOf(1, {{kThreads, 60, 20, 2}}, "plain")}}}};
}

TEST(Calibration, TakesTheFastestSetting) {
  const MeasuredRoom room = calibration().machines[0].rooms[0];
  ASSERT_TRUE(best(room));
  EXPECT_EQ(best(room)->setting, kProcesses);
}

TEST(Calibration, TakesOfWhatIsEquallyFastWhatCostsLeast) {
  EXPECT_EQ(best(roomOf(4, {{kProcesses, 17.5, 108, 3}, {kThreads, 17.1, 100, 3}}))->setting, kThreads);
  EXPECT_EQ(best(roomOf(4, {{kProcesses, 17.5, 108, 3}, {kThreads, 16.9, 100, 3}}))->setting, kProcesses);
}

TEST(Calibration, TakesTheFastestThatHasWhatIsWishedFor) {
  const MeasuredRoom room = calibration().machines[0].rooms[0];
  EXPECT_EQ(best(room, {false, {}, {}})->setting, kThreads);
  EXPECT_EQ(best(room, {{}, {}, true})->setting, kPinned);
  EXPECT_EQ(best(room, {{}, 2, {}})->setting, kThreads);
  EXPECT_EQ(best(room, {true, 2, {}}), nullptr);
}

TEST(Calibration, OfTheNearestNumberOfWallsHolds) {
  MachineCalibration m;
  for (const std::size_t walls : {1, 3, 6}) m.rooms.push_back(roomOf(walls, {}));
  EXPECT_EQ(roomFor(m, 4, "full")->walls, 3u);
  EXPECT_EQ(roomFor(m, 5, "full")->walls, 6u);
  EXPECT_EQ(roomFor(m, 2, "full")->walls, 3u);
  EXPECT_EQ(roomFor(m, 1, "full")->walls, 1u);
}

TEST(Calibration, OfOneWallSaysNothingAboutSeveral) {
  MachineCalibration m;
  m.rooms.push_back(roomOf(1, {}));
  EXPECT_EQ(roomFor(m, 2, "full"), nullptr);
  m.rooms[0].walls = 2;
  EXPECT_EQ(roomFor(m, 1, "full"), nullptr);
}

TEST(Calibration, OfTheSameLookCountsMoreThanOfTheSameNumberOfWalls) {
  MachineCalibration m;
  m.rooms = {roomOf(4, {}, "full"), roomOf(6, {}, "plain")};
  EXPECT_EQ(roomFor(m, 4, "plain")->walls, 6u);
  EXPECT_EQ(roomFor(m, 6, "full")->walls, 4u);
  m.rooms.pop_back();
  EXPECT_EQ(roomFor(m, 4, "plain")->walls, 4u);
}

TEST(Calibration, ReplacesARoomThatIsMeasuredAgainAndKeepsTheOthers) {
  Calibration known = calibration();
  known.machines.push_back({machine(8), "earlier", {roomOf(4, {{kThreads, 1, 1, 1}})}});
  known.add({machine(), "later", {roomOf(4, {{kThreads, 20, 90, 5}})}});
  ASSERT_EQ(known.machines.size(), 2u);
  const MachineCalibration* mine = known.of(machine());
  ASSERT_TRUE(mine);
  EXPECT_EQ(mine->when, "later");
  ASSERT_EQ(mine->rooms.size(), 2u);
  EXPECT_EQ(best(*roomFor(*mine, 4, "full"))->framesPerSecond, 20);
  EXPECT_EQ(roomFor(*mine, 1, "plain")->settings.size(), 1u);
  EXPECT_EQ(known.of(machine(8))->when, "earlier");
  EXPECT_EQ(known.of(machine(3)), nullptr);
}

TEST(Calibration, TriesThreadsAndProcessesWithRasteriserThreadsFromNoneToAll) {
  for (const std::uint32_t processors : {1u, 2u, 4u, 16u, 128u})
    for (const std::size_t walls : {std::size_t{1}, std::size_t{4}, std::size_t{6}}) {
      const auto settings = settingsToTry(processors, walls);
      EXPECT_GE(settings.size(), 4u);
      EXPECT_LE(settings.size(), 6u);
      for (const bool processes : {false, true})
        for (const std::uint32_t threads : {0u, std::min(processors, kMostRasteriserThreads)})
          EXPECT_EQ(std::ranges::count(settings, DrawSetting{processes, threads, false}), 1)
              << processors << " processors, " << walls << " walls";
    }
}

TEST(DrawSetting, OfAnUnknownMachineIsThreadsWithOneRasteriserThreadForEachProcessor) {
  EXPECT_EQ(unmeasuredSetting(2, 4), (DrawSetting{false, 2, false}));
  EXPECT_EQ(unmeasuredSetting(100, 4), (DrawSetting{false, 32, false}));
  EXPECT_EQ(unmeasuredSetting(2, 4, {true, {}, {}}), (DrawSetting{true, 0, false}));
  EXPECT_EQ(unmeasuredSetting(16, 4, {true, {}, {}}), (DrawSetting{true, 4, false}));
  EXPECT_EQ(unmeasuredSetting(16, 4, {true, 1, true}), (DrawSetting{true, 1, true}));
}

TEST(CalibrationFile, IsReadAsItWasWritten) {
  const std::string text = toJson(calibration());
  const auto read = calibrationOf(text, "file");
  ASSERT_TRUE(read) << format(read.error());
  EXPECT_EQ(toJson(read.value()), text);
  const MachineCalibration* m = read.value().of(machine());
  ASSERT_TRUE(m);
  EXPECT_EQ(m->machine.rasteriser, machine().rasteriser);
  EXPECT_EQ(best(m->rooms[0])->setting, kProcesses);
  EXPECT_EQ(best(m->rooms[0])->cpuMs, 108.125);
  EXPECT_EQ(m->rooms[1].look, "plain");
}

TEST(CalibrationFile, ThatIsNotThereKnowsNoMachine) {
  for (const char* none : {"", "/nowhere/calibration.json"}) {
    const auto read = readCalibration(none);
    ASSERT_TRUE(read);
    EXPECT_TRUE(read.value().machines.empty());
  }
}

TEST(CalibrationFile, IsToldWhereItIsNoJson) {
  const auto read = calibrationOf("{ \"stadion-calibration\": 1,\n  \"machines\": [ }\n", "my.json");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().where.file, "my.json");
  EXPECT_EQ(read.error().where.line, 2u);
  EXPECT_EQ(read.error().where.column, 17u);
  EXPECT_NE(read.error().message.find("remove the file"), std::string::npos);
}

std::string saidOf(const std::string& text) {
  const auto read = calibrationOf(text, "my.json");
  return read ? "" : read.error().message;
}

TEST(CalibrationFile, OfAnotherVersionOrAnotherKindIsRefused) {
  EXPECT_NE(saidOf("{\"stadion-calibration\": 2, \"machines\": []}").find("another version"),
            std::string::npos);
  EXPECT_NE(saidOf("{\"machines\": []}").find("no calibration"), std::string::npos);
  EXPECT_NE(saidOf("[1]").find("no calibration"), std::string::npos);
  EXPECT_EQ(saidOf("{\"stadion-calibration\": 1, \"machines\": []}"), "");
}

TEST(CalibrationFile, NamesWhatCannotBe) {
  const auto with = [](const std::string& what, const std::string& instead) {
    std::string text = toJson(calibration());
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return saidOf(text.replace(at, what.size(), instead));
  };
  EXPECT_NE(with("\"rasteriser_threads\": 2", "\"rasteriser_threads\": -2").find("rasteriser_threads"),
            std::string::npos);
  EXPECT_NE(with("\"rasteriser_threads\": 2", "\"rasteriser_threads\": 1e9").find("from 0 to 32"),
            std::string::npos);
  EXPECT_NE(with("\"thread\"", "\"threat\"").find("wall_workers"), std::string::npos);
  EXPECT_NE(with("\"pinned\": false", "\"pinned\": 0").find("true or false"), std::string::npos);
  EXPECT_NE(with("12.25", "-1").find("frames_per_second"), std::string::npos);
  EXPECT_NE(with("\"walls\": 4", "\"wall\": 4").find("\"walls\" is missing"), std::string::npos);
  EXPECT_NE(with("\"look\": \"full\"", "\"look\": 4").find("look"), std::string::npos);
  EXPECT_NE(with("\"machines\": [", "\"machines\": 3, \"others\": [").find("machines"), std::string::npos);
}

TEST(CalibrationFile, SurvivesAnyDamage) {
  const std::string whole = toJson(calibration());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    calibrationOf(whole.substr(0, i), "cut");
    std::string hurt = whole;
    hurt[i] = static_cast<char>(hurt[i] ^ 0x41);
    calibrationOf(hurt, "hurt");
  }
}

/// The environment's variables as they were, at the end.
class Environment {
public:
  explicit Environment(std::vector<std::string> names) {
    for (const std::string& name : names) {
      const char* value = std::getenv(name.c_str());
      before_.push_back({name, value ? std::optional<std::string>(value) : std::nullopt});
      unsetenv(name.c_str());
    }
  }
  ~Environment() {
    for (const auto& [name, value] : before_)
      value ? setenv(name.c_str(), value->c_str(), 1) : unsetenv(name.c_str());
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

private:
  std::vector<std::pair<std::string, std::optional<std::string>>> before_;
};

TEST(CalibrationFile, LiesInTheUsersConfigurationFolder) {
  const Environment restored({"STADION_CALIBRATION", "XDG_CONFIG_HOME", "HOME"});
  EXPECT_EQ(calibrationFile(), "");
  setenv("HOME", "/somewhere/ada", 1);
  EXPECT_EQ(calibrationFile(), "/somewhere/ada/.config/stadion/calibration.json");
  setenv("XDG_CONFIG_HOME", "/elsewhere/ada", 1);
  EXPECT_EQ(calibrationFile(), "/elsewhere/ada/stadion/calibration.json");
  setenv("XDG_CONFIG_HOME", "relative", 1);  // the specification says: to be ignored
  EXPECT_EQ(calibrationFile(), "/somewhere/ada/.config/stadion/calibration.json");
  setenv("STADION_CALIBRATION", "here.json", 1);
  EXPECT_EQ(calibrationFile(), "here.json");
  setenv("STADION_CALIBRATION", "none", 1);
  EXPECT_EQ(calibrationFile(), "");
}

TEST(CalibrationFile, IsWrittenIntoFoldersThatAreNotThereYet) {
  namespace fs = std::filesystem;
  const fs::path folder = makeFreshFolder();
  const std::string file = folder / "a" / "b" / "calibration.json";
  const auto wrong = writeCalibration(file, calibration());
  EXPECT_FALSE(wrong) << format(*wrong);
  const auto read = readCalibration(file);
  ASSERT_TRUE(read);
  EXPECT_EQ(toJson(read.value()), toJson(calibration()));
  std::ofstream(folder / "plain") << "a file";
  EXPECT_TRUE(writeCalibration(folder / "plain" / "calibration.json", calibration()));
  fs::remove_all(folder);
}

/// As if each setting always had its own speed.
std::vector<MeasuredSetting> played(SettingTrials& trials, std::size_t times,
                                    std::vector<DrawSetting>& order) {
  for (std::size_t i = 0; i < times && trials.any(); ++i) {
    const DrawSetting s = trials.next();
    order.push_back(s);
    trials.measured((s.processes ? 20 : 10) + s.rasteriserThreads + (s.pinned ? 0.5 : 0), 100);
  }
  return trials.results();
}

TEST(SettingTrials, TryEachOnceAndThenOnlyWhatIsWorthwhile) {
  SettingTrials trials(settingsToTry(2, 4), true);
  std::vector<DrawSetting> order;
  played(trials, 5, order);
  EXPECT_FALSE(trials.allTried());
  played(trials, 1, order);
  EXPECT_TRUE(trials.allTried());
  order.clear();
  played(trials, 6, order);
  for (const DrawSetting& s : order) EXPECT_TRUE(s.processes);
  EXPECT_EQ(std::ranges::count_if(order, [](const DrawSetting& s) { return s.pinned; }), 3);
  for (const MeasuredSetting& m : trials.results())
    EXPECT_EQ(m.rounds, m.setting.processes && !m.setting.pinned ? 2u : 1u);
}

TEST(SettingTrials, GoTheOtherWayRoundEverySecondTime) {
  SettingTrials trials({{true, 0, false}, {true, 1, false}}, false);
  std::vector<DrawSetting> order;
  played(trials, 6, order);
  ASSERT_EQ(order.size(), 6u);
  EXPECT_EQ(order[0], order[3]);
  EXPECT_EQ(order[1], order[2]);
  EXPECT_EQ(order[0], order[4]);
}

TEST(SettingTrials, KeepTheMedianOfWhatWasMeasured) {
  SettingTrials trials({kThreads}, false);
  for (const double fps : {10.0, 90.0, 12.0}) trials.measured(fps, 2 * fps);
  ASSERT_EQ(trials.results().size(), 1u);
  EXPECT_EQ(trials.results()[0].framesPerSecond, 12);
  EXPECT_EQ(trials.results()[0].cpuMs, 24);
  EXPECT_EQ(trials.results()[0].rounds, 3u);
}

TEST(SettingTrials, LeaveOutWhatCannotBeMeasured) {
  SettingTrials trials({kThreads, kProcesses}, true);
  trials.measured(10, 100);
  trials.failed();
  std::vector<DrawSetting> order;
  played(trials, 8, order);
  for (const DrawSetting& s : order) EXPECT_FALSE(s.processes);
  SettingTrials none({kThreads}, true);
  none.failed();
  EXPECT_FALSE(none.any());
  EXPECT_TRUE(none.results().empty());
}

}  // namespace
}  // namespace stadion
