#include "engine/input/scripted_input.h"
#include "engine/nodes/group_node.h"
#include "engine/nodes/path_node.h"
#include "engine/nodes/scene_node.h"
#include "tests/dynamics/nodes/show_nodes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace show_nodes;

constexpr double kRates[] = {30, 60, 96, 144, 240};

/// A show whose visitor follows a script.
struct VisitedShow : ShowFixture {
  ScriptedInput visitor;
  std::vector<EventRecord> events;

  explicit VisitedShow(double hertz) { rate = hertz; }
  void playTo(double seconds) {
    while (signatureAt(next, rate).time <= fromSeconds(seconds)) {
      const TimeSignature now = signatureAt(next++, rate);
      visitor.sampleFrame(now.time - now.step, now.time, input);
      scene.advance(now, input, changes, nullptr);
      events.insert(events.end(), scene.events().begin(), scene.events().end());
    }
  }
  /// Every rate has a frame that ends at a whole second.
  void tell(const std::string& target, CommandId command, std::vector<std::string> arguments,
            double seconds) {
    ASSERT_TRUE(scene.command(target, command, std::move(arguments), fromSeconds(seconds)));
  }
};

/// A foot with a ball in its way, nothing else.
struct Kick {
  Nanoseconds when = 0;
  BodyState after;
};

Kick kickAt(double rate, bool smooth, bool carried) {
  VisitedShow show(rate);
  const MeshId box = show.meshes.add(cube(0.1));
  Ball* ball = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    if (carried) addNode<MovingNode>(load, "leg", PlaceAttributes{}, false);
    auto& foot = addNode<Block>(load, "foot", box, Vec3(0, 0, 0));
    (void)foot;
    ball = &addNode<Ball>(load, "ball", Vec3(0, 0, 0), std::vector<std::string>{});
    addNode<Sim>(load, "sim", std::vector<std::string>{"foot"}, std::vector<std::string>{"ball"});
  };
  show.scene.open("show");
  show.visitor.key("foot", 0, {0, -1, 0})
      .key("foot", 0.1037, {0, -1, 0})
      .key("foot", 0.2111, {0.05, -0.5, 0.02}, {0, 0, 20}, smooth)
      .key("foot", 0.2713, {-0.02, 0.1, 0.01}, {15, 0, -10}, smooth)
      .key("foot", 0.2811, {0.5, 0.15, 0.3}, {40, 0, 0}, smooth)
      .key("foot", 0.6, {2, -2, 0.3});
  show.tell("foot", CommandId::Attach, {"all", "foot"}, 0);
  show.playTo(1);
  Kick kick;
  kick.after = ball->state();
  for (const EventRecord& e : show.events)
    if (e.event == Event("onimpact") && kick.when == 0) kick.when = e.when;
  return kick;
}

TEST(ExactTimes, AFootOfAnInputLogHitsAtTheSameTimeWithTheSameVelocityAtEveryFrameRate) {
  for (const bool smooth : {false, true}) {
    const Kick first = kickAt(kRates[0], smooth, false);
    ASSERT_GT(first.when, fromSeconds(0.2));
    EXPECT_GT(first.after.v.norm(), 1);
    for (const double rate : kRates) {
      const Kick kick = kickAt(rate, smooth, false);
      EXPECT_LE(std::abs(kick.when - first.when), 1) << rate << " Hz, smooth " << smooth;
      EXPECT_LE((kick.after.v - first.after.v).norm(), 1e-9) << rate << " Hz, smooth " << smooth;
      EXPECT_LE((kick.after.p - first.after.p).norm(), 1e-9) << rate << " Hz, smooth " << smooth;
      EXPECT_LE((kick.after.omega - first.after.omega).norm(), 1e-8) << rate << " Hz, smooth " << smooth;
    }
  }
}

/// A cart that drives along +X with 1 m/s, or a ball that falls, and a lamp below it.
struct Carried {
  VisitedShow show;
  MovingNode* lamp = nullptr;

  enum class By { PathBefore, PathAfter, Body };

  Carried(double rate, By by) : show(rate) {
    show.loader.files["show"] = [&](LoadedScene& load) {
      const NodeRef parent{load.number, by == By::PathBefore ? 1u : 0u};
      const auto drive = [&](NodeRef cart) {
        Keyframe start, end;
        end.time = 10, end.X_PN.p = {10, 0, 0};
        addNode<PathNode>(load, "drive", PlaceAttributes{}, cart, std::vector<Keyframe>{start, end}, false,
                          false, true);
      };
      if (by == By::PathBefore) drive(parent);
      if (by == By::Body)
        addNode<Ball>(load, "cart", Vec3(0, 0, 0), std::vector<std::string>{"push"});
      else
        addNode<MovingNode>(load, "cart", PlaceAttributes{}, false);
      PlaceAttributes below;
      below.parent = parent, below.X_PN.translation() = Vec3(0, 0, 1);
      lamp = &addNode<MovingNode>(load, "lamp", below, false);
      if (by == By::PathAfter) drive(parent);
      if (by != By::Body) return;
      addNode<Field>(load, "push", Vec3(2, 0, 0), true);
      addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"cart"});
    };
    show.scene.open("show");
    show.visitor.key("head", 0, {3, 4, 2});
  }
  Vec3 lampAt() const { return show.scene.placements().world(lamp->placement()).translation(); }
};

