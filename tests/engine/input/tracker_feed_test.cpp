#include "engine/input/tracker_feed.h"

#include "engine/input/input_recorder.h"
#include "engine/maths/functions.h"
#include "tests/engine/asset/importing.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace stadion {
namespace {

constexpr Nanoseconds kFeedMs = 1'000'000;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

RigFile bareFeedRig() {
  RigFile rig = standardRig();
  rig.cutoff = rig.beta = 0;
  return rig;
}

Pose poseAt(double x, double y, double z) {
  return {Vec3(x, y, z), Quat::Identity()};
}

/// A feed whose clock runs with show time.
struct Room {
  explicit Room(const RigFile& rig = bareFeedRig()) : feed(rig) {}
  TrackerFeed feed;
  InputSample sample;
  std::uint64_t next = 0;

  const InputSample& frame(double rate = 60) {
    const TimeSignature now = signatureAt(next++, rate);
    feed.sampleFrame(1'000'000'000 + now.time, now.time - now.step, now.time, sample);
    return sample;
  }
  /// Measures at that show time.
  void head(Nanoseconds time, const Pose& X) { feed.pose("head", 1'000'000'000 + time, X); }
};

TEST(TrackerFeed, TheRigsTrackersAreThereFromTheFirstFrameLostUntilTheyAreHeardOf) {
  Room room;
  room.frame();
  ASSERT_EQ(room.sample.trackers.size(), 2u);
  EXPECT_FALSE(room.sample.find("head")->valid);
  room.head(10 * kFeedMs, poseAt(0.1, 0.2, 1.6));
  room.frame();
  EXPECT_TRUE(room.sample.find("head")->valid);
  EXPECT_FALSE(room.sample.find("wand")->valid);
}

TEST(TrackerFeed, APoseIsCarriedOnToTheFramesEndButNotFarther) {
  RigFile rig = bareFeedRig();
  rig.ease = 0, rig.predict = 0.02;
  Room room(rig);
  // 1 m/s to the right, for so long that the smoothed speed has arrived.
  for (int i = 0; i <= 300; ++i) room.head(i * 5 * kFeedMs, poseAt(i * 0.005, 0, 1.7));
  room.next = 91;  // 1516.67 ms, 16.67 ms after the last measurement
  EXPECT_NEAR(room.frame().find("head")->X_RT.p.x(), 1.5 + 0.016667, 1e-4);
  room.next = 95;  // 83 ms after it
  EXPECT_NEAR(room.frame().find("head")->X_RT.p.x(), 1.5 + 0.02, 1e-4);
}

TEST(TrackerFeed, ASilentHeadHoldsThenEasesToItsSafePoseThenIsLost) {
  Room room;
  for (int i = 0; i <= 200; ++i) room.head(i * 5 * kFeedMs, poseAt(1, 0, 1.2));
  room.next = 60;
  EXPECT_EQ(room.frame().find("head")->X_RT.p, Vec3(1, 0, 1.2));
  room.next = 66;  // 1.1 s: at the end of hold
  EXPECT_NEAR((room.frame().find("head")->X_RT.p - Vec3(1, 0, 1.2)).norm(), 0, 1e-12);
  double before = 0;
  for (room.next = 67; room.next <= 95;) {
    const TrackerSample& head = *room.frame().find("head");
    ASSERT_TRUE(head.valid);
    const double way = (head.X_RT.p - Vec3(1, 0, 1.2)).norm();
    EXPECT_GE(way, before);
    EXPECT_LT(way - before, 0.09) << "it does not jump";
    before = way;
  }
  EXPECT_NEAR((room.sample.find("head")->X_RT.p - Vec3(0, 0, 1.7)).norm(), 0, 5e-3);
  room.frame();
  EXPECT_FALSE(room.frame().find("head")->valid);
}

TEST(TrackerFeed, ASilenceAndItsEndAreReportedButNotOfTrackersThatComeAndGo) {
  Room room;
  const auto heardAt = [&](Nanoseconds time) {
    std::string told;
    for (const TrackerFeed::Reception& h : room.feed.receptionChanges(1'000'000'000 + time))
      told += std::string(h.tracker) + (h.heard ? " heard " : " silent ") +
              std::to_string(std::lround(10 * h.silent)) + ";";
    return told;
  };
  EXPECT_EQ(heardAt(0), "");  // no tracker has been heard of yet
  room.head(10 * kFeedMs, poseAt(0, 0, 1.7));
  EXPECT_EQ(heardAt(50 * kFeedMs), "");
  EXPECT_EQ(heardAt(1010 * kFeedMs), "head silent 10;");
  EXPECT_EQ(heardAt(1020 * kFeedMs), "");
  room.head(2010 * kFeedMs, poseAt(0, 0, 1.7));
  EXPECT_EQ(heardAt(2020 * kFeedMs), "head heard 20;");
  EXPECT_EQ(heardAt(4000 * kFeedMs), "");  // again, within ten seconds
  room.head(12'000 * kFeedMs, poseAt(0, 0, 1.7));
  EXPECT_EQ(heardAt(12'010 * kFeedMs), "");
  EXPECT_EQ(heardAt(13'000 * kFeedMs), "head silent 10;");
}

TEST(TrackerFeed, HeardOfAgainTheHeadEasesBack) {
  Room room;
  for (int i = 0; i <= 200; ++i) room.head(i * 5 * kFeedMs, poseAt(1, 0, 1.2));
  room.next = 121;
  for (int i = 400; i <= 600; ++i) room.head(i * 5 * kFeedMs, poseAt(-1, 0, 1.2));
  // Heard again at 2 s; halfway back at 2.25 s, there at 2.5 s.
  Room later;
  for (int i = 0; i <= 200; ++i) later.head(i * 5 * kFeedMs, poseAt(1, 0, 1.2));
  for (int i = 400; i <= 449; ++i) later.head(i * 5 * kFeedMs, poseAt(-1, 0, 1.2));
  later.next = 135;
  EXPECT_NEAR((later.frame().find("head")->X_RT.p - Vec3(-0.5, 0, 1.45)).norm(), 0, 0.02);
  room.next = 150;
  EXPECT_NEAR((room.frame().find("head")->X_RT.p - Vec3(-1, 0, 1.2)).norm(), 0, 1e-6);
}

TEST(TrackerFeed, ASilentWandIsLostAndLetsGoOfEverything) {
  Room room;
  room.feed.pose("wand", 1'000'000'000, poseAt(0, 1, 1));
  room.feed.button("wand", 1'000'000'000, 1, true);
  room.feed.axis("wand", 1'000'000'000, 1, 0.75);
  room.frame();
  EXPECT_EQ(room.sample.find("wand")->buttons, 1u);
  EXPECT_EQ(room.sample.find("wand")->axes[1], 0.75f);
  room.next = 20;
  EXPECT_FALSE(room.frame().find("wand")->valid);
  EXPECT_EQ(room.sample.find("wand")->buttons, 0u);
  EXPECT_EQ(room.sample.find("wand")->axes[1], 0.0f);
  EXPECT_EQ(room.sample.find("wand")->X_RT.p, Vec3(0, 1, 1));
  // Heard of again it holds nothing: the button may have been released meanwhile.
  room.next = 25;
  room.feed.pose("wand", 1'000'000'000 + 400 * kFeedMs, poseAt(0, 1, 1));
  EXPECT_TRUE(room.frame().find("wand")->valid);
  EXPECT_EQ(room.sample.find("wand")->buttons, 0u);
  EXPECT_EQ(room.sample.find("wand")->axes[1], 0.0f);
}

TEST(TrackerFeed, AButtonPressedAndReleasedBetweenTwoFramesIsNotMissed) {
  Room room;
  room.feed.pose("wand", 1'000'000'000, poseAt(0, 1, 1));
  room.frame();
  room.feed.button("wand", 1'000'000'000 + 5 * kFeedMs, 2, true);
  room.feed.button("wand", 1'000'000'000 + 9 * kFeedMs, 2, false);
  const TrackerSample& wand = *room.frame().find("wand");
  ASSERT_EQ(wand.controls.size(), 3u);
  EXPECT_EQ(wand.controls[1].buttons, 2u);
  EXPECT_NEAR(static_cast<double>(wand.controls[1].time), 5e6, 2);
  EXPECT_EQ(wand.controls[2].buttons, 0u);
  EXPECT_NEAR(static_cast<double>(wand.controls[2].time), 9e6, 2);
}

TEST(TrackerFeed, WhatCannotBeIsRefusedCountedAndNeverInASample) {
  Room room;
  room.feed.pose("wand", 1'000'000'000, poseAt(0, 1, 1));
  const double huge = 1e300, inf = std::numeric_limits<double>::infinity();
  for (const Pose& X :
       {poseAt(kNaN, 0, 0), poseAt(inf, 0, 0), poseAt(huge, 0, 0), Pose{Vec3::Zero(), Quat(0, 0, 0, 0)},
        Pose{Vec3::Zero(), Quat(kNaN, 0, 0, 1)}, Pose{Vec3::Zero(), Quat(huge, 0, 0, 1)}})
    EXPECT_FALSE(room.feed.pose("wand", 1'000'000'000 + kFeedMs, X));
  EXPECT_FALSE(room.feed.button("wand", 0, 0, true));
  EXPECT_FALSE(room.feed.button("wand", 0, 33, true));
  EXPECT_FALSE(room.feed.axis("wand", 0, 8, 0.5));
  EXPECT_FALSE(room.feed.axis("wand", 0, -1, 0.5));
  EXPECT_FALSE(room.feed.axis("wand", 0, 0, kNaN));
  EXPECT_EQ(room.feed.counts().refused, 11u);
  EXPECT_FALSE(room.feed.pose("hat", 1'000'000'000, poseAt(0, 0, 0)));
  EXPECT_EQ(room.feed.counts().unknown, 1u);
  EXPECT_FALSE(room.feed.pose("wand", 999'000'000, poseAt(5, 5, 5)));
  EXPECT_EQ(room.feed.counts().late, 1u);
  EXPECT_TRUE(room.feed.axis("wand", 1'000'000'000, 0, 7));
  room.frame();
  EXPECT_EQ(room.sample.trackers.size(), 2u);
  EXPECT_EQ(room.sample.find("wand")->X_RT.p, Vec3(0, 1, 1));
  EXPECT_EQ(room.sample.find("wand")->axes[0], 1.0f);
}

TEST(TrackerFeed, AFloodOfChangesInOneFrameIsCut) {
  Room room;
  room.feed.pose("wand", 1'000'000'000, poseAt(0, 1, 1));
  room.frame();
  for (int i = 0; i < 100'000; ++i) room.feed.button("wand", 1'000'000'000 + i * 100, 1 + i % 2, i % 3 != 0);
  EXPECT_LE(room.frame().find("wand")->controls.size(), 70u);
}

/// A rig with a gamepad, which may send what it holds again and again.
struct PadRoom : Room {
  static RigFile rig() {
    RigFile rig = bareFeedRig();
    rig.trackers.push_back({"pad", {}, {}});
    return rig;
  }
  PadRoom() : Room(rig()) {}
  const TrackerSample& pad() { return *frame().find("pad"); }
  Nanoseconds now() const { return 1'000'000'000 + signatureAt(next, 60).time - kFeedMs; }
};

TEST(TrackerFeed, ADeviceOfAxesAndButtonsOnlyIsThereWithoutAPose) {
  PadRoom room;
  EXPECT_FALSE(room.pad().hasControls());
  room.feed.axis("pad", room.now(), 1, 0.75);
  room.feed.button("pad", room.now(), 3, true);
  const TrackerSample& pad = room.pad();
  EXPECT_TRUE(pad.controlsOnly);
  EXPECT_FALSE(pad.valid) << "its place is unknown";
  EXPECT_EQ(pad.axes[1], 0.75f);
  EXPECT_EQ(pad.buttons, 4u);
  EXPECT_TRUE(pad.knots.empty());
  InputSample now;
  room.feed.sampleNow(room.now(), now);
  EXPECT_TRUE(now.find("pad")->controlsOnly);
  EXPECT_TRUE(room.feed.status(room.now()).back().heard);
  EXPECT_FALSE(room.feed.status(room.now()).back().posed);
}

TEST(TrackerFeed, APadThatRepeatsItsStateIsLostWhenItStops) {
  for (const int every : {1, 2, 6, 30, 60}) {  // frames between two messages
    PadRoom room;
    for (int n = 0; n < 300; ++n) {
      if (n % every == 0)
        room.feed.axis("pad", room.now(), 1, 1), room.feed.button("pad", room.now(), 1, true);
      const TrackerSample& pad = room.pad();
      EXPECT_TRUE(pad.controlsOnly) << "frame " << n << " of one that sends every " << every;
      EXPECT_EQ(pad.axes[1], 1.0f);
    }
    const int patience = std::max(6, 3 * every) + 2;
    for (int n = 0; n < patience; ++n) room.frame();
    EXPECT_FALSE(room.pad().controlsOnly) << every;
    EXPECT_EQ(room.sample.find("pad")->axes[1], 0.0f);
    EXPECT_EQ(room.sample.find("pad")->buttons, 0u);
    EXPECT_EQ(room.feed.receptionChanges(room.now()).size(), 1u);
    room.feed.axis("pad", room.now(), 1, 0.5);
    EXPECT_EQ(room.pad().axes[1], 0.5f);
    EXPECT_TRUE(room.feed.receptionChanges(room.now()).at(0).heard);
  }
}

TEST(TrackerFeed, APadThatSendsChangesOnlyHoldsThemForTenSeconds) {
  PadRoom room;
  for (int copy = 0; copy < 3; ++copy) room.feed.axis("pad", room.now() + copy * 10, 1, 1);
  for (int n = 0; n < 590; ++n) EXPECT_EQ(room.pad().axes[1], 1.0f) << n;
  for (int n = 0; n < 20; ++n) room.frame();
  EXPECT_EQ(room.pad().axes[1], 0.0f);
  EXPECT_TRUE(room.pad().controlsOnly);
  EXPECT_TRUE(room.feed.receptionChanges(room.now()).empty()) << "a pad at rest is not silent";
  room.feed.axis("pad", room.now(), 1, -1);
  EXPECT_EQ(room.pad().axes[1], -1.0f);
}

TEST(TrackerFeed, APressOfAPadWithinOneFrameIsNotMissed) {
  for (const Nanoseconds off :
       {0 * kFeedMs, -40 * kFeedMs, 40 * kFeedMs}) {  // measured before, in and after the frame
    PadRoom room;
    room.pad(), room.pad();
    room.feed.button("pad", room.now() + off - 2 * kFeedMs, 2, true);
    room.feed.button("pad", room.now() + off, 2, false);
    const auto controls = room.pad().controls;
    EXPECT_TRUE(std::ranges::any_of(controls, [](const ControlKnot& c) { return c.buttons == 2; })) << off;
    EXPECT_EQ(room.sample.find("pad")->buttons, 0u);
  }
}

TEST(TrackerFeed, ADeviceThatSendsAPoseLaterIsATrackerFromThenOn) {
  PadRoom room;
  room.feed.axis("pad", room.now(), 1, 1);
  EXPECT_TRUE(room.pad().controlsOnly);
  room.feed.pose("pad", room.now(), poseAt(0, 1, 1));
  EXPECT_TRUE(room.pad().valid);
  EXPECT_FALSE(room.sample.find("pad")->controlsOnly);
  for (int n = 0; n < 20; ++n) room.frame();
  EXPECT_FALSE(room.pad().hasControls());
}

/// What a record of the run gives when it is replayed.
std::vector<InputSample> replayed(const std::string& path, const std::vector<InputSample>& live,
                                  double rate) {
  Diagnostics findings;
  auto log = loadInputLog(path, findings);
  EXPECT_TRUE(log);
  std::vector<InputSample> samples;
  for (std::size_t n = 0; n < live.size() && log; ++n) {
    const TimeSignature now = signatureAt(n, rate);
    samples.emplace_back();
    log->sampleFrame(now.time - now.step, now.time, samples.back());
  }
  return samples;
}

TEST(TrackerFeed, TheRecordOfAWildVisitGivesTheVerySameSamples) {
  for (int visit = 0; visit < 20; ++visit) {
    RigFile rig = standardRig();
    rig.origin = Vec3(0.3, 0.1, 0), rig.yaw = 0.7;
    if (visit % 3 == 0) rig.cutoff = 0;
    rig.trackers.push_back({"pad", {}, {}});
    TrackerFeed feed(rig);
    std::uint64_t seed = 17 + static_cast<std::uint64_t>(visit);
    const auto random = [&] {
      seed = seed * 6364136223846793005ull + 1442695040888963407ull;
      return static_cast<double>(seed >> 11) / 9007199254740992.0;
    };
    test::TestFolder folder;
    const std::string path = folder.path() / "visit.input";
    InputRecorder recorder(path);
    std::vector<InputSample> live;
    Nanoseconds clock = 1'000'000'000;
    for (std::uint64_t n = 0; n < 300; ++n) {
      const TimeSignature now = signatureAt(n, 60);
      const Nanoseconds frameEnd = clock + 16 * kFeedMs + static_cast<Nanoseconds>(random() * 3e6);
      for (Nanoseconds t = clock; t < frameEnd; t += 1 + static_cast<Nanoseconds>(random() * 8e6)) {
        const char* name = random() < 0.5 ? "head" : "wand";
        const bool padComes = n > 20 + static_cast<unsigned>(visit);
        if (padComes && random() < 0.4) feed.axis("pad", t, 1, std::floor(4 * random()) / 4);
        if (padComes && random() < 0.2)
          feed.button("pad", t, 1 + static_cast<int>(2 * random()), random() < 0.5);
        if (n == 280 && visit % 2 == 0) feed.pose("pad", t, poseAt(0, 1, 1));
        if (random() < 0.02) t += 700 * kFeedMs;         // silence
        const double wild = random() < 0.03 ? 3 : 0.02;  // what cannot have moved there
        if (random() < 0.7)
          feed.pose(name, t,
                    {Vec3(wild * random(), random() * wild, 1 + wild * random()),
                     det::expRotation(Vec3(random(), random(), random()))});
        if (random() < 0.2) feed.button(name, t, 1 + static_cast<int>(4 * random()), random() < 0.5);
        if (random() < 0.2) feed.axis(name, t, static_cast<int>(8 * random()), 2 * random() - 1);
        clock = t;
      }
      clock = std::max(clock, frameEnd);
      live.emplace_back();
      feed.sampleFrame(clock, now.time - now.step, now.time, live.back());
      recorder.record(live.back());
    }
    ASSERT_FALSE(recorder.commit());
    const auto again = replayed(path, live, 60);
    ASSERT_EQ(again.size(), live.size());
    for (std::size_t n = 0; n < live.size(); ++n)
      for (std::size_t t = 0; t < live[n].trackers.size(); ++t)
        ASSERT_TRUE(live[n].trackers[t] == again[n].trackers[t])
            << "visit " << visit << ", frame " << n << ", " << live[n].trackers[t].name;
  }
}

TEST(TrackerFeed, ANewGroupBeginsAtTimeZeroWithWhatIsKnown) {
  Room room;
  room.head(10 * kFeedMs, poseAt(0.1, 0.2, 1.6));
  room.frame(), room.frame(), room.frame();
  room.feed.restart();
  room.next = 0;
  EXPECT_TRUE(room.frame().find("head")->valid) << "it has been heard of a moment ago";
  EXPECT_TRUE(room.sample.find("head")->knots.empty());
}

TEST(OneEuroFilter, ATremblingTrackerBecomesStillAndAFastOneHardlyLags) {
  OneEuroFilter filter(4, 30);
  double worst = 0;
  for (int i = 0; i < 400; ++i) {
    const double tremble = (i % 2 ? 1 : -1) * 0.001;
    const Pose X = filter.pass({Vec3(tremble, 0, 0), Quat::Identity()}, 0.01);
    if (i > 100) worst = std::max(worst, std::fabs(X.p.x()));
  }
  EXPECT_LT(worst, 0.0005);
  filter.reset();
  Pose X;
  for (int i = 0; i <= 100; ++i) X = filter.pass({Vec3(0.02 * i, 0, 0), Quat::Identity()}, 0.01);
  EXPECT_GT(X.p.x(), 2.0 - 0.01) << "at 2 m/s it lags by less than 5 ms";
  EXPECT_NEAR(filter.velocity().x(), 2, 1e-6);
}

TEST(OneEuroFilter, WithoutCutoffPosesComeThroughAsTheyAre) {
  OneEuroFilter filter(0, 0);
  filter.pass({Vec3(1, 2, 3), Quat::Identity()}, 0);
  const Pose X{Vec3(2, 3, 4), det::expRotation(Vec3(0.1, 0.2, 0.3))};
  const Pose out = filter.pass(X, 0.01);
  EXPECT_NEAR((out.p - X.p).norm(), 0, 1e-15);
  EXPECT_NEAR((out.q.coeffs() - X.q.coeffs()).norm(), 0, 1e-15);
}

}  // namespace
}  // namespace stadion
