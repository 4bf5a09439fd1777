/// What is decided about nodes that cost too much is obeyed from the frame on whose signature says so, and
/// the same by everyone; levels of detail follow the visitor's distance; the log keeps all of it.

#include "engine/input/input_log.h"
#include "engine/input/input_recorder.h"
#include "engine/nodes/lod_node.h"
#include "engine/plain_file.h"
#include "tests/engine/show_fixture.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

namespace stadion {
namespace {

/// Runs on its own in every frame, as a dynamics node whose bodies move.
class RunningNode : public Node {
public:
  RunningNode(NodeRef self, std::string name) : Node(NodeKind::Dynamics, self, std::move(name)) {}
  bool busy() const override { return true; }
  Rank rank() const override { return Rank::Dynamics; }
  struct Cycle {
    std::uint64_t frame;
    Nanoseconds start;
    bool rested;
  };
  std::vector<Cycle> cycles;
  std::vector<std::uint64_t> heard;

protected:
  void receive(const Message&, FrameContext& frame) override { heard.push_back(frame.now.frame); }
  void simulate(FrameContext& frame) override {
    cycles.push_back({frame.now.frame, frame.start(), frame.rested});
  }
};

/// A group with an object in it, a node that runs, and an lod node with two children.
struct LoadFixture : ShowFixture {
  RunningNode* running = nullptr;
  LodNode* lod = nullptr;
  MeshId mesh = meshes.add(unitMesh());
  static constexpr NodeRef kGroup{1, 0}, kObject{1, 1}, kRunning{1, 2}, kLod{1, 3};

  LoadFixture() {
    loader.files["show"] = [this](Load& load) {
      addNode<MovingNode>(load, "group", PlaceAttributes{}, false);
      PlaceAttributes below;
      below.parent = kGroup;
      addObject(load, "object", below);
      running = &addNode<RunningNode>(load, "running");
      PlaceAttributes away;
      away.X_PN.translation() = Vec3(0, 10, 0);
      lod = &addNode<LodNode>(load, "lod", away, std::vector<NodeRef>{{1, 4}, {1, 5}},
                              std::vector<double>{5, 20});
      PlaceAttributes ofLod;
      ofLod.parent = kLod;
      addObject(load, "near", ofLod);
      addObject(load, "far", ofLod);
      load.terms[kGroup.position] = {1, {Concession::Lod, Concession::Hide}, 1};
      load.terms[kRunning.position] = {1, {Concession::Half, Concession::Rest}, 1};
    };
    EXPECT_TRUE(scene.open("show"));
    head(Vec3(0, 0, 0));
  }
  void addObject(Load& load, const std::string& name, const PlaceAttributes& place) {
    const auto position = static_cast<std::uint32_t>(load.nodes.size());
    load.nodes.push_back(std::make_unique<ObjectNode>(NodeKind::Object, NodeRef{1, position}, name, place,
                                                      Appearance{mesh, true, "", 0.02}));
    load.enterOrder.push_back(position);
    load.names[name] = position;
  }

