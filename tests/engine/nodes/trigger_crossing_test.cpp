#include "engine/input/scripted_input.h"
#include "engine/nodes/trigger_node.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

class TellingTrigger : public TriggerNode {
public:
  TellingTrigger(NodeRef self, std::string name, const NodeType& type, const Region& region,
                 const std::string& tracker, PlaceAttributes place = {}, bool on = true)
      : TriggerNode(type, self, std::move(name), std::move(place), region, tracker, on) {}
};

Region ballRegion(double radius) {
  Region r;
  r.radius = radius;
  return r;
}

Region slab(const Vec3& halfSize) {
  Region r;
  r.form = Region::Form::Box;
  r.halfSize = halfSize;
  return r;
}

/// What a trigger tells when a device goes as scripted.
std::vector<EventRecord> told(const Region& region, ScriptedInput input, double rate, double seconds,
                              const std::string& tracker = "head",
                              const std::vector<std::pair<CommandId, double>>& commands = {},
                              bool on = true) {
  ShowFixture show;
  show.rate = rate;
  show.loader.files["show"] = [&](LoadedScene& load) {
    const NodeType& type = tracker == "head" ? kUserTriggerType : kWandTriggerType;
    addNode<TellingTrigger>(load, "zone", type, region, tracker, PlaceAttributes{}, on);
  };
  show.scene.open("show");
  for (const auto& [command, when] : commands) show.scene.command("zone", command, {}, fromSeconds(when));
  std::vector<EventRecord> all;
  for (TimeSignature now = signatureAt(show.next, rate); now.time <= fromSeconds(seconds);
       now = signatureAt(show.next, rate)) {
    input.sampleFrame(now.time - now.step, now.time, show.input);
    show.frame();
    all.insert(all.end(), show.scene.events().begin(), show.scene.events().end());
  }
  return all;
}

void expectEvents(const std::vector<EventRecord>& events,
                  const std::vector<std::pair<Event, double>>& expected) {
  ASSERT_EQ(events.size(), expected.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    EXPECT_EQ(events[i].event, expected[i].first);
    EXPECT_NEAR(static_cast<double>(events[i].when), 1e9 * expected[i].second, 2) << "event " << i;
  }
}

TEST(TriggerCrossing, AVisitWithinOneFrameIsToldWithItsExactTimes) {
  ScriptedInput input;
  input.key("head", 0, {-1, 0, 0}).key("head", 1, {-1, 0, 0}).key("head", 1.4, {3, 0, 0});  // 10 m/s
  for (const double rate : {5.0, 30.0, 60.0, 240.0}) {
    expectEvents(told(ballRegion(0.05), input, rate, 2), {{Event("enter"), 1.095}, {Event("exit"), 1.105}});
    expectEvents(told(slab({0.05, 1, 1}), input, rate, 2), {{Event("enter"), 1.095}, {Event("exit"), 1.105}});
  }
}

TEST(TriggerCrossing, TheWayInsideAFrameCounts) {
  // There and back between two frames: the ends of the frame are both outside.
  ScriptedInput input;
  input.key("head", 0, {-2, 0, 0}).key("head", 0.1, {0, 0, 0}).key("head", 0.2, {-2, 0, 0});
  for (const double rate : {4.0, 60.0})
    expectEvents(told(ballRegion(1), input, rate, 1), {{Event("enter"), 0.05}, {Event("exit"), 0.15}});
}

TEST(TriggerCrossing, AGrazeIsNoVisit) {
  ScriptedInput input;
  input.key("head", 0, {-2, 1, 0}).key("head", 1, {2, 1, 0});
  EXPECT_TRUE(told(ballRegion(0.999999), input, 3, 2).empty());
  EXPECT_EQ(told(ballRegion(1.000001), input, 3, 2).size(), 2u);
}

TEST(TriggerCrossing, ADeviceThatWasLostHasJumped) {
  ScriptedInput input;
  input.key("head", 0, {-1, 0, 0});
  InputStamp lost;
  lost.time = fromSeconds(0.3), lost.valid = false, lost.X_RT.p = Vec3(-1, 0, 0);
  ASSERT_TRUE(input.add("wand", [] {
    InputStamp s;
    s.X_RT.p = Vec3(-1, 0, 0);
    return s;
  }()));
  ASSERT_TRUE(input.add("wand", lost));
  input.key("wand", 0.512, {1, 0, 0}).key("wand", 0.812, {0, 0, 0});
  for (const double rate : {3.0, 60.0})
    expectEvents(told(ballRegion(0.5), input, rate, 2, "wand"), {{Event("enter"), 0.662}});
}

