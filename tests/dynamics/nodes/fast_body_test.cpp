/// Only a tracker can jump: sensors and other dynamics nodes see bodies and animations of any speed at the
/// exact time, at every frame rate.

#include "dynamics/collision/shape_choice.h"
#include "engine/input/tracker_jump.h"
#include "engine/nodes/object_node.h"
#include "engine/nodes/path_node.h"
#include "engine/nodes/rig_node.h"
#include "tests/dynamics/nodes/show_nodes.h"
#include "tests/dynamics/world/scenes.h"

#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>

namespace stadion {
namespace {

using namespace show_nodes;

constexpr std::array kTraceRates{5.0, 30.0, 60.0, 144.0};
constexpr double kRadius = 0.1;
constexpr double kNanosecond = 1.001e-9;

/// A cube that starts with a velocity.
class Shot : public DynObjectNode {
public:
  Shot(NodeRef self, std::string name, MeshId mesh, const Vec3& p, const Vec3& v,
       std::vector<std::string> hooks, double restitution = 1, const Vec3& omega = Vec3::Zero())
      : DynObjectNode(self, std::move(name), at(p), {mesh, true, "box"},
                      body(v, std::move(hooks), restitution, omega), fit()) {}

private:
  static PlaceAttributes at(const Vec3& p) {
    PlaceAttributes place;
    place.X_PN.translation() = p;
    return place;
  }
  static BodyAttributes body(const Vec3& v, std::vector<std::string> hooks, double restitution,
                             const Vec3& omega) {
    BodyAttributes b;
    b.velocity = v, b.angularVelocity = omega, b.hooks = std::move(hooks);
    b.surface.restitution = restitution, b.surface.friction = 0;
    return b;
  }
  static SharedFit fit() {
    const Vec3 half = Vec3::Constant(kRadius);
    ShapeChoice box;
    box.shape = BoxShape{{}, half}, box.kind = ShapeKind::Box;
    return std::make_shared<const FittedShape>(
        FittedShape{Vec3::Ones(), std::move(box), massOfBox({}, half, 1), 0});
  }
};

/// A cube below something.
class Rider : public ObjectNode {
public:
  Rider(NodeRef self, std::string name, MeshId mesh, NodeRef parent, const Vec3& p)
      : ObjectNode(kObjectType, self, std::move(name), below(parent, p), {mesh, true, "box"}) {}

private:
  static PlaceAttributes below(NodeRef parent, const Vec3& p) {
    PlaceAttributes place;
    place.parent = parent, place.X_PN.translation() = p;
    return place;
  }
};

/// A sensor around cubes of 2 * kRadius and bodies that fly; events are kept.
struct Gallery : ShowFixture {
  using Names = std::vector<std::string>;
  NodeRef sensor;
  std::vector<double> impacts, releases;  ///< of the sensor [s]
  MeshId small = meshes.add(cube(kRadius)), wall = meshes.add(cube(2));