  void frame(std::initializer_list<LoadDecision> decisions = {}) {
    TimeSignature now = signatureAt(next++, rate);
    for (const LoadDecision& d : decisions) EXPECT_TRUE(now.load.add(d));
    input.time = now.time;
    scene.advance(now, input, changes, nullptr);
    for (const ChangeSet::Instance& i : changes.instances) records[i.record.owner] = i.record;
  }
  void frames(std::uint64_t count) {
    for (; count > 0; --count) frame();
  }
  bool shown(std::uint32_t position) {
    const InstanceRecord& r = records.at({1, position});
    return (r.flags & InstanceRecord::kShown) != 0;
  }
  std::map<NodeRef, InstanceRecord> records;
};

TEST(LoadControl, WhatRunsHalfAsOftenRunsInEverySecondFrameWithTheStepsAddedUp) {
  LoadFixture f;
  f.frames(4);
  f.frame({{1, 2, 1}});
  f.running->cycles.clear();
  f.frames(10);
  ASSERT_EQ(f.running->cycles.size(), 5U);
  for (std::size_t i = 1; i < 5; ++i) {
    const auto &before = f.running->cycles[i - 1], &now = f.running->cycles[i];
    EXPECT_EQ(now.frame, before.frame + 2);
    EXPECT_EQ(now.start, signatureAt(before.frame, f.rate).time);
    EXPECT_FALSE(now.rested);
  }
}

TEST(LoadControl, MessagesReachWhatRunsMoreSeldomAtOnce) {
  LoadFixture f;
  f.frames(4);
  f.frame({{1, 2, 3}});
  f.frames(5);
  const std::size_t before = f.running->cycles.size();
  f.scene.command("running", Verb::Reset, {}, 0);
  f.frame();
  ASSERT_EQ(f.running->heard.size(), 1U);
  EXPECT_EQ(f.running->heard[0], 10U);
  EXPECT_EQ(f.running->cycles.size(), before + 1);
}

TEST(LoadControl, WhatRestsStandsStillAndGoesOnWithOneStep) {
  LoadFixture f;
  f.frames(4);
  f.frame({{1, 2, 3}});
  f.running->cycles.clear();
  f.frames(20);
  EXPECT_TRUE(f.running->cycles.empty());
  f.frame({{1, 2, 0}});
  ASSERT_EQ(f.running->cycles.size(), 1U);
  EXPECT_TRUE(f.running->cycles[0].rested);
  EXPECT_EQ(f.running->cycles[0].start, signatureAt(24, f.rate).time);
  f.frame();
  EXPECT_FALSE(f.running->cycles[1].rested);
}

TEST(LoadControl, WhatIsHiddenIsNotDrawnWithAllBelowItUntilItComesBack) {
  LoadFixture f;
  f.frames(2);
  EXPECT_TRUE(f.shown(1));
  f.frame({{1, 0, 4}});
  EXPECT_FALSE(f.shown(1));
  f.frame({{1, 0, 3}});
  EXPECT_TRUE(f.shown(1));
}

TEST(LoadControl, TheAuthorsOwnHidingIsNotUndone) {
  LoadFixture f;
  f.frames(2);
  f.scene.command("object", Verb::Hide, {}, 0);
  f.frame({{1, 0, 4}});
  f.frames(2);
  f.frame({{1, 0, 0}});
  EXPECT_FALSE(f.shown(1));
  f.scene.command("object", Verb::Show, {}, 0);
  f.frame();
  EXPECT_TRUE(f.shown(1));
}

TEST(LoadControl, LessDetailIsInTheRecordsOfAllBelow) {
  LoadFixture f;
  f.frames(2);
  f.frame({{1, 0, 2}});
  EXPECT_DOUBLE_EQ(f.scene.reliefOf(LoadFixture::kObject).lod, 2.25);
  EXPECT_EQ(f.scene.reliefOf(LoadFixture::kRunning), Relief{});
}

TEST(LoadControl, DecisionsAboutNobodyAreLeft) {
  LoadFixture f;
  f.frames(2);
  f.frame({{7, 3, 2}, {1, 1, 1}, {1, 999, 1}});
  f.frame({{1, 2, 99}});  // a level that the ladder does not have
  f.frames(2);
  EXPECT_EQ(f.scene.reliefOf(LoadFixture::kObject), Relief{});
  EXPECT_TRUE(f.scene.reliefOf(LoadFixture::kRunning).rests);
}

TEST(LoadControl, TheSameDecisionsGiveTheSameHashAndOthersDoNot) {
  const auto hashes = [](std::uint64_t at, std::uint32_t level) {
    LoadFixture f;
    std::vector<std::uint64_t> all;
    for (std::uint64_t n = 0; n < 20; ++n) {
      n == at ? f.frame({{1, 2, level}}) : f.frame();
      all.push_back(f.scene.stateHash());
    }
    return all;
  };
  EXPECT_EQ(hashes(5, 1), hashes(5, 1));
  EXPECT_NE(hashes(5, 1), hashes(6, 1));
  EXPECT_NE(hashes(5, 1), hashes(5, 2));
  EXPECT_EQ(hashes(5, 1)[4], hashes(6, 1)[4]);
}

TEST(LodNode, DrawsTheChildForTheDistanceAndComesBackATenthNearer) {
  const std::vector<double> ranges{10, 50};
  EXPECT_EQ(LodNode::levelAt(9.9, 0, ranges), 0U);
  EXPECT_EQ(LodNode::levelAt(10, 0, ranges), 1U);
  EXPECT_EQ(LodNode::levelAt(9.5, 1, ranges), 1U);
  EXPECT_EQ(LodNode::levelAt(8.9, 1, ranges), 0U);
  EXPECT_EQ(LodNode::levelAt(60, 0, ranges), 2U);
  EXPECT_EQ(LodNode::levelAt(46, 2, ranges), 2U);
  EXPECT_EQ(LodNode::levelAt(44, 2, ranges), 1U);
}

TEST(LodNode, ShowsOneChildWhereverTheVisitorIs) {
  LoadFixture f;
  f.frames(2);
  EXPECT_FALSE(f.shown(4));
  EXPECT_TRUE(f.shown(5));
  f.head(Vec3(0, 8, 0));
  f.frame();
  EXPECT_TRUE(f.shown(4));
  EXPECT_FALSE(f.shown(5));
  f.head(Vec3(0, 40, 0));
  f.frame();
  EXPECT_FALSE(f.shown(4));
  EXPECT_FALSE(f.shown(5));
}

TEST(LodNode, UnderStressEverythingCountsAsFartherAway) {
  LoadFixture f;
  f.head(Vec3(0, 6, 0));  // 4 m away
  f.frames(2);
  EXPECT_TRUE(f.shown(4));
  f.frame({{0, 0, 2}});  // 2^(2/4) times
  EXPECT_DOUBLE_EQ(f.scene.stress(), std::sqrt(2.0));
  EXPECT_FALSE(f.shown(4));
  EXPECT_TRUE(f.shown(5));
  EXPECT_DOUBLE_EQ(f.changes.viewer.stress, std::sqrt(2.0));
  f.frame({{0, 0, 0}});
  EXPECT_TRUE(f.shown(4));
}

TEST(LodNode, TheChoiceIsNoPartOfTheStateHash) {
  LoadFixture near, far;
  far.head(Vec3(0, -50, 0));
  near.frames(3), far.frames(3);
  EXPECT_EQ(near.scene.stateHash(), far.scene.stateHash());
}

TEST(ReliefInLogs, IsReadAsItWasWritten) {
  InputLog log;
  log.decisions.rate = 60;
  log.decisions.relief = {{7, {1, 14, 2}}, {7, {0, 0, 3}}, {90, {1, 14, 0}}};
  Diagnostics findings;
  const std::string text = formatInputLog(log);
  const auto again = parseInputLog(text, "t.input", findings);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->decisions.relief, log.decisions.relief);
  EXPECT_EQ(formatInputLog(*again), text);
}

TEST(ReliefInLogs, TheRecorderWritesWhatTheSignaturesSay) {
  const std::string file =
      (std::filesystem::temp_directory_path() / ("relief-" + std::to_string(getpid()) + ".input")).string();
  InputRecorder recorder(file, 60);
  for (std::uint64_t n = 0; n < 10; ++n) {
    TimeSignature now = signatureAt(n, 60);
    if (n == 4) now.load.add({1, 2, 3}), now.load.add({0, 0, 5});
    recorder.frame(now);
  }
  EXPECT_FALSE(recorder.commit());
  Diagnostics findings;
  const auto log = loadInputLog(file, findings);
  std::filesystem::remove(file);
  ASSERT_TRUE(log);
  EXPECT_EQ(log->decisions.relief, (LoadDecisions{{4, {1, 2, 3}}, {4, {0, 0, 5}}}));
}

TEST(ReliefInLogs, MistakesAreToldWithTheirPlace) {
  const auto first = [](const std::string& records) {
    Diagnostics out;
    EXPECT_FALSE(parseInputLog("stadion-input 2\nrate 60\n" + records, "t.input", out));
    return out.all().empty() ? std::string()
                             : format(out.all()[0]).substr(0, format(out.all()[0]).find('\n'));
  };
  EXPECT_EQ(first("relief 5 1 2\n"), "t.input:3:13: error: the level is missing");
  EXPECT_NE(first("relief 5 0 2 1\n").find("t.input:3:10: error"), std::string::npos);
  EXPECT_NE(first("stress 5 17\n").find("t.input:3:10: error"), std::string::npos);
  EXPECT_NE(first("stress 5 1 1\n").find("one word too many"), std::string::npos);
  EXPECT_NE(first("relief 5 1 2 1\nrelief 5 1 2 2\n").find("said already"), std::string::npos);
  EXPECT_NE(first("relief 5 1 1 1\nrelief 5 1 2 1\nrelief 5 1 3 1\nrelief 5 1 4 1\nrelief 5 1 5 1\n")
                .find("at most 4"),
            std::string::npos);
}

}  // namespace
}  // namespace stadion
