#pragma once
/// The machine whose clock and trackers count: says what frame comes next, and when all may show it.
///
/// A frame is shown once all members have drawn it. Who is not heard of for the deadline is left out, and the
/// others go on; who comes later gets the scene's state between two frames, and is a member again once it has
/// caught up.
///
/// Threads  begin(), issue(), simulated() and sampling on the App thread; mayShow() on the Draw thread that
///          arrived last; the rest on the network's.

#include "engine/input/input_device.h"
#include "pipeline/cluster/bus.h"
#include "pipeline/cluster/cluster_file.h"
#include "pipeline/cluster/orders.h"
#include "pipeline/cluster/tally.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace stadion::cluster {

struct LeadOptions {
  ClusterFile cluster;
  std::uint64_t show = 0;           ///< hash of its script and input
  double rate = 60;                 ///< [1/s]
  std::chrono::seconds patience{};  ///< with nodes that have not come; then the show begins without them
  std::function<void(const std::string&)> tell;
  std::function<bool()> stop;  ///< nobody waits any longer
};

class Lead final : public FrameOrders, public BusListener {
public:
  static Result<std::unique_ptr<Lead>> open(LeadOptions options);
  ~Lead() override;

  /// Waits until all nodes have opened the show, or patience is at its end.
  void begin();
  /// What becomes of the show's input: each sample goes to all. `inner` must outlive it.
  InputDevice& input(InputDevice& inner);
  /// How the scene's state is written down, between two frames.
  void saveWith(std::function<std::vector<std::uint8_t>()> save) { save_ = std::move(save); }
  /// The scene after a frame, where it is compared.
  bool compares(std::uint64_t frame) const { return frame % options_.cluster.hashEvery == 0; }
  void simulated(std::uint64_t frame, std::uint64_t hash);
  const Tally& tally() const { return tally_; }
  /// The show is over: waits until all have heard of it.
  void finish();

  bool leads() const override { return true; }
  void issue(FrameOrder& order) override;
  std::optional<FrameOrder> next() override { return {}; }
  bool mayShow(const TimeSignature& now) override;

  using BusListener::hear;
  void hear(const Presence& presence) override;
  void hear(const Drawn& drawn) override;
  void hear(const SceneHash& hash) override;
  void hear(const Difference& difference) override;
  void left(std::uint8_t node) override;

private:
  class SampledInput;
  using Clock = std::chrono::steady_clock;

  struct Follower {
    std::uint64_t incarnation = 0;  ///< 0: it is not there
    Phase phase = Phase::Waiting;
    bool member = false, asks = false;
    bool differs = false;  ///< its scene, and it has not joined again since
  };
  /// An order that not all have drawn.
  struct Round {
    std::uint64_t serial = 0;
    std::uint32_t awaited = 0;
    bool drawnHere = false;
  };
  /// The scene's state on its way.
  struct Parcel {
    std::uint64_t to = 0, serial = 0;
    std::vector<std::uint8_t> bytes;
  };

  explicit Lead(LeadOptions options);
  void send(const InputSample* input);
  void answerWhoAsks();
  void sendParcels();
  void leaveOut(std::size_t node, const std::string& why);
  void release();
  void compare(std::size_t node, std::uint64_t frame, std::uint64_t hash);
  const std::string& nameOf(std::size_t node) const { return options_.cluster.nodes[node].name; }

  LeadOptions options_;
  Session session_{};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Follower> followers_;  ///< by node
  FrameOrder pending_;
  bool awaitsInput_ = false;   ///< an order waits for its input
  std::uint32_t explain_ = 0;  ///< who is to say with it where its scene differs
  bool stop_ = false;          ///< scenes differ, and that is to end the show
  std::uint64_t serial_ = 0, go_ = 0, shown_ = 0;
  std::deque<Round> rounds_;                                    ///< by serial
  std::uint8_t latest_ = 0;                                     ///< who has drawn last
  std::deque<std::pair<std::uint64_t, std::uint64_t>> hashes_;  ///< ours: frame, hash
  std::vector<SceneHash> early_;                                ///< of frames that we have not simulated yet
  std::deque<Parcel> parcels_;
  bool ending_ = false;
  std::function<std::vector<std::uint8_t>()> save_;
  std::unique_ptr<SampledInput> input_;
  WrittenOrder written_;
  Tally tally_;
  std::unique_ptr<Bus> bus_;
  std::thread sender_;
};

}  // namespace stadion::cluster
