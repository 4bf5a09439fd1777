/// What the loudspeakers of a hall play, sample by sample.

#include "engine/maths/angles.h"
#include "pipeline/sound/loudspeaker_device.h"
#include "pipeline/sound/sound_recording.h"
#include "pipeline/sound/speaker_mixer.h"
#include "tests/fresh_folder.h"
#include "tests/programs/becomes.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace stadion {
namespace {

/// Two loudspeakers at 30 degrees to both sides, equally far away.
LoudspeakerSet stereoHall() {
  LoudspeakerSet hall;
  for (const double side : {-1.0, 1.0}) {
    Loudspeaker s;
    s.name = side < 0 ? "left" : "right";
    s.place = Vec3(side * 1.5, 1.5 * std::sqrt(3.0), 1.7);
    s.channel = hall.all.empty() ? 0 : 1;
    hall.all.push_back(s);
  }
  return hall;
}

std::shared_ptr<const Sound> steadySound(std::int16_t value, std::uint64_t samples = 480'000,
                                         std::uint32_t rate = SpeakerMixer::kRate) {
  return std::make_shared<const Sound>(Sound{{samples, rate, 1}, std::vector<std::int16_t>(samples, value)});
}

std::shared_ptr<const Sound> tone(double hertz, std::uint32_t rate = SpeakerMixer::kRate,
                                  double seconds = 2) {
  Sound s{{static_cast<std::uint64_t>(seconds * rate), rate, 1}, {}};
  for (std::uint64_t i = 0; i < s.info.samples; ++i)
    s.samples.push_back(static_cast<std::int16_t>(
        std::lround(16'000 * std::sin(2 * kPi * hertz * static_cast<double>(i) / rate))));
  return std::make_shared<const Sound>(std::move(s));
}

std::vector<float> mixed(SpeakerMixer& mixer, std::size_t frames) {
  std::vector<float> out(frames * mixer.channels());
  mixer.mix(out);
  return out;
}

float largestStep(const std::vector<float>& all, std::uint32_t channels, std::uint32_t channel) {
  float most = 0;
  for (std::size_t i = channels + channel; i < all.size(); i += channels)
    most = std::max(most, std::fabs(all[i] - all[i - channels]));
  return most;
}

TEST(SpeakerMixer, ASoundBeginsAtItsSampleAndInItsDirection) {
  SpeakerMixer mixer(stereoHall());
  const auto voice = mixer.start(steadySound(16'384), false, 0, 100);
  mixer.set(voice, 0.5, Vec3(-1.5, 1.5 * std::sqrt(3.0), 0), 1000);
  const auto out = mixed(mixer, 200);
  for (std::size_t i = 0; i < 200; ++i) {
    EXPECT_FLOAT_EQ(out[2 * i], i < 100 ? 0.0f : 0.25f) << i;
    EXPECT_NEAR(out[2 * i + 1], 0, 1e-8) << i;
  }
}

TEST(SpeakerMixer, AMovedSoundReachesItsNewGainsWithoutAClick) {
  SpeakerMixer mixer(stereoHall());
  const auto voice = mixer.start(steadySound(32'767), false, 0);
  mixer.set(voice, 1, Vec3(-1.5, 1.5 * std::sqrt(3.0), 0), 1000);
  mixed(mixer, 10);
  mixer.set(voice, 1, Vec3(1.5, 1.5 * std::sqrt(3.0), 0), 1000);
  const auto out = mixed(mixer, 1001);
  for (const std::uint32_t channel : {0u, 1u}) EXPECT_LT(largestStep(out, 2, channel), 1.01f / 1000);
  EXPECT_NEAR(out[2000], 0, 1e-6);
  EXPECT_NEAR(out[2001], 32'767.0 / 32'768, 1e-6);
}

TEST(SpeakerMixer, AStoppedAndAPausedVoiceFadeOut) {
  SpeakerMixer mixer(stereoHall());
  const auto voice = mixer.start(steadySound(32'767), true, 0);
  mixer.set(voice, 1, Vec3(0, 2, 0), 0);
  mixed(mixer, 10);
  mixer.pause(voice, true);
  const auto fading = mixed(mixer, 300);
  EXPECT_LT(largestStep(fading, 2, 0), 1.01f / SpeakerMixer::kFade);
  EXPECT_EQ(fading.back(), 0);
  EXPECT_EQ(mixer.voices(), 1U);
  mixer.pause(voice, false);
  EXPECT_GT(mixed(mixer, 300).back(), 0.7f);
  mixer.stop(voice);
  EXPECT_LT(largestStep(mixed(mixer, 300), 2, 0), 1.01f / SpeakerMixer::kFade);
  EXPECT_EQ(mixer.voices(), 0U);
}

TEST(SpeakerMixer, AVoiceThatHasEndedIsGoneAndALoopIsNot) {
  SpeakerMixer mixer(stereoHall());
  const auto once = mixer.start(steadySound(10'000, 100), false, 0),
             loop = mixer.start(steadySound(10'000, 100), true, 0);
  mixer.set(once, 1, Vec3::Zero(), 0);
  mixer.set(loop, 1, Vec3::Zero(), 0);
  const auto out = mixed(mixer, 500);
  EXPECT_EQ(mixer.voices(), 1U);
  EXPECT_FLOAT_EQ(out[0], 2 * out[998]);
  EXPECT_GT(out[998], 0.2f);
}

TEST(SpeakerMixer, NearerLoudspeakersAreDelayedByTheirSamples) {
  LoudspeakerSet hall = stereoHall();
  hall.all[1].place = hall.ear + 0.5 * (hall.all[1].place - hall.ear);  // 1.5 m instead of 3 m
  SpeakerMixer mixer(hall);
  const auto voice = mixer.start(steadySound(32'767), false, 0);
  mixer.set(voice, 1, Vec3(0, 2, 0), 0);
  const auto out = mixed(mixer, 400);
  const auto delay = static_cast<std::size_t>(std::lround(1.5 / kSpeedOfSound * SpeakerMixer::kRate));
  EXPECT_EQ(delay, 210U);
  EXPECT_EQ(out[2 * (delay - 1) + 1], 0);
  EXPECT_NEAR(out[2 * delay + 1], 0.5 * out[0], 1e-6);
}

TEST(SpeakerMixer, AnotherRateKeepsTheTone) {
  SpeakerMixer mixer(stereoHall());
  const auto voice = mixer.start(tone(440, 44'100), false, 0);
  mixer.set(voice, 1, Vec3(-1.5, 1.5 * std::sqrt(3.0), 0), 0);
  const auto out = mixed(mixer, SpeakerMixer::kRate);
  double worst = 0;
  for (std::size_t i = 10; i + 10 < SpeakerMixer::kRate; ++i)
    worst = std::max(worst, std::fabs(out[2 * i] - 16'000 / 32'768.0 *
                                                       std::sin(2 * kPi * 440 * static_cast<double>(i) /
                                                                SpeakerMixer::kRate)));
  EXPECT_LT(worst, 2e-4);
}

TEST(SpeakerMixer, ASubwooferPlaysWhatIsLow) {
  LoudspeakerSet hall = stereoHall();
  Loudspeaker low;
  low.name = "low", low.place = Vec3(0, 3, 1.7), low.channel = 3, low.crossover = 100;
  hall.all.push_back(low);
  const auto levelAt = [&](double hertz) {
    SpeakerMixer mixer(hall);
    const auto voice = mixer.start(tone(hertz), false, 0);
    mixer.set(voice, 1, Vec3(0, 2, 0), 0);
    const auto out = mixed(mixer, SpeakerMixer::kRate);
    EXPECT_EQ(mixer.channels(), 4U);
    float most = 0;
    for (std::size_t i = out.size() / 2; i < out.size(); i += 4) {
      EXPECT_EQ(out[i + 2], 0) << "a channel without a loudspeaker";
      most = std::max(most, std::fabs(out[i + 3]));
    }
    return most / (16'000 / 32'768.0);
  };
  EXPECT_NEAR(levelAt(30), 1, 0.02);
  EXPECT_NEAR(levelAt(100), 0.5, 0.01) << "-6 dB at the crossover";
  EXPECT_NEAR(levelAt(400), 1.0 / 256, 5e-4) << "24 dB an octave";
}

TEST(SpeakerMixer, TheVolumeOfAllRuns) {
  SpeakerMixer mixer(stereoHall());
  const auto voice = mixer.start(steadySound(32'767), true, 0);
  mixer.set(voice, 1, Vec3(0, 2, 0), 0);
  mixed(mixer, 10);
  mixer.setVolume(0, 480);
  const auto out = mixed(mixer, 500);
  EXPECT_LT(largestStep(out, 2, 0), 1.01f / 480);
  EXPECT_EQ(out.back(), 0);
}

// A recording.

SoundRecord thudAt(const Vec3& place, double since) {
  SoundRecord s;
  s.node = {1, 7}, s.file = "thud.wav", s.position = place, s.range = 30, s.since = fromSeconds(since);
  return s;
}

std::string bytesOfSound(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Plays half a second with a sound that moves, in frames of that rate, and returns the file.
std::string recordedAt(const FreshFolder& folder, const std::string& name, double rate) {
  AssetRoots roots;
  roots.add(std::string(STADION_SOURCE_DIR) + "/assets");
  const std::string path = folder.path() / name;
  SoundRecording recording(stereoHall(), roots, [&] { return path; });
  for (int frame = 0; frame <= rate / 2; ++frame) {
    SoundScape scape;
    scape.time = fromSeconds(frame / rate);
    scape.X_WH.p = Vec3(0, 0, 1.7);
    if (frame / rate >= 0.1) scape.sounds = {thudAt(Vec3(-2 + 4 * frame / rate, 2, 1.7), 0.0925)};
    recording.play(scape, {});
  }
  EXPECT_FALSE(recording.finish());
  EXPECT_EQ(recording.file(), path);
  EXPECT_EQ(recording.clipped(), 0U);
  return bytesOfSound(path);
}

TEST(SoundRecording, IsAWaveFileThatBeginsWithTheShow) {
  const FreshFolder folder;
  const std::string file = recordedAt(folder, "one.wav", 60);
  ASSERT_GT(file.size(), 100U);
  EXPECT_EQ(file.substr(0, 4), "RIFF");
  EXPECT_EQ(file.substr(8, 4), "WAVE");
  EXPECT_EQ(file.size(), 104 + 24'000 * 2 * 3U) << "half a second of two channels";
  const auto sampleAtFrame = [&](std::size_t frame, std::size_t channel) {
    const auto* at = reinterpret_cast<const unsigned char*>(file.data()) + 104 + (2 * frame + channel) * 3;
    return static_cast<std::int32_t>(at[0] << 8 | at[1] << 16 | at[2] << 24) >> 8;
  };
  std::size_t first = 0;
  while (first < 24'000 && sampleAtFrame(first, 0) == 0) ++first;
  EXPECT_GE(first, 4'440U) << "0.0925 s";
  EXPECT_LT(first, 4'540U) << "the sound itself begins at once";
  EXPECT_EQ(recordedAt(folder, "again.wav", 60), file) << "the same calls, the same bytes";
}

TEST(SoundRecording, ReadsAsAnySoundFile) {
  const FreshFolder folder;
  recordedAt(folder, "one.wav", 60);
  const FileDescriptor file(open((folder.path() / "one.wav").c_str(), O_RDONLY | O_CLOEXEC));
  const auto info = readSoundInfo(file.get(), "one.wav");
  ASSERT_TRUE(info) << info.error().message;
  EXPECT_EQ(info.value().channels, 2U);
  EXPECT_EQ(info.value().rate, 48'000U);
  EXPECT_EQ(info.value().samples, 24'000U);
}

TEST(SoundRecording, AShowWithoutSoundsLeavesNoFile) {
  const FreshFolder folder;
  const AssetRoots roots;
  SoundRecording recording(stereoHall(), roots, [] {
    ADD_FAILURE() << "no file is asked for";
    return std::string();
  });
  for (int frame = 0; frame < 10; ++frame) {
    SoundScape scape;
    scape.time = fromSeconds(frame / 60.0);
    recording.play(scape, {});
  }
  EXPECT_FALSE(recording.finish());
  EXPECT_TRUE(recording.file().empty());
}

// A live device.

/// Keeps what it gets; goes away after some blocks.
struct KeptOutput : SpeakerOutput {
  KeptOutput(std::atomic<int>& all, int limit) : blocks(all), most(limit) {}
  bool write(std::span<const float> frames) override {
    for (const float x : frames) loudest = std::max(loudest, std::fabs(x));
    ++blocks;
    return ++own < most;
  }
  std::atomic<int>& blocks;
  int own = 0, most;
  float loudest = 0;
};

TEST(ThreadsLoudspeakerDevice, ADeviceThatHasGoneIsOpenedAgain) {
  std::atomic<int> blocks = 0, opened = 0;
  auto device = openLoudspeakers(stereoHall(), [&]() -> Result<std::unique_ptr<SpeakerOutput>> {
    ++opened;
    return std::unique_ptr<SpeakerOutput>(std::make_unique<KeptOutput>(blocks, opened == 1 ? 5 : 1'000'000));
  });
  ASSERT_TRUE(device) << device.error().message;
  EXPECT_TRUE(device.value()->standsInRoom());
  EXPECT_EQ(device.value()->name(), "2 loudspeakers on 2 channels of \"default\"");
  const auto voice = device.value()->start(steadySound(1000), true, 0);
  device.value()->set(voice, 1, Vec3(0, 2, 0));
  EXPECT_TRUE(becomes([&] { return blocks > 10; }));
  EXPECT_EQ(opened, 2);
  device.value()->stop(voice);
}

TEST(ThreadsLoudspeakerDevice, AlsaPlaysIntoAFile) {
  const FreshFolder folder;
  LoudspeakerSet hall = stereoHall();
  hall.all[1].channel = 11;  // no usual layout has so many
  const std::string file = folder.path() / "sound.raw";
  hall.card = "file:" + file + ",raw";
  auto device = openLoudspeakers(hall);
  if (!device) GTEST_SKIP() << device.error().message;
  const auto voice = device.value()->start(steadySound(16'384), true, 0);
  device.value()->set(voice, 1, Vec3(-1.5, 1.5 * std::sqrt(3.0), 0));
  EXPECT_TRUE(
      becomes([&] { return std::filesystem::exists(file) && std::filesystem::file_size(file) > 200'000; }));
  device = Result<std::unique_ptr<SoundDevice>>::failure("closed");
  const std::string all = bytesOfSound(file);
  ASSERT_EQ(all.size() % (12 * sizeof(float)), 0U);
  std::vector<float> frames(all.size() / sizeof(float));
  std::memcpy(frames.data(), all.data(), all.size());
  float left = 0, others = 0;
  for (std::size_t i = 0; i < frames.size(); ++i)
    (i % 12 == 0 ? left : others) = std::max(i % 12 == 0 ? left : others, std::fabs(frames[i]));
  EXPECT_NEAR(left, 0.5, 1e-6);
  EXPECT_LT(others, 1e-6);
}

TEST(LoudspeakerDevice, WithoutADeviceItSaysWhich) {
  LoudspeakerSet hall = stereoHall();
  hall.card = "hw:NoSuchCard";
  const auto device = openLoudspeakers(hall);
  ASSERT_FALSE(device);
  EXPECT_TRUE(device.error().message.find("libasound.so.2 is missing") != std::string::npos ||
              device.error().message.find("the sound device \"hw:NoSuchCard\" cannot be opened") !=
                  std::string::npos)
      << device.error().message;
}

}  // namespace
}  // namespace stadion
