/// Machines of a cluster that talk over the network of this machine, each a process: a scene is a number that
/// each frame changes.

#include "engine/core/state_hash.h"
#include "engine/input/scripted_input.h"
#include "pipeline/cluster/cluster_leader.h"
#include "pipeline/cluster/follower.h"
#include "pipeline/cluster/loopback_sockets.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <functional>
#include <mutex>
#include <utility>

namespace stadion::cluster {
namespace {

constexpr std::uint64_t kFrames = 60, kHashEvery = 10;

ClusterFile roomOf(pid_t test) {
  ClusterFile file;
  for (const char* name : {"front", "left", "right"}) file.nodes.push_back({name, {name}, 1});
  file.partition = "talk" + std::to_string(test);
  file.hashEvery = kHashEvery;
  file.deadline = 2;
  return file;
}

/// The visitor's place adds to it, so that a host without his input has another one.
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

/// What the processes have in common.
struct Common {
  std::atomic<std::uint64_t> frame = 0;  ///< that has been shown
  std::atomic<std::uint64_t> ends[3]{};  ///< by node: its scene at the end
};

class ThreadsCluster : public ::testing::Test {
protected:
  ThreadsCluster()
      : common_(new (mmap(nullptr, sizeof(Common), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))
                    Common) {
    visitor_.key("head", 0, Vec3(0, 0, 1.7)).key("head", 2, Vec3(0, 1, 1.7));
  }
  ~ThreadsCluster() override {
    for (const pid_t machine : machines_) kill(machine, SIGKILL), waitpid(machine, nullptr, 0);
    munmap(common_, sizeof(Common));
  }

  /// A machine that follows until the last frame, from frame `from` on. All are started before this process
  /// has threads. `disturb` may change its scene after a frame.
  using Disturb = std::function<void(std::uint64_t frame, NumberScene&)>;
  void follow(std::size_t node, std::uint64_t from = 0, const Disturb& disturb = {}) {
    const pid_t machine = fork();
    if (machine != 0) return machines_.push_back(machine);
    while (common_->frame < from) usleep(1000);
    _exit(play(node, disturb) ? 0 : 1);
  }

  ClusterFile room() const {
    ClusterFile file = roomOf(test_);
    file.stopOnDifference = stopOnDifference_;
    return file;
  }
  void openLead() {
    lead_.reset();
    auto lead = ClusterLeader::open({room(), {1}, patience_, told_.teller(), [] { return false; }});
    ASSERT_TRUE(lead) << lead.error().message;
    lead_ = std::move(lead.value());
    lead_->saveWith([this] { return SavedScene{0, scene_.save()}; });
  }

