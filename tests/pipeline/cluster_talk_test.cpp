/// Machines of a cluster that talk over the real network of this machine, all in one process: a scene is a
/// number that each frame changes.

#include "engine/input/scripted_input.h"
#include "engine/state_hash.h"
#include "pipeline/cluster/follower.h"
#include "pipeline/cluster/lead.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <functional>
#include <map>
#include <mutex>
#include <thread>

namespace stadion::cluster {
namespace {

constexpr std::uint64_t kFrames = 60, kHashEvery = 10;

ClusterFile room() {
  ClusterFile file;
  for (const char* name : {"front", "left", "right"}) file.nodes.push_back({name, {name}, 1});
  file.partition = "talk" + std::to_string(getpid());
  file.hashEvery = kHashEvery;
  file.deadline = 2;
  return file;
}

/// Where the visitor stands adds to it, so that who has not heard of him has another one.
struct NumberScene {
  std::uint64_t number = 1;

  void simulate(const TimeSignature& now, const InputSample& input) {
    StateHash hash;
    hash.add(number), hash.add(now.frame);
    for (const TrackerSample& t : input.trackers) hash.add(t.X_RT.p.y());
    number = hash.value();
  }
  std::vector<std::uint8_t> save() const {
    std::vector<std::uint8_t> bytes(sizeof number);
    std::memcpy(bytes.data(), &number, sizeof number);
    return bytes;
  }
  void restore(const std::vector<std::uint8_t>& bytes) {
    ASSERT_EQ(bytes.size(), sizeof number);
    std::memcpy(&number, bytes.data(), sizeof number);
  }
};

/// What was told, from any thread.
class Told {
public:
  std::function<void(const std::string&)> teller() {
    return [this](const std::string& what) {
      const std::lock_guard lock(mutex_);
      all_ += what + "\n";
    };
  }
  bool has(const std::string& part) const {
    const std::lock_guard lock(mutex_);
    return all_.find(part) != std::string::npos;
  }
  std::string all() const {
    const std::lock_guard lock(mutex_);
    return all_;
  }

private:
  mutable std::mutex mutex_;
  std::string all_;
};

class ThreadsCluster : public ::testing::Test {
protected:
  ThreadsCluster() { visitor_.key("head", 0, Vec3(0, 0, 1.7)).key("head", 2, Vec3(0, 1, 1.7)); }
  ~ThreadsCluster() override {
    stop_ = true;
    for (std::thread& t : machines_) t.join();
  }

  std::function<bool()> stopped() {
    return [this] { return stop_.load(); };
  }

  void openLead() {
    lead_.reset();
    auto lead = Lead::open({room(), 1, "", patience_, told_.teller(), stopped()});
    ASSERT_TRUE(lead) << lead.error().message;
    lead_ = std::move(lead.value());
    lead_->saveWith([this] { return scene_.save(); });
  }

  /// Orders, simulates and shows one frame.
  void frame(std::uint64_t number, bool last = false) {
    FrameOrder order;
    order.signature = signatureAt(number, 60), order.last = last;
    const TimeSignature now = order.signature;
    lead_->issue(order);
    InputSample input;
    lead_->input(visitor_).sampleFrame(now.time - now.step, now.time, input);
    scene_.simulate(now, input);
    if (lead_->compares(number)) lead_->simulated(number, scene_.number);
    EXPECT_TRUE(lead_->mayShow(now));
  }

