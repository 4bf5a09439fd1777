#include "engine/asset/roots.h"
#include "engine/asset/sound_file.h"
#include "tests/engine/asset/importing.h"

#include <gtest/gtest.h>

namespace stadion::test {
namespace {

const std::filesystem::path kSoundAssets = std::filesystem::path(STADION_SOURCE_DIR) / "assets";

/// A file of that content, opened by name below its folder.
Result<Sound> readBytes(const std::string& bytes) {
  TestFolder folder;
  std::ofstream(folder.path() / "s.wav", std::ios::binary) << bytes;
  AssetRoots roots;
  roots.add(folder.path());
  auto found = roots.open("s.wav");
  return readSound(found.value().file.get(), found.value().path);
}

std::string replaced(std::string bytes, std::size_t at, std::uint32_t value, int size) {
  for (int i = 0; i < size; ++i)
    bytes[at + static_cast<std::size_t>(i)] = static_cast<char>(value >> 8 * i & 255);
  return bytes;
}

TEST(SoundFile, TheLengthIsTheCountOfSamples) {
  AssetRoots roots;
  roots.add(kSoundAssets);
  auto found = roots.open("thud.wav");
  ASSERT_TRUE(found);
  const auto info = readSoundInfo(found.value().file.get(), found.value().path);
  ASSERT_TRUE(info) << info.error().message;
  EXPECT_EQ(info.value().channels, 1u);
  EXPECT_EQ(info.value().rate, 22050u);
  EXPECT_EQ(info.value().samples, 13230u);
  EXPECT_EQ(info.value().length(), 600'000'000);
  // The descriptor is as it was: it can be read again.
  EXPECT_TRUE(readSound(found.value().file.get(), found.value().path));
}

TEST(SoundFile, LengthsAreRoundedToTheNearestNanosecond) {
  EXPECT_EQ((SoundInfo{1, 44100, 1}.length()), 22676);
  EXPECT_EQ((SoundInfo{2, 3000, 1}.length()), 666667);
  EXPECT_EQ((SoundInfo{44100ull * 3600, 44100, 2}.length()), 3'600'000'000'000);
}

TEST(SoundFile, WhatIsNoSoundIsRefusedWithItsName) {
  for (const std::string& bytes :
       {std::string(), std::string("RIFF"), std::string(5000, 'x'), std::string("fLaC\0\0\0", 7)}) {
    const auto sound = readBytes(bytes);
    ASSERT_FALSE(sound);
    EXPECT_NE(sound.error().message.find("s.wav"), std::string::npos) << sound.error().message;
  }
}

TEST(SoundFile, AHeaderThatPromisesTooMuchGivesNoMoreThanIsThere) {
  const std::string good = bytesOf(kSoundAssets / "thud.wav");
  const auto lying = readBytes(replaced(good, 40, 0x7fffff00, 4));
  if (lying) {
    EXPECT_LE(lying.value().samples.size(), good.size());
  }
  const auto many = readBytes(replaced(good, 22, 4000, 2));
  EXPECT_FALSE(many) << "4000 channels";
  const auto fast = readBytes(replaced(good, 24, 4'000'000'000u, 4));
  EXPECT_FALSE(fast) << "four billion samples a second";
}

TEST(SoundFile, DamagedFilesAreReadOrRefusedButNeverBringTheProgramDown) {
  const std::string good = bytesOf(kSoundAssets / "thud.wav").substr(0, 3000);
  std::uint64_t seed = 1;
  for (int n = 0; n < 500; ++n) {
    std::string bytes = good;
    for (int k = 0; k < 3; ++k) {
      seed = seed * 6364136223846793005ull + 1442695040888963407ull;
      bytes[(seed >> 33) % 80] = static_cast<char>(seed >> 56);
    }
    const auto sound = readBytes(bytes);
    if (sound) {
      EXPECT_LE(sound.value().samples.size(), 100'000'000u);
    }
  }
}

}  // namespace
}  // namespace stadion::test
