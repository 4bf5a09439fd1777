#include "pipeline/device/osc_trackers.h"

#include "engine/input/input_recorder.h"
#include "tests/engine/asset/importing.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace stadion {
namespace {

constexpr Nanoseconds kMs = 1'000'000;
constexpr Nanoseconds kApart = 1'700'000'000'000 * kMs;  ///< the sender's clock is ahead by so much

TEST(SenderClock, TheLeastDelayCounts) {
  SenderClock clock;
  const auto ours = [&](Nanoseconds sent, Nanoseconds arrived) {
    return clock.read(sent * kMs + kApart, arrived * kMs).ours.value_or(-1);
  };
  EXPECT_EQ(ours(1000, 1005), 1005 * kMs);
  EXPECT_EQ(ours(1010, 1012), 1012 * kMs) << "a shorter delay";
  EXPECT_EQ(ours(1020, 1029), 1022 * kMs) << "what came late was measured on time";
}

TEST(SenderClock, ClocksThatDriftApartAreFollowed) {
  for (const double drift : {-1e-3, -1e-4, 1e-4, 1e-3}) {
    SenderClock clock;
    Nanoseconds worst = 0;
    for (Nanoseconds t = 1000 * kMs; t < 60'000 * kMs; t += 10 * kMs) {
      const auto sent = kApart + static_cast<Nanoseconds>((1 + drift) * static_cast<double>(t));
      const auto reading = clock.read(sent, t);
      ASSERT_TRUE(reading.ours && !reading.set);
      worst = std::max(worst, std::abs(*reading.ours - t));
    }
    EXPECT_LT(worst, kMs) << drift;
  }
}

TEST(SenderClock, OneOlderStampIsLateAndTwoInTheNewOrderAreANewClock) {
  for (const Nanoseconds back : {15 * kMs, 50 * kMs, 450 * kMs, 3'600'000 * kMs}) {
    SenderClock clock;
    Nanoseconds now = 1000 * kMs, sent = kApart;
    const auto next = [&](Nanoseconds off) {
      now += 10 * kMs, sent += 10 * kMs;
      return clock.read(sent + off, now);
    };
    for (int i = 0; i < 20; ++i) EXPECT_TRUE(next(0).ours);
    EXPECT_FALSE(next(-back).ours) << "alone it is late";
    for (int i = 0; i < 20; ++i) {
      const auto reading = next(0);
      EXPECT_EQ(reading.ours, now);
      EXPECT_FALSE(reading.set);
    }
    EXPECT_FALSE(next(-back).ours);
    const auto second = next(-back);
    EXPECT_EQ(second.ours, now);
    ASSERT_TRUE(second.set);
    EXPECT_EQ(*second.set, -back);
    EXPECT_EQ(next(-back).ours, now);
  }
}

TEST(SenderClock, AWildStampOfTheFutureCostsOneMeasurement) {
  SenderClock clock;
  Nanoseconds now = 1000 * kMs;
  int lost = 0;
  for (int i = 0; i < 100; ++i, now += 10 * kMs) {
    const auto reading = clock.read(kApart + now + (i == 50 ? 3'600'000 * kMs : 0), now);
    EXPECT_EQ(reading.ours.value_or(now), now);
    lost += reading.ours ? 0 : 1;
  }
  EXPECT_EQ(lost, 1);
}

TEST(SenderClock, AStampThatStandsStillIsNoTime) {
  SenderClock clock;
  int taken = 0;
  for (Nanoseconds now = 0; now < 5000 * kMs; now += 10 * kMs) {
    const auto reading = clock.read(kApart + now / (1000 * kMs) * (1000 * kMs), now);  // whole seconds
    EXPECT_EQ(reading.ours.value_or(now), now);
    taken += reading.ours ? 1 : 0;
  }
  EXPECT_GE(taken, 490);
}

TEST(SenderClock, AClockThatIsSetWhileTheSenderIsSilentIsFollowedWithinHalfASecond) {
  for (const Nanoseconds back : {50 * kMs, 300 * kMs, 900 * kMs}) {
    SenderClock clock;
    Nanoseconds now = 1000 * kMs, worst = 0;
    for (int i = 0; i < 100; ++i, now += 10 * kMs) clock.read(kApart + now, now);
    now += 1000 * kMs;
    for (int i = 0; i < 100; ++i, now += 10 * kMs) {
      const auto reading = clock.read(kApart + now - back, now);
      ASSERT_TRUE(reading.ours);
      if (i > 50) worst = std::max(worst, now - *reading.ours);
    }
    EXPECT_EQ(worst, 0);
  }
}

TEST(SenderClock, ABurstAfterAStallIsSpacedByItsStamps) {
  SenderClock clock;
  Nanoseconds now = 1000 * kMs;
  for (int i = 0; i < 100; ++i, now += 10 * kMs) clock.read(kApart + now, now);
  const Nanoseconds stalled = now, arrives = now + 600 * kMs;
  for (; now < arrives; now += 10 * kMs)
    EXPECT_EQ(clock.read(kApart + now, arrives + (now - stalled) / 1000).ours, now);
}

/// A rig with a head that sways by 0.3 m, whose sender may set its clock, and the frames of a show.
struct SwayingHead {
  double rate = 100, jitter = 0;  ///< [Hz], of arrival [s]
  Nanoseconds step = 0;           ///< by which the clock is set, at 2 s
  int swapped = 0;                ///< every so many datagrams one overtakes the one before; 0: none
  std::vector<std::string> trackers{"head"};
  std::vector<std::string> told{};
  FeedCounts counts{};

