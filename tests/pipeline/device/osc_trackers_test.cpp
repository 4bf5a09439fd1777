#include "pipeline/device/osc_trackers.h"

#include <algorithm>
#include <arpa/inet.h>
#include <atomic>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <lo/lo.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace stadion {
namespace {

/// A rig that listens on a free port, and a sender.
struct Room {
  Room() : trackers(standardRig(), [this](const std::string& line) { told.push_back(line); }) {
    auto opened = OscTrackers::open(0, trackers);
    EXPECT_TRUE(opened) << opened.error().message;
    osc = std::move(opened.value());
    to = lo_address_new("127.0.0.1", std::to_string(osc->port()).c_str());
  }
  ~Room() { lo_address_free(to); }

  void pose(const char* path, double x, double y, double z, double qw = 1) {
    lo_send(to, path, "fffffff", x, y, z, 0.0, 0.0, 0.0, qw);
  }
  void raw(const std::string& bytes) {
    const int s = socket(AF_INET, SOCK_DGRAM, 0);
    sockaddr_in a{};
    a.sin_family = AF_INET, a.sin_port = htons(osc->port());
    inet_pton(AF_INET, "127.0.0.1", &a.sin_addr);
    sendto(s, bytes.data(), bytes.size(), 0, reinterpret_cast<const sockaddr*>(&a), sizeof a);
    close(s);
  }
  /// Waits until so many things have arrived.
  template <class Count>
  void await(Count count, std::uint64_t wanted) {
    for (int i = 0; i < 60'000 && count() < wanted; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    EXPECT_EQ(count(), wanted);
  }
  void awaitTaken(std::uint64_t n) {
    await([&] { return trackers.counts().taken; }, n);
  }
  InputSample now() {
    InputSample sample;
    trackers.sampleNow(sample);
    return sample;
  }

  std::vector<std::string> told;  // of the server's thread; read when all has arrived
  LiveTrackers trackers;
  std::unique_ptr<OscTrackers> osc;
  lo_address to = nullptr;
};

TEST(ThreadsOscTrackers, PosesButtonsAndAxesArriveFromTheNetwork) {
  Room room;
  room.pose("/tracker/wand/pose", 0.5, 1, 1.25);
  lo_send(room.to, "/tracker/wand/button", "ii", 2, 1);
  lo_send(room.to, "/tracker/wand/axis", "id", 1, -0.5);
  lo_send(room.to, "/tracker/wand/button", "iT", 3);
  room.awaitTaken(4);
  const InputSample sample = room.now();
  const TrackerSample& wand = *sample.find("wand");
  EXPECT_TRUE(wand.valid);
  EXPECT_NEAR((wand.X_RT.p - Vec3(0.5, 1, 1.25)).norm(), 0, 1e-9);
  EXPECT_EQ(wand.buttons, 6u);
  EXPECT_EQ(wand.axes[1], -0.5f);
}

TEST(ThreadsOscTrackers, ABundleOfTheFutureIsTakenAtOnce) {
  Room room;
  lo_timetag later;
  lo_timetag_now(&later);
  later.sec += 3600;
  lo_bundle bundle = lo_bundle_new(later);
  lo_message m = lo_message_new();
  for (const float x : {0.f, 1.f, 1.f, 0.f, 0.f, 0.f, 1.f}) lo_message_add_float(m, x);
  lo_bundle_add_message(bundle, "/tracker/wand/pose", m);
  lo_send_bundle(room.to, bundle);
  lo_bundle_free_recursive(bundle);
  room.awaitTaken(1);
  EXPECT_TRUE(room.now().find("wand")->valid);
}

TEST(ThreadsOscTrackers, WhatIsNoMeasurementIsCountedToldOnceAndLeftOut) {
  Room room;
  const auto misunderstood = [&] { return room.osc->misunderstood(); };
  for (int i = 0; i < 3; ++i) lo_send(room.to, "/tracker/wand/pose", "fff", 1.0, 2.0, 3.0);
  lo_send(room.to, "/tracker/wand/pose", "s", "../../etc/passwd");
  lo_send(room.to, "/tracker//pose", "i", 1);
  lo_send(room.to, "/tracker/", "i", 1);
  lo_send(room.to, "/", "i", 1);
  lo_send(room.to, "/tracker/wand/axis", "iiiiiiiiiiiiiiiiiiii", 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1,
          1, 1, 1, 1, 1);
  room.await(misunderstood, 8);
  lo_send(room.to, "/tracker/wand/button", "fi", std::numeric_limits<float>::infinity(), 1);
  lo_send(room.to, "/tracker/wand/button", "fi", 1e30f, 1);
  lo_send(room.to, "/tracker/wand/axis", "if", 0, std::numeric_limits<float>::quiet_NaN());
  room.pose("/tracker/wand/pose", std::numeric_limits<double>::quiet_NaN(), 0, 0);
  room.pose("/tracker/wand/pose", 1e30, 0, 0);
  room.pose("/tracker/wand/pose", 0, 0, 0, 0);
  room.await([&] { return room.trackers.counts().refused; }, 6);
  room.pose("/tracker/hat/pose", 0, 0, 0);
  room.pose("/tracker/hat/pose", 0, 0, 0);
  room.await([&] { return room.trackers.counts().unknown; }, 2);
  EXPECT_FALSE(room.now().find("wand")->valid);
  EXPECT_EQ(room.now().find("wand")->buttons, 0u);
  EXPECT_EQ(room.told.size(), 8u) << "each kind of mistake once";
  const auto tellsOf = [&](const char* begin) {
    return std::ranges::count_if(room.told, [&](const std::string& line) { return line.starts_with(begin); });
  };
  EXPECT_EQ(tellsOf("tracker \"wand\" says what cannot be"), 1);
  EXPECT_EQ(tellsOf("tracker \"hat\" is not in the rig file"), 1);
}

TEST(ThreadsOscTrackers, PacketsThatAreNoOscNeverReachTheShow) {
  Room room;
  using namespace std::string_literals;
  for (const std::string& bytes :
       {"x"s, "hello world"s, "/tracker"s, "#bundle"s, "#bundle\0\0\0\0\0\0\0\0\0\xff\xff\xff\xff"s,
        "/tracker/wand/pose\0\0,fffffff\0\0\0\0"s, std::string(1000, '\0'), std::string(60000, '/'),
        "/a\0\0,b\0\0\x7f\xff\xff\xff"s})
    room.raw(bytes);
  std::uint64_t seed = 5;
  for (int n = 0; n < 2000; ++n) {
    std::string bytes = "/tracker/wand/pose\0\0,fffffff\0\0\0\0"s + std::string(28, '\1');
    for (int k = 0; k < 4; ++k) {
      seed = seed * 6364136223846793005ull + 1442695040888963407ull;
      bytes[(seed >> 33) % bytes.size()] = static_cast<char>(seed >> 56);
    }
    room.raw(bytes.substr(0, 4 + (seed >> 20) % bytes.size()));
    if (n % 50 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  // It still listens.
  const std::uint64_t before = room.trackers.counts().taken;
  for (int i = 0; i < 20'000 && room.trackers.counts().taken <= before; ++i) {
    lo_send(room.to, "/tracker/head/axis", "id", 0, 1.0);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_GT(room.trackers.counts().taken, before);
  for (const TrackerSample& t : room.now().trackers) EXPECT_TRUE(t.X_RT.finite());
}

TEST(ThreadsOscTrackers, APortThatIsTakenIsRefused) {
  Room room;
  LiveTrackers other(standardRig(), [](const std::string&) {});
  EXPECT_FALSE(OscTrackers::open(room.osc->port(), other));
}

TEST(ThreadsOscTrackers, EachSenderIsToldFromTheOthersByItsHost) {
  std::string from;
  std::atomic<int> heard = 0;
  auto server = OscServer::open(0, [&](const OscMessage& m) { from = m.from, ++heard; });
  ASSERT_TRUE(server);
  const lo_address to = lo_address_new("127.0.0.1", std::to_string(server.value()->port()).c_str());
  lo_timetag now;
  lo_timetag_now(&now);
  lo_send_timestamped(to, now, "/tracker/wand/button", "ii", 2, 1);
  for (int i = 0; i < 5000 && heard == 0; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(2));
  lo_address_free(to);
  server.value().reset();
  EXPECT_EQ(from, "127.0.0.1");
}

}  // namespace
}  // namespace stadion