TEST(ExactTimes, WhatFollowsATrackerIsThereWhateverMovesItsParentInWhicheverOrder) {
  for (const double rate : kRates)
    for (const auto by : {Carried::By::PathBefore, Carried::By::PathAfter, Carried::By::Body}) {
      Carried c(rate, by);
      c.show.playTo(0.5);
      c.show.tell("lamp", CommandId::Attach, {"all", "head"}, 0.5);
      c.show.playTo(1);
      EXPECT_LE((c.lampAt() - Vec3(3, 4, 2)).norm(), 1e-12) << rate << " Hz";
      c.show.tell("lamp", CommandId::Reset, {}, 1);
      c.show.tell("lamp", CommandId::Attach, {"all", "head"}, 1.2);
      c.show.playTo(2);
      EXPECT_LE((c.lampAt() - Vec3(3, 4, 2)).norm(), 1e-12) << rate << " Hz";
    }
}

TEST(ExactTimes, WhatOnlyTurnsWithATrackerIsStillCarried) {
  for (const double rate : kRates)
    for (const auto by : {Carried::By::PathBefore, Carried::By::PathAfter, Carried::By::Body}) {
      Carried c(rate, by);
      c.show.tell("lamp", CommandId::Attach, {"orientation", "head"}, 0);
      c.show.playTo(2);
      EXPECT_LE((c.lampAt() - Vec3(by == Carried::By::Body ? 4 : 2, 0, 1)).norm(), 1e-9) << rate << " Hz";
    }
}

TEST(ExactTimes, WhatLeavesItsTrackerGoesAlongWithItsParentFromThatTime) {
  constexpr double kWhen = 1.01234;
  for (const double rate : kRates)
    for (const auto by : {Carried::By::PathBefore, Carried::By::PathAfter, Carried::By::Body}) {
      Carried c(rate, by);
      c.show.tell("lamp", CommandId::Attach, {"all", "head"}, 0);
      c.show.tell("lamp", CommandId::Detach, {}, kWhen);
      c.show.playTo(2);
      const double gone = by == Carried::By::Body ? 4 - kWhen * kWhen : 2 - kWhen;
      // Between frames a body's way is taken to be straight.
      const double straight = by == Carried::By::Body ? 0.25 / rate / rate : 1e-9;
      EXPECT_LE((c.lampAt() - Vec3(3 + gone, 4, 2)).norm(), straight) << rate << " Hz";
    }
}

TEST(ExactTimes, NeitherItsParentNorAPathMovesABodyAtRest) {
  for (const bool parent : {false, true}) {
    VisitedShow show(60);
    const Ball* ball = nullptr;
    show.loader.files["show"] = [&](LoadedScene& load) {
      const NodeRef cart = addNode<MovingNode>(load, "cart", PlaceAttributes{}, false).self();
      ball = &addNode<Ball>(load, "ball", Vec3(0, 0, 5), std::vector<std::string>{}, cart);
      Keyframe start, end;
      end.time = 10, end.X_PN.p = {10, 0, 0};
      addNode<PathNode>(load, "drive", PlaceAttributes{}, parent ? cart : ball->self(),
                        std::vector<Keyframe>{start, end}, false, false, true);
      addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"ball"});
    };
    show.scene.open("show");
    show.playTo(0.5);
    const Vec3 placed = show.scene.placements().world(ball->placement()).translation();
    EXPECT_LE((placed - Vec3(0, 0, 5)).norm(), parent ? 0.02 : 5.0);
    show.playTo(2);
    EXPECT_EQ(show.scene.placements().world(ball->placement()).translation(), placed);
    EXPECT_EQ(ball->state().pose.p, placed);
  }
}

