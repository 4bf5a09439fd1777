#include "engine/nodes/environment_node.h"
#include "engine/scene/scene_snapshot.h"
#include "tests/engine/scene/show_fixture.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

EnvironmentRecord surroundedBy(MeshId picture) {
  EnvironmentRecord record;
  record.picture = picture;
  return record;
}

/// An outdoor picture, a hall that is off, and tones.
struct EnvironmentShow : ShowFixture {
  explicit EnvironmentShow(bool opens = true) {
    loader.files["show"] = [](LoadedScene& load) {
      addNode<EnvironmentNode>(load, "outside", surroundedBy(7), 1, true);
      addNode<EnvironmentNode>(load, "hall", surroundedBy(8), 0.5, false);
      addNode<TonesNode>(load, "tones", ToneCurve::Neutral, 1);
    };
    if (!opens) return;  // a snapshot does
    scene.open("show");
    frame();
  }
  void tell(const std::string& node, std::string_view command, std::vector<std::string> words = {}) {
    EXPECT_TRUE(scene.command(node, commandNamed(command), std::move(words), changes.signature.time));
  }
  const EnvironmentRecord& lit() const { return changes.sky.environment; }
};

TEST(EnvironmentNode, OfThoseThatAreEnabledTheLastOneLights) {
  EnvironmentShow show;
  EXPECT_EQ(show.lit().lit, 1u);
  EXPECT_EQ(show.lit().picture, 7u);
  show.tell("hall", "enable");
  show.frames(2);
  EXPECT_EQ(show.lit().picture, 8u);
  EXPECT_EQ(show.lit().intensity, 0.5f);
  show.tell("hall", "toggle");
  show.tell("outside", "disable");
  show.frames(2);
  EXPECT_EQ(show.lit().lit, 0u) << "the sky's ambient lights again";
  show.tell("outside", "reset");
  show.frames(2);
  EXPECT_EQ(show.lit().picture, 7u);
}

TEST(EnvironmentNode, IntensityChangesAtOnceOrSlowly) {
  EnvironmentShow show;
  show.tell("outside", "intensity", {"3"});
  show.frames(2);
  EXPECT_EQ(show.lit().intensity, 3);
  const Nanoseconds from = show.changes.signature.time;
  show.tell("outside", "intensity", {"1", "fade", "0.5"});
  double last = 3;
  while (show.changes.signature.time < from + fromSeconds(0.5)) {
    show.frame();
    const double part = toSeconds(show.changes.signature.time - from) / 0.5;
    EXPECT_NEAR(double{show.lit().intensity}, 3 - 2 * std::min(part, 1.0), 1e-5);
    EXPECT_LE(show.lit().intensity, last);
    last = double{show.lit().intensity};
  }
  EXPECT_EQ(show.lit().intensity, 1);
  show.tell("outside", "intensity", {"-2"});
  show.frames(2);
  EXPECT_EQ(show.lit().intensity, 0) << "the nearest one within the limits";
  show.tell("outside", "intensity", {"many"});
  show.frames(2);
  EXPECT_EQ(show.lit().intensity, 0);
  show.tell("outside", "reset");
  show.frames(2);
  EXPECT_EQ(show.lit().intensity, 1);
}

TEST(TonesNode, ExposureIsInStops) {
  EnvironmentShow show;
  EXPECT_EQ(show.changes.sky.tones.curve, ToneCurve::Neutral);
  EXPECT_NEAR(show.changes.sky.tones.exposure, 2, 1e-6);
  show.tell("tones", "exposure", {"-1", "fade", "1"});
  show.frames(31);
  EXPECT_NEAR(show.changes.sky.tones.exposure, 1, 0.03) << "half way";
  show.frames(40);
  EXPECT_NEAR(show.changes.sky.tones.exposure, 0.5, 1e-6);
  show.tell("tones", "exposure", {"0"});
  show.frames(2);
  EXPECT_EQ(show.changes.sky.tones.exposure, 1) << "exactly, so that it costs nothing";
}

TEST(TonesNode, AShowWithoutIsShownAsBefore) {
  ShowFixture show;
  show.loader.files["show"] = [](LoadedScene&) {};
  show.scene.open("show");
  show.frame();
  EXPECT_EQ(show.changes.sky.environment.lit, 0u);
  EXPECT_EQ(show.changes.sky.tones.exposure, 1);
  EXPECT_EQ(show.changes.sky.tones.curve, ToneCurve::Soft);
}

TEST(EnvironmentNode, TheStateHashSeesSwitchIntensityAndExposure) {
  EnvironmentShow a, b, c, d;
  b.tell("hall", "enable");
  c.tell("outside", "intensity", {"2"});
  d.tell("tones", "exposure", {"0.25"});
  for (EnvironmentShow* show : {&a, &b, &c, &d}) show->frames(2);
  EXPECT_NE(a.scene.stateHash(), b.scene.stateHash());
  EXPECT_NE(a.scene.stateHash(), c.scene.stateHash());
  EXPECT_NE(a.scene.stateHash(), d.scene.stateHash());
}

TEST(EnvironmentNode, ASnapshotGoesOnInTheMiddleOfAFade) {
  EnvironmentShow first, second(false);
  first.tell("outside", "intensity", {"5", "fade", "1"});
  first.tell("tones", "exposure", {"3", "fade", "1"});
  first.frames(20);
  const std::vector<std::uint8_t> state = SceneSnapshot(first.scene).save();
  ASSERT_EQ(SceneSnapshot(second.scene).restore(state, "show"), std::nullopt);
  second.next = first.next;
  for (int i = 0; i < 60; ++i) {
    first.frame(), second.frame();
    EXPECT_EQ(first.scene.stateHash(), second.scene.stateHash()) << i;
    EXPECT_EQ(first.lit().intensity, second.lit().intensity) << i;
    EXPECT_EQ(first.changes.sky.tones.exposure, second.changes.sky.tones.exposure) << i;
  }
  EXPECT_EQ(second.lit().intensity, 5);
}

}  // namespace
}  // namespace stadion
