/// A live run decides by the clock; what it decides is recorded, and a replay obeys it.

#include "engine/input/input_recorder.h"
#include "tests/programs/desk.h"
#include "tests/programs/program.h"
#include "tests/show/player/played_show.h"

#include <csignal>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>

namespace stadion {
namespace {

/// A ball, and a part of the show that is to be there at once when it is asked for: so large that it will
/// come late on the fastest machine.
std::string writeShow(const TestFolder& folder) {
  std::string part = fileContent(testShow("part.evs"));
  for (int i = 0; i < 20000; ++i) part += fmt::format("group( name=g{}, position=\"0, 0, {}\" )\n", i, i);
  folder.write("part.evs", part);
  return folder.write("show.evs", fileContent(testShow("reload_without.evs")) +
                                      "timer( period=0.2, repeat=on, eventmessage=\"timesup, part, load\",\n"
                                      "       eventmessage=\"timesup, part, unload, 0.12\" )\n"
                                      "scene( name=part, file=part.evs, initstate=off, ready=0 )\n");
}

struct LiveRun {
  std::string hashes;  ///< as `stadion hash` prints them
  std::uint64_t missed = 0;
};

/// Plays 60 frames on the ticks of the clock; some of them take so long that ticks are missed.
LiveRun playLive(const std::string& show, const std::string& log, Mode mode) {
  LiveRun run;
  const auto player = openShow(show);
  if (!player) return run;
  InputRecorder recorder(log, player->rate());
  player->playLive();
  player->tellLateLoads([&](std::uint32_t load, Nanoseconds time) { recorder.lateLoad(load, time); });
  ShowParts parts = player->parts(StereoLayout::Off);
  FrameLoop* playing = nullptr;
  Nanoseconds ended = 0;
  parts.observer = [&](const TimeSignature& now, const InputSample& input, const Scene& scene) {
    ended = now.time;
    recorder.frame(now);
    recorder.record(input);
    run.hashes += fmt::format("{} {:016x}\n", now.frame, scene.stateHash());
    if (now.frame % 10 == 5) std::this_thread::sleep_for(std::chrono::milliseconds(60));
    if (now.frame == 59) playing->endAfterThisFrame();
  };
  ShowStages stages(std::move(parts));
  FrameLoopOptions o = player->loopOptions();
  o.mode = mode, o.pace = Pace::Lock, o.delivery = Delivery::Latest;
  const std::atomic<bool> never = false;
  FrameLoop loop(stages, o, never);
  playing = &loop;
  run.missed = loop.run().missedTicks;
  for (const std::uint32_t load : player->overdueLoads()) recorder.lateLoad(load, ended + 1);
  EXPECT_FALSE(recorder.commit());
  return run;
}

TEST(ProgramLiveRun, WithMissedTicksAndLateFilesReplaysToTheSameHashes) {
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined}) {
    const TestFolder folder;
    const std::string show = writeShow(folder), log = folder.path() / "live.input";
    const LiveRun live = playLive(show, log, mode);
    EXPECT_GE(live.missed, 6u);
    const std::string text = fileContent(log);
    EXPECT_NE(text.find("\nframe "), std::string::npos) << text;
    EXPECT_NE(text.find("\nload "), std::string::npos) << text;
    for (const char* replay : {"sequential", "pipelined"}) {
      const ProgramResult r = stadionProgram({"hash", show, "--input", log, "--mode", replay, "--asset-root",
                                              assetFolder(), "--walls", "desktop"});
      EXPECT_EQ(r.status, 0) << r.err;
      EXPECT_EQ(r.out, live.hashes) << text;
    }
    if (mode != Mode::Pipelined) continue;
    // Without the decisions it is another run.
    const ProgramResult other =
        stadionProgram({"hash", show, "--frames", "60", "--asset-root", assetFolder(), "--walls", "desktop"});
    EXPECT_NE(other.out, live.hashes);
  }
}

TEST(ProgramLiveRun, ThatIsStoppedReplaysToItsLastFrame) {
  const TestFolder folder;
  const std::string show = writeShow(folder), log = folder.path() / "live.input";
  ProgramRun run;
  // A thousand ticks a second are more than can be drawn.
  run.words = {stadionPath(), "run",   show,     "--asset-root", assetFolder(),    "--walls", "desktop",
               "--size",      "64x48", "--rate", "1000",         "--record-input", log,       "--json"};
  run.signal = SIGINT, run.signalWhen = playsLive;
  run.signalAfter = std::chrono::milliseconds(700);
  const ProgramResult live = runProgram(run);
  ASSERT_EQ(live.status, 130) << live.err;
  const auto summary = nlohmann::json::parse(live.out);
  // The log knows its rate.
  const ProgramResult r =
      stadionProgram({"hash", show, "--input", log, "--asset-root", assetFolder(), "--walls", "desktop"});
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string last = fmt::format("\n{} {}\n", summary.at("last_frame").get<int>(),
                                       summary.at("state_hash").get<std::string>());
  ASSERT_GE(r.out.size(), last.size());
  EXPECT_EQ(r.out.substr(r.out.size() - last.size()), last);

  const ProgramResult refused = stadionProgram(
      {"hash", show, "--input", log, "--rate", "60", "--asset-root", assetFolder(), "--walls", "desktop"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("live.input: error: was recorded live at 1000 frames a second"),
            std::string::npos)
      << refused.err;
}

// As timeout(1) does: it signals the process and then its whole group.
TEST(ProgramLiveRun, ThatIsToldTwiceAtOnceToStopEndsInOrder) {
  // The two are one within a tenth of a second. On a busy machine this test may take longer between them:
  // then it tries again.
  bool inOrder = false;
  std::string told;
  for (int tries = 0; tries < 20 && !inOrder; ++tries) {
    const TestFolder folder;
    const std::string journal = folder.path() / "run.log", out = folder.path() / "out";
    RunningProgram program({{stadionPath(), "run", writeShow(folder), "--asset-root", assetFolder(),
                             "--walls", "desktop", "--size", "64x48", "--frames", "1000000", "--pictures",
                             "none", "--journal", journal, "--out", out}});
    ASSERT_TRUE(program.waitUntil([&] { return has(fileContent(journal), "the first picture"); }));
    kill(program.pid(), SIGINT), kill(-program.pid(), SIGINT);
    EXPECT_EQ(program.status(), 130) << program.err();
    inOrder = std::filesystem::exists(out + "/summary.json");
    told = program.out() + program.err();
  }
  EXPECT_TRUE(inOrder) << told;
}

}  // namespace
}  // namespace stadion
