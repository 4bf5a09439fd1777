/// What a live run gave up because something took too long is in its log, and a replay of it goes the same
/// way, frame by frame, in every mode.

#include "engine/core/cost_budget.h"
#include "engine/input/input_recorder.h"
#include "tests/programs/program.h"
#include "tests/show/player/played_show.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <thread>

namespace stadion {
namespace {

/// Two worlds of their own: a ball that bounces for ever, and one that a carousel's arm meets; trees of
/// levels beside them.
constexpr const char* kDegradationShow = R"(
forcelinear( name=gravity, direction="0, 0, -1" )
object( name=ground, file=plane.3ds )
dynobject( name=ball, file=football.3ds, position="0, 3, 2", restitution=1, hook=gravity, levels=2 )
dynamics( name=game, collider=ground, collidee=ball, budget=0.8, onoverrun="half, rest" )
path( name=carousel, onoverrun="half, rest", target=arm, key="0, 4,6,1, 0,0,0", key="1, 4,6,1, 0,0,180", key="2, 4,6,1, 0,0,360", loop=on )
group( name=arm )
object( name=bat, file=football.3ds, parent=arm, position="1, 0, 0" )
dynobject( name=target, file=football.3ds, position="5, 6.5, 3", restitution=0.8, hook=gravity )
dynamics( name=bats, collider=ground, collider=bat, collidee=target, onoverrun="half, rest", priority=2 )
lod( name=tree, ranges="5, 20", position="0, 9, 0", onoverrun="lod, hide" )
object( file=football.3ds, parent=tree )
object( file=football.3ds, parent=tree, scale=2 )
)";

/// Decides what a test says.
class Scripted final : public DegradationDecider {
public:
  explicit Scripted(DegradationDecisions decisions) : decisions_(std::move(decisions)) {}
  FrameDecisions decide(std::uint64_t frame) override {
    FrameDecisions decisions;
    const auto [first, last] = decisions_.equal_range(frame);
    for (auto at = first; at != last; ++at) decisions.add(at->second);
    return decisions;
  }

private:
  DegradationDecisions decisions_;
};

/// Plays 150 frames live, with a tick missed now and then; returns the hashes as `stadion hash` prints them.
std::string playLive(const std::string& show, const std::string& log, Mode mode, bool relieved) {
  const auto player = openShow(show);
  if (!player) return {};
  const auto at = [&](const char* name) { return player->scene().tree().resolve(name, {1, 0}).position; };
  Scripted decider({{20, {1, at("game"), 1}},
                    {31, {1, at("game"), 3}},
                    {32, {1, at("bats"), 2}},
                    {32, {1, at("tree"), 4}},
                    {33, {0, 0, 5}},
                    {70, {1, at("game"), 2}},
                    {40, {1, at("carousel"), 1}},
                    {60, {1, at("carousel"), 3}},
                    {75, {1, at("carousel"), 2}},
                    {90, {1, at("game"), 0}},
                    {90, {1, at("bats"), 0}},
                    {100, {1, at("bats"), 3}},
                    {110, {1, at("carousel"), 0}},
                    {120, {1, at("bats"), 1}}});
  InputRecorder recorder(log, player->rate());
  std::string hashes;
  ShowParts parts = player->parts(StereoLayout::Off);
  FrameLoop* playing = nullptr;
  parts.observer = [&](const TimeSignature& now, const InputSample& input, const Scene& scene) {
    recorder.frame(now), recorder.record(input);
    hashes += fmt::format("{} {:016x}\n", now.frame, scene.stateHash());
    if (now.frame % 50 == 7) std::this_thread::sleep_for(std::chrono::milliseconds(60));
    if (now.frame == 149) playing->endAfterThisFrame();
  };
  ShowStages stages(std::move(parts));
  FrameLoopOptions o = player->loopOptions();
  o.mode = mode, o.pace = Pace::Lock, o.delivery = Delivery::Latest, o.rate = player->rate();
  if (relieved) o.decider = &decider;
  const std::atomic<bool> never = false;
  FrameLoop loop(stages, o, never);
  playing = &loop;
  loop.run();
  EXPECT_FALSE(recorder.commit());
  return hashes;
}

TEST(ProgramDegradationReplay, ARunThatGaveUpThingsReplaysToTheSameHashesInEveryMode) {
  for (const Mode mode : {Mode::Sequential, Mode::Pipelined}) {
    const TestFolder folder;
    const std::string show = folder.write("show.evs", kDegradationShow), log = folder.path() / "live.input";
    const std::string live = playLive(show, log, mode, true);
    ASSERT_FALSE(live.empty());
    const std::string text = fileContent(log);
    EXPECT_NE(text.find("\nrelief 31 1 3 3\n"), std::string::npos) << text;
    EXPECT_NE(text.find("\nstress 33 5\n"), std::string::npos) << text;
    for (const char* replay : {"sequential", "pipelined"}) {
      const ProgramResult r = stadionProgram({"hash", show, "--input", log, "--mode", replay, "--asset-root",
                                              assetFolder(), "--walls", "desktop"});
      EXPECT_EQ(r.status, 0) << r.err;
      EXPECT_EQ(r.out, live) << text;
    }
  }
}

TEST(ProgramDegradationReplay, TheSummaryTellsWhatWasObeyed) {
  const TestFolder folder;
  const std::string show = folder.write("show.evs", kDegradationShow);
  const std::string log = folder.write("a.input", "stadion-input 2\nrate 60\nframe 30 0.5\nrelief 5 1 3 3\n"
                                                  "stress 6 5\nstress 9 2\nrelief 8 1 3 1\n");
  const auto replayed = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words{"run",         show,      "--input", log,    "--asset-root",
                                   assetFolder(), "--walls", "desktop", "--gl", "none"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult r = stadionProgram(words);
    EXPECT_EQ(r.status, 0) << r.err;
    return r.out;
  };
  const auto summary = nlohmann::json::parse(replayed({"--json"}));
  const nlohmann::json stress{{"highest", stressOf(5)}, {"at_end", stressOf(2)}, {"changes", 2}};
  EXPECT_EQ(summary.value("stress", nlohmann::json()), stress);
  const nlohmann::json obeyed{{"node", "game"}, {"changes", 2}, {"highest_level", 3}, {"level", 1}};
  EXPECT_EQ(summary.value("obeyed", nlohmann::json()), nlohmann::json{obeyed});
  const std::string text = replayed({});
  EXPECT_NE(text.find("stress: everything counted as up to 2.38 times farther away"), std::string::npos)
      << text;
  EXPECT_NE(text.find("obeyed the log: game gave up 3 levels at most, 1 at the end, 2 changes"),
            std::string::npos)
      << text;
}

TEST(ProgramDegradationReplay, DecisionsAboutNothingAreTold) {
  const TestFolder folder;
  const std::string show = folder.write("show.evs", kDegradationShow);
  const std::string log = folder.write("a.input", "stadion-input 2\nrate 60\nframe 30 0.5\nrelief 5 1 3 3\n"
                                                  "relief 6 7 5 1\nrelief 7 1 99 1\nrelief 8 1 99 0\n"
                                                  "relief 9 1 0 1\n");
  const ProgramResult r = stadionProgram(
      {"run", show, "--input", log, "--asset-root", assetFolder(), "--walls", "desktop", "--gl", "none"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.out.find("note: decisions of the log about nodes that are not there or give nothing up: 4"),
            std::string::npos)
      << r.out;
  EXPECT_EQ(r.out.find("obeyed the log: ?"), std::string::npos) << r.out;
}

TEST(ProgramDegradationReplay, WithoutTheDecisionsItIsAnotherRun) {
  const TestFolder folder;
  const std::string show = folder.write("show.evs", kDegradationShow), log = folder.path() / "live.input";
  const std::string live = playLive(show, log, Mode::Sequential, true);
  std::string text = fileContent(log);
  for (std::size_t i = text.find("\nrelief "); i != std::string::npos; i = text.find("\nrelief "))
    text.erase(i, text.find('\n', i + 1) - i);
  const ProgramResult r = stadionProgram({"hash", show, "--input", folder.write("other.input", text),
                                          "--asset-root", assetFolder(), "--walls", "desktop"});
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.out, live);
  EXPECT_EQ(r.out.substr(0, r.out.find("\n20 ")), live.substr(0, live.find("\n20 ")));
}

}  // namespace
}  // namespace stadion
