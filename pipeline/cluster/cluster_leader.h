#pragma once
/// The cluster's leader: its clock and trackers count. It orders the next frame, and says when all hosts may
/// show it.
///
/// A frame is shown once all members have drawn it. If a host is silent for the deadline, the leader leaves
/// it out, and the others go on. A host that comes later gets the scene's state between two frames. It is a
/// member again once it has caught up. If a previous leader has crashed, the others hold their picture, and
/// the show continues from the scene of one of them.
///
/// Threads  takeOver() and begin() before there is an App thread; issue(), simulated() and sampling on the
///          App thread; mayShow() on the Draw thread that arrived last; the rest on the network's.
///
/// Size     more than 20 fields: one mutex guards them, because the network's threads, App and Draw change
///          them together.

#include "engine/input/input_device.h"
#include "pipeline/cluster/bus.h"
#include "pipeline/cluster/cluster_file.h"
#include "pipeline/cluster/cluster_stats.h"
#include "pipeline/cluster/compatibility_key.h"
#include "pipeline/cluster/orders.h"
#include "pipeline/cluster/scene_transfer.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace stadion::cluster {

struct LeaderOptions {
  ClusterFile cluster;
  CompatibilityKey key;
  std::chrono::seconds patience{};  ///< limit for hosts that have not come; then the show begins without them
  std::function<void(const std::string&)> tell;
  std::function<bool()> stop;  ///< the wait is no longer wanted
  std::uint64_t above = 0;     ///< the session's number is higher than this, the previous show's
  /// The hosts to wait for, one bit each; another host takes part only if it is present. After a show: the
  /// hosts that were present.
  std::uint32_t expected = ~std::uint32_t{0};
};

/// The operator's choice about hosts that have not come.
enum class WaitDecision {
  Lasts,    ///< the leader goes on waiting for the missing hosts
  Ends,     ///< the show starts without the missing hosts
  GivesUp,  ///< the show does not start
};
using OperatorDecision = std::function<WaitDecision(bool told)>;

/// A show that the other hosts play already.
struct ShowUnderWay {
  TimeSignature last;                                      ///< last frame before the show continues
  std::shared_ptr<const std::vector<std::uint8_t>> state;  ///< snapshot of the scene
  std::uint64_t files = 0;                                 ///< Scene::files()
  Standstill still{};                                      ///< whether the show stood still
  Presentation presentation{};                             ///< how that frame was shown
};

/// How a host of the cluster is.
struct HostState {
  std::string name;
  enum class Is { Leads, Plays, Joins, Absent } is = Is::Absent;
  bool differs = false;  ///< its scene differs from the leader's
};

class ClusterLeader final : public FrameOrders, public BusListener {
public:
  /// Number of deadlines after which a host that lives but draws nothing is left out.
  static constexpr double kStuck = 10;

  static Result<std::unique_ptr<ClusterLeader>> open(LeaderOptions options);
  /// Returns a leader without a network, which receives only what receive() is given and sends no scene.
  static std::unique_ptr<ClusterLeader> unconnected(LeaderOptions options, std::uint64_t session);
  ~ClusterLeader() override;

  /// Looks for a show that the other hosts play since its leader crashed, and has one of them send its scene.
  /// Returns nothing if there is none: the show begins. Takes at most two seconds if hosts are missing.
  /// Expects that no show of our own has begun.
  std::optional<ShowUnderWay> takeOver();
  /// Waits until all hosts have opened the show, or until the time limit has passed. Calls `operators`
  /// repeatedly for the operator's choice, with whether he has heard which hosts are missing. `rate` in 1/s.
  /// Returns false if the operator gives up: nothing has begun.
  bool begin(
      double rate, const OperatorDecision& operators = [](bool) { return WaitDecision::Lasts; });
  /// The hosts that played with us at the end or shortly before, one bit each. Call it after finish().
  std::uint32_t played() const;
  bool hasBegun() const;
  std::uint64_t session() const;  ///< number of the session
  /// Wraps the show's input: each sample also goes to all hosts. `inner` must outlive it.
  InputDevice& input(InputDevice& inner);
  /// Sets how the scene's state is saved, between two frames.
  void saveWith(std::function<SavedScene()> save) { save_ = std::move(save); }
  /// Returns true if the scene is compared after that frame, by its digest().
  bool compares(std::uint64_t frame) const { return frame % options_.cluster.hashEvery == 0; }
  void simulated(std::uint64_t frame, std::uint64_t digest);
  ClusterStats stats() const;
  std::vector<HostState> hosts() const;
  /// Returns true if another program leads this cluster already: ours must end.
  bool hasDouble() const;
  /// Waits until all hosts have received everything. With `over`, also ends the show for all.
  void finish(bool over);