TEST(ExactTimes, AHandGrabsAndLetsGoInsideTheFrame) {
  for (const double rate : kRates) {
    VisitedShow show(rate);
    Ball* ball = nullptr;
    show.loader.files["show"] = [&](LoadedScene& load) {
      ball = &addNode<Ball>(load, "ball", Vec3(0, 0.3, 1), std::vector<std::string>{});
      addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"ball"});
    };
    show.scene.open("show");
    show.visitor.key("wand", 0, {0, 0, 1}).key("wand", 1.5, {0, 3, 1}).key("wand", 3, {0, 0, 1});  // 2 m/s
    const double grabbed = 0.1234, released = 0.5077;
    show.tell("ball", CommandId::Grab, {"wand"}, grabbed);
    show.tell("ball", CommandId::Release, {}, released);
    show.playTo(1);
    // It goes along from the moment of the grab, and on with the hand's velocity: no jump at either end.
    EXPECT_NEAR(ball->state().p.y(), 0.3 + 2 * (1 - grabbed), 1e-9) << rate;
    EXPECT_LE((ball->state().v - Vec3(0, 2, 0)).norm(), 1e-9) << rate;
  }
}

TEST(ExactTimes, AThrowDoesNotDependOnTheFrameRate) {
  std::optional<BodyState> first;
  for (const double rate : kRates) {
    VisitedShow show(rate);
    Ball* ball = nullptr;
    show.loader.files["show"] = [&](LoadedScene& load) {
      addNode<Field>(load, "gravity", Vec3(0, 0, -kStandardGravity), true);
      ball = &addNode<Ball>(load, "ball", Vec3(0.1, 0.3, 1), std::vector<std::string>{"gravity"});
      addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"ball"});
    };
    show.scene.open("show");
    for (int i = 0; i <= 100; ++i) {  // a device at 91 Hz; an arm that swings ever faster
      const double t = i / 91.0, s = t * t;
      show.visitor.key("wand", t, {0.2 * s, s, 1 + 0.3 * t}, {40 * s, 10 * t, 0});
    }
    show.tell("ball", CommandId::Grab, {"wand"}, 0.0507);
    show.tell("ball", CommandId::Release, {}, 0.6091);
    show.playTo(1);
    if (!first) first = ball->state();
    EXPECT_GT(ball->state().v.y(), 1.0);
    EXPECT_LE((ball->state().v - first->v).norm(), 1e-6) << rate;
    EXPECT_LE((ball->state().p - first->p).norm(), 1e-6) << rate;
  }
}

TEST(ExactTimes, AResetTakesEffectInsideTheFrameAndCommandsKeepTheirOrder) {
  for (const double rate : kRates) {
    VisitedShow show(rate);
    Ball* ball = nullptr;
    show.loader.files["show"] = [&](LoadedScene& load) {
      addNode<Field>(load, "gravity", Vec3(0, 0, -kStandardGravity), true);
      ball = &addNode<Ball>(load, "ball", Vec3(0, 0, 5), std::vector<std::string>{"gravity"});
      addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"ball"});
    };
    show.scene.open("show");
    show.visitor.key("wand", 0, {0, 0, 1});
    // Within one frame of 30 Hz, told in another order than they are due.
    show.tell("ball", CommandId::Reset, {}, 0.5043);
    show.tell("ball", CommandId::Release, {}, 0.5032);
    show.tell("ball", CommandId::Grab, {"wand"}, 0.5021);
    show.tell("ball", CommandId::Unhook, {"gravity"}, 0.5091);
    show.playTo(1);
    const double fell = 0.5091 - 0.5043;
    EXPECT_NEAR(ball->state().v.z(), -kStandardGravity * fell, 1e-9) << rate;
    EXPECT_NEAR(ball->state().p.z(),
                5 - 0.5 * kStandardGravity * fell * fell - kStandardGravity * fell * (1 - 0.5091), 1e-9)
        << rate;
  }
}

TEST(ExactTimes, ASwitchedOffSimulationStandsStillAndThenGoesOn) {
  for (const double rate : kRates) {
    VisitedShow show(rate);
    const MeshId box = show.meshes.add(cube(0.1));
    Ball* ball = nullptr;
    show.loader.files["show"] = [&](LoadedScene& load) {
      addNode<Field>(load, "gravity", Vec3(0, 0, -kStandardGravity), true);
      addNode<Block>(load, "foot", box, Vec3(5, 0, 0));
      ball = &addNode<Ball>(load, "ball", Vec3(0, 0, 0), std::vector<std::string>{"gravity"});
      addNode<Sim>(load, "sim", std::vector<std::string>{"foot"}, std::vector<std::string>{"ball"});
    };
    show.scene.open("show");
    // While all stands still a foot passes through the ball, which will not feel it.
    show.visitor.key("foot", 0, {5, 0, -0.5}).key("foot", 0.5, {5, 0, -0.5});
    show.visitor.key("foot", 0.8, {-5, 0, -0.5}).key("foot", 3, {-5, 0, -0.5});
    show.tell("foot", CommandId::Attach, {"all", "foot"}, 0);
    show.playTo(0.1);
    const double off = 0.3217, on = 1.2345;
    show.tell("sim", CommandId::Disable, {}, off);
    show.tell("sim", CommandId::Enable, {}, on);
    show.playTo(1);
    EXPECT_NEAR(ball->state().v.z(), -kStandardGravity * off, 1e-12) << rate;
    show.playTo(2);
    const double flown = 2 - (on - off);
    EXPECT_NEAR(ball->state().p.z(), -0.5 * kStandardGravity * flown * flown, 1e-9) << rate;
    EXPECT_EQ(ball->state().p.x(), 0) << rate;
    EXPECT_TRUE(show.events.empty()) << rate;
  }
}

