/// What is decided about nodes that cost too much is obeyed from the frame on whose signature says so, and
/// the same by everyone; levels of detail follow the visitor's distance; the log keeps all of it.

#include "engine/base/plain_file.h"
#include "engine/input/input_log.h"
#include "engine/input/input_recorder.h"
#include "engine/nodes/group_node.h"
#include "engine/nodes/lod_node.h"
#include "engine/nodes/object_node.h"
#include "engine/nodes/path_node.h"
#include "engine/nodes/scene_node.h"
#include "engine/nodes/sway_node.h"
#include "tests/engine/scene/show_fixture.h"
#include "tests/fresh_folder.h"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

namespace stadion {
namespace {

/// Runs on its own in every frame, as a dynamics node whose bodies move.
/// Goes on step by step, as dynamics nodes do.
constexpr NodeType kRunningType{
    .name = "running", .help = "", .traits = {Trait::Collides, Trait::Degradable}};

class RunningNode : public Node {
public:
  RunningNode(NodeRef self, std::string name) : Node(kRunningType, self, std::move(name)) {}
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
    loader.files["show"] = [this](LoadedScene& load) {
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
      load.terms[kGroup.position] = {1, {DegradationStep::Lod, DegradationStep::Hide}, 1};
      load.terms[kRunning.position] = {1, {DegradationStep::Half, DegradationStep::Rest}, 1};
    };
    EXPECT_TRUE(scene.open("show"));
    head(Vec3(0, 0, 0));
  }
  void addObject(LoadedScene& load, const std::string& name, const PlaceAttributes& place) {
    const auto position = static_cast<std::uint32_t>(load.nodes.size());
    load.nodes.push_back(std::make_unique<ObjectNode>(kObjectType, NodeRef{1, position}, name, place,
                                                      Appearance{mesh, true, "", 0.02}));
    load.enterOrder.push_back(position);
    load.names[name] = position;
  }

