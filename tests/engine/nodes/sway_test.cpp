#include "engine/maths/angles.h"
#include "engine/nodes/sway_node.h"

#include "engine/nodes/group_node.h"
#include "tests/engine/scene/show_fixture.h"

#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <set>

namespace stadion {
namespace {

SwayAttributes swell() {
  SwayAttributes a;
  a.amplitude = {2, 0.5, 1}, a.frequency = {0.2, 0.35, 0.5};
  a.phase = {0.3, -1, 2}, a.phaseStep = {0.7, 0.2, -0.4};
  a.angularVelocity = {0, 0, 0.8};
  return a;
}

PlaceAttributes at(double x, double y, double z, double scale = 1) {
  PlaceAttributes place;
  place.X_PN.translation() = Vec3(x, y, z);
  place.X_PN.linear() *= scale;
  return place;
}

/// A sway and its targets, boats on a line.
struct SwayShow : ShowFixture {
  static constexpr std::uint32_t kBoats = 3;
  std::vector<PlacedNode*> boats;
  SwayNode* sway = nullptr;

  explicit SwayShow(double framesPerSecond = 60, SwayAttributes a = swell(), std::uint32_t count = kBoats) {
    rate = framesPerSecond;
    const MeshId mesh = meshes.add(unitMesh());
    loader.files["show"] = [this, a, mesh, count](LoadedScene& load) mutable {
      for (std::uint32_t i = 0; i < count; ++i) {
        a.targets.push_back({load.number, i});
        boats.push_back(
            &addNode<MovingNode>(load, "boat" + std::to_string(i), at(10 * i, 1, 2, 1 + i), false, mesh));
      }
      sway = &addNode<SwayNode>(load, "sway", PlaceAttributes{}, a, true);
    };
    scene.open("show");
  }
  void until(double seconds) {
    while (signatureAt(next, rate).time <= fromSeconds(seconds)) frame();
  }
  const Affine& placeOf(std::size_t boat) { return scene.placements().world(boats[boat]->placement()); }
};

Affine expected(std::size_t boat, double t) {
  const SwayAttributes a = swell();
  Affine X = at(10.0 * static_cast<double>(boat), 1, 2).X_PN;
  for (int i = 0; i < 3; ++i)
    X.translation()[i] += a.amplitude[i] * std::sin(2 * kPi * a.frequency[i] * t + a.phase[i] +
                                                    static_cast<double>(boat) * a.phaseStep[i]);
  X.linear() =
      Eigen::AngleAxisd(0.8 * t, Vec3::UnitZ()).toRotationMatrix() * (1.0 + static_cast<double>(boat));
  return X;
}

void expectAt(SwayShow& show, double t) {
  for (std::size_t boat = 0; boat < show.boats.size(); ++boat)
    EXPECT_LT((show.placeOf(boat).matrix() - expected(boat, t).matrix()).cwiseAbs().maxCoeff(), 1e-12)
        << "boat " << boat << " at " << t;
}

TEST(Sway, MovesEachTargetAlongItsOwnSinusoidAndTurnsItKeepingItsScale) {
  SwayShow show;
  for (const double t : {0.0, 0.5, 7.0, 60.0}) {
    show.until(t);
    expectAt(show, t);
  }
}

TEST(Sway, MovesHundredsAsItMovesThree) {
  SwayShow show(60, swell(), 200);
  for (const double t : {0.5, 7.0}) {
    show.until(t);
    expectAt(show, t);
  }
}

TEST(Sway, TurnsWhatLiesAslantAboutAnyAxis) {
  ShowFixture show;
  PlacedNode* boat = nullptr;
  PlaceAttributes place;
  place.X_PN.linear() = Eigen::AngleAxisd(0.4, Vec3::UnitX()).toRotationMatrix() * Vec3(1, 2, 3).asDiagonal();
  const Vec3 omega(0.3, -0.2, 0.5);
  show.loader.files["show"] = [&](LoadedScene& load) {
    boat = &addNode<MovingNode>(load, "boat", place, false);
    SwayAttributes a;
    a.targets = {{load.number, 0}}, a.angularVelocity = omega;
    addNode<SwayNode>(load, "sway", PlaceAttributes{}, a, true);
  };
  show.scene.open("show");
  while (show.input.time < fromSeconds(2)) show.frame();
  const Mat3 turned =
      Eigen::AngleAxisd(2 * omega.norm(), omega.normalized()).toRotationMatrix() * place.X_PN.linear();
  const Affine& X = show.scene.placements().world(boat->placement());
  EXPECT_LT((X.linear() - turned).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Sway, IsTheSameToTheBitAtEveryFrameRate) {
  SwayShow slow(10), fast(240);
  slow.until(3), fast.until(3);
  for (std::size_t boat = 0; boat < SwayShow::kBoats; ++boat)
    EXPECT_EQ(slow.placeOf(boat).matrix(), fast.placeOf(boat).matrix());
}

TEST(Sway, IsVisitedAloneHoweverManyItMoves) {
  SwayShow show;
  show.frames(3);
  EXPECT_EQ(show.scene.counters().nodesVisited, 1u);
  EXPECT_EQ(show.scene.counters().changesPublished, SwayShow::kBoats);
}

TEST(Sway, DisableLeavesTheTargetsWhereTheyAreAtTheCommandsTime) {
  for (const double rate : {30.0, 60.0, 240.0}) {
    SwayShow show(rate);
    show.until(0.9);
    show.scene.command("sway", CommandId::Disable, {}, fromSeconds(1.2345));
    show.until(2);
    expectAt(show, 1.2345);
    show.frame();
    EXPECT_EQ(show.scene.counters().nodesVisited, 0u);
    EXPECT_TRUE(show.changes.instances.empty());
  }
}

TEST(Sway, EnableGoesOnWhereDisableStoppedAndResetRestarts) {
  SwayShow show;
  show.scene.command("sway", CommandId::Disable, {}, fromSeconds(0.5));
  show.scene.command("sway", CommandId::Enable, {}, fromSeconds(1.25));
  show.until(2);
  expectAt(show, 1.25);
  show.scene.command("sway", CommandId::Reset, {}, fromSeconds(2.5));
  show.until(3);
  expectAt(show, 0.5);
}

TEST(Sway, TheStateFollowsFromTheTimeForWhichItWasOn) {
  SwayShow one, other;
  one.scene.command("sway", CommandId::Disable, {}, fromSeconds(0.5));
  other.scene.command("sway", CommandId::Disable, {}, fromSeconds(0.6));
  // From then on both have been on for as long.
  other.scene.command("sway", CommandId::Reset, {}, fromSeconds(1));
  one.scene.command("sway", CommandId::Reset, {}, fromSeconds(1));
  one.until(0.8), other.until(0.8);
  EXPECT_NE(one.scene.stateHash(), other.scene.stateHash());
  one.until(2), other.until(2);
  EXPECT_EQ(one.scene.stateHash(), other.scene.stateHash());
}

TEST(Sway, WhatFollowsATrackerIsLeftAloneUntilItIsDetached) {
  SwayShow show;
  show.tracker("wand", {5, 5, 5});
  show.scene.command("boat1", CommandId::Attach, {"all", "wand"}, fromSeconds(0.5));
  show.scene.command("boat1", CommandId::Detach, {}, fromSeconds(1.5));
  show.until(1);
  EXPECT_LT((show.placeOf(1).translation() - Vec3(5, 5, 5)).norm(), 1e-12);
  show.until(2);
  expectAt(show, 2);
}

TEST(Sway, WithoutTargetsItMovesWhatStandsBelowIt) {
  ShowFixture show;
  PlacedNode* below = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    addNode<SwayNode>(load, "sway", at(0, 0, 1), swell(), true);
    PlaceAttributes place = at(3, 0, 0);
    place.parent = {load.number, 0};
    below = &addNode<MovingNode>(load, "below", place, false);
  };
  show.scene.open("show");
  while (show.input.time < fromSeconds(1)) show.frame();
  const SwayAttributes a = swell();
  Vec3 p = Vec3(0, 0, 1) + Eigen::AngleAxisd(0.8, Vec3::UnitZ()) * Vec3(3, 0, 0);
  for (int i = 0; i < 3; ++i) p[i] += a.amplitude[i] * std::sin(2 * kPi * a.frequency[i] + a.phase[i]);
  EXPECT_LT((show.scene.placements().world(below->placement()).translation() - p).norm(), 1e-12);
}

/// What has been published of each boat.
struct Published {
  std::map<NodeRef, InstanceRecord> records;