TEST(ExactTimes, ALoadedBodyBeginsAtTheTimeOfItsLoad) {
  for (const double rate : kRates) {
    VisitedShow show(rate);
    Ball* ball = nullptr;
    show.loader.files["game"] = [&](LoadedScene& load) {
      addNode<Field>(load, "gravity", Vec3(0, 0, -kStandardGravity), true);
      ball = &addNode<Ball>(load, "ball", Vec3(0, 0, 5), std::vector<std::string>{"gravity"});
      addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"ball"});
    };
    show.loader.files["show"] = [&](LoadedScene& load) {
      addNode<SceneNode>(load, "game", PlaceAttributes{}, "game", fromSeconds(0.1), false);
      // Somebody outside looks after the same body.
      addNode<TouchWatch>(load, "watch", std::vector<std::string>{}, std::vector<std::string>{"game/ball"});
    };
    show.scene.open("show");
    show.tell("game", CommandId::Load, {}, 0.2077);
    show.playTo(1);
    ASSERT_TRUE(ball);
    const double fell = 1 - 0.3077;
    EXPECT_NEAR(ball->state().v.z(), -kStandardGravity * fell, 1e-9) << rate;
    EXPECT_NEAR(ball->state().p.z(), 5 - 0.5 * kStandardGravity * fell * fell, 1e-9) << rate;
  }
}

TEST(ExactTimes, AnUnloadedWallIsFeltUntilItGoes) {
  // The ball's surface meets the wall at 0.4 s, at 2 m/s.
  for (const double gone : {0.3999, 0.4001})
    for (const double rate : kRates) {
      VisitedShow show(rate);
      const MeshId box = show.meshes.add(cube(0.5));
      Ball* ball = nullptr;
      show.loader.files["game"] = [&](LoadedScene& load) {
        addNode<Block>(load, "wall", box, Vec3(0, 1.4, 0));
      };
      show.loader.files["show"] = [&](LoadedScene& load) {
        addNode<SceneNode>(load, "game", PlaceAttributes{}, "game", Nanoseconds{0}, true);
        addNode<Field>(load, "push", Vec3(0, 200, 0), true, 0.01);
        ball = &addNode<Ball>(load, "ball", Vec3(0, 0.01, 0), std::vector<std::string>{"push"});
        addNode<Sim>(load, "sim", std::vector<std::string>{"game/wall"}, std::vector<std::string>{"ball"});
      };
      show.scene.open("show");
      show.tell("game", CommandId::Unload, {}, gone);
      show.playTo(1);
      // 2 m/s after 0.01 s and 0.02 m: 0.8 m at 0.4 s. Half of the speed comes back from the wall.
      EXPECT_NEAR(ball->state().v.y(), gone < 0.4 ? 2 : -1, 1e-6) << rate << " Hz, gone at " << gone;
      EXPECT_EQ(show.scene.tree().loads().size(), 1u);
    }
}

/// Waits for a time long after the test.
class AlarmNode : public Node {
public:
  AlarmNode(NodeRef self, std::string name) : Node(kGroupType, self, std::move(name)) {}

protected:
  void onEnter(Scene& scene) override { scene.schedule().wakeAt(fromSeconds(100), self()); }
};

TEST(ExactTimes, AlarmsOfAnUnloadedFileLeaveNoTraceInTheStateHash) {
  const auto hashWith = [](bool alarm) {
    VisitedShow show(60);
    show.loader.files["game"] = [&](LoadedScene& load) {
      if (alarm) addNode<AlarmNode>(load, "clock");
    };
    show.loader.files["show"] = [&](LoadedScene& load) {
      addNode<SceneNode>(load, "game", PlaceAttributes{}, "game", Nanoseconds{0}, true);
    };
    show.scene.open("show");
    show.tell("game", CommandId::Unload, {}, 0.3);
    show.playTo(0.5);
    return show.scene.stateHash();
  };
  EXPECT_EQ(hashWith(true), hashWith(false));
}

}  // namespace
}  // namespace stadion
