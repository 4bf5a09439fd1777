#include "engine/input/scripted_input.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"
#include "engine/nodes/rig_drive.h"
#include "engine/nodes/rig_node.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

void say(ScriptedInput& input, double seconds, float turn, float forward, const Vec3& p = Vec3::Zero(),
         double yaw = 0, bool smooth = false) {
  InputStamp stamp;
  stamp.time = fromSeconds(seconds);
  stamp.X_RT = {p, det::fromEuler(0, 0, yaw)};
  stamp.axes[0] = turn, stamp.axes[1] = forward;
  stamp.smooth = smooth;
  ASSERT_TRUE(input.add("wand", stamp));
}

/// Where the rig is after `seconds`.
Pose driven(ScriptedInput input, double rate, double seconds, double speed = 2, double turnRate = 1,
            const std::vector<std::pair<CommandId, double>>& commands = {}) {
  ShowFixture show;
  show.rate = rate;
  show.loader.files["show"] = [&](LoadedScene& load) {
    addNode<NavigatorNode>(load, "nav", NavigatorNode::Attributes{speed, turnRate, false, "wand"}, true);
  };
  show.scene.open("show");
  for (const auto& [command, when] : commands) show.scene.command("nav", command, {}, fromSeconds(when));
  for (TimeSignature now = signatureAt(show.next, rate); now.time <= fromSeconds(seconds);
       now = signatureAt(show.next, rate)) {
    input.sampleFrame(now.time - now.step, now.time, show.input);
    show.frame();
  }
  return show.scene.feed().rigPose();
}

ScriptedInput steps() {
  // Constant axes that change at times that no frame rate hits.
  ScriptedInput input;
  input.key("head", 0, {0.3, -0.2, 1.7});
  say(input, 0, 0, 1);
  say(input, 0.7131, 0, 1), say(input, 0.713100001, 0.5f, 1);
  say(input, 1.3877, 0.5f, 1), say(input, 1.387700001, -1, 0.25f);
  say(input, 1.9013, -1, 0.25f), say(input, 1.901300001, 0, 0);
  return input;
}

TEST(Navigator, TurningWhileGoingIsAnArcAroundItsCentre) {
  ScriptedInput input;
  say(input, 0, 1, 1);
  say(input, 10, 1, 1);
  // 2 m/s and 1 rad/s to the right: a circle of 2 m. The head is over the rig's origin.
  const Pose X = driven(input, 60, 2);
  EXPECT_LT((X.p - Vec3(2 - 2 * std::cos(2.0), 2 * std::sin(2.0), 0)).norm(), 1e-9);
  EXPECT_LT(X.q.angularDistance(det::fromEuler(0, 0, -2)), 1e-9);
}

TEST(Navigator, GoesTheSameWayFrom30To240FramesASecond) {
  const Pose reference = driven(steps(), 1000, 3);
  for (const double rate : {30.0, 60.0, 72.0, 90.0, 240.0}) {
    const Pose X = driven(steps(), rate, 3);
    EXPECT_LT((X.p - reference.p).norm(), 1e-8) << rate;
    EXPECT_LT(X.q.angularDistance(reference.q), 1e-8) << rate;
  }
  EXPECT_GT(reference.p.norm(), 1);
}

TEST(Navigator, GoesTheSameWayWhenAxesHeadAndWandGlide) {
  ScriptedInput input;
  input.key("head", 0, {0, 0, 1.7}).key("head", 1.511, {0.5, 0.2, 1.6}).key("head", 2.77, {-0.4, 0.1, 1.7});
  say(input, 0, 0, 0), say(input, 0.913, 1, 1, {0, 0, 1}, 0.5),
      say(input, 2.003, -0.5f, 0.5f, {0, 0, 1}, -0.8);
  say(input, 3.3, 0, 1);
  const Pose reference = driven(input, 1000, 3);
  for (const double rate : {30.0, 60.0, 240.0}) {
    const Pose X = driven(input, rate, 3);
    EXPECT_LT((X.p - reference.p).norm(), 1e-6) << rate;
    EXPECT_LT(X.q.angularDistance(reference.q), 1e-6) << rate;
  }
}

TEST(Navigator, CommandsTakeEffectAtTheirTimeWithinAFrame) {
  ScriptedInput input;
  say(input, 0, 0, 1);
  say(input, 10, 0, 1);
  for (const double rate : {30.0, 60.0, 240.0}) {
    const Pose X =
        driven(input, rate, 3, 2, 1,
               {{CommandId::Disable, 0.70001}, {CommandId::Enable, 1.20002}, {CommandId::Toggle, 2.00003}});
    EXPECT_NEAR(X.p.y(), 2 * (0.70001 + 0.80001), 1e-8) << rate;
  }
}

TEST(Navigator, TurnsAboutTheHead) {
  ScriptedInput input;
  input.key("head", 0, {1, 2, 1.7});
  say(input, 0, 1, 0);
  say(input, 10, 1, 0);
  const Pose X = driven(input, 30, 2);
  EXPECT_LT((X * Vec3(1, 2, 1.7) - Vec3(1, 2, 1.7)).norm(), 1e-9);
}

TEST(RigDrive, TheQuadratureAgreesWithTheArc) {
  const RigDrive drive{7, 3, false, 1};
  RigDrive::End a{0.8, 1, {0.3, 0.1, 1.7}, det::fromEuler(0.2, 0.1, 1)}, b = a;
  b.forward += 1e-13;  // not the same any more
  const Pose X = {Vec3(1, 2, 3), det::fromEuler(0, 0, 0.4)};
  const Pose arc = drive.moved(X, a, a), way = drive.moved(X, a, b);
  EXPECT_LT((arc.p - way.p).norm(), 1e-11);
  EXPECT_LT(arc.q.angularDistance(way.q), 1e-12);
}

TEST(RigDrive, SmallTurnsAreAsExactAsLargeOnes) {
  for (const double angle : {1e-9, 1e-4, 0.00999, 0.01001, kPi}) {
    const RigDrive drive{angle, 1, false, 1};
    const RigDrive::End e{-1, 1, Vec3::Zero(), Quat::Identity()};
    const Vec3 p = drive.moved({}, e, e).p;
    EXPECT_NEAR(p.x(), angle < 1e-3 ? -angle / 2 : (std::cos(angle) - 1) / angle, 1e-12);
    EXPECT_NEAR(p.y(), angle < 1e-3 ? 1 - angle * angle / 6 : std::sin(angle) / angle, 1e-12);
  }
}

TEST(Navigator, ADeviceWithoutAPoseMovesTheRigTheWayItFaces) {
  for (const double rate : {30., 60., 144.}) {
    ScriptedInput pad;
    InputStamp stamp;
    stamp.valid = false, stamp.controlsOnly = true;
    stamp.axes[1] = 1;
    for (const double t : {0., 2.}) {
      stamp.time = fromSeconds(t);
      ASSERT_TRUE(pad.add("wand", stamp));
    }
    EXPECT_LT((driven(pad, rate, 1).p - Vec3(0, 2, 0)).norm(), 1e-9) << rate;
  }
}

}  // namespace
}  // namespace stadion
