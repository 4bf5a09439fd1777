/// A field posts what happens to it, at the exact time, and acts for just as long.

#include "tests/dynamics/nodes/show_nodes.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace stadion {
namespace {

using namespace show_nodes;

/// A show with a field and a ball, played to a time, and the events of the field.
struct FieldShow : ShowFixture {
  std::vector<std::pair<std::string, Nanoseconds>> told;
  Ball* ball = nullptr;

  FieldShow(double hertz, bool on, double duration, bool hooked = true) {
    rate = hertz;
    loader.files["show"] = [=, this](LoadedScene& load) {
      addNode<Field>(load, "push", Vec3(10, 0, 0), on, duration);
      ball = &addNode<Ball>(load, "ball", Vec3::Zero(),
                            hooked ? std::vector<std::string>{"push"} : std::vector<std::string>{});
      addNode<Sim>(load, "sim", std::vector<std::string>{}, std::vector<std::string>{"ball"});
    };
    scene.open("show");
  }
  void command(const std::string& target, CommandId command, double seconds,
               std::vector<std::string> arguments = {}) {
    ASSERT_TRUE(scene.command(target, command, std::move(arguments), fromSeconds(seconds)));
  }
  void playTo(double seconds) {
    while (signatureAt(next, rate).time <= fromSeconds(seconds)) {
      frame();
      for (const EventRecord& e : scene.events()) told.emplace_back(e.event.name(), e.when);
    }
  }
};

constexpr double kFieldRates[] = {30, 60, 144};

TEST(FieldEvents, CarryTheExactTimeAtEveryFrameRate) {
  const std::vector<std::pair<std::string, Nanoseconds>> right{
      {"enabled", 103'700'000},   {"expired", 353'700'000},     // by its duration
      {"enabled", 501'100'000},   {"disabled", 703'300'000},    // enabled again meanwhile, which is no event
      {"enabled", 804'400'000},   {"disabled", 900'000'000},    // by toggle and reset
      {"enabled", 1'103'700'000}, {"expired", 1'353'700'000}};  // the command comes as it expires
  for (const double rate : kFieldRates) {
    FieldShow show(rate, false, 0.25);
    show.command("push", CommandId::Enable, 0.1037);
    show.command("push", CommandId::Enable, 0.5011);
    show.command("push", CommandId::Enable, 0.6022);
    show.command("push", CommandId::Disable, 0.7033);
    show.command("push", CommandId::Toggle, 0.8044);
    show.command("push", CommandId::Reset, 0.9);
    show.command("push", CommandId::Enable, 1.1037);
    show.command("push", CommandId::Disable, 1.3537);
    show.playTo(2);
    EXPECT_EQ(show.told, right) << rate;
    const double acted = 0.25 + (0.7033 - 0.5011) + (0.9 - 0.8044) + 0.25;
    EXPECT_NEAR(show.ball->state().v.x(), 10 * acted, 1e-9) << rate;
  }
}

TEST(FieldEvents, OneThatIsEnabledAtTheStartExpiresAndPostsNothingElse) {
  for (const double rate : kFieldRates) {
    FieldShow show(rate, true, 0.3004);
    show.playTo(1);
    ASSERT_EQ(show.told.size(), 1U) << rate;
    EXPECT_EQ(show.told[0], std::pair(std::string("expired"), Nanoseconds{300'400'000})) << rate;
    EXPECT_NEAR(show.ball->state().v.x(), 3.004, 1e-9) << rate;
  }
}

TEST(FieldEvents, ABodyThatIsHookedLaterFeelsTheRestOfTheActivation) {
  for (const double rate : kFieldRates) {
    FieldShow show(rate, true, 0.5, false);
    show.command("ball", CommandId::Hook, 0.3, {"push"});
    show.playTo(1);
    ASSERT_EQ(show.told.size(), 1U) << rate;
    EXPECT_NEAR(show.ball->state().v.x(), 2, 1e-9) << rate;
  }
}

/// Two fields hold a ball on the floor against a third one, until the stronger of them expires.
TEST(FieldEvents, ABodyAsleepWakesAtTheTimeAtWhichAFieldExpires) {
  for (const double rate : {25.0, 60.0, 240.0})
    for (const double duration : {0.1, 0.5004, 1.2004}) {
      FieldShow show(rate, true, duration, false);
      show.loader.files["held"] = [&](LoadedScene& load) {
        addNode<Field>(load, "down", Vec3(0, 0, -20), true, duration);
        addNode<Field>(load, "up", Vec3(0, 0, 10), true);
        addNode<Block>(load, "floor", show.meshes.add(cube(1)), Vec3(0, 0, -1));
        show.ball = &addNode<Ball>(load, "held", Vec3(0, 0, 0.1), std::vector<std::string>{"down", "up"});
        addNode<Sim>(load, "world", std::vector<std::string>{"floor"}, std::vector<std::string>{"held"});
      };
      show.scene.open("held");
      show.playTo(2);
      const double risen = toSeconds(signatureAt(show.next - 1, rate).time) - duration;
      EXPECT_NEAR(show.ball->state().v.z(), 10 * risen, 1e-9) << rate << " Hz, " << duration << " s";
    }
}

}  // namespace
}  // namespace stadion