  bool leads() const override { return true; }
  void issue(FrameOrder& order) override;
  std::optional<FrameOrder> next() override { return {}; }
  bool mayShow(const TimeSignature& now) override;

  using BusListener::receive;
  void receive(const Session& session) override;
  void receive(const Presence& presence) override;
  void receive(const Drawn& drawn) override;
  void receive(const SceneHash& hash) override;
  void receive(const Difference& difference) override;
  void receive(const StatePart& part) override;
  void left(std::uint8_t node, std::uint64_t incarnation) override;

private:
  class SampledInput;
  using Clock = std::chrono::steady_clock;

  struct Follower {
    std::uint64_t incarnation = 0;  ///< 0: the host is absent
    std::uint64_t session = 0;      ///< the session that it is in; 0: none
    std::uint64_t plays = 0;        ///< the session of its scene; 0: it has none
    std::uint64_t serial = 0;       ///< last order that the host's scene has applied
    std::uint64_t show = 0;         ///< CompatibilityKey::show() of that session
    Phase phase = Phase::Waiting;
    bool member = false, asks = false;
    bool differs = false;  ///< the host's scene differs from ours, and the host has not joined again since
  };
  /// The last sample from a host, present or not.
  struct Word {
    std::uint64_t incarnation = 0, count = 0;
    std::optional<Clock::time_point> gone{};  ///< time at which the host stopped playing
  };
  /// An order that not all hosts have drawn.
  struct OrderEpoch {
    std::uint64_t serial = 0, frame = 0;
    std::uint32_t awaited = 0;
    std::optional<Clock::time_point> drawnHere{};
  };

  ClusterLeader(LeaderOptions options, std::uint64_t session);
  std::optional<std::size_t> newestOf(std::uint32_t nodes) const;
  void send(const InputSample* input);
  void answerRequests();
  void sendTransfers();
  void leaveOut(std::size_t node, const std::string& why);
  void letGo(std::size_t node);
  void leaveOutStuckFollowers();
  std::vector<std::string> missing() const;
  void release();
  void compare(std::size_t node, std::uint64_t frame, std::uint64_t hash);
  bool waits() const { return !double_ && !options_.stop(); }
  const std::string& nameOf(std::size_t node) const { return options_.cluster.nodes[node].name; }

  LeaderOptions options_;
  Session session_{};
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Follower> followers_;  ///< by host
  std::vector<Word> words_;          ///< by host
  std::uint32_t played_ = ~std::uint32_t{0};
  FrameOrder pending_;
  bool awaitsInput_ = false;   ///< an order waits for its input
  std::uint32_t explain_ = 0;  ///< hosts that must say with it where their scene differs
  bool stop_ = false;          ///< scenes differ, and this ends the show
  std::uint64_t serial_ = 0, go_ = 0, shown_ = 0;
  std::deque<OrderEpoch> epochs_;                               ///< by serial
  std::uint8_t latest_ = 0;                                     ///< the host that has drawn last
  std::deque<std::pair<std::uint64_t, std::uint64_t>> hashes_;  ///< ours: frame, hash
  std::vector<SceneHash> early_;  ///< hashes of frames that we have not simulated yet
  std::deque<SceneTransfer> transfers_;
  IncomingScene incoming_;  ///< from the host that sends us the show
  bool ending_ = false, double_ = false;
  std::function<SavedScene()> save_;
  std::unique_ptr<SampledInput> input_;
  WrittenOrder written_;
  ClusterStats stats_;
  std::unique_ptr<Bus> bus_;
  std::thread sender_;
};

}  // namespace stadion::cluster