  Gallery(double framesPerSecond, const TestLoader::Recipe& recipe) {
    rate = framesPerSecond;
    loader.files["show"] = recipe;
    scene.open("show");
  }
  void sense(LoadedScene& load, Names colliders, Names collidees, double releaseDistance = 0.5) {
    sensor =
        addNode<Sensor>(load, "sensor", std::move(colliders), std::move(collidees), releaseDistance).self();
  }
  Gallery& play(double seconds) {
    while (signatureAt(next, rate).time <= fromSeconds(seconds)) {
      frame();
      for (const EventRecord& e : scene.events()) {
        if (e.node != sensor) continue;
        if (e.event == Event("onimpact")) impacts.push_back(toSeconds(e.when));
        if (e.event == Event("onrelease")) releases.push_back(toSeconds(e.when));
      }
    }
    return *this;
  }

private:
  class Sensor : public CollisionNode {
  public:
    Sensor(NodeRef self, std::string name, Names colliders, Names collidees, double releaseDistance)
        : CollisionNode(kCollisionType, self, std::move(name),
                        {std::move(colliders), std::move(collidees), releaseDistance, true, true, {}},
                        std::make_shared<ShapeStore>()) {}
  };
};

void expectTimes(const std::vector<double>& seen, const std::vector<double>& truth, const std::string& what) {
  ASSERT_EQ(seen.size(), truth.size()) << what;
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_NEAR(seen[i], truth[i], kNanosecond) << what << " " << i;
}

std::string at(double rate, double speed) {
  return std::to_string(rate) + " Hz, " + std::to_string(speed) + " m/s";
}

TEST(FastBody, ASensorSeesABodyOfAnySpeedAtTheExactTimeWhereverItStandsInTheFile) {
  for (const double rate : kTraceRates)
    for (const double speed : {3.0, 70.0, 343.0, 7900.0})
      for (const bool sensorFirst : {false, true}) {
        Gallery g(rate, [&](LoadedScene& load) {
          addNode<Block>(load, "target", g.wall, Vec3(0, 12.345, 0));
          if (sensorFirst) g.sense(load, {"target"}, {"shot"});
          addNode<Shot>(load, "shot", g.small, Vec3::Zero(), Vec3(0, speed, 0), Gallery::Names{});
          addNode<Sim>(load, "sim", Gallery::Names{}, Gallery::Names{"shot"});
          if (!sensorFirst) g.sense(load, {"target"}, {"shot"});
        });
        g.play(18 / speed + 0.5);
        const double meets = (12.345 - 2 - kRadius) / speed, parts = (12.345 + 2 + kRadius + 0.5) / speed;
        expectTimes(g.impacts, {meets}, at(rate, speed));
        expectTimes(g.releases, {parts}, at(rate, speed) + " release");
      }
}

TEST(FastBody, ASensorFollowsTheArcOfAThrow) {
  for (const double rate : kTraceRates) {
    Gallery g(rate, [&](LoadedScene& load) {
      addNode<Field>(load, "gravity", Vec3(0, 0, -9.81), true);
      for (int i = 0; i < 8; ++i) {
        addNode<Block>(load, "floor" + std::to_string(i), g.wall, Vec3(0, 4 * i, -5));
      }
      addNode<Shot>(load, "shot", g.small, Vec3::Zero(), Vec3(0, 25, 0), Gallery::Names{"gravity"});
      addNode<Sim>(load, "sim", Gallery::Names{}, Gallery::Names{"shot"});
      Gallery::Names floor;
      for (int i = 0; i < 8; ++i) floor.push_back("floor" + std::to_string(i));
      g.sense(load, floor, {"shot"});
    });
    g.play(1);
    ASSERT_GE(g.impacts.size(), 1U) << rate;
    EXPECT_NEAR(g.impacts[0], std::sqrt(2 * (3 - kRadius) / 9.81), kNanosecond) << rate;
  }
}

/// The floor of the simulation is a sensor as well: each bounce is told at its time.
TEST(FastBody, ASensorSeesEveryBounceWithinAFrame) {
  for (const double rate : kTraceRates) {
    Gallery g(rate, [&](LoadedScene& load) {
      addNode<Block>(load, "left", g.wall, Vec3(0, -3, 0));
      addNode<Block>(load, "right", g.wall, Vec3(0, 3, 0));
      addNode<Shot>(load, "shot", g.small, Vec3::Zero(), Vec3(0, 50, 0), Gallery::Names{});
      addNode<Sim>(load, "sim", Gallery::Names{"left", "right"}, Gallery::Names{"shot"});
      g.sense(load, {"left", "right"}, {"shot"}, 0.25);
    });
    constexpr double kSeconds = 0.8, kSpeed = 50;
    g.play(kSeconds + 1e-4);
    std::vector<double> meets, parts;
    const double way = 2 * (1 - kRadius);
    for (double y = 1 - kRadius; y < kSpeed * kSeconds; y += way) meets.push_back(y / kSpeed);
    for (double y = 1 - kRadius + 0.25; y < kSpeed * kSeconds; y += way) parts.push_back(y / kSpeed);
    // What has parted in the frame of its impact is told in the next one.
    if (g.releases.size() < parts.size()) parts.resize(g.releases.size());
    expectTimes(g.impacts, meets, std::to_string(rate));
    EXPECT_GE(g.releases.size(), 16U) << rate;
    expectTimes(g.releases, parts, std::to_string(rate) + " release");
  }
}

TEST(FastBody, SeveralSensorsInOneFrameAreMetInTurn) {
  for (const double rate : kTraceRates) {
    Gallery g(rate, [&](LoadedScene& load) {
      Gallery::Names posts;
      for (int i = 0; i < 6; ++i) {
        posts.push_back("post" + std::to_string(i));
        addNode<Block>(load, posts.back(), g.small, Vec3(0, 2 + i, 0.05));
      }
      addNode<Shot>(load, "shot", g.small, Vec3::Zero(), Vec3(0, 200, 0), Gallery::Names{});
      addNode<Sim>(load, "sim", Gallery::Names{}, Gallery::Names{"shot"});
      g.sense(load, posts, {"shot"}, 0.2);
    });
    g.play(0.6);
    std::vector<double> meets, parts;
    for (int i = 0; i < 6; ++i) meets.push_back((2 + i - 2 * kRadius) / 200);
    for (int i = 0; i < 6; ++i) parts.push_back((2 + i + 2 * kRadius + 0.2) / 200);
    expectTimes(g.impacts, meets, std::to_string(rate));
    std::ranges::sort(g.releases);
    expectTimes(g.releases, parts, std::to_string(rate) + " release");
  }
}

TEST(FastBody, WhatABodyCarriesIsSeenAtTheExactTime) {
  for (const double rate : kTraceRates) {
    Gallery g(rate, [&](LoadedScene& load) {
      addNode<Block>(load, "target", g.wall, Vec3(0, 20, 0));
      const Shot& shot = addNode<Shot>(load, "shot", g.small, Vec3::Zero(), Vec3(0, 90, 0), Gallery::Names{});
      addNode<Rider>(load, "rider", g.small, shot.self(), Vec3(0, 1, 0));
      addNode<Sim>(load, "sim", Gallery::Names{}, Gallery::Names{"shot"});
      g.sense(load, {"target"}, {"rider"});
    });
    g.play(0.6);
    expectTimes(g.impacts, {(20 - 2 - 1 - kRadius) / 90}, std::to_string(rate));
  }
}

TEST(FastBody, WhatAPathMovesIsNeverAJump) {
  for (const double rate : kTraceRates)
    for (const double speed : {30.0, 100.0, 500.0}) {
      Gallery g(rate, [&](LoadedScene& load) {
        addNode<Block>(load, "target", g.wall, Vec3(0, 20, 0));
        const Block& train = addNode<Block>(load, "train", g.small, Vec3::Zero());
        const double lasts = 100 / speed;
        addNode<PathNode>(load, "rails", PlaceAttributes{}, train.self(),
                          std::vector<Keyframe>{{0, {}}, {lasts, {{0, 100, 0}, Quat::Identity()}}}, false,
                          false, true);
        g.sense(load, {"target"}, {"train"});
      });
      g.play(0.9);
      expectTimes(g.impacts, {(20 - 2 - kRadius) / speed}, at(rate, speed));
      expectTimes(g.releases, {(20 + 2 + kRadius + 0.5) / speed}, at(rate, speed) + " release");
    }
}

/// A body that another dynamics node moves hits one of this: as a wall of its speed.
TEST(FastBody, AnotherDynamicsNodesBodyHitsAtTheExactTime) {
  for (const double rate : kTraceRates)
    for (const double speed : {20.0, 70.0, 400.0})
      for (const bool lookerFirst : {false, true}) {
        Shot* hit = nullptr;
        Gallery g(rate, [&](LoadedScene& load) {
          const auto looker = [&] {
            hit = &addNode<Shot>(load, "hit", g.small, Vec3(0, 10, 0), Vec3::Zero(), Gallery::Names{});
            addNode<Sim>(load, "second", Gallery::Names{"shot"}, Gallery::Names{"hit"});
          };
          if (lookerFirst) looker();
          addNode<Shot>(load, "shot", g.small, Vec3::Zero(), Vec3(0, speed, 0), Gallery::Names{});
          addNode<Sim>(load, "first", Gallery::Names{}, Gallery::Names{"shot"});
          if (!lookerFirst) looker();
          g.sensor = load.nodes[load.names["second"]]->self();
        });
        g.play(10 / speed + 0.5);
        const double meets = (10 - 2 * kRadius) / speed;
        expectTimes(g.impacts, {meets}, at(rate, speed));
        const double since = toSeconds(g.scene.now()) - meets;
        EXPECT_NEAR(hit->state().v.y(), 2 * speed, 1e-9 * speed) << at(rate, speed);
        EXPECT_NEAR(hit->state().p.y(), 10 + 2 * speed * since, 1e-7 * speed) << at(rate, speed);
      }
}

TEST(FastBody, AResetIsAJumpThatNothingOnItsWaySees) {
  for (const double rate : kTraceRates) {
    Gallery g(rate, [&](LoadedScene& load) {
      addNode<Block>(load, "target", g.wall, Vec3(0, 5, 0));
      const Shot& shot =
          addNode<Shot>(load, "shot", g.small, Vec3(0, 20, 0), Vec3(0, 10, 0), Gallery::Names{});
      addNode<Sim>(load, "sim", Gallery::Names{}, Gallery::Names{"shot"});
      g.sense(load, {"target"}, {"shot"});
      addNode<SpeakingNode>(load, "clock", std::vector<Nanoseconds>{333'333'333})
          .addNotification(notify(Event("timesup"), "shot", CommandId::Reset));
      (void)shot;
    });
    g.play(1);
    EXPECT_TRUE(g.impacts.empty()) << rate;
  }
}

/// What stands on the rig, and what follows a tracker on it.
TEST(FastBody, ARigThatIsDrivenFastTakesItsLoadAlongTheWay) {
  for (const double rate : kTraceRates)
    for (const bool onTracker : {false, true}) {
      Gallery g(rate, [&](LoadedScene& load) {
        addNode<Block>(load, "target", g.wall, Vec3(0, 20, 0));
        const RigNode& rig = addNode<RigNode>(load, "rig", PlaceAttributes{}, 1.7);
        addNode<NavigatorNode>(load, "drive", NavigatorNode::Attributes{120, 0.8, false, "wand"}, true);
        const MovingNode& hand = addNode<MovingNode>(load, "hand", PlaceAttributes{}, false);
        addNode<Rider>(load, "load", g.small, onTracker ? hand.self() : rig.self(), Vec3::Zero());
        g.sense(load, {"target"}, {"load"});
        addNode<SpeakingNode>(load, "clock", std::vector<Nanoseconds>{0})
            .addNotification(notify(Event("timesup"), "hand", CommandId::Attach, 0, {"all", "wand"}));
      });
      g.tracker("wand", Vec3::Zero());
      g.input.trackers[0].axes[1] = 1;
      g.play(0.9);
      expectTimes(g.impacts, {(20 - 2 - kRadius) / 120},
                  std::to_string(rate) + (onTracker ? " tracker" : ""));
    }
}

TEST(FastBody, ATrackerStillJumps) {
  Gallery g(60, [&](LoadedScene& load) {
    addNode<Block>(load, "target", g.wall, Vec3(0, 5, 0));
    const MovingNode& hand = addNode<MovingNode>(load, "hand", PlaceAttributes{}, false);
    addNode<Rider>(load, "glove", g.small, hand.self(), Vec3::Zero());
    g.sense(load, {"target"}, {"glove"});
    addNode<SpeakingNode>(load, "clock", std::vector<Nanoseconds>{0})
        .addNotification(notify(Event("timesup"), "hand", CommandId::Attach, 0, {"all", "wand"}));
  });
  g.tracker("wand", Vec3(0, 0, 0));
  g.play(0.5);
  g.tracker("wand", Vec3(0, 20, 0));
  g.play(1);
  EXPECT_TRUE(g.impacts.empty());
}

/// A hand at this speed, frame by frame, through a wall 4 m thick.
std::vector<double> impactsOfHandAt(double speed) {
  constexpr double kRate = 60, kFrom = 0.5;
  Gallery g(kRate, [&](LoadedScene& load) {
    addNode<Block>(load, "target", g.wall, Vec3(0, 5, 0));
    const MovingNode& hand = addNode<MovingNode>(load, "hand", PlaceAttributes{}, false);
    addNode<Rider>(load, "glove", g.small, hand.self(), Vec3::Zero());
    g.sense(load, {"target"}, {"glove"});
    addNode<SpeakingNode>(load, "clock", std::vector<Nanoseconds>{0})
        .addNotification(notify(Event("timesup"), "hand", CommandId::Attach, 0, {"all", "wand"}));
  });
  g.tracker("wand", Vec3::Zero());
  g.play(kFrom + 1e-3);
  for (int frame = 1; frame <= 12; ++frame) {
    g.tracker("wand", Vec3(0, frame * speed / kRate, 0));
    g.play(kFrom + frame / kRate + 1e-3);
  }
  return g.impacts;
}

std::string sectionOf(const std::string& document, const std::string& heading) {
  std::ifstream file(std::string(STADION_SOURCE_DIR) + document);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::size_t from = text.find(heading), to = text.find("\n#", from + 1);
  return from == std::string::npos ? "" : text.substr(from, to - from);
}

/// docs/language.md has the rule; other documents link to it.
TEST(FastBody, ATrackerJumpsFromTheSpeedInTheDocuments) {
  const std::string rule = sectionOf("/docs/language.md", "### A tracker's jump");
  const auto says = [&](const std::string& text) { return rule.find(text) != std::string::npos; };
  EXPECT_TRUE(says("faster than " + std::to_string(static_cast<int>(kTeleportSpeed)) + " m/s in the rig"))
      << rule;
  EXPECT_TRUE(says("faster than " + std::to_string(static_cast<int>(kJumpSpeed)) + " m/s there")) << rule;
  EXPECT_TRUE(says("at most " + std::to_string(kLongestJump / 1'000'000) + " ms apart")) << rule;
  const std::vector<double> met = impactsOfHandAt(kTeleportSpeed - 1);
  ASSERT_EQ(met.size(), 1U);
  EXPECT_TRUE(impactsOfHandAt(kTeleportSpeed + 1).empty()) << "what it touches after a jump posts no impact";
}

TEST(FastBody, APairThatATrackerLeavesByAJumpIsReleasedAtOnce) {
  Gallery g(60, [&](LoadedScene& load) {
    addNode<Block>(load, "target", g.wall, Vec3(0, 5, 0));
    const MovingNode& hand = addNode<MovingNode>(load, "hand", PlaceAttributes{}, false);
    addNode<Rider>(load, "glove", g.small, hand.self(), Vec3::Zero());
    g.sense(load, {"target"}, {"glove"});
    addNode<SpeakingNode>(load, "clock", std::vector<Nanoseconds>{0})
        .addNotification(notify(Event("timesup"), "hand", CommandId::Attach, 0, {"all", "wand"}));
  });
  g.tracker("wand", Vec3(0, 2.5, 0));
  g.play(0.5);
  g.tracker("wand", Vec3(0, 3.2, 0));  // 42 m/s
  g.play(0.6);
  ASSERT_EQ(g.impacts.size(), 1U);
  EXPECT_TRUE(g.releases.empty());
  g.tracker("wand", Vec3(0, -20, 0));
  g.play(1);
  ASSERT_EQ(g.releases.size(), 1U);
  EXPECT_LE(g.releases[0], 0.6 + 2.0 / 60);
  EXPECT_EQ(g.impacts.size(), 1U);
}

/// A ball comes to rest in a sensor and is put elsewhere: it leaves in that moment.
TEST(FastBody, WhatIsPutElsewhereIsReleasedAtOnce) {
  for (const double rate : kTraceRates) {
    Gallery g(rate, [&](LoadedScene& load) {
      addNode<Block>(load, "target", g.wall, Vec3(0, 5, 0));
      addNode<Shot>(load, "shot", g.small, Vec3(0, -20, 0), Vec3(0, 50, 0), Gallery::Names{});
      addNode<Sim>(load, "sim", Gallery::Names{}, Gallery::Names{"shot"});
      g.sense(load, {"target"}, {"shot"});
      addNode<SpeakingNode>(load, "clock", std::vector<Nanoseconds>{500'000'000})
          .addNotification(notify(Event("timesup"), "shot", CommandId::Reset));
    });
    g.play(0.85);
    expectTimes(g.impacts, {(23 - kRadius) / 50}, std::to_string(rate));
    ASSERT_EQ(g.releases.size(), 1U) << rate;
    EXPECT_GE(g.releases[0], 0.5) << rate;
    EXPECT_LE(g.releases[0], 0.5 + 1 / rate + kNanosecond) << rate;
  }
}

/// What rides on a body that is reset jumps with it.
TEST(FastBody, WhatHangsOnABodyThatIsResetDoesNotSweepOverWhatLiesBetween) {
  for (const double rate : kTraceRates) {
    Gallery g(rate, [&](LoadedScene& load) {
      addNode<Block>(load, "target", g.wall, Vec3(0, 5, 0));
      const Shot& shot =
          addNode<Shot>(load, "shot", g.small, Vec3(0, 20, 0), Vec3(0, 10, 0), Gallery::Names{});
      addNode<Rider>(load, "rider", g.small, shot.self(), Vec3(0, -10, 0));
      addNode<Sim>(load, "sim", Gallery::Names{}, Gallery::Names{"shot"});
      g.sense(load, {"target"}, {"rider"});
      addNode<SpeakingNode>(load, "clock", std::vector<Nanoseconds>{1'000'000'000, 1'333'333'333})
          .addNotification(notify(Event("timesup"), "shot", CommandId::Reset));
    });
    g.play(1.6);
    EXPECT_TRUE(g.impacts.empty()) << rate;
  }
}

/// A bat dashes a ball, which has left its wall by less than the release distance, back against it.
TEST(FastBody, WhatIsDashedBackHasNotParted) {
  using namespace scenes;
  for (const double rate : kTraceRates) {
    World w;
    w.addCollider({w.addShape(BoxShape{{}, Vec3(1, 1, 1)}), {{0, 2, 0}, Quat::Identity()}, {0.0, 0.25, 0.0}});
    BodyDef d;
    d.shape = w.addShape(BallShape{Vec3::Zero(), kRadius});
    d.mass = massOfSphere(Vec3::Zero(), kRadius, 1000);
    d.v = Vec3(0, 4, 0), d.surface = {0.0, 0.25, 0.0}, d.releaseDistance = 0.5;
    const BodyId ball = w.addBody(d);
    // It gives the ball its own speed, 0.54 s after the start and 0.315 m before the wall.
    BodyDef bat = d;
    bat.pose.p = Vec3(0, -32.015, 0), bat.v = Vec3(0, 60, 0);
    bat.surface = {0.0, 1.0, 0.0}, bat.releaseDistance = std::numeric_limits<double>::infinity();
    w.addBody(bat);
    std::size_t impacts = 0, releases = 0;
    play(w, 0.56, rate, [&](double) {
      for (const ContactEvent& e : w.events())
        if (!e.other.isBody && e.body == ball) ++(e.kind == ContactEvent::Kind::Impact ? impacts : releases);
    });
    EXPECT_EQ(impacts, 2U) << rate;
    EXPECT_EQ(releases, 0U) << rate;
  }
}

/// Slow and thick enough that the world's windows of time end while they overlap.
TEST(FastBody, EachPassThroughASensorIsToldOnce) {
  for (const double speed : {3.0, 11.0, 20.0, 37.0})
    for (int shift = 0; shift < 8; ++shift) {
      Gallery g(5, [&](LoadedScene& load) {
        addNode<Block>(load, "target", g.wall, Vec3(0, 6 + 0.31 * shift, 0));
        addNode<Shot>(load, "shot", g.small, Vec3::Zero(), Vec3(0, speed, 0), Gallery::Names{});
        addNode<Sim>(load, "sim", Gallery::Names{}, Gallery::Names{"shot"});
        g.sense(load, {"target"}, {"shot"});
      });
      const double middle = 6 + 0.31 * shift;
      g.play(16 / speed + 0.5);
      expectTimes(g.impacts, {(middle - 2 - kRadius) / speed}, at(5, speed));
      expectTimes(g.releases, {(middle + 2 + kRadius + 0.5) / speed}, at(5, speed) + " release");
    }
}

/// A simulation's own pairs.
TEST(FastBody, APairThatMeetsAndPartsWithinAFrameIsReleasedAtTheExactTime) {
  using namespace scenes;
  for (const double rate : kTraceRates)
    for (const double speed : {4.0, 30.0, 90.0}) {
      World w;
      w.addCollider({w.addShape(BoxShape{{}, Vec3(1, 1, 1)}), {{0, 2, 0}, Quat::Identity()}, {}});
      BodyDef d;
      d.shape = w.addShape(BallShape{Vec3::Zero(), kRadius});
      d.mass = massOfSphere(Vec3::Zero(), kRadius, 1000);
      d.v = Vec3(0, speed, 0), d.surface = {0.0, 0.5, 0.0}, d.releaseDistance = 0.3;
      w.addBody(d);
      std::vector<double> impacts, releases;
      std::uint64_t frame = 0, met = 0;
      play(w, 0.6 + 3 / speed, rate, [&](double) {
        ++frame;
        for (const ContactEvent& e : w.events()) {
          const bool meets = e.kind == ContactEvent::Kind::Impact;
          if (meets) met = frame;
          EXPECT_TRUE(meets || frame > met);
          (meets ? impacts : releases).push_back(toSeconds(e.time));
        }
      });
      const double meets = (1 - kRadius) / speed;
      expectTimes(impacts, {meets}, at(rate, speed));
      expectTimes(releases, {meets + 0.3 / (0.5 * speed)}, at(rate, speed) + " release");
    }
}

/// Between two walls: each meeting and parting, the same at every rate.
TEST(FastBody, EveryMeetingAndPartingIsToldWhateverTheRate) {
  using namespace scenes;
  for (const double rate : kTraceRates) {
    World w;
    w.addCollider({w.addShape(BoxShape{{}, Vec3(1, 1, 1)}), {{0, 2, 0}, Quat::Identity()}, {}});
    w.addCollider({w.addShape(BoxShape{{}, Vec3(1, 1, 1)}), {{0, -2, 0}, Quat::Identity()}, {}});
    BodyDef d;
    d.shape = w.addShape(BallShape{Vec3::Zero(), kRadius});
    d.mass = massOfSphere(Vec3::Zero(), kRadius, 1000);
    d.v = Vec3(0, 35, 0), d.surface = {0.0, 1.0, 0.0}, d.releaseDistance = 0.4;
    w.addBody(d);
    std::vector<double> impacts, releases, meets, parts;
    play(w, 2, rate, [&](double) {
      for (const ContactEvent& e : w.events())
        (e.kind == ContactEvent::Kind::Impact ? impacts : releases).push_back(toSeconds(e.time));
    });
    for (double y = 1 - kRadius; y < 70; y += 2 * (1 - kRadius))
      meets.push_back(y / 35), parts.push_back((y + 0.4) / 35);
    expectTimes(impacts, meets, std::to_string(rate));
    ASSERT_GE(releases.size() + 5, parts.size()) << rate;  // those of the last frame are yet to be told
    parts.resize(std::min(parts.size(), releases.size()));
    expectTimes(releases, parts, std::to_string(rate) + " release");
  }
}

}  // namespace
}  // namespace stadion
