#include "engine/nodes/scene_node.h"
#include "tests/dynamics/nodes/show_nodes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace show_nodes;

TEST(DynamicsNode, AFieldSwitchedByMessageActsForExactlyItsTimeAtAnyFrameRate) {
  for (const double rate : {30.0, 60.0, 96.0, 240.0}) {
    ShowFixture show;
    show.rate = rate;
    Ball* ball = nullptr;
    show.loader.files["show"] = [&](LoadedScene& load) {
      auto& clock = addNode<SpeakingNode>(load, "clock", std::vector<Nanoseconds>{fromSeconds(0.0123)});
      clock.addNotification(notify(Event("timesup"), "push", CommandId::Enable, 0.3));
      clock.addNotification(notify(Event("timesup"), "push", CommandId::Disable, 0.5111));
      addNode<Field>(load, "push", Vec3(0, 10, 0), false);
      ball = &addNode<Ball>(load, "ball", Vec3(0, 0, 0), std::vector<std::string>{"push"});
      addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"ball"});
    };
    show.scene.open("show");
    show.frames(static_cast<std::uint64_t>(rate) + 1);  // to 1 s
    const double on = 0.2111, after = 1.0 - 0.5234;
    EXPECT_NEAR(ball->state().v.y(), 10 * on, 1e-9) << rate;
    EXPECT_NEAR(ball->state().p.y(), 5 * on * on + 10 * on * after, 1e-9) << rate;
  }
}

TEST(DynamicsNode, ADurationEndsAnActivationInsideAFrame) {
  ShowFixture show;
  Ball* ball = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    addNode<Field>(load, "push", Vec3(0, 0, 7), true, 0.1234);
    ball = &addNode<Ball>(load, "ball", Vec3(0, 0, 0), std::vector<std::string>{"push"});
    addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"ball"});
  };
  show.scene.open("show");
  show.frames(31);
  EXPECT_NEAR(ball->state().v.z(), 7 * 0.1234, 1e-9);
}

TEST(DynamicsNode, UnhookedABodyNoLongerFeelsTheField) {
  ShowFixture show;
  Ball* ball = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    addNode<SpeakingNode>(load, "clock", std::vector<Nanoseconds>{1})
        .addNotification(notify(Event("timesup"), "ball", CommandId::Unhook, 0.25, {"gravity"}));
    addNode<Field>(load, "gravity", Vec3(0, 0, -kStandardGravity), true);
    ball = &addNode<Ball>(load, "ball", Vec3(0, 0, 0), std::vector<std::string>{"gravity"});
    addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"ball"});
  };
  show.scene.open("show");
  show.frames(61);
  EXPECT_NEAR(ball->state().v.z(), -kStandardGravity * 0.25, 1e-7);
}

TEST(DynamicsNode, AFieldTurnsWithWhatCarriesIt) {
  ShowFixture show;
  Ball* ball = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    PlaceAttributes turned;
    turned.X_PN.linear() = Eigen::AngleAxisd(1.5707963267948966, Vec3::UnitZ()).toRotationMatrix() * 2.0;
    addNode<MovingNode>(load, "leg", turned, false);
    PlaceAttributes carried;
    carried.parent = {load.number, 0};
    addNode<Field>(load, "push", Vec3(1, 0, 0), true, 0.0, carried);
    ball = &addNode<Ball>(load, "ball", Vec3(0, 0, 0), std::vector<std::string>{"push"});
    addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"ball"});
  };
  show.scene.open("show");
  show.frames(61);
  EXPECT_NEAR(ball->state().v.y(), 2.0, 1e-9) << "its scale multiplies its strength";
  EXPECT_NEAR(ball->state().v.x(), 0.0, 1e-9);
}