  void frame(std::initializer_list<DegradationDecision> decisions = {}) {
    TimeSignature now = signatureAt(next++, rate);
    for (const DegradationDecision& d : decisions) EXPECT_TRUE(now.decisions.add(d));
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

TEST(DegradationControl, WhatRunsHalfAsOftenRunsInEverySecondFrameWithTheStepsAddedUp) {
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

TEST(DegradationControl, MessagesReachWhatRunsMoreSeldomAtOnce) {
  LoadFixture f;
  f.frames(4);
  f.frame({{1, 2, 3}});
  f.frames(5);
  const std::size_t before = f.running->cycles.size();
  f.scene.command("running", CommandId::Reset, {}, 0);
  f.frame();
  ASSERT_EQ(f.running->heard.size(), 1U);
  EXPECT_EQ(f.running->heard[0], 10U);
  EXPECT_EQ(f.running->cycles.size(), before + 1);
}

TEST(DegradationControl, WhatRestsStandsStillAndGoesOnWithOneStep) {
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

TEST(DegradationControl, WhatIsHiddenIsNotDrawnWithAllBelowItUntilItComesBack) {
  LoadFixture f;
  f.frames(2);
  EXPECT_TRUE(f.shown(1));
  f.frame({{1, 0, 4}});
  EXPECT_FALSE(f.shown(1));
  f.frame({{1, 0, 3}});
  EXPECT_TRUE(f.shown(1));
}

TEST(DegradationControl, TheAuthorsOwnHidingIsNotUndone) {
  LoadFixture f;
  f.frames(2);
  f.scene.command("object", CommandId::Hide, {}, 0);
  f.frame({{1, 0, 4}});
  f.frames(2);
  f.frame({{1, 0, 0}});
  EXPECT_FALSE(f.shown(1));
  f.scene.command("object", CommandId::Show, {}, 0);
  f.frame();
  EXPECT_TRUE(f.shown(1));
}

TEST(DegradationControl, LessDetailIsInTheRecordsOfAllBelow) {
  LoadFixture f;
  f.frames(2);
  f.frame({{1, 0, 2}});
  EXPECT_DOUBLE_EQ(f.scene.degradation().of(LoadFixture::kObject).lod, 2.25);
  EXPECT_EQ(f.scene.degradation().of(LoadFixture::kRunning), NodeDegradation{});
}

TEST(DegradationControl, DecisionsAboutNoNodeAreIgnored) {
  LoadFixture f;
  f.frames(2);
  f.frame({{7, 3, 2}, {1, 1, 1}, {1, 999, 1}});
  f.frame({{1, 2, 99}});  // a level that the ladder does not have
  f.frames(2);
  EXPECT_EQ(f.scene.degradation().of(LoadFixture::kObject), NodeDegradation{});
  EXPECT_TRUE(f.scene.degradation().of(LoadFixture::kRunning).rests);
}

TEST(DegradationControl, TheSameDecisionsGiveTheSameHashAndOthersDoNot) {
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

/// Looks at where a placement goes, in every frame in which it moves.
class LookingNode : public Node {
public:
  LookingNode(NodeRef self, std::string name, const PlacedNode& at)
      : Node(kGroupType, self, std::move(name)), at_(at) {}
  Rank rank() const override { return Rank::Outcome; }
  PoseTrack way;  ///< in the last of them

protected:
  void onEnter(Scene& scene) override {
    scene.schedule().watch(at_.placement(), self());
    before_ = poseOf(scene.placements().world(at_.placement()));
  }
  void simulate(FrameContext& frame) override {
    const Placements& placements = frame.scene.placements();
    way =
        frame.scene.poseTracks().within(at_.placement(), before_, frame.start(), frame.now.time, placements);
    before_ = poseOf(placements.world(at_.placement()));
  }

private:
  const PlacedNode& at_;
  Pose before_;
};

/// A scene, whose file holds a path that runs along x at 1 m/s and restarts after two metres, a sway
/// along y, and a node that watches the path.
struct StandsFixture : ShowFixture {
  static constexpr NodeRef kScene{1, 0}, kPath{2, 0};
  static constexpr std::uint32_t kHalf = 1, kQuarter = 2, kRest = 3;
  PathNode* path = nullptr;
  SwayNode* sway = nullptr;
  LookingNode* looking = nullptr;

  StandsFixture() {
    loader.files["show"] = [](LoadedScene& load) {
      addNode<SceneNode>(load, "stands", PlaceAttributes{}, "stands", Nanoseconds{0}, true);
      load.terms[kScene.position] = {1, {DegradationStep::Half, DegradationStep::Rest}, 1};
    };
    loader.files["stands"] = [this](LoadedScene& load) {
      const std::vector<Keyframe> keys{{0, {Vec3::Zero(), Quat::Identity()}},
                                       {2, {Vec3(2, 0, 0), Quat::Identity()}}};
      path = &addNode<PathNode>(load, "path", PlaceAttributes{}, NodeRef{}, keys, true, false, true);
      SwayAttributes swell;
      swell.amplitude = Vec3(0, 1, 0), swell.frequency = Vec3(0, 0.25, 0);
      sway = &addNode<SwayNode>(load, "sway", PlaceAttributes{}, swell, true);
      looking = &addNode<LookingNode>(load, "looking", *path);
      load.terms[kPath.position] = {1, {DegradationStep::Half, DegradationStep::Rest}, 1};
    };
    EXPECT_TRUE(scene.open("show"));
    frames(4);
  }
  void decide(NodeRef node, std::uint32_t level) {
    TimeSignature now = signatureAt(next++, rate);
    EXPECT_TRUE(now.decisions.add({node.load, node.position, level}));
    input.time = now.time;
    scene.advance(now, input, changes, nullptr);
  }
  double now() const { return toSeconds(scene.now()); }
  double x() const { return scene.placements().world(path->placement()).translation().x(); }
  double y() const { return scene.placements().world(sway->placement()).translation().y(); }
};

double swellAt(double t) {
  return std::sin(0.5 * 3.14159265358979323846 * t);
}

TEST(DegradationControl, WhatMovesByTheTimeInASceneAtHalfPaceIsInEverySecondFrameWhereItsTimeHasIt) {
  StandsFixture f;
  f.decide(StandsFixture::kScene, StandsFixture::kHalf);
  int pathRan = 0, swayRan = 0;
  for (int i = 0; i < 300; ++i) {
    const double x = f.x(), y = f.y();
    f.frame();
    pathRan += f.x() != x, swayRan += f.y() != y;
    EXPECT_NEAR(f.x(), f.x() != x ? std::fmod(f.now(), 2) : x, 1e-9);
    EXPECT_NEAR(f.y(), f.y() != y ? swellAt(f.now()) : y, 1e-9);
  }
  EXPECT_EQ(pathRan, 150);
  EXPECT_NEAR(swayRan, 150, 2) << "twice it turns within two frames";
}

TEST(DegradationControl, WhatMovesByTheTimeStandsStillInASceneThatRestsAndGoesOnFromThere) {
  StandsFixture f;
  f.frames(60);
  const double x = f.x(), t = f.now();
  f.decide(StandsFixture::kScene, StandsFixture::kRest);
  for (int i = 0; i < 40; ++i) {
    f.frame();
    EXPECT_EQ(f.scene.counters().nodesVisited, 0U);
    EXPECT_EQ(f.x(), x);
    EXPECT_NEAR(f.y(), swellAt(t), 1e-9);
  }
  f.decide(StandsFixture::kScene, 0);
  EXPECT_NEAR(f.x(), x + 1 / f.rate, 1e-8);
  EXPECT_NEAR(f.y(), swellAt(t + 1 / f.rate), 1e-8);
  ASSERT_EQ(f.looking->way.size(), 2U);
  EXPECT_FALSE(f.looking->way[1].jump);
  f.frames(30);
  EXPECT_NEAR(f.x(), x + 31 / f.rate, 1e-8);
}

TEST(DegradationControl, APathGivesUpItsPaceByItself) {
  StandsFixture f;
  f.decide(StandsFixture::kPath, StandsFixture::kRest);
  const double x = f.x();
  f.frames(20);
  EXPECT_EQ(f.x(), x);
  EXPECT_NEAR(f.y(), swellAt(f.now()), 1e-9) << "its neighbour goes on";
}

TEST(DegradationControl, WhatAPathHasMissedIsAWayThroughTheFrameInWhichItRuns) {
  StandsFixture f;
  f.decide(StandsFixture::kScene, StandsFixture::kQuarter);
  bool restarted = false;
  for (int i = 0; i < 300; ++i) {
    const double before = f.x();
    const Nanoseconds start = f.scene.now();
    f.frame();
    if (f.x() == before) continue;
    const PoseTrack& way = f.looking->way;
    ASSERT_EQ(way.size(), 2U);
    EXPECT_EQ(way[0].time, start);
    EXPECT_NEAR(way[0].X.p.x(), before, 1e-9);
    EXPECT_EQ(way[1].time, f.scene.now());
    EXPECT_NEAR(way[1].X.p.x(), f.x(), 1e-9);
    EXPECT_EQ(way[1].jump, f.x() < before);
    restarted |= way[1].jump;
  }
  EXPECT_TRUE(restarted);
}

TEST(DegradationControl, ThoseThatRunNowAndThenTakeTurnsWhereverTheyStandInTheirFile) {
  constexpr std::uint32_t kPaths = 200;
  for (const std::uint32_t apart : {1U, 2U, 3U, 4U}) {
    ShowFixture f;
    f.loader.files["show"] = [](LoadedScene& load) {
      addNode<SceneNode>(load, "stands", PlaceAttributes{}, "stands", Nanoseconds{0}, true);
      load.terms[0] = {1, {DegradationStep::Half, DegradationStep::Rest}, 1};
    };
    f.loader.files["stands"] = [&](LoadedScene& load) {
      for (std::uint32_t i = 0; i < apart * kPaths; ++i) {
        if (i % apart != 0) {
          addNode<ListeningNode>(load, "");
          continue;
        }
        const std::vector<Keyframe> keys{{0, {}}, {9, {Vec3(2, 0, 0), Quat::Identity()}}};
        addNode<PathNode>(load, "", PlaceAttributes{}, NodeRef{}, keys, true, false, true);
      }
    };
    ASSERT_TRUE(f.scene.open("show"));
    f.frames(4);
    TimeSignature now = signatureAt(f.next++, f.rate);
    ASSERT_TRUE(now.decisions.add({1, 0, 2}));
    f.scene.advance(now, f.input, f.changes, nullptr);
    for (int i = 0; i < 8; ++i) {
      f.frame();
      EXPECT_NEAR(static_cast<double>(f.scene.counters().nodesVisited), kPaths / 4.0, kPaths / 20.0) << apart;
    }
  }
}

TEST(DegradationControl, WhatIsInAHandGoesAlongThoughItsSceneRests) {
  StandsFixture f;
  f.tracker("wand", Vec3(5, 0, 0));
  f.scene.command("stands/path", CommandId::Attach, {"all", "wand"}, 0);
  f.frames(2);
  f.decide(StandsFixture::kScene, StandsFixture::kRest);
  f.tracker("wand", Vec3(6, 0, 0));
  f.frame();
  EXPECT_NEAR(f.x(), 6, 1e-9);
}

TEST(DegradationControl, ThatAPathHasRestedSinceItsLastTurnIsPartOfTheState) {
  using Decisions = std::map<std::uint64_t, std::uint32_t>;
  const auto hash = [](const Decisions& decisions) {
    StandsFixture f;
    while (f.next <= 10)
      decisions.contains(f.next) ? f.decide(StandsFixture::kPath, decisions.at(f.next)) : f.frame();
    return f.scene.stateHash();
  };
  const auto quarter = StandsFixture::kQuarter, rest = StandsFixture::kRest;
  EXPECT_EQ(hash({{9, rest}, {10, quarter}}), hash({{9, rest}, {10, quarter}}));
  EXPECT_NE(hash({{9, rest}, {10, quarter}}), hash({{9, quarter}})) << "frame 9 does not count";
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
  EXPECT_DOUBLE_EQ(f.scene.degradation().stress(), std::sqrt(2.0));
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

TEST(DegradationInLogs, IsReadAsItWasWritten) {
  InputLog log;
  log.decisions.rate = 60;
  log.decisions.degradation = {{7, {1, 14, 2}}, {7, {0, 0, 3}}, {90, {1, 14, 0}}};
  Diagnostics findings;
  const std::string text = formatInputLog(log);
  const auto again = parseInputLog(text, "t.input", findings);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->decisions.degradation, log.decisions.degradation);
  EXPECT_EQ(formatInputLog(*again), text);
}

TEST(DegradationInLogs, TheRecorderWritesWhatTheSignaturesSay) {
  const FreshFolder folder;
  const std::string file = folder / "relief.input";
  InputRecorder recorder(file, 60);
  for (std::uint64_t n = 0; n < 10; ++n) {
    TimeSignature now = signatureAt(n, 60);
    if (n == 4) now.decisions.add({1, 2, 3}), now.decisions.add({0, 0, 5});
    recorder.frame(now);
  }
  EXPECT_FALSE(recorder.commit());
  Diagnostics findings;
  const auto log = loadInputLog(file, findings);
  std::filesystem::remove(file);
  ASSERT_TRUE(log);
  EXPECT_EQ(log->decisions.degradation, (DegradationDecisions{{4, {1, 2, 3}}, {4, {0, 0, 5}}}));
}

TEST(DegradationInLogs, MistakesAreToldWithTheirPlace) {
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