  static double at(double t) { return 0.3 * std::sin(2 * t); }

  struct Datagram {
    Nanoseconds arrival, sent;
    std::size_t tracker;
    double x;
  };
  std::vector<Datagram> datagrams(double seconds) const {
    std::vector<Datagram> all;
    std::uint64_t seed = 7;
    for (std::size_t k = 0; k < trackers.size(); ++k)
      for (int i = 0; i < static_cast<int>(rate * seconds); ++i) {
        seed = seed * 6364136223846793005ull + 1442695040888963407ull;
        const double t = i / rate, late = jitter * static_cast<double>(seed >> 11) / 9007199254740992.0;
        // Clocks of different senders are set at different times.
        const bool set = t > 2 + 0.1 * static_cast<double>(k);
        all.push_back({fromSeconds(1 + t + late), kApart + fromSeconds(t) + (set ? step : 0), k, at(t)});
      }
    std::ranges::stable_sort(all, {}, &Datagram::arrival);
    for (std::size_t i = 1; swapped > 0 && i < all.size(); i += static_cast<std::size_t>(swapped))
      std::swap(all[i].arrival, all[i - 1].arrival), std::swap(all[i], all[i - 1]);
    return all;
  }

  /// The farthest that a tracker is off in a frame from 1 s on. More than 100: it was lost.
  double worst(double seconds = 4, std::vector<InputSample>* samples = nullptr) {
    RigFile rig = standardRig();
    rig.trackers.clear();
    for (const std::string& name : trackers) rig.trackers.push_back({name, {}, {}});
    Nanoseconds now = 0;
    LiveTrackers live(
        rig, [&](const std::string& line) { told.push_back(line); }, [&] { return now; });
    OscTrackers osc(live);
    const std::vector<Datagram> all = datagrams(seconds);
    double most = 0;
    std::size_t next = 0;
    for (std::uint64_t n = 0; n < static_cast<std::uint64_t>(60 * seconds); ++n) {
      const TimeSignature frame = signatureAt(n, 60);
      const Nanoseconds clock = 1000 * kMs + frame.time;
      for (; next < all.size() && all[next].arrival <= clock; ++next) {
        const Datagram& d = all[next];
        now = d.arrival;
        const std::array<double, 7> numbers{d.x, 0, 1.7, 0, 0, 0, 1};
        const std::string path = "/tracker/" + trackers[d.tracker] + "/pose";
        osc.take({path, numbers, true, d.sent, "10.0.0." + std::to_string(d.tracker)});
      }
      now = clock;
      InputSample sample;
      live.sampleFrame(frame.time - frame.step, frame.time, sample);
      for (const TrackerSample& t : sample.trackers) {
        if (n < 60) continue;
        most = std::max(most, t.valid ? std::fabs(t.X_RT.p.x() - at(toSeconds(frame.time))) : 1000);
      }
      if (samples) samples->push_back(sample);
    }
    counts = live.counts();
    return most;
  }
};

TEST(SenderClock, PosesGoOnWhateverTheStepTheRateAndTheJitter) {
  constexpr Nanoseconds kSteps[] = {1, 5, 10, 30, 50, 99, 300, 450, 600, 5'000, 3'600'000};  // [ms]
  for (const double rate : {30., 60., 100., 250., 500.})
    for (const double jitter : {0., 0.3, 0.9}) {  // of a period
      const double undisturbed = SwayingHead{.rate = rate, .jitter = jitter / rate}.worst();
      EXPECT_LT(undisturbed, 0.03);
      for (const Nanoseconds step : kSteps)
        for (const int sign : {-1, 1}) {
          SwayingHead head{.rate = rate, .jitter = jitter / rate, .step = sign * step * kMs};
          // At 0.6 m/s at most; one measurement may be missing.
          EXPECT_LT(head.worst(), undisturbed + 0.01 + 0.6 / rate)
              << rate << " Hz, jitter " << jitter << ", step " << sign * step << " ms";
          EXPECT_LE(head.counts.late, 2U) << rate << " Hz, step " << sign * step << " ms";
        }
    }
}

TEST(SenderClock, DatagramsThatOvertakeOthersCostThoseOthersOnly) {
  for (const double rate : {30., 100., 500.})
    for (const Nanoseconds step : {Nanoseconds{0}, -300 * kMs, 300 * kMs}) {
      SwayingHead head{.rate = rate, .step = step, .swapped = 7};
      EXPECT_LT(head.worst(), 0.03 + 0.6 / rate) << rate << " Hz, step " << step;
      EXPECT_NEAR(static_cast<double>(head.counts.late), 4 * rate / 7, 3);
      const bool told = !head.told.empty();
      EXPECT_EQ(told, step < 0) << "forwards nothing had been taken for late";
    }
}

TEST(SenderClock, EverySenderHasAClockOfItsOwn) {
  for (const Nanoseconds step : {-3'600'000 * kMs, -450 * kMs, -50 * kMs, 600 * kMs}) {
    SwayingHead all{.step = step, .trackers = {"head", "wand", "foot"}};
    EXPECT_LT(all.worst(), 0.03);
    EXPECT_LE(all.counts.late, 3U);
    EXPECT_EQ(all.told.size(), step < 0 ? 3U : 0U) << "each is told once, where older stamps came";
  }
}

TEST(SenderClock, TheRecordOfAVisitWithSetClocksGivesTheVerySameSamples) {
  for (const Nanoseconds step : {-450 * kMs, -5'000 * kMs, 600 * kMs}) {
    std::vector<InputSample> live;
    SwayingHead{.jitter = 0.008, .step = step, .swapped = 5, .trackers = {"head", "wand"}}.worst(4, &live);
    test::TestFolder folder;
    const std::string path = folder.path() / "visit.input";
    InputRecorder recorder(path);
    for (const InputSample& sample : live) recorder.record(sample);
    ASSERT_FALSE(recorder.commit());
    Diagnostics findings;
    const auto log = loadInputLog(path, findings);
    ASSERT_TRUE(log);
    for (std::size_t n = 0; n < live.size(); ++n) {
      const TimeSignature now = signatureAt(n, 60);
      InputSample again;
      log->sampleFrame(now.time - now.step, now.time, again);
      for (std::size_t t = 0; t < again.trackers.size(); ++t)
        ASSERT_TRUE(live[n].trackers[t] == again.trackers[t]) << "frame " << n;
    }
  }
}

/// A gamepad that is stamped, and what it holds.
struct StampedPad {
  StampedPad() {
    RigFile rig = standardRig();
    rig.trackers = {{"pad", {}, {}}};
    live.emplace(
        rig, [](const std::string&) {}, [this] { return now; });
    osc.emplace(*live);
  }
  void button(Nanoseconds sent, int which, bool down) {
    const std::array<double, 2> numbers{static_cast<double>(which), down ? 1. : 0.};
    osc->take({"/tracker/pad/button", numbers, true, kApart + sent, "10.0.0.1"});
  }
  std::uint32_t held() {
    InputSample sample;
    live->sampleNow(sample);
    return sample.trackers[0].buttons;
  }
  Nanoseconds now = 1000 * kMs;
  std::optional<LiveTrackers> live;
  std::optional<OscTrackers> osc;
};

TEST(SenderClock, AButtonIsNotHeldForEverBecauseTheClockWasSetMeanwhile) {
  for (const Nanoseconds back : {5 * kMs, 50 * kMs, 200 * kMs, 300 * kMs, 5'000 * kMs})
    for (const Nanoseconds held : {20 * kMs, 150 * kMs, 1000 * kMs}) {
      StampedPad pad;
      pad.button(pad.now, 1, true);
      pad.now += held;
      pad.button(pad.now - back, 1, false);
      if (pad.held() == 0) continue;
      // Within a tenth of a second it may have been overtaken; what is said next tells.
      EXPECT_LT(held, 100 * kMs);
      if (back < held + 50 * kMs) continue;  // no: that is newer than the first one again
      pad.now += 50 * kMs;
      pad.button(pad.now - back, 2, true);
      EXPECT_EQ(pad.held(), 2U) << back << " " << held;
    }
}

TEST(SenderClock, AButtonWhoseReleaseOvertookItIsNotHeld) {
  StampedPad pad;
  pad.button(pad.now + 2 * kMs, 1, false);
  pad.button(pad.now, 1, true);
  EXPECT_EQ(pad.held(), 0U);
  pad.now += 100 * kMs;
  pad.button(pad.now, 2, true);
  EXPECT_EQ(pad.held(), 2U);
}

TEST(SenderClock, SeveralControlsMayHaveOneStamp) {
  StampedPad pad;
  pad.button(pad.now, 1, true), pad.button(pad.now, 2, true), pad.button(pad.now, 4, true);
  EXPECT_EQ(pad.held(), 11U);
}

}  // namespace
}  // namespace stadion
