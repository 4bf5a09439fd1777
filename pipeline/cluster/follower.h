#pragma once
/// Follows the leader's orders: plays the same show, frame by frame.
///
/// It opens the show from its own files. If the show is under way, it continues from the leader's scene. If
/// an order is missing or another program leads, the host has to join again, with a new follower. A new
/// leader has no scene: the follower that has come farthest sends it one. So each follower keeps its scene
/// until it has applied the first order after a change. The leader may crash while there is no other.
///
/// Threads  join(), next(), simulated() and sampling on the App thread (join() before there is one);
///          mayShow() on the Draw thread that arrived last; the rest on the network's. Scenes are sent on
///          threads of their own.
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

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace stadion::cluster {

struct FollowerOptions {
  ClusterFile cluster;
  std::size_t node = 0;
  CompatibilityKey key;
  std::function<void(const std::string&)> tell;
  std::function<bool()> stop;                    ///< the wait is no longer wanted
  std::function<bool()> leave{};                 ///< no further order is to be applied
  std::shared_ptr<const ResumableScene> kept{};  ///< the scene that the previous follower kept
  std::uint64_t played = 0;                      ///< the previous follower's session; 0: there was none
};

/// How the show is to be opened.
struct JoinTerms {
  double rate = 60;     ///< [1/s]
  TimeSignature after;  ///< with a state: of the frame simulated last
  /// The state from which the scene continues; null: the show begins.
  std::shared_ptr<const std::vector<std::uint8_t>> state;
  std::uint64_t files = 0;  ///< with a state: Scene::files() there
  bool playsLog = false;    ///< the leader plays an input log, which this host has, too
};

class Follower final : public FrameOrders, public BusListener {
public:
  static Result<std::unique_ptr<Follower>> open(FollowerOptions options);
  /// Returns a follower without a network, which receives only what receive() is given.
  static std::unique_ptr<Follower> unconnected(FollowerOptions options, std::uint64_t incarnation);
  ~Follower() override;

  /// Waits for the leader, and for the scene's state if the show is under way. Returns nothing if the wait
  /// was stopped, or if the shows differ. A difference has been logged by then.
  std::optional<JoinTerms> join();
  /// The first difference between the scene and one saved on another host: its place and field, the value
  /// here, the value there. Nothing if they are equal. Called on the App thread, between two frames.
  struct Differs {
    std::string where, here, there;
  };
  using Compare = std::function<std::optional<Differs>(const SavedScene& there)>;
  void compareWith(Compare compare) { compare_ = std::move(compare); }
  /// The leader's input sample for the frame that next() returned.
  InputDevice& input() { return *input_; }
  bool compares(std::uint64_t frame) const { return frame % options_.cluster.hashEvery == 0; }
  /// Reports the scene's digest() after that frame.
  void simulated(std::uint64_t frame, std::uint64_t digest);
  /// Returns true if orders are missing: the run has ended, and the host is to join again.
  bool mustRejoin() const;
  /// Returns true if another program is this host already: ours must end.
  bool hasDouble() const;
  /// Returns true if the leader has other files than this host.
  bool isRefused() const;
  /// Returns true if the leader has ended the show for all.
  bool isOver() const;
  /// Returns true if the show is over and its last frame was not shown here: this host was still catching up,
  /// or was left out.
  bool missedTheEnd() const;
  std::uint64_t session() const;  ///< the session that was joined; 0: none
  /// Returns true if the run has ended and its scene must be kept. A new leader or the next follower may ask
  /// for it.
  bool keepsScene() const;
  /// Keeps the current scene; `last` is the frame simulated last. Any host that asks gets it.
  void keep(const TimeSignature& last, SavedScene scene);
  /// Returns the kept scene; null if there is none, or if it differs from the others' scene.
  std::shared_ptr<const ResumableScene> kept() const;
  ClusterStats stats() const;
  void finish();

  bool leads() const override { return false; }
  void issue(FrameOrder&) override {}
  std::optional<FrameOrder> next() override;
  bool mayShow(const TimeSignature& now) override;

  using BusListener::receive;
  void receive(const Session& session) override;
  void receive(const Presence& presence) override;
  void receive(const Order& order) override;
  void receive(const Go& go) override;
  void receive(const StatePart& part) override;

private:
  class OrderedInput;

  Follower(FollowerOptions options, std::uint64_t incarnation);
  bool isOurs(const Session& session) const;
  void announce(Phase phase);
  void announceProgress();
  void giveIfAsked();
  void tellEnd();
  const std::string& leader() const { return options_.cluster.nodes[options_.cluster.lead].name; }
  std::optional<JoinTerms> joinSession(std::unique_lock<std::mutex>& lock);
  bool awaitSession(std::unique_lock<std::mutex>& lock);
  bool agrees(const CompatibilityKey& theirs);
  void forgetOtherSessions();
  bool awaitState(std::unique_lock<std::mutex>& lock);
  void continueFromState(JoinTerms& joining);
  bool hasEnded() const { return again_ || over_ || double_; }
  bool leaves() const { return options_.leave && options_.leave(); }
  bool explain(std::unique_lock<std::mutex>& lock);
  void awaitDouble(std::unique_lock<std::mutex>& lock);
  template <class Ready>
  bool await(std::unique_lock<std::mutex>& lock, const char* what, const Ready& ready);

  FollowerOptions options_;
  std::uint64_t incarnation_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  Session session_{};         ///< number 0: there is none
  std::uint64_t joined_ = 0;  ///< the session that we play
  std::uint64_t show_ = 0;    ///< CompatibilityKey::show() of that
  std::deque<HeardOrder> orders_;
  IncomingScene incoming_;        ///< from the leader
  std::uint64_t frame_ = 0;       ///< applied last
  Standstill still_{};            ///< whether the show stood still then
  Presentation presentation_{};   ///< how that frame was shown
  std::optional<bool> isMember_;  ///< by the newest order, for any program with our name
  Compare compare_;
  std::uint64_t appliedSerial_ = 0, go_ = 0, shown_ = 0;
  std::uint64_t framesShown_;  ///< one more than the last frame that our walls have shown; 0: none
  std::uint64_t frames_ = 0;   ///< once the show is over: one more than the last frame that any wall has
                               ///< shown
  std::uint8_t latest_ = 0;
  Phase told_ = Phase::Waiting;
  std::uint64_t announced_ = 0;  ///< number of announcements
  std::uint64_t toldSerial_ = 0;
  std::deque<std::pair<std::uint64_t, bool>>
      shows_;  ///< orders applied and not yet shown: whether we draw them
  bool again_ = false, double_ = false, refused_ = false;
  bool over_ = false;                           ///< the leader has ended the show
  bool endTold_ = false;                        ///< the operator knows it, or that the last frame plays
  bool plays_ = false;                          ///< there is a scene from which the show can go on
  bool differs_ = false;                        ///< but it is not that of the others
  std::shared_ptr<const ResumableScene> kept_;  ///< until there is another one
  std::uint64_t given_ = 0;                     ///< session of the leader to which it was sent
  std::vector<std::thread> giving_;
  InputSample sample_;
  bool sampled_ = false;
  std::unique_ptr<InputDevice> input_;
  ClusterStats stats_;
  std::unique_ptr<Bus> bus_;
};

}  // namespace stadion::cluster
