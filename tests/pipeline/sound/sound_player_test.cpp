#include "pipeline/sound/sound_player.h"

#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace stadion {
namespace {

/// Writes down what it is asked to play.
class NotingDevice : public SoundDevice {
public:
  explicit NotingDevice(std::vector<std::string>& notes) : notes_(notes) {}
  std::string name() const override { return "notebook"; }
  Voice start(const std::shared_ptr<const Sound>& sound, bool loop, double offset) override {
    notes_.push_back(fmt::format("start {} {} samples{}, at {:g}", ++voices_, sound->samples.size(),
                                 loop ? " again and again" : "", offset));
    return voices_;
  }
  void set(Voice voice, double gain, const Vec3& p) override {
    notes_.push_back(fmt::format("set {} {:g} {:g},{:g},{:g}", voice, gain, p.x(), p.y(), p.z()));
  }
  void stop(Voice voice) override { notes_.push_back(fmt::format("stop {}", voice)); }
  void pause(Voice voice, bool paused) override {
    notes_.push_back(fmt::format("{} {}", paused ? "pause" : "go on", voice));
  }
  void setVolume(double v) override { notes_.push_back(fmt::format("volume {:g}", v)); }

private:
  std::vector<std::string>& notes_;
  Voice voices_ = 0;
};

struct Listener {
  Listener() {
    roots.add(std::string(STADION_SOURCE_DIR) + "/assets");
    player.emplace(
        roots, [this](const std::string& line) { told.push_back(line); },
        [this] { return Result<std::unique_ptr<SoundDevice>>(std::make_unique<NotingDevice>(notes)); });
  }
  std::vector<std::string> frame(std::vector<SoundRecord> sounds, double seconds, SoundMix mix = {}) {
    SoundScape scape;
    scape.time = fromSeconds(seconds);
    scape.X_WH.p = Vec3(0, 0, 1);
    scape.sounds = std::move(sounds);
    player->play(scape, mix);
    player->waitUntilPlayed();
    return std::exchange(notes, {});
  }
  AssetRoots roots;
  std::vector<std::string> notes, told;
  std::optional<SoundPlayer> player;
};

SoundRecord thud(double since) {
  SoundRecord s;
  s.node = {1, 7}, s.file = "thud.wav", s.since = fromSeconds(since);
  return s;
}

using Notes = std::vector<std::string>;

TEST(ThreadsSoundPlayer, ASoundStartsOnceAndStopsWhenItIsNoLongerThere) {
  Listener l;
  EXPECT_EQ(l.frame({}, 0), Notes{});
  EXPECT_TRUE(l.told.empty()) << "a show without sounds opens no device";
  EXPECT_EQ(l.frame({thud(0.1)}, 0.1), (Notes{"volume 1", "start 1 13230 samples, at 0", "set 1 1 0,0,0"}));
  EXPECT_EQ(l.frame({thud(0.1)}, 0.12), (Notes{"set 1 1 0,0,0"}));
  EXPECT_EQ(l.frame({}, 0.2), (Notes{"stop 1"}));
  EXPECT_EQ(l.told, Notes{"sound: notebook"});
}

TEST(ThreadsSoundPlayer, AnotherBeginningIsAnotherSound) {
  Listener l;
  l.frame({thud(0.1)}, 0.1);
  EXPECT_EQ(l.frame({thud(0.2)}, 0.2), (Notes{"stop 1", "start 2 13230 samples, at 0", "set 2 1 0,0,0"}));
}

TEST(ThreadsSoundPlayer, WhatBeganEarlierIsEnteredInTheMiddle) {
  Listener l;
  EXPECT_EQ(l.frame({thud(0.1)}, 0.35)[1], "start 1 13230 samples, at 0.25");
  SoundRecord loop = thud(0);
  loop.node = {1, 8}, loop.loop = true;
  const Notes notes = l.frame({loop}, 1.5);
  EXPECT_EQ(notes[1], "start 2 13230 samples again and again, at 0.3") << "the third pass of 0.6 s";
}

TEST(ThreadsSoundPlayer, APlaceIsHeardFromTheHeadAndFadesToItsRange) {
  Listener l;
  SoundRecord s = thud(0);
  s.range = 20, s.gain = 0.8, s.position = Vec3(0, 10, 1);
  EXPECT_EQ(l.frame({s}, 0).back(), "set 1 0.2 0,10,0");
  s.position = Vec3(0, -21, 1);
  EXPECT_EQ(l.frame({s}, 0.1).back(), "set 1 0 0,-21,0");
}

TEST(ThreadsSoundPlayer, TheOperatorsVolumeAndPauseReachTheDeviceOnce) {
  Listener l;
  l.frame({thud(0)}, 0);
  EXPECT_EQ(l.frame({thud(0)}, 0.1, {0.5, true}), (Notes{"volume 0.5", "set 1 1 0,0,0", "pause 1"}));
  EXPECT_EQ(l.frame({thud(0)}, 0.1, {0.5, true}), (Notes{"set 1 1 0,0,0"}));
  EXPECT_EQ(l.frame({thud(0)}, 0.1, {0.5, false}), (Notes{"set 1 1 0,0,0", "go on 1"}));
}

TEST(ThreadsSoundPlayer, AFileThatIsNotThereIsSilence) {
  Listener l;
  SoundRecord s = thud(0);
  s.file = "nowhere.wav";
  EXPECT_EQ(l.frame({s}, 0), (Notes{"volume 1"}));
}

TEST(ThreadsSoundPlayer, WithoutADeviceItSaysSoOnceAndIsSilent) {
  AssetRoots roots;
  Notes told;
  SoundPlayer player(
      roots, [&](const std::string& line) { told.push_back(line); },
      [] { return Result<std::unique_ptr<SoundDevice>>::failure("no device"); });
  for (int i = 0; i < 3; ++i) {
    SoundScape scape;
    scape.sounds = {thud(0)};
    player.play(scape, {});
    player.waitUntilPlayed();
  }
  EXPECT_EQ(told, Notes{"sound: no device; the show is played silently"});
}

TEST(ThreadsSoundDevice, OpenAlPlaysIntoNothing) {
  setenv("ALSOFT_DRIVERS", "null", 1);
  auto device = openSoundDevice();
  if (!device) GTEST_SKIP() << device.error().message;
  const auto sound =
      std::make_shared<const Sound>(Sound{{2205, 22050, 1}, std::vector<std::int16_t>(2205, 1000)});
  const auto voice = device.value()->start(sound, true, 0.05);
  ASSERT_NE(voice, 0u);
  device.value()->setVolume(0.5);
  device.value()->set(voice, 0.7, Vec3(1, 2, 3));
  device.value()->pause(voice, true);
  device.value()->pause(voice, false);
  device.value()->stop(voice);
  EXPECT_FALSE(device.value()->name().empty());
}

TEST(SoundPlayer, LoudnessFallsToNothingAtTheRange) {
  EXPECT_EQ(loudnessAt(100, 0), 1);
  EXPECT_EQ(loudnessAt(0, 10), 1);
  EXPECT_EQ(loudnessAt(5, 10), 0.25);
  EXPECT_EQ(loudnessAt(10, 10), 0);
  EXPECT_EQ(loudnessAt(1e9, 10), 0);
}

}  // namespace
}  // namespace stadion
