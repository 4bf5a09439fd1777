/// The show "Ancient Olympia" with its recorded visit, as anybody would start it.

#include "tests/programs/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

namespace stadion {
namespace {

std::string olympia() {
  return std::filesystem::path(assetFolder()).parent_path() / "scripts/olympia.evs";
}

/// The summary of the visit, played so.
nlohmann::json visitPlayed(const std::vector<std::string>& how) {
  // Not in real time, which is a minute and a half.
  std::vector<std::string> words{"run", olympia(), "--json", "--pace", "free"};
  words.insert(words.end(), how.begin(), how.end());
  const ProgramResult played = stadionProgram(words);
  EXPECT_EQ(played.status, 0) << played.err;
  return nlohmann::json::parse(played.out, nullptr, false);
}

// Drawn on four walls it takes a minute.
TEST(ProgramFullOlympia, TheRecordedVisitIsTheSameWhenItIsDrawn) {
  const auto drawn =
      visitPlayed({"--walls", "cave4", "--size", "64x48", "--look", "plain", "--app-threads", "4"});
  const auto unseen = visitPlayed({"--gl", "none", "--mode", "sequential"});
  for (const char* of : {"last_frame", "state_hash", "history_hash", "measured"})
    EXPECT_EQ(drawn.at(of), unseen.at(of)) << of;
}

TEST(ProgramOlympia, TheRecordedVisitEndsTheSameInBothModesAndReportsAllThrows) {
  const auto summary = visitPlayed({"--gl", "none", "--mode", "pipelined", "--app-threads", "4"});
  ASSERT_TRUE(summary.is_object());
  // As the boards tell them, rounded down. Change these figures only with the visit, the games or the flight
  // models.
  struct Throw {
    const char* node;
    int centimetres;
  };
  constexpr Throw kThrows[] = {{"tape", 5326}, {"rivals_tape", 5266},   // discus
                               {"tape", 5599}, {"rivals_tape", 6369},   // javelin
                               {"tape", 1057}, {"rivals_tape", 3047}};  // ball
  const auto& throws = summary.at("measured");
  ASSERT_EQ(throws.size(), std::size(kThrows));
  for (std::size_t i = 0; i < std::size(kThrows); ++i) {
    EXPECT_EQ(throws[i].at("node"), kThrows[i].node) << i;
    EXPECT_EQ(std::floor(100 * throws[i].at("metres").get<double>()), kThrows[i].centimetres) << i;
  }

  const auto expected = visitPlayed({"--gl", "none", "--mode", "sequential", "--app-threads", "1"});
  ASSERT_TRUE(expected.is_object());
  EXPECT_EQ(expected.at("last_frame"), 5400);
  for (const char* of : {"last_frame", "state_hash"}) EXPECT_EQ(summary.at(of), expected.at(of)) << of;
  EXPECT_EQ(summary.at("history_hash"), expected.at("history_hash"))
      << "some of the 5401 frames' states differ";
}

/// All distances of a visit, as they are told, at some other rate and with more of the log.
std::vector<std::string> distances(const std::string& log, const std::string& rate,
                                   const std::string& seconds = "80") {
  std::vector<std::string> options = {"run", olympia(), "--input", log, "--gl", "none", "--seconds", seconds};
  if (!rate.empty()) options.insert(options.end(), {"--rate", rate});
  const ProgramResult played = stadionProgram(options);
  EXPECT_EQ(played.status, 0) << played.err;
  EXPECT_EQ(played.err.find("out of the simulation"), played.err.npos) << played.err;
  std::vector<std::string> told;
  std::istringstream lines(played.out + played.err);
  for (std::string line; std::getline(lines, line);)
    if (const auto at = line.find("  measured   "); at != line.npos) told.push_back(line.substr(at));
  return told;
}

// What counts has a latency, so that it happens at its own time.
TEST(ProgramFullOlympia, AllGoAsFarAtOtherFrameRatesAndWhenFramesAreLate) {
  const std::string visit = std::filesystem::path(olympia()).replace_extension(".input");
  const std::vector<std::string> usual = distances(visit, "60");
  EXPECT_EQ(usual.size(), 6u);
  EXPECT_EQ(distances(visit, "30"), usual);
  EXPECT_EQ(distances(visit, "90"), usual);
  // As on a machine that has much else to do: frames come 1/240 s to 33 ms after each other, in no order.
  const TestFolder folder;
  const std::string late = folder.path() / "late.input";
  std::string log = fileContent(visit);
  log.replace(0, log.find('\n'), "stadion-input 2\nrate 240");
  std::uint64_t tick = 0;
  std::minstd_rand random(112);
  for (int frame = 1; tick < 240 * 80; ++frame) {
    tick += 1 + random() % 8;
    log += "frame " + std::to_string(frame) + ' ' + std::to_string(static_cast<double>(tick) / 240) + '\n';
  }
  std::ofstream(late) << log;
  EXPECT_EQ(distances(late, ""), usual);
}

// His legs carry the hand along once they are free again, which must not be before it lets go.
TEST(ProgramOlympia, AVisitorThatPushesTheJoypadAllTheWhileThrowsAsFarAtAnyRate) {
  const TestFolder folder;
  const std::string log = folder.path() / "push.input";
  std::ofstream(log) << R"(stadion-input 1
key head 0 0 6 1.7
key head 20 0 6 1.7
key wand 0     0   6    1.1
key wand 2     0   6    1.1
key wand 3     0.6 6.7  1
key wand 3.2   0.6 6.7  1    buttons 1
key wand 3.4   0.6 6.7  1
key wand 4     0.4 5.2  1.1
key wand 4.1   0.4 5.66 1.22 turn 25 0 0 buttons 2 axes 0 1
key wand 4.275 0.4 6.4  1.6  turn 34 0 0 buttons 2 axes 0 1
key wand 4.28  0.4 6.42 1.62 turn 34 0 0 buttons 4 axes 0 1
key wand 4.4   0.4 6.8  1.9  turn 40 0 0 buttons 4 axes 0 1
key wand 5     0   6    1
)";
  const std::vector<std::string> usual = distances(log, "60", "20");
  ASSERT_EQ(usual.size(), 2u);
  EXPECT_EQ(distances(log, "30", "20"), usual);
  EXPECT_EQ(distances(log, "240", "20"), usual);
}

// In real time as long as the machine is fast enough: what is late is simulated all the same, and loads are
// waited for.
TEST(ProgramFullOlympia, AsItComesFromTheClockTheVisitIsTheRecordedOne) {
  const TestFolder folder;
  const std::string log = folder.path() / "short.input";
  std::ofstream(log)
      << "stadion-input 1\nkey head 0 0 0 1.7\nkey head 2.5 0 0 1.7\n"
         "key wand 0 0.28 0.3 1.1\nkey wand 1 0.28 0.3 1.1 axes 0 1\nkey wand 2.5 0.28 0.3 1.1 axes 0 1\n";
  // The log lies beside the script that is played: the command does not ask for every frame.
  const std::string scripts = STADION_SOURCE_DIR "/scripts";
  const std::string script = folder.path() / "visit.evs";
  std::filesystem::copy(scripts + "/olympia.evs", script);
  std::filesystem::rename(log, folder.path() / "visit.input");
  const auto hashOf = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {
        "run", script, "--json", "--asset-root", scripts, "--asset-root", STADION_SOURCE_DIR "/assets"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult played = stadionProgram(words);
    EXPECT_EQ(played.status, 0) << played.err;
    const auto j = nlohmann::json::parse(played.out);
    EXPECT_EQ(j["last_frame"], 150) << played.out;
    return j["state_hash"];
  };
  const auto usual = hashOf({"--gl", "none", "--pace", "free"});
  EXPECT_EQ(hashOf({"--gl", "none"}), usual);
  EXPECT_EQ(hashOf({"--gl", "none", "--mode", "sequential"}), usual);
  EXPECT_EQ(hashOf({"--gl", "osmesa", "--size", "400x300", "--walls", "cave4", "--mode", "sequential"}),
            usual);
}

/// A visitor who walks up to the discus and takes it.
constexpr const char* kTake = R"(stadion-input 1
key head 0    0    0     1.70
key wand 0    0.28 0.30  1.10
key wand 4    0.28 0.30  1.10
key wand 4.3  0.28 0.30  1.10  axes 0 1
key wand 7    0.28 0.30  1.10  axes 0 1
key wand 7.3  0.28 0.30  1.10
key wand 9.4  0.60 0.55  0.98
key wand 9.6  0.60 0.55  0.98  buttons 1
key wand 9.8  0.60 0.55  0.98
)";