TEST(DynamicsNode, IsNotVisitedWhileItsBodiesRestAndWakesWhenAColliderMoves) {
  ShowFixture show;
  const MeshId box = show.meshes.add(cube(1));
  Ball* ball = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    addNode<Field>(load, "gravity", Vec3(0, 0, -kStandardGravity), true);
    addNode<Block>(load, "floor", box, Vec3(0, 0, -1));
    addNode<Block>(load, "foot", box, Vec3(0, -5, 1.05));
    ball = &addNode<Ball>(load, "ball", Vec3(0, 0, 0.1), std::vector<std::string>{"gravity"});
    addNode<Sim>(load, "sim", std::vector<std::string>{"floor", "foot"}, std::vector<std::string>{"ball"});
  };
  show.scene.open("show");
  show.tracker("foot", {0, -5, 1.05});
  show.frames(60);
  EXPECT_EQ(show.scene.counters().nodesVisited, 0u);
  EXPECT_EQ(show.scene.events().size(), 0u);
  EXPECT_EQ(ball->state().p, Vec3(0, 0, 0.1));
  show.scene.command("foot", CommandId::Attach, {"all", "foot"}, show.input.time);
  std::size_t impacts = 0;
  for (int n = 0; n < 120; ++n) {  // at 4 m/s; the near face reaches the ball after 3.9 m
    show.tracker("foot", {0, std::min(-5 + 4 * n / 60.0, -0.5), 1.05});
    show.frame();
    for (const EventRecord& e : show.scene.events()) impacts += e.event == Event("onimpact");
  }
  EXPECT_EQ(impacts, 1u);
  EXPECT_GT(ball->state().v.y(), 1.0);
}

/// A show in which the wand, a metre up, has just grabbed the only ball.
Ball& grabbedBall(ShowFixture& show) {
  Ball* ball = nullptr;
  show.loader.files["show"] = [&](LoadedScene& load) {
    ball = &addNode<Ball>(load, "ball", Vec3(0, 0, 1), std::vector<std::string>{});
    addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"ball"});
  };
  show.scene.open("show");
  show.tracker("wand", {0, 0, 1});
  show.frames(2);
  show.scene.command("ball", CommandId::Grab, {"wand"}, show.input.time);
  show.frame();
  show.loader.files.erase("show");  // it refers to what ends here
  return *ball;
}

TEST(DynamicsNode, AGrabbedBodyFollowsTheHandAndKeepsItsVelocityWhenReleased) {
  ShowFixture show;
  const Ball& ball = grabbedBall(show);
  for (int n = 1; n <= 30; ++n) {
    show.tracker("wand", {0, 3 * n / 60.0, 1});
    show.frame();
  }
  EXPECT_NEAR(ball.state().pose.p.y(), 1.5, 1e-9);
  show.scene.command("ball", CommandId::Release, {}, show.input.time);
  show.frames(60);
  EXPECT_NEAR(ball.state().v.y(), 3.0, 1e-3);
  show.scene.command("ball", CommandId::Reset, {}, show.input.time);
  show.frames(2);
  EXPECT_EQ(ball.state().p, Vec3(0, 0, 1));
  EXPECT_EQ(ball.state().v, Vec3(0, 0, 0));
}