  /// Orders, simulates and shows one frame. True: it was the last one.
  bool frame(std::uint64_t number, bool last = false) {
    FrameOrder order;
    order.signature = signatureAt(number, 60), order.last = last;
    const TimeSignature now = order.signature;
    lead_->issue(order);
    InputSample input;
    lead_->input(visitor_).sampleFrame(now.time - now.step, now.time, input);
    scene_.simulate(now, input);
    if (lead_->compares(number)) lead_->simulated(number, scene_.number);
    EXPECT_TRUE(lead_->mayShow(now));
    common_->frame = number;
    return order.last;
  }
  /// Frames until that was told, kFrames at least. The last one is the last of all.
  void framesUntil(const std::string& told) {
    std::uint64_t f = 0;
    for (; f < kFrames || (!told_.has(told) && f < 100'000); ++f) frame(f);
    frame(f, true);
    lead_->finish(true);
  }

  void expectAllEnd() {
    for (const pid_t machine : machines_) {
      int status = -1;
      waitpid(machine, &status, 0);
      EXPECT_EQ(status, 0) << told_.all();
    }
    machines_.clear();
  }
  void expectAllAlike() {
    const std::size_t machines = machines_.size();
    expectAllEnd();
    for (std::size_t node = 1; node <= machines; ++node)
      EXPECT_EQ(common_->ends[node], scene_.number) << node << "\n" << told_.all();
  }

  const pid_t test_ = getpid();
  bool stopOnDifference_ = false;
  Common* common_;
  std::chrono::seconds patience_{20};  ///< with a host that has not come
  ScriptedInput visitor_;
  NumberScene scene_;
  Told told_;
  std::unique_ptr<ClusterLeader> lead_;
  std::vector<pid_t> machines_;

private:
  /// False: there is no network.
  bool play(std::size_t node, const Disturb& disturb) {
    NumberScene scene;
    std::shared_ptr<const ResumableScene> kept;
    for (bool over = false; !over;) {
      auto opened = Follower::open(
          {room(), node, {1}, [](const std::string&) {}, [] { return false; }, {}, std::move(kept)});
      if (!opened) return false;
      Follower& follower = *opened.value();
      const auto joining = follower.join();
      if (!joining) continue;
      scene = {};
      if (joining->state) scene.restore(*joining->state);
      follower.compareWith([&](const SavedScene& there) -> std::optional<Follower::Differs> {
        if (scene.save() == there.bytes) return {};
        return Follower::Differs{"the number", "one", "another"};
      });
      TimeSignature last = joining->after;
      while (const auto order = follower.next()) {
        last = order->signature;
        InputSample input;
        follower.input().sampleAt(last.time, input);
        scene.simulate(last, input);
        if (disturb) disturb(last.frame, scene);
        if (follower.compares(last.frame)) follower.simulated(last.frame, scene.number);
        over = follower.mayShow(last) && order->last;
        if (over) break;
      }
      if (follower.keepsScene()) follower.keep(last, {0, scene.save()});
      kept = follower.kept();
      follower.finish();
    }
    common_->ends[node] = scene.number;
    return true;
  }
};

TEST_F(ThreadsCluster, AllComeToTheSameScene) {
  follow(1), follow(2);
  openLead();
  lead_->begin(60);
  framesUntil("");
  expectAllAlike();
  EXPECT_EQ(lead_->stats().leftOut, 0U) << told_.all();
  EXPECT_EQ(lead_->stats().differed, 0U);
}

TEST_F(ThreadsCluster, WhereNoInterfaceIsNamedNothingIsHeardFromOtherMachines) {
  openLead();
  const std::set<int> sockets = udpSockets();
  EXPECT_FALSE(sockets.empty());
  for (const int socket : sockets) {
    char device[16] = {};
    socklen_t size = sizeof device;
    ASSERT_EQ(getsockopt(socket, SOL_SOCKET, SO_BINDTODEVICE, device, &size), 0);
    EXPECT_STREQ(device, "lo");
  }
}

TEST_F(ThreadsCluster, AHostThatComesLaterGetsTheScene) {
  follow(1), follow(2, 20);
  patience_ = std::chrono::seconds(1);
  openLead();
  lead_->begin(60);
  EXPECT_TRUE(told_.has("the show begins without right")) << told_.all();
  framesUntil("right plays with us");
  expectAllAlike();
}

TEST_F(ThreadsCluster, AnotherSceneIsNamedAndTakenOver) {
  bool done = false;
  follow(1);
  follow(2, 0, [&](std::uint64_t frame, NumberScene& scene) {
    if (frame == 25 && !std::exchange(done, true)) scene.number ^= 1;
  });
  openLead();
  lead_->begin(60);
  framesUntil("right plays with us");
  expectAllAlike();
  EXPECT_TRUE(told_.has("the scene of right differs from ours since frame 30 at the latest")) << told_.all();
  EXPECT_TRUE(told_.has("the number is one there and another here")) << told_.all();
}

TEST_F(ThreadsCluster, AnotherSceneMayEndTheShowForAll) {
  stopOnDifference_ = true;
  follow(1);
  follow(2, 0, [](std::uint64_t frame, NumberScene& scene) { scene.number += frame == 25; });
  openLead();
  lead_->begin(60);
  std::uint64_t f = 0;
  while (f < 100'000 && !frame(f)) ++f;
  EXPECT_LT(f, 100'000U) << told_.all();
  lead_->finish(true);
  expectAllEnd();
  EXPECT_EQ(common_->ends[1], scene_.number);
  EXPECT_NE(common_->ends[2], scene_.number);
  EXPECT_EQ(lead_->stats().stopped, 1U);
  EXPECT_TRUE(told_.has("the number is one there and another here")) << told_.all();
}

TEST_F(ThreadsCluster, ARestartedLeaderGoesOnFromAnothersScene) {
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
  for (std::uint64_t f = 30; f <= kFrames; ++f) frame(f, f == kFrames);
  lead_->finish(true);
  expectAllAlike();
}

TEST_F(ThreadsCluster, ARestartedLeaderMayDieBeforeTheOthersHaveItsScene) {
  follow(1), follow(2);
  openLead();
  lead_->begin(60);
  for (std::uint64_t f = 0; f < 30; ++f) frame(f);
  const std::uint64_t before = scene_.number;
  for (int deaths = 0; deaths < 3; ++deaths) {
    openLead();
    const auto underWay = lead_->takeOver();
    ASSERT_TRUE(underWay) << deaths << "\n" << told_.all();
    EXPECT_EQ(underWay->last.frame, 29U);
    scene_ = {};
    scene_.restore(*underWay->state);
    EXPECT_EQ(scene_.number, before);
  }
  lead_->begin(60);
  for (std::uint64_t f = 30; f <= kFrames; ++f) frame(f, f == kFrames);
  lead_->finish(true);
  expectAllAlike();
}

TEST_F(ThreadsCluster, AShowGoesOnFromTheHostThatHasComeFarthest) {
  follow(1), follow(2);
  openLead();
  lead_->begin(60);
  for (std::uint64_t f = 0; f < 20; ++f) frame(f);
  kill(machines_[0], SIGSTOP);
  for (std::uint64_t f = 20; f < 40; ++f) frame(f);
  EXPECT_TRUE(told_.has("left has not been heard of")) << told_.all();
  const std::uint64_t before = scene_.number;
  openLead();
  kill(machines_[0], SIGCONT);
  const auto underWay = lead_->takeOver();
  ASSERT_TRUE(underWay) << told_.all();
  EXPECT_EQ(underWay->last.frame, 39U);
  scene_.restore(*underWay->state);
  EXPECT_EQ(scene_.number, before);
  lead_->begin(60);
  for (std::uint64_t f = 40; f <= kFrames + 40; ++f) frame(f, f == kFrames + 40);
  lead_->finish(true);
  expectAllAlike();
}

}  // namespace
}  // namespace stadion::cluster
