/// A live run with a tracked head: late latch, prediction, and what the summary says of them.

#include "tests/programs/desk.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <lo/lo.h>
#include <nlohmann/json.hpp>
#include <thread>

namespace stadion {
namespace {

using nlohmann::json;

constexpr const char* kShow = R"(forcelinear( name=gravity, direction="0, 0, -1" )
object( name=floor, file=plane.3ds )
dynobject( name=ball, file=football.3ds, position="0, 4, 2", density=0.1, restitution=0.8, hook=gravity )
dynamics( collider=floor, collidee=ball )
usertrigger( sphere="0.2, 0, 1.7, 0.1", eventmessage="enter, gravity, toggle" )
)";

const std::string kLatencyWalls = STADION_SOURCE_DIR "/scripts/suites/two.walls";

std::string lastHash(const std::string& show, const std::string& input) {
  const ProgramResult r = stadionProgram({"hash", show, "--asset-root", assetFolder(), "--input", input});
  EXPECT_EQ(r.status, 0) << r.err;
  const auto line = r.out.rfind('\n', r.out.size() - 2);
  return r.out.substr(line == std::string::npos ? 0 : line + 1);
}

/// Plays while a head goes to and fro before the walls; the summary.
json visit(const TestFolder& folder, const std::vector<std::string>& more) {
  const std::string show = folder.write("show.evs", kShow);
  const std::string tracker = std::to_string(freePort()), desk = std::to_string(freePort());
  ProgramRun run{{stadionPath(), "run", show, "--asset-root", assetFolder(), "--walls", kLatencyWalls,
                  "--size", "64x48", "--look", "plain", "--no-sound", "--json", "--osc", desk, "--tracker",
                  "osc:" + tracker}};
  run.words.insert(run.words.end(), more.begin(), more.end());
  RunningProgram program(run);
  const lo_address head = lo_address_new("127.0.0.1", tracker.c_str());
  const lo_address operating = lo_address_new("127.0.0.1", desk.c_str());
  EXPECT_TRUE(program.says("playing until Ctrl-C"));
  for (int i = 0; i < 200 || program.runs(); ++i) {
    lo_send(head, "/tracker/head/pose", "ddddddd", 0.3 * std::sin(0.05 * i), 0.0, 1.7, 0.0, 0.0, 0.0, 1.0);
    if (i >= 200 && i % 10 == 0) lo_send(operating, "/stadion/end", "");
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  lo_address_free(head), lo_address_free(operating);
  EXPECT_EQ(program.status(), 0) << program.err();
  return json::parse(program.out(), nullptr, false);
}

TEST(ProgramLatency, FramesAreDrawnFromTheNewestHeadByThreadsAndByProcesses) {
  for (const char* drawnBy : {"thread", "process"}) {
    const TestFolder folder;
    const json s = visit(folder, {"--late-latch", "--wall-workers", drawnBy});
    ASSERT_TRUE(s.is_object());
    const json& latch = s.at("late_latch");
    EXPECT_GT(latch.at("frames"), 0);
    EXPECT_LE(latch.at("frames"), s.at("frames_drawn"));
    EXPECT_GT(latch.at("farthest_m"), 0.0) << "it has moved between App and Draw";
    EXPECT_FALSE(s.contains("predicted_ms"));
    EXPECT_EQ(s.at("motion_to_image_ms").size(), 2u);
    for (const auto& [wall, ms] : s.at("motion_to_image_ms").items()) {
      EXPECT_GT(ms.at("p50"), 0.0) << wall;
      EXPECT_GE(ms.at("p99"), ms.at("p50")) << wall;
    }
  }
}

TEST(ProgramLatency, TheRecordOfAHeadThatWasForeseenReplaysToTheSameState) {
  const TestFolder folder;
  const std::string record = folder.path() / "visit.input";
  const json s = visit(folder, {"--predict", "auto", "--late-latch", "--record-input", record});
  ASSERT_TRUE(s.is_object());
  EXPECT_GT(s.at("predicted_ms"), 0.0);
  EXPECT_EQ(lastHash(folder.path() / "show.evs", record),
            fmt::format("{} {}\n", s.at("last_frame").get<int>(), s.at("state_hash").get<std::string>()));
}

TEST(ProgramLatency, WhatNeedsALiveHeadIsRefusedWithoutOneAndWherePicturesMustBeTheSame) {
  const std::string show = testShow("moving.evs");
  const auto refusal = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"run", show});
    const ProgramResult r = stadionProgram(words);
    EXPECT_EQ(r.status, 2) << r.err;
    return r.err;
  };
  for (const std::vector<std::string>& asked :
       {std::vector<std::string>{"--late-latch"}, {"--predict", "20"}, {"--predict", "auto"}}) {
    EXPECT_NE(refusal(asked).find(asked[0] + " needs the head of a live tracker: --tracker osc:PORT"),
              std::string::npos);
    for (const std::vector<std::string>& every :
         {std::vector<std::string>{"--frames", "3"}, {"--out", "/tmp/x"}}) {
      std::vector<std::string> words = asked;
      words.insert(words.end(), every.begin(), every.end());
      EXPECT_NE(refusal(words).find(asked[0] + " is for live runs"), std::string::npos);
    }
  }
  EXPECT_NE(refusal({"--predict", "200"}).find("\"200\" is not auto or off, nor a number from 0 to 100"),
            std::string::npos);
  EXPECT_NE(refusal({"--predict", "soon"}).find("\"soon\" is not auto or off"), std::string::npos);
  EXPECT_NE(refusal({"--late-latch", "--latch-reach", "9", "0.1"}).find("9"), std::string::npos);
}

}  // namespace
}  // namespace stadion