/// He lets it go over its stand, where it lies already, then takes it again and throws it.
constexpr const char* kDrop = R"(
key wand 9.9  0.60 0.55  0.98  buttons 4
key wand 10   0.60 0.55  0.98
key wand 27.6 0.60 0.55  0.98  buttons 1
key wand 27.8 0.60 0.55  0.98
key wand 29.5 0.55 -0.50 1.15  turn 30 0 0  smooth
key wand 29.8 0.55 -0.48 1.15  turn 30 0 0  buttons 2 axes 0 0.95
key wand 30.3 0.52 0.44  1.68  turn 33 0 0  buttons 4
key wand 30.4 0.52 0.62  1.79  turn 33 0 0
key wand 36   0.52 0.44  1.68  turn 33 0 0
)";

TEST(ProgramOlympia, ADiscusDroppedOnItsStandEndsTheTurnAndCanBeTakenAgain) {
  const TestFolder folder;
  const std::string log = folder.path() / "drop.input";
  std::ofstream(log) << kTake << kDrop;
  const ProgramResult played =
      stadionProgram({"run", olympia(), "--input", log, "--walls", "desktop", "--size", "32x24", "--look",
                      "plain", "--seconds", "36", "--out", folder.path() / "out"});
  ASSERT_EQ(played.status, 0) << played.err;
  const auto summary = nlohmann::json::parse(fileContent(folder.path() / "out/summary.json"));
  const auto& throws = summary.at("measured");
  ASSERT_EQ(throws.size(), 2u) << "a foul has no distance";
  EXPECT_EQ(throws[0].at("node"), "rivals_tape") << "the athlete's turn has come";
  EXPECT_EQ(throws[1].at("node"), "tape") << "the discus could be taken again";
  EXPECT_GT(throws[1].at("metres"), 10);
}

