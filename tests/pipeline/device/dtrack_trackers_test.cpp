#include "pipeline/device/dtrack_trackers.h"
#include "tests/pipeline/device/plain_rig.h"

#include <gtest/gtest.h>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <numbers>
#include <random>
#include <thread>

namespace stadion {
namespace {

/// A rig that is given packets by hand.
struct Cameras {
  explicit Cameras(const RigFile& rig = standardRig())
      : trackers(
            rig, [this](const std::string& line) { told += line + "\n"; }, [this] { return clock; }) {}

  void at(double seconds, const std::string& packet) {
    clock = 1'000'000'000'000 + static_cast<Nanoseconds>(seconds * 1e9);
    dtrack.take(packet, "10.0.0.7");
  }
  TrackerSample sampleOf(const std::string& name) {
    InputSample sample;
    trackers.sampleNow(sample);
    return *sample.find(name);
  }

  Nanoseconds clock = 1'000'000'000'000;
  std::string told;
  LiveTrackers trackers;
  DTrackTrackers dtrack{trackers};
};

/// As in ART's manual: a body, and a Flystick with six buttons, of which the first and the third are down.
const std::string kDTrackPacket =
    "fr 21753\r\n"
    "ts 39596.024831\r\n"
    "6dcal 2\r\n"
    "6d 1 [0 1.000][326.848 -187.216 1709.503 0.0 0.0 90.0][0 1 0 -1 0 0 0 0 1]\r\n"
    "6df2 1 1 [0 1.000 6 2][261.103 116.520 941.085 0 0 0][1 0 0 0 1 0 0 0 1]"
    "[5 -1.00 0.25]\r\n"
    "3d 0\r\n";

TEST(DTrackTrackers, BodiesAreTheHeadAndFlysticksTheWand) {
  Cameras cameras(plainRig(""));
  cameras.at(0, kDTrackPacket);
  EXPECT_EQ(cameras.told, "");
  const TrackerSample head = cameras.sampleOf("head"), wand = cameras.sampleOf("wand");
  ASSERT_TRUE(head.valid && wand.valid);
  EXPECT_LT((head.X_RT.p - Vec3(0.326848, -0.187216, 1.709503)).norm(), 1e-9);
  EXPECT_LT((head.X_RT.q * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-9) << "the matrix comes by columns";
  EXPECT_LT((wand.X_RT.p - Vec3(0.261103, 0.116520, 0.941085)).norm(), 1e-9);
  EXPECT_EQ(wand.buttons, 5u);
  EXPECT_EQ(wand.axes[0], -1);
  EXPECT_EQ(wand.axes[1], 0.25f);
}

TEST(DTrackTrackers, TheRigFileSaysWhichDeviceIsWhichTracker) {
  Cameras cameras(
      plainRig("unit in\ntracker head  sent-as body3\ntracker wand\ntracker foot  sent-as body0\n"));
  cameras.at(0, "6d 2 [3 1][1000 0 0 0 0 0][1 0 0 0 1 0 0 0 1] [0 1][0 2000 0 0 0 0][1 0 0 0 1 0 0 0 1]\n");
  EXPECT_LT((cameras.sampleOf("head").X_RT.p - Vec3(1, 0, 0)).norm(), 1e-9)
      << "millimetres, whatever the unit";
  EXPECT_LT((cameras.sampleOf("foot").X_RT.p - Vec3(0, 2, 0)).norm(), 1e-9);
  EXPECT_FALSE(cameras.sampleOf("wand").valid);
}

TEST(DTrackTrackers, ABodyThatIsNotSeenSendsNoPoseButItsButtons) {
  Cameras cameras(plainRig(""));
  cameras.at(0, "6df2 1 1 [0 -1.000 2 1][0 0 0 0 0 0][0 0 0 0 0 0 0 0 0][2 0.5]\n");
  EXPECT_EQ(cameras.trackers.counts().refused, 0u);
  EXPECT_EQ(cameras.sampleOf("wand").buttons, 2u);
}

TEST(DTrackTrackers, AButtonThatIsReleasedBetweenPacketsIsReleased) {
  Cameras cameras(plainRig(""));
  const auto press = [&](double seconds, int bits) {
    cameras.at(seconds, "ts " + std::to_string(100 + seconds) + "\n6df 1 [0 1 " + std::to_string(bits) +
                            "][0 0 1000 0 0 0][1 0 0 0 1 0 0 0 1]\n");
  };
  press(0, 1);
  press(0.01, 3);
  press(0.02, 2);
  EXPECT_EQ(cameras.sampleOf("wand").buttons, 2u);
}

std::string bodyAt(double time, double x) {
  return "ts " + std::to_string(time) + "\n6d 1 [0 1][" + std::to_string(x) +
         " 0 1700 0 0 0][1 0 0 0 1 0 0 0 1]\n";
}

TEST(DTrackTrackers, TimeGoesOnOverMidnight) {
  Cameras cameras(plainRig(""));
  for (int i = 0; i < 200; ++i) {
    const double now = 0.01 * i, ofDay = 86'399 + now;
    cameras.at(now, bodyAt(ofDay >= 86'400 ? ofDay - 86'400 : ofDay, 10.0 * i));
  }
  EXPECT_EQ(cameras.trackers.counts().late, 0u);
  EXPECT_EQ(cameras.trackers.counts().taken, 200u);
  EXPECT_EQ(cameras.told, "");
  EXPECT_LT((cameras.sampleOf("head").X_RT.p - Vec3(1.99, 0, 1.7)).norm(), 1e-9);
}

TEST(DTrackTrackers, APacketThatWasOvertakenIsLateAndAClockThatWasSetIsFollowed) {
  Cameras cameras(plainRig(""));
  for (int i = 0; i < 10; ++i) cameras.at(0.01 * i, bodyAt(500 + 0.01 * i, i));
  cameras.at(0.1, bodyAt(500.05, 77));
  EXPECT_EQ(cameras.trackers.counts().late, 1u);
  for (int i = 1; i < 10; ++i) cameras.at(0.1 + 0.01 * i, bodyAt(100 + 0.01 * i, 10 + i));
  EXPECT_NE(cameras.told.find("clock was set back"), std::string::npos) << cameras.told;
  EXPECT_LT((cameras.sampleOf("head").X_RT.p - Vec3(0.019, 0, 1.7)).norm(), 3e-3);
}

TEST(DTrackTrackers, DamagedPacketsAreCountedAndChangeNothing) {
  Cameras cameras(plainRig(""));
  for (const char* packet :
       {"", "hello", "\n\n", "6d", "6d 1", "6d 2 [0 1][0 0 0 0 0 0][1 0 0 0 1 0 0 0 1]",
        "6d 1 [0 1][0 0 0 0 0][1 0 0 0 1 0 0 0 1]", "6d 1 [0 1][0 0 nan 0 0 0][1 0 0 0 1 0 0 0 1]",
        "6d 1 [0 1][0 0 1e999 0 0 0][1 0 0 0 1 0 0 0 1]", "6d -1", "6d 999999999999",
        "6d 1 [0.5 1][0 0 0 0 0 0][1 0 0 0 1 0 0 0 1]", "ts -5\n6d 0", "ts x\n6d 0",
        "6d 1 [0 1][0 0 0 0 0 0][1 0 0 0 1 0 0 0 1", "6df2 1 1 [0 1 40 0][0 0 0 0 0 0][1 0 0 0 1 0 0 0 1][1]",
        "6df2 1 1 [0 1 2 1][0 0 0 0 0 0][1 0 0 0 1 0 0 0 1][1]"})
    cameras.at(0, packet);
  EXPECT_EQ(cameras.dtrack.misunderstood(), 17u);
  EXPECT_EQ(cameras.trackers.counts().taken, 0u);
  cameras.at(0, "6d 1 [0 1][0 0 1000 0 0 0][1 0 0 0 1 0 0 0 5]\n");
  EXPECT_EQ(cameras.trackers.counts().refused, 1u) << "no rotation";
}

TEST(DTrackTrackers, CutAndMutatedPacketsHarmNothing) {
  Cameras cameras(plainRig(""));
  std::minstd_rand random(7);
  for (int i = 0; i < 20'000; ++i) {
    std::string packet = kDTrackPacket.substr(0, random() % (kDTrackPacket.size() + 1));
    for (unsigned k = random() % 4; k > 0 && !packet.empty(); --k)
      packet[random() % packet.size()] = static_cast<char>(random());
    cameras.at(0.001 * i, packet);
  }
  for (const char* name : {"head", "wand"}) EXPECT_TRUE(cameras.sampleOf(name).X_RT.finite());
}

TEST(ThreadsDTrackTrackers, PacketsArriveFromTheNetwork) {
  LiveTrackers trackers(plainRig(""), [](const std::string&) {});
  auto opened = DTrackTrackers::open(0, trackers);
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_FALSE(DTrackTrackers::open(opened.value()->port(), trackers)) << "the port is taken";
  const int s = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in a{};
  a.sin_family = AF_INET, a.sin_port = htons(opened.value()->port());
  ::inet_pton(AF_INET, "127.0.0.1", &a.sin_addr);
  ::sendto(s, kDTrackPacket.data(), kDTrackPacket.size(), 0, reinterpret_cast<const sockaddr*>(&a), sizeof a);
  ::close(s);
  for (int i = 0; i < 30'000 && trackers.counts().taken < 6; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_EQ(trackers.counts().taken, 6u) << "two poses, two buttons, two axes";
}

}  // namespace
}  // namespace stadion