  /// Takes up the last frame's changes, and compares with where the boats are.
  void follow(SwayShow& show) {
    std::set<InstanceId> told;
    for (const ChangeSet::Instance& i : show.changes.instances) {
      EXPECT_TRUE(told.insert(i.id).second) << "told twice";
      records[i.record.owner] = i.record;
    }
    for (std::size_t k = 0; k < show.boats.size(); ++k) {
      const InstanceRecord& r = records[show.boats[k]->self()];
      const Affine& X = show.placeOf(k);
      for (int at = 0; at < 12; ++at)
        ASSERT_EQ(r.model[at], X(at / 4, at % 4)) << "boat " << k << ", frame " << show.next;
      ASSERT_EQ((r.flags & InstanceRecord::kShown) != 0,
                show.scene.placements().shown(show.boats[k]->placement()))
          << "boat " << k << ", frame " << show.next;
    }
  }
};

TEST(Sway, EachIsPublishedOnceWhereItIsWhateverBecomesOfIt) {
  SwayShow show(60, swell(), 150);
  show.tracker("wand", {5, 5, 5});
  Published published;
  std::mt19937 random(5);
  const std::vector<std::pair<CommandId, std::vector<std::string>>> commands{
      {CommandId::Hide, {}},   {CommandId::Show, {}},  {CommandId::Attach, {"all", "wand"}},
      {CommandId::Detach, {}}, {CommandId::Reset, {}}, {CommandId::Attach, {"position", "wand"}}};
  for (int frame = 0; frame < 200; ++frame) {
    show.tracker("wand", Vec3(5, 5, 0.01 * frame));
    const auto& [command, arguments] = commands[random() % commands.size()];
    const std::string target = random() % 20 == 0 ? "sway" : "boat" + std::to_string(random() % 150);
    if (target != "sway")
      show.scene.command(target, command, arguments, show.input.time);
    else
      show.scene.command(target, frame % 2 ? CommandId::Toggle : CommandId::Reset, {}, show.input.time);
    show.frame();
    published.follow(show);
    if (HasFatalFailure()) return;
  }
}

TEST(Sway, AVisitorItCarriesGoesAlongAlsoWhenHeComesLater) {
  SwayShow show;
  show.until(0.5);
  PlacedNode* rider = nullptr;
  show.loader.files["rider"] = [&](LoadedScene& load) {
    PlaceAttributes above = at(0, 0, 1);
    above.parent = show.boats[1]->self();
    rider = &addNode<MovingNode>(load, "rider", above, false);
  };
  show.scene.requestLoad("rider", {}, fromSeconds(0.6));
  show.until(2);
  ASSERT_TRUE(rider);
  EXPECT_LT((show.scene.placements().world(rider->placement()).translation() - expected(1, 2) * Vec3(0, 0, 1))
                .norm(),
            1e-12);
}

TEST(Sway, WhatItMovedStaysWhereItIsWhenItIsUnloaded) {
  ShowFixture show;
  PlacedNode* boat = nullptr;
  const MeshId mesh = show.meshes.add(unitMesh());
  show.loader.files["show"] = [&](LoadedScene& load) {
    boat = &addNode<MovingNode>(load, "boat", at(0, 1, 2), false, mesh);
  };
  show.loader.files["swell"] = [&](LoadedScene& load) {
    SwayAttributes a = swell();
    a.targets = {boat->self()};
    addNode<SwayNode>(load, "sway", PlaceAttributes{}, a, true);
  };
  show.scene.open("show");
  const std::uint32_t swellLoad = show.scene.requestLoad("swell", {}, 0);
  show.scene.requestUnload(swellLoad, fromSeconds(1));
  while (show.input.time < fromSeconds(1)) show.frame();
  const Affine left = show.scene.placements().world(boat->placement());
  EXPECT_GT((left.translation() - Vec3(0, 1, 2)).norm(), 0.1);
  ASSERT_EQ(show.changes.instances.size(), 1u) << "its last way is seen";
  EXPECT_EQ(show.changes.instances[0].record.model[3], left(0, 3));
  show.frames(3);
  EXPECT_TRUE(show.changes.instances.empty());
  EXPECT_EQ(show.scene.placements().world(boat->placement()).matrix(), left.matrix());
}

TEST(Sway, WhatAnotherMovesAsItBeginsIsPublishedOnce) {
  ShowFixture show;
  PlacedNode* boat = nullptr;
  const MeshId mesh = show.meshes.add(unitMesh());
  show.loader.files["show"] = [&](LoadedScene& load) {
    boat = &addNode<MovingNode>(load, "boat", at(0, 1, 2), false, mesh);
  };
  show.loader.files["swell"] = [&](LoadedScene& load) {
    SwayAttributes a = swell();
    a.targets = {boat->self()};
    addNode<SwayNode>(load, "sway", PlaceAttributes{}, a, true);
  };
  show.scene.open("show");
  show.frames(3);
  show.scene.requestLoad("swell", {}, show.input.time);
  show.scene.command("boat", CommandId::Reset, {}, show.input.time);
  show.frame();
  EXPECT_EQ(show.changes.instances.size(), 1u);
  EXPECT_EQ(show.changes.instances[0].record.model[3],
            show.scene.placements().world(boat->placement())(0, 3));
}

TEST(Sway, OfTwoThatMoveTheSameTheLaterOneCounts) {
  ShowFixture show;
  PlacedNode* boat = nullptr;
  SwayAttributes other = swell();
  other.amplitude = {0, 0, 3};
  show.loader.files["show"] = [&](LoadedScene& load) {
    boat = &addNode<MovingNode>(load, "boat", at(0, 1, 2), false);
    SwayAttributes a = swell();
    a.targets = other.targets = {boat->self()};
    addNode<SwayNode>(load, "first", PlaceAttributes{}, a, true);
    addNode<SwayNode>(load, "second", PlaceAttributes{}, other, true);
  };
  show.scene.open("show");
  while (show.input.time < fromSeconds(1)) show.frame();
  const Vec3 p = show.scene.placements().world(boat->placement()).translation();
  EXPECT_EQ(p.head<2>(), Vec2(0, 1));
  EXPECT_NEAR(p.z(), 2 + 3 * std::sin(2 * kPi * 0.5 + 2), 1e-12);
}

/// Looks where boat 1 was inside each frame.
class Onlooker : public Node {
public:
  Onlooker(NodeRef self, std::string name, NodeRef target)
      : Node(kGroupType, self, std::move(name)), target_(target) {}
  Rank rank() const override { return Rank::Sensing; }
  bool busy() const override { return true; }
  double worst = 0;

protected:
  void simulate(FrameContext& frame) override {
    const PlacementId id = frame.scene.find(target_)->placed()->placement();
    if (watched_ && frame.now.step > 0)
      for (int part = 0; part <= 7; ++part) {
        const Nanoseconds t = frame.start() + frame.now.step * part / 7;
        const Vec3 p = frame.scene.poseTracks().at(id, t, frame.scene.placements()).p;
        worst = std::max(worst, (p - expected(1, toSeconds(t)).translation()).norm());
      }
    if (!std::exchange(watched_, true)) frame.scene.schedule().watch(id, self());
  }

private:
  NodeRef target_;
  bool watched_ = false;
};

TEST(Sway, ReportsTheWayInsideTheFrameToNodesThatWatch) {
  ShowFixture show;
  show.rate = 5;
  Onlooker* onlooker = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    SwayAttributes a = swell();
    for (std::uint32_t i = 0; i < 2; ++i) {
      a.targets.push_back({load.number, i});
      addNode<MovingNode>(load, "boat" + std::to_string(i), at(10 * i, 1, 2, 1 + i), false);
    }
    addNode<SwayNode>(load, "sway", PlaceAttributes{}, a, true);
    onlooker = &addNode<Onlooker>(load, "onlooker", NodeRef{load.number, 1});
  };
  show.scene.open("show");
  show.frames(15);
  // A chord of 2 ms is off by a w^2 (0.002 s)^2 / 8 at most; at the ends of a frame it is exact.
  EXPECT_LT(onlooker->worst, 2e-5);
  EXPECT_GT(onlooker->worst, 0);
}

}  // namespace
}  // namespace stadion