// He has taken the discus, so the joypad does not move him; a few steps on his own feet must not end the
// game.
TEST(ProgramOlympia, AVisitorWithTheDiscusCanStepForwardThrowItAndWalkOn) {
  const TestFolder folder;
  const std::string log = folder.path() / "step.input";
  std::ofstream(log) << kTake << R"(
key head 10    0    0    1.70
key head 12    0    1.3  1.70
key wand 13    0.60 1.40 1.30
key wand 14    0.60 1.40 1.30
key wand 14.1  0.60 2.00 1.60  buttons 4
key wand 14.2  0.60 2.60 1.90
key wand 15    0.60 1.60 1.30  axes 0 1
key wand 19    0.60 1.60 1.30  axes 0 1
)";
  const ProgramResult played =
      stadionProgram({"run", olympia(), "--input", log, "--gl", "none", "--seconds", "19"});
  ASSERT_EQ(played.status, 0) << played.err;
  const std::string told = played.out + played.err;
  EXPECT_NE(told.find("measured   tape"), told.npos) << "the game is there still: " << told;
  EXPECT_NE(told.find("unloaded   discus"), told.npos) << "he can walk away: " << told;
}

TEST(ProgramOlympia, IsFoundRightByCheck) {
  const ProgramResult checked = stadionProgram({"check", olympia()});
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_EQ(checked.err.find("warning"), checked.err.npos) << checked.err;
}

TEST(ProgramOlympia, APartOfTheShowIsCheckedInIt) {
  const auto part = [](const char* name) {
    return (std::filesystem::path(olympia()).parent_path() / "olympia" / name).string();
  };
  // Its names are of the show around it.
  for (const char* name : {"game_discus.evs", "officials.evs"}) {
    const ProgramResult checked = stadionProgram({"check", part(name)});
    EXPECT_EQ(checked.status, 0) << checked.out;
    EXPECT_NE(checked.out.find(": ok, as a part of "), checked.out.npos) << checked.out;
    EXPECT_NE(checked.out.find("olympia.evs"), checked.out.npos) << checked.out;
  }
}

}  // namespace
}  // namespace stadion
