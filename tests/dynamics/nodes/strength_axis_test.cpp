/// Fields whose strength a joypad gives: the motion follows the device's records, not the frames.

#include "engine/input/scripted_input.h"
#include "tests/dynamics/nodes/show_nodes.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

using namespace show_nodes;

void say(ScriptedInput& input, double seconds, float axis, bool valid = true) {
  InputStamp stamp;
  stamp.time = fromSeconds(seconds);
  stamp.axes[3] = axis;
  stamp.valid = valid;
  ASSERT_TRUE(input.add("pad", stamp));
}

/// A ball that feels gravity, if there is a floor, and the field that the pad scales.
struct Joypad : ShowFixture {
  Field* fan = nullptr;
  Ball* ball = nullptr;
  ScriptedInput pad;

  Joypad(double framesPerSecond, const Vec3& push, bool floor, ScriptedInput said, bool on = true)
      : pad(std::move(said)) {
    rate = framesPerSecond;
    const MeshId mesh = meshes.add(cube(5));
    loader.files["show"] = [=, this](LoadedScene& load) {
      fan = &addNode<Field>(load, "fan", push, on, 0, PlaceAttributes{}, StrengthAxis{"pad", 3});
      addNode<Field>(load, "gravity", Vec3(0, 0, floor ? -9.81 : 0), true);
      addNode<Block>(load, "floor", mesh, Vec3(0, 0, -5.1));
      ball = &addNode<Ball>(load, "ball", Vec3(-4, 0, 0), std::vector<std::string>{"fan", "gravity"});
      addNode<Sim>(load, "sim", std::vector<std::string>{"floor"}, std::vector<std::string>{"ball"});
    };
    scene.open("show");
  }
  BodyState after(double seconds) {
    for (TimeSignature now = signatureAt(next, rate); now.time <= fromSeconds(seconds);
         now = signatureAt(next, rate)) {
      pad.sampleFrame(now.time - now.step, now.time, input);
      frame();
    }
    return ball->state();
  }
};

/// 0 until 0.31 s, evenly to 1 at 1.03 s, and -0.5 from 1.5 s on.
ScriptedInput pulls() {
  ScriptedInput input;
  say(input, 0.31, 0), say(input, 1.03, 1), say(input, 1.5, 1), say(input, 1.500000001, -0.5f);
  return input;
}

TEST(StrengthAxis, AFreeBodyGetsExactlyWhatTheDeviceSaid) {
  // v and x at 2 s of an acceleration of 4 times the axis.
  const double rise = 0.72, v1 = 4 * rise / 2, x1 = 4 * rise * rise / 6;
  const double v2 = v1 + 4 * 0.47, x2 = x1 + v1 * 0.47 + 2 * 0.47 * 0.47;
  const double v3 = v2 - 2 * 0.5, x3 = x2 + v2 * 0.5 - 0.25;
  for (const double rate : {10., 30., 144.}) {
    const BodyState s = Joypad(rate, {0, 0, 4}, false, pulls()).after(2);
    EXPECT_NEAR(s.p.z(), x3, 3e-7) << rate;  // axes are single precision
    EXPECT_NEAR(s.v.z(), v3, 3e-7) << rate;
  }
}

TEST(StrengthAxis, ABallOnTheGroundStartsAndRollsAlikeAtEveryFrameRate) {
  const BodyState a = Joypad(30, {2, 0, 0}, true, pulls()).after(2);
  EXPECT_GT(a.p.x(), -3.5);
  for (const double rate : {60., 144., 240.}) {
    const BodyState b = Joypad(rate, {2, 0, 0}, true, pulls()).after(2);
    EXPECT_LT((a.p - b.p).norm(), 3e-6) << rate;
    EXPECT_LT((a.v - b.v).norm(), 3e-6) << rate;
  }
}

TEST(StrengthAxis, ADeviceThatIsLostOrMissingGivesNothing) {
  ScriptedInput lost;
  say(lost, 0, 1), say(lost, 0.5, 0, false), say(lost, 1.01, 1);
  for (const double rate : {30., 144.}) {
    Joypad show(rate, {0, 0, 1}, false, lost);
    EXPECT_NEAR(show.after(1).v.z(), 0.5, 1e-9);
    EXPECT_NEAR(show.after(1.5).v.z(), 0.99, 1e-9);
  }
  EXPECT_EQ(Joypad(30, {0, 0, 1}, false, {}).after(1).v.z(), 0);
}

TEST(StrengthAxis, AFieldThatIsSwitchedOnStartsWithWhatTheAxisSaysThen) {
  for (const double rate : {30., 144.}) {
    Joypad show(rate, {0, 0, 1}, false, pulls(), false);
    show.scene.command("fan", CommandId::Enable, {}, fromSeconds(1.25));
    EXPECT_NEAR(show.after(1.5).v.z(), 0.25, 1e-9);
    show.scene.command("fan", CommandId::Disable, {}, fromSeconds(1.75));
    EXPECT_NEAR(show.after(2).v.z(), 0.125, 1e-8);
  }
}

TEST(StrengthAxis, AStillDeviceLeavesTheShowAsleep) {
  ScriptedInput still;
  say(still, 0, 0.1f);
  Joypad show(60, {0.1, 0, 0}, true, still);
  show.after(1);
  const std::size_t before = show.scene.counters().nodesVisited;
  EXPECT_TRUE(show.ball->state().asleep());
  EXPECT_LE(before, 1u) << "the field looks at its axis, and no other node does anything";
}

TEST(StrengthAxis, OfAMediumItScalesTheWind) {
  const ForceField fan{MediumField{1.2, 0.5, {4, 0, 0}}, {}, {}, 0, 0.5, 0.5};
  ForceField wind{MediumField{1.2, 0.5, {2, 0, 0}}, {}, {}};
  const BodyInField body{2, 0.1, Vec3::Zero(), {0, 1, 0}};
  EXPECT_LT((accelerationOf(fan, body, 0.3) - accelerationOf(wind, body, 0.3)).norm(), 1e-15);
  EXPECT_TRUE(fan.evenMedium());
  wind.last = 0;
  EXPECT_FALSE(wind.evenMedium());
}

}  // namespace
}  // namespace stadion