  /// A machine that follows until the last frame. `disturb` may change its scene after a frame.
  void follow(std::size_t node, std::function<void(std::uint64_t, NumberScene&)> disturb = {}) {
    machines_.emplace_back([this, node, disturb] {
      NumberScene scene;
      TimeSignature last;
      for (bool over = false; !over && !stop_;) {
        auto opened = Follower::open({room(), node, 1, "", told_.teller(), stopped()});
        if (!opened) return told_.teller()(opened.error().message);
        Follower& follower = *opened.value();
        const auto joining = follower.join();
        if (!joining) continue;
        scene = {};
        if (joining->state) scene.restore(*joining->state);
        follower.compareWith([&](const std::vector<std::uint8_t>& there) -> std::optional<Follower::Differs> {
          if (scene.save() == there) return {};
          return Follower::Differs{"the number", "one", "another"};
        });
        while (const auto order = follower.next()) {
          InputSample input;
          follower.input().sampleAt(order->signature.time, input);
          scene.simulate(order->signature, input);
          last = order->signature;
          if (disturb) disturb(last.frame, scene);
          if (follower.compares(last.frame)) follower.simulated(last.frame, scene.number);
          if (!follower.mayShow(last)) break;
          over = order->last;
          if (over) break;
        }
        if (follower.isAskedForScene()) follower.giveScene(last, scene.save());
        follower.finish();
      }
      const std::lock_guard lock(mutex_);
      ends_[node] = scene.number;
    });
  }

  void expectAllAlike() {
    for (std::thread& t : machines_) t.join();
    machines_.clear();
    for (const auto& [node, number] : ends_) EXPECT_EQ(number, scene_.number) << node << "\n" << told_.all();
  }

  ScriptedInput visitor_;
  NumberScene scene_;
  Told told_;
  std::atomic<bool> stop_ = false;
  std::chrono::seconds patience_{20};  ///< with who has not come
  std::unique_ptr<Lead> lead_;
  std::mutex mutex_;
  std::map<std::size_t, std::uint64_t> ends_;
  std::vector<std::thread> machines_;
};

TEST_F(ThreadsCluster, AllComeToTheSameScene) {
  follow(1), follow(2);
  openLead();
  lead_->begin(60);
  for (std::uint64_t f = 0; f < kFrames; ++f) frame(f, f + 1 == kFrames);
  lead_->finish();
  expectAllAlike();
  EXPECT_EQ(ends_.size(), 2U);
  EXPECT_EQ(lead_->tally().leftOut, 0U) << told_.all();
  EXPECT_EQ(lead_->tally().differed, 0U);
}

TEST_F(ThreadsCluster, WhoComesLaterGetsTheScene) {
  follow(1);
  patience_ = std::chrono::seconds(1);
  openLead();
  lead_->begin(60);  // without the third
  for (std::uint64_t f = 0; f < kFrames; ++f) {
    if (f == 20) follow(2);
    frame(f);
  }
  std::uint64_t f = kFrames;
  for (; !told_.has("right plays with us") && f < 100'000; ++f) frame(f);
  frame(f, true);
  lead_->finish();
  expectAllAlike();
  EXPECT_EQ(ends_.size(), 2U) << told_.all();
}

TEST_F(ThreadsCluster, AnotherSceneIsNamedAndTakenOver) {
  std::atomic<bool> done = false;
  follow(1);
  follow(2, [&](std::uint64_t frame, NumberScene& scene) {
    if (frame == 25 && !done.exchange(true)) scene.number ^= 1;
  });
  openLead();
  lead_->begin(60);
  std::uint64_t f = 0;
  for (; f < kFrames || (!told_.has("right plays with us") && f < 100'000); ++f) frame(f);
  frame(f, true);
  lead_->finish();
  expectAllAlike();
  EXPECT_TRUE(told_.has("the scene of right differs from ours since frame 30 at the latest")) << told_.all();
  EXPECT_TRUE(told_.has("the number is one there and another here")) << told_.all();
}

TEST_F(ThreadsCluster, WhoLeadsAnewGoesOnFromAnothersScene) {
  follow(1), follow(2);
  openLead();
  lead_->begin(60);
  for (std::uint64_t f = 0; f < 30; ++f) frame(f);
  const std::uint64_t before = scene_.number;
  scene_ = {};
  openLead();
  const auto underWay = lead_->takeOver();
  ASSERT_TRUE(underWay) << told_.all();
  scene_.restore(*underWay->state);
  EXPECT_EQ(scene_.number, before);
  EXPECT_EQ(underWay->last.frame, 29U);
  lead_->begin(60);
  for (std::uint64_t f = 30; f < kFrames; ++f) frame(f, f + 1 == kFrames);
  lead_->finish();
  expectAllAlike();
}

}  // namespace
}  // namespace stadion::cluster
