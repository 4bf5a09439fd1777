/// When loads and unloads that were requested take effect.

#include "engine/core/state_fields.h"
#include "engine/scene/load_requests.h"

#include <gtest/gtest.h>

namespace stadion {
namespace {

constexpr Nanoseconds kSecond = 1'000'000'000;

struct CountingLoader : SceneLoader {
  std::vector<std::uint32_t> requested;
  bool late = false;

  void request(std::uint32_t number, const std::string&, NodeRef, const Affine&) override {
    requested.push_back(number);
  }
  bool takesEffect(std::uint32_t, Nanoseconds) override { return !late; }
  std::unique_ptr<LoadedScene> take(std::uint32_t) override { return nullptr; }
  void dispose(std::unique_ptr<LoadedScene>, std::uint64_t) override {}
};

TimeSignature at(Nanoseconds time) {
  TimeSignature now;
  now.time = time;
  return now;
}

TEST(LoadRequests, TakeEffectInTheFrameOfTheirShowTime) {
  CountingLoader loader;
  LoadRequests requests(loader);
  EXPECT_EQ(requests.load("a.evs", {}, Affine::Identity(), 2 * kSecond), 1U);
  EXPECT_EQ(requests.load("b.evs", {1, 0}, Affine::Identity(), kSecond), 2U);
  EXPECT_EQ(loader.requested, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_FALSE(requests.takeLoad(at(kSecond - 1)));
  ASSERT_EQ(requests.takeLoad(at(kSecond)).value().number, 2U);
  EXPECT_FALSE(requests.awaits(2));
  EXPECT_TRUE(requests.awaits(1));
  ASSERT_EQ(requests.takeLoad(at(2 * kSecond)).value().number, 1U);
  EXPECT_TRUE(requests.nonePending());
}

TEST(LoadRequests, ALateLoadDelaysItsUnload) {
  CountingLoader loader;
  LoadRequests requests(loader);
  loader.late = true;
  const std::uint32_t number = requests.load("a.evs", {}, Affine::Identity(), kSecond);
  requests.unload(number, 2 * kSecond);
  EXPECT_FALSE(requests.takeLoad(at(3 * kSecond)));
  EXPECT_FALSE(requests.takeUnload(at(3 * kSecond))) << "the load has not arrived";
  loader.late = false;
  EXPECT_TRUE(requests.takeLoad(at(3 * kSecond)));
  ASSERT_EQ(requests.takeUnload(at(3 * kSecond)).value().at, 2 * kSecond);
}

TEST(LoadRequests, AreDroppedWithTheirLoad) {
  CountingLoader loader;
  LoadRequests requests(loader);
  const std::uint32_t number = requests.load("a.evs", {}, Affine::Identity(), 0);
  requests.unload(number, kSecond);
  requests.drop(number);
  EXPECT_TRUE(requests.nonePending());
  EXPECT_TRUE(requests.asked(number));
  requests.forget(number);
  EXPECT_FALSE(requests.asked(number));
}

TEST(LoadRequests, AreRequestedAgainAfterTheyAreRestored) {
  CountingLoader first;
  LoadRequests before(first);
  before.setScript("/here/show.evs");
  before.load("/here/show.evs", {}, Affine::Identity(), 0);
  before.load("part.evs", {1, 3}, Affine::Identity(), kSecond);
  SavedState saved;
  before.state(saved);
  const std::vector<std::uint8_t> bytes = saved.take();

  CountingLoader second;
  LoadRequests after(second);
  after.setScript("/there/show.evs");
  RestoredState in(bytes);
  after.state(in);
  after.requestAgain(in);
  ASSERT_FALSE(in.failed());
  EXPECT_EQ(second.requested, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_TRUE(after.awaits(2));
}

}  // namespace
}  // namespace stadion