TEST(TriggerCrossing, ButtonsAreToldAtTheTimeOfTheirPressAlsoWhenReleasedWithinTheFrame) {
  ScriptedInput input;
  input.key("wand", 0, {0, 0, 0}).key("wand", 0.501, {0, 0, 0}, Vec3::Zero(), false, 1);
  input.key("wand", 0.503, {0, 0, 0}).key("wand", 0.777, {0, 0, 0}, Vec3::Zero(), false, 2);
  for (const double rate : {10.0, 60.0, 240.0})
    expectEvents(
        told(ballRegion(1), input, rate, 1, "wand"),
        {{Event("enter"), 0}, {Event("button1"), 0.501}, {Event("button1up"), 0.503}, {Event("button2"), 0.777}});
}

TEST(TriggerCrossing, AButtonCountsWhereTheDeviceIsWhenItIsPressed) {
  ScriptedInput input;  // presses on its way through, then outside
  input.key("wand", 0, {-2, 0, 0}).key("wand", 0.2, {0, 0, 0}, Vec3::Zero(), false, 1);
  input.key("wand", 0.4, {2, 0, 0}).key("wand", 0.45, {2, 0, 0}, Vec3::Zero(), false, 1);
  for (const double rate : {2.0, 60.0})
    expectEvents(told(ballRegion(1), input, rate, 1, "wand"),
                 {{Event("enter"), 0.1}, {Event("button1"), 0.2}, {Event("exit"), 0.3}, {Event("button1up"), 0.4}});
}

TEST(TriggerCrossing, AReleaseIsToldWhereverTheDeviceIsThenIfThePressWas) {
  ScriptedInput input;  // button 1 pressed inside, 2 outside; both let go far away, then 2 inside
  input.key("wand", 0, {0, 0, 0}).key("wand", 0.2, {0, 0, 0}, Vec3::Zero(), false, 1);
  input.key("wand", 0.3, {2, 0, 0}, Vec3::Zero(), false, 3).key("wand", 0.4137, {5, 0, 0});
  input.key("wand", 0.5, {2, 0, 0}, Vec3::Zero(), false, 2).key("wand", 0.6, {0, 0, 0});
  for (const double rate : {2.0, 30.0, 60.0, 144.0, 1000.0})
    expectEvents(told(ballRegion(1), input, rate, 1, "wand"), {{Event("enter"), 0},
                                                               {Event("button1"), 0.2},
                                                               {Event("exit"), 0.25},
                                                               {Event("button1up"), 0.4137},
                                                               {Event("enter"), 0.55}});
}

TEST(TriggerCrossing, ADeviceThatIsLostLetsGoOfItsButtonsAtThatTime) {
  ScriptedInput input;
  input.key("wand", 0, {0, 0, 0}).key("wand", 0.2, {0, 0, 0}, Vec3::Zero(), false, 1);
  InputStamp lost;
  lost.time = fromSeconds(0.3123), lost.valid = false;
  ASSERT_TRUE(input.add("wand", lost));
  input.key("wand", 0.7, {0, 0, 0});
  for (const double rate : {2.0, 30.0, 60.0, 1000.0})
    expectEvents(told(ballRegion(1), input, rate, 1, "wand"),
                 {{Event("enter"), 0}, {Event("button1"), 0.2}, {Event("button1up"), 0.3123}});
}

TEST(TriggerCrossing, ATriggerThatWasDisabledMeanwhileTellsNoRelease) {
  ScriptedInput input;
  input.key("wand", 0, {0, 0, 0}).key("wand", 0.2, {0, 0, 0}, Vec3::Zero(), false, 1);
  input.key("wand", 0.8, {0, 0, 0});
  for (const double rate : {4.0, 60.0})
    expectEvents(
        told(ballRegion(1), input, rate, 1, "wand", {{CommandId::Disable, 0.5}, {CommandId::Enable, 0.6}}),
        {{Event("enter"), 0}, {Event("button1"), 0.2}, {Event("enter"), 0.6}});
}

TEST(TriggerCrossing, WhetherAReleaseWillBeToldIsPartOfTheState) {
  // Pressed inside or before it came in: in the end all is the same, but for what the release will do.
  const auto hashAfter = [](const Vec3& pressedAt) {
    ShowFixture show;
    show.loader.files["show"] = [](LoadedScene& load) {
      addNode<TellingTrigger>(load, "zone", kWandTriggerType, ballRegion(1), "wand");
    };
    show.scene.open("show");
    ScriptedInput input;
    input.key("wand", 0, {0, 0, 0}).key("wand", 0.1, pressedAt);
    input.key("wand", 0.2, pressedAt, Vec3::Zero(), false, 1)
        .key("wand", 0.3, {0, 0, 0}, Vec3::Zero(), false, 1);
    for (TimeSignature now = signatureAt(show.next, show.rate); now.time <= fromSeconds(0.5);
         now = signatureAt(show.next, show.rate)) {
      input.sampleFrame(now.time - now.step, now.time, show.input);
      show.frame();
    }
    return show.scene.stateHash();
  };
  EXPECT_EQ(hashAfter({0.5, 0, 0}), hashAfter({0.25, 0, 0}));
  EXPECT_NE(hashAfter({0.5, 0, 0}), hashAfter({2, 0, 0}));
}

