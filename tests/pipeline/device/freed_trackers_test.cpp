#include "pipeline/device/freed_trackers.h"
#include "tests/pipeline/device/plain_rig.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace stadion {
namespace {

using FreeDBytes = std::array<std::uint8_t, kFreeDBytes>;

void putNumber(FreeDBytes& packet, std::size_t at, double value) {
  const auto bits = static_cast<std::uint32_t>(std::lround(value));
  packet[at] = static_cast<std::uint8_t>(bits >> 16);
  packet[at + 1] = static_cast<std::uint8_t>(bits >> 8);
  packet[at + 2] = static_cast<std::uint8_t>(bits);
}

void sealSum(FreeDBytes& packet) {
  packet.back() = 0x40;
  for (std::size_t i = 0; i + 1 < packet.size(); ++i)
    packet.back() = static_cast<std::uint8_t>(packet.back() - packet[i]);
}

/// Angles in degrees, the place in metres.
FreeDBytes freeDPacket(std::uint8_t camera, double pan, double tilt, double roll, const Vec3& p) {
  FreeDBytes packet{0xd1, camera};
  putNumber(packet, 2, pan * 32'768), putNumber(packet, 5, tilt * 32'768),
      putNumber(packet, 8, roll * 32'768);
  putNumber(packet, 11, p.x() * 64'000), putNumber(packet, 14, p.y() * 64'000),
      putNumber(packet, 17, p.z() * 64'000);
  sealSum(packet);
  return packet;
}

struct Studio {
  explicit Studio(const std::string& lines = "")
      : trackers(
            plainRig(lines), [this](const std::string& line) { told += line; },
            [] { return 1'000'000'000; }) {}
  TrackerSample sampleOf(const std::string& name) {
    InputSample sample;
    trackers.sampleNow(sample);
    return *sample.find(name);
  }
  std::string told;
  LiveTrackers trackers;
  FreeDTrackers freed{trackers};
};

TEST(FreeDTrackers, ReadsPlacesAndAngles) {
  Studio studio;
  studio.freed.take(freeDPacket(4, 90, 30, 0, {1.25, -2, 1.5}), "10.0.0.8");
  const TrackerSample head = studio.sampleOf("head");
  ASSERT_TRUE(head.valid) << studio.told;
  EXPECT_LT((head.X_RT.p - Vec3(1.25, -2, 1.5)).norm(), 1e-5);
  EXPECT_LT((head.X_RT.q * Vec3::UnitY() - Vec3(std::sqrt(0.75), 0, 0.5)).norm(), 1e-5)
      << "to the right and up";
  Studio other;
  other.freed.take(freeDPacket(4, 0, 0, 90, {0, 0, 0}), "10.0.0.8");
  EXPECT_LT((other.sampleOf("head").X_RT.q * Vec3::UnitZ() - Vec3::UnitX()).norm(), 1e-5)
      << "leans to the right";
}

TEST(FreeDTrackers, TheRigFileSaysWhichCameraIsWhichTracker) {
  Studio studio("unit cm\ntracker head  sent-as camera2\ntracker wand  sent-as camera1\n");
  studio.freed.take(freeDPacket(1, 0, 0, 0, {1, 0, 0}), "");
  studio.freed.take(freeDPacket(2, 0, 0, 0, {2, 0, 0}), "");
  studio.freed.take(freeDPacket(3, 0, 0, 0, {3, 0, 0}), "");
  EXPECT_NEAR(studio.sampleOf("wand").X_RT.p.x(), 1, 1e-5);
  EXPECT_NEAR(studio.sampleOf("head").X_RT.p.x(), 2, 1e-5);
  EXPECT_EQ(studio.trackers.counts().unknown, 1u);
}

TEST(FreeDTrackers, OtherAndDamagedPacketsAreCounted) {
  Studio studio;
  const FreeDBytes good = freeDPacket(1, 10, 20, 30, {1, 2, 3});
  for (std::size_t i = 0; i < good.size(); ++i) {
    FreeDBytes bad = good;
    bad[i] ^= 0x10;
    studio.freed.take(bad, "");
    studio.freed.take(std::span(good).first(i), "");
  }
  EXPECT_EQ(studio.freed.misunderstood(), 2 * good.size());
  EXPECT_EQ(studio.trackers.counts().taken, 0u);
  FreeDBytes other = good;
  other[0] = 0xd2;
  sealSum(other);
  EXPECT_FALSE(readFreeD(other));
}

TEST(FreeDTrackers, AnyNumbersGiveAFinitePose) {
  std::minstd_rand random(5);
  for (int i = 0; i < 10'000; ++i) {
    FreeDBytes packet;
    for (std::uint8_t& byte : packet) byte = static_cast<std::uint8_t>(random() >> 8);
    packet[0] = 0xd1;
    sealSum(packet);
    const auto read = readFreeD(packet);
    ASSERT_TRUE(read);
    EXPECT_TRUE(read->X_SD.finite());
    EXPECT_NEAR(read->X_SD.q.norm(), 1, 1e-9);
  }
}

}  // namespace
}  // namespace stadion