TEST(DynamicsNode, ABodyThatLeavesAllBoundsIsToldOfByEventAndByName) {
  for (const auto& [pull, rate] : {std::pair{1e11, 60.}, {1e11, 240.}, {1e13, 60.}}) {
    ShowFixture show;
    show.rate = rate;
    Ball* ball = nullptr;
    show.loader.files["show"] = [&, pull = pull](LoadedScene& load) {
      addNode<Field>(load, "storm", Vec3(pull, 0, 0), true);
      addNode<Field>(load, "other", Vec3(0, 0, 0), false);
      ball = &addNode<Ball>(load, "doomed", Vec3(0, 0, 1), std::vector<std::string>{"storm"});
      ball->addNotification({Event("onquarantine"), "other", CommandId::Enable, {}, 0});
      addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"doomed"});
    };
    show.scene.open("show");
    std::vector<EventRecord> told;
    const auto play = [&](std::size_t frames) {
      for (std::size_t n = 0; n < frames; ++n) {
        show.frame();
        for (const EventRecord& e : show.scene.events())
          if (e.event == Event("onquarantine")) told.push_back(e);
      }
    };
    play(static_cast<std::size_t>(5 * rate));
    ASSERT_EQ(ball->state().mode, BodyMode::Quarantined);
    ASSERT_EQ(told.size(), 1u) << "once";
    EXPECT_EQ(told[0].node, ball->self());
    EXPECT_EQ(told[0].when, ball->state().clock);
    ASSERT_EQ(show.loader.reported.size(), 1u);
    const std::string& what = show.loader.reported[0].message;
    EXPECT_NE(what.find("\"doomed\" is out of the simulation from"), what.npos) << what;
    const bool atOnce = pull > 1e12;  // no such pull is followed at all
    EXPECT_NE(what.find(atOnce ? "infinite" : "bounds"), what.npos) << what;
    EXPECT_NEAR(toSeconds(told[0].when), atOnce ? 0 : std::sqrt(20), 1e-6)
        << "10^12 m at 10^11 m/s2, at any rate";
    EXPECT_NEAR(ball->state().pose.p.x(), atOnce ? 0 : 1e12, 1e6);
    show.scene.command("doomed", CommandId::Reset, {}, show.input.time);
    play(static_cast<std::size_t>(5 * rate));
    EXPECT_EQ(told.size(), 2u) << "it is in the same storm again";
  }
}

TEST(DynamicsNode, AHandThatJumpsThrowsNothingAndItIsSaid) {
  for (const double speed : {40., 100.}) {
    ShowFixture show;
    const Ball& ball = grabbedBall(show);
    for (int n = 1; n <= 10; ++n) {
      show.tracker("wand", {0, speed * n / 60.0, 1});
      show.frame();
    }
    show.scene.command("ball", CommandId::Release, {}, show.input.time);
    show.frames(2);
    EXPECT_NEAR(ball.state().v.y(), speed < 60 ? speed : 0, 1e-3);
    EXPECT_EQ(show.loader.reported.size(), speed < 60 ? 0u : 1u);
  }
}

TEST(CollisionNode, TellsWhenObjectsThatOthersMoveTouchAndComeApart) {
  ShowFixture show;
  const MeshId box = show.meshes.add(cube(0.5));
  std::vector<EventRecord> events;
  show.loader.files["show"] = [&](LoadedScene& load) {
    addNode<Block>(load, "wall", box, Vec3(0, 0, 0));
    addNode<Block>(load, "hand", box, Vec3(0, -3, 0));
    addNode<TouchWatch>(load, "watch", std::vector<std::string>{"wall"}, std::vector<std::string>{"hand"});
  };
  show.scene.open("show");
  show.tracker("hand", {0, -3, 0});
  show.frames(2);
  show.scene.command("hand", CommandId::Attach, {"all", "hand"}, show.input.time);
  for (int n = 0; n < 240; ++n) {  // forward 2.1 m at 2 m/s, and back
    const double s = n / 60.0 * 2;
    show.tracker("hand", {0, -3 + (s < 2.1 ? s : std::max(4.2 - s, -1.0)), 0});
    show.frame();
    for (const EventRecord& e : show.scene.events()) events.push_back(e);
  }
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].event, Event("onimpact"));
  EXPECT_EQ(events[1].event, Event("onrelease"));
  EXPECT_NEAR(toSeconds(events[1].when - events[0].when), 0.1 + 0.25, 0.02);
}