TEST(TriggerCrossing, DisableEndsTheWatchAtItsTimeWithinTheFrame) {
  ScriptedInput input;
  input.key("head", 0, {-2, 0, 0}).key("head", 1, {2, 0, 0});
  for (const double rate : {4.0, 60.0})
    expectEvents(told(ballRegion(1), input, rate, 1, "head", {{CommandId::Disable, 0.6}}),
                 {{Event("enter"), 0.25}});
}

TEST(TriggerCrossing, EnableBeginsTheWatchAtItsTimeWithinTheFrame) {
  ScriptedInput head, wand;
  head.key("head", 0, {0, 0, 0}).key("head", 0.6, {0, 0, 0}).key("head", 1, {4, 0, 0});  // 10 m/s
  wand.key("wand", 0, {0, 0, 0}).key("wand", 0.6, {0, 0, 0}).key("wand", 1, {4, 0, 0});
  for (const double rate : {5.0, 30.0, 60.0, 144.0, 1000.0})
    for (const std::string device : {"head", "wand"})
      expectEvents(told(ballRegion(0.05), device == "head" ? head : wand, rate, 1.2, device,
                        {{CommandId::Enable, 0.6017}}, false),
                   {{Event("enter"), 0.6017}, {Event("exit"), 0.605}});
}

TEST(TriggerCrossing, ATriggerThatMovesPastAVisitorNoticesThem) {
  ShowFixture show;
  show.rate = 4;
  show.loader.files["show"] = [&](LoadedScene& load) {
    addNode<MovingNode>(load, "carrier");  // 1 m/s along x
    PlaceAttributes below;
    below.parent = {load.number, 0};
    addNode<TellingTrigger>(load, "zone", kUserTriggerType, ballRegion(0.05), "head", below);
  };
  show.scene.open("show");
  show.head({1.1, 0, 0});
  std::vector<EventRecord> all;
  for (int i = 0; i < 8; ++i) {
    show.frame();
    all.insert(all.end(), show.scene.events().begin(), show.scene.events().end());
  }
  expectEvents(all, {{Event("enter"), 1.05}, {Event("exit"), 1.15}});
}

TEST(TriggerCrossing, ChordsOfSpheresAndBoxesAreExact) {
  const auto s = ballRegion(2).chord({-4, 0, 0}, {4, 0, 0});
  ASSERT_TRUE(s);
  EXPECT_DOUBLE_EQ(s->in, 0.25);
  EXPECT_DOUBLE_EQ(s->out, 0.75);
  EXPECT_FALSE(ballRegion(2).chord({-4, 2.0000001, 0}, {4, 2.0000001, 0}));
  EXPECT_FALSE(ballRegion(2).chord({1, 0, 0}, {1, 0, 0}));
  const auto b = slab({1, 2, 3}).chord({-3, -6, 0}, {3, 6, 0});
  ASSERT_TRUE(b);
  EXPECT_DOUBLE_EQ(b->in, 1.0 / 3);
  EXPECT_DOUBLE_EQ(b->out, 2.0 / 3);
  EXPECT_FALSE(slab({1, 2, 3}).chord({-3, 2.1, 0}, {3, 2.1, 0}));
}

TEST(TriggerCrossing, ADeviceWithoutAPoseIsWhereTheHeadIs) {
  ScriptedInput input;
  input.key("head", 0, {-1, 0, 0}).key("head", 1, {-1, 0, 0}).key("head", 1.4, {3, 0, 0});  // 10 m/s
  InputStamp pad;
  pad.valid = false, pad.controlsOnly = true;
  for (const auto& [time, buttons] : {std::pair{0., 0u}, {1.05, 1u}, {1.1, 0u}, {2., 0u}}) {
    pad.time = fromSeconds(time), pad.buttons = buttons;
    ASSERT_TRUE(input.add("pad", pad));
  }
  for (const double rate : {30.0, 60.0, 240.0})
    expectEvents(
        told(ballRegion(0.75), input, rate, 2, "pad"),
        {{Event("enter"), 1.025}, {Event("button1"), 1.05}, {Event("button1up"), 1.1}, {Event("exit"), 1.175}});
}

}  // namespace
}  // namespace stadion