/// A ball sleeps a metre up, on a shelf that follows a tracker, on one from a sub-scene, or on a held ball.
/// Whatever the show does to that, the ball falls.
TEST(DynamicsNode, ASleeperFallsWhateverTheShowDoesToWhatHoldsItUp) {
  struct Cause {
    const char* name;
    const char* carrier;
    std::function<void(ShowFixture&)> happens;
  };
  const auto tell = [](const char* node, CommandId command) {
    return [=](ShowFixture& show) { show.scene.command(node, command, {}, show.input.time); };
  };
  const auto turn = [](ShowFixture& show) {
    show.input.trackers[0].X_RT.q = Quat(Eigen::AngleAxisd(M_PI, Vec3::UnitX()));
  };
  const std::vector<Cause> causes{
      {"its tracker goes", "shelf",
       [](ShowFixture& show) {
         show.tracker("hand", {3, 0, 1});
       }},
      {"it is detached and reset", "shelf",
       [&](ShowFixture& show) {
         tell("shelf", CommandId::Detach)(show), show.frames(30);
         tell("shelf", CommandId::Reset)(show);
       }},
      {"it goes while the simulation is off", "shelf",
       [&](ShowFixture& show) {
         tell("sim", CommandId::Disable)(show), show.frames(30);
         show.tracker("hand", {3, 0, 1}), show.frames(30);
         tell("sim", CommandId::Enable)(show);
       }},
      {"its file is unloaded", "game", tell("game", CommandId::Unload)},
      {"it is let go", "held", tell("held", CommandId::Release)},
      {"it is reset", "held", tell("held", CommandId::Reset)},
      {"the hand goes", "held",
       [](ShowFixture& show) {
         show.tracker("hand", {3, 0, 1});
       }},
      {"gravity is turned over", "shelf", turn},
  };
  for (const Cause& cause : causes) {
    SCOPED_TRACE(std::string(cause.carrier) + ": " + cause.name);
    ShowFixture show;
    const MeshId box = show.meshes.add(cube(0.5));
    const std::string on = cause.carrier;
    Ball* ball = nullptr;
    show.loader.files["game"] = [&](LoadedScene& load) { addNode<Block>(load, "plate", box, Vec3(0, 0, 1)); };
    show.loader.files["show"] = [&](LoadedScene& load) {
      addNode<MovingNode>(load, "leg", PlaceAttributes{}, false);
      PlaceAttributes carried;
      carried.parent = {load.number, 0};
      addNode<Field>(load, "gravity", Vec3(0, 0, -kStandardGravity), true, 0.0, carried);
      addNode<Block>(load, "shelf", box, Vec3(5, 0, 1));
      if (on == "game") addNode<SceneNode>(load, "game", PlaceAttributes{}, "game", Nanoseconds{0}, true);
      addNode<Ball>(load, "held", Vec3(5, 0, 3), std::vector<std::string>{});
      ball = &addNode<Ball>(load, "ball", Vec3(0, 0, on == "held" ? 1.25 : 1.65),
                            std::vector<std::string>{"gravity"});
      std::vector<std::string> colliders{"shelf"};
      if (on == "game") colliders.emplace_back("game/plate");
      addNode<Sim>(load, "sim", colliders, std::vector<std::string>{"ball", "held"});
    };
    show.tracker("hand", on == "held" ? Vec3(5, 0, 3) : Vec3(0, 0, 1));
    show.scene.open("show");
    show.frame();
    if (on == "shelf") show.scene.command("shelf", CommandId::Attach, {"all", "hand"}, show.input.time);
    if (on == "held") show.scene.command("held", CommandId::Grab, {"hand"}, show.input.time);
    if (cause.name == std::string("gravity is turned over"))
      show.scene.command("leg", CommandId::Attach, {"orientation", "hand"}, show.input.time);
    show.frames(2);
    if (on == "held") show.tracker("hand", {0, 0, 1});
    show.frames(300);
    ASSERT_EQ(ball->state().mode, BodyMode::Rest);
    const Vec3 bed = ball->state().p;
    ASSERT_NEAR(bed.z(), on == "held" ? 1.2 : 1.6, 0.01);
    cause.happens(show);
    show.frames(60);
    EXPECT_GT((ball->state().p - bed).norm(), 1.0);
  }
}

}  // namespace
}  // namespace stadion
