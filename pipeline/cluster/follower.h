#pragma once
/// A machine that plays what another one orders: the same show, frame by frame.
///
/// It opens the show from its own files; if that is under way already, it goes on from the leading machine's
/// scene. Where an order is missing, or another program leads now, it has to join again, with a follower of
/// its own. Who leads anew has lost the show: then the follower that has come farthest gives it its scene. So
/// each keeps the scene that it had until it obeys the first order after another one: who leads may die while
/// there is no other.
///
/// Threads  join(), next(), simulated() and sampling on the App thread (join() before there is one);
///          mayShow() on the Draw thread that arrived last; the rest on the network's. Scenes are given on
///          threads of their own.

#include "engine/input/input_device.h"
#include "pipeline/cluster/agreement.h"
#include "pipeline/cluster/bus.h"
#include "pipeline/cluster/cluster_file.h"
#include "pipeline/cluster/orders.h"
#include "pipeline/cluster/scene_parcel.h"
#include "pipeline/cluster/tally.h"

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
  Agreement terms;
  std::function<void(const std::string&)> tell;
  std::function<bool()> stop;               ///< nobody waits any longer
  std::function<bool()> leave{};            ///< no further order is to be obeyed
  std::shared_ptr<const KeptScene> kept{};  ///< by the follower before
  std::uint64_t played = 0;                 ///< the session of that; 0: there was none
};

/// How the show is to be opened.
struct Joining {
  double rate = 60;     ///< [1/s]
  TimeSignature after;  ///< with a state: of what was simulated last
  /// What the scene goes on from; null: the show begins.
  std::shared_ptr<const std::vector<std::uint8_t>> state;
  std::uint64_t files = 0;  ///< with a state: Scene::files() there
  bool playsLog = false;    ///< an input log, which we have, too
};

class Follower final : public FrameOrders, public BusListener {
public:
  static Result<std::unique_ptr<Follower>> open(FollowerOptions options);
  /// One that hears only what hear() is given.
  static std::unique_ptr<Follower> unconnected(FollowerOptions options, std::uint64_t incarnation);
  ~Follower() override;

  /// Waits for who leads, and for the scene's state if the show is under way. Nothing: nobody waits any
  /// longer, or the shows differ; then it has been told.
  std::optional<Joining> join();
  /// Where the scene differs from one that was written down elsewhere: its place and field, here, there;
  /// nothing: it does not. Called on the App thread, between two frames.
  struct Differs {
    std::string where, here, there;
  };
  using Compare = std::function<std::optional<Differs>(const SavedScene& there)>;
  void compareWith(Compare compare) { compare_ = std::move(compare); }
  /// What the leading machine has sampled for the frame that next() has given.
  InputDevice& input() { return *input_; }
  bool compares(std::uint64_t frame) const { return frame % options_.cluster.hashEvery == 0; }
  /// The scene's digest() after that frame.
  void simulated(std::uint64_t frame, std::uint64_t digest);
  /// Orders are missing: the run has ended, and the show is to be joined again.
  bool isToJoinAgain() const;
  /// Another program is this node already: ours is to end.
  bool hasDouble() const;
  /// Who leads has other files than we have.
  bool isRefused() const;
  /// Who leads has ended the show for all.
  bool isOver() const;
  /// The show is over, and its last frame was not shown here: we were still catching up, or had been left
  /// out.
  bool missedTheEnd() const;
  std::uint64_t session() const;  ///< the number of the one that was joined; 0: none
  /// The run has ended, and the scene is to be kept: for who leads anew and asks for it, or for the next
  /// follower.
  bool keepsScene() const;
  /// The scene as it is now; `last` has been simulated last. Whoever asks gets it.
  void keep(const TimeSignature& last, SavedScene scene);
  /// Null: there is none, or it is not that of the others.
  std::shared_ptr<const KeptScene> kept() const;
  Tally tally() const;
  void finish();

  bool leads() const override { return false; }
  void issue(FrameOrder&) override {}
  std::optional<FrameOrder> next() override;
  bool mayShow(const TimeSignature& now) override;

  using BusListener::hear;
  void hear(const Session& session) override;
  void hear(const Presence& presence) override;
  void hear(const Order& order) override;
  void hear(const Go& go) override;
  void hear(const StatePart& part) override;

private:
  class OrderedInput;

  Follower(FollowerOptions options, std::uint64_t incarnation);
  bool isOurs(const Session& session) const;
  void announce(Phase phase);
  void announceProgress();
  void giveIfAsked();
  std::optional<Joining> joinSession(std::unique_lock<std::mutex>& lock);
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
  std::uint64_t show_ = 0;    ///< Agreement::show() of that
  std::deque<HeardOrder> orders_;
  IncomingScene incoming_;        ///< of who leads
  std::uint64_t frame_ = 0;       ///< obeyed last
  Standstill still_{};            ///< whether the show stood with it
  Presentation presentation_{};   ///< and so it was shown
  std::optional<bool> isMember_;  ///< by the newest order, whoever of our name that is
  Compare compare_;
  std::uint64_t obeyed_ = 0, go_ = 0, shown_ = 0;
  std::uint64_t framesShown_;  ///< the last frame that our walls have shown, and one; 0: none
  std::uint64_t frames_ = 0;   ///< once the show is over: the last one that was shown anywhere, and one
  std::uint8_t latest_ = 0;
  Phase told_ = Phase::Waiting;
  std::uint64_t announced_ = 0;  ///< how often
  std::uint64_t toldSerial_ = 0;
  std::deque<std::pair<std::uint64_t, bool>>
      shows_;  ///< orders obeyed and not shown yet: whether we draw them
  bool again_ = false, double_ = false, refused_ = false;
  bool over_ = false;                      ///< who leads has ended the show
  bool plays_ = false;                     ///< there is a scene from which the show can go on
  bool differs_ = false;                   ///< but it is not that of the others
  std::shared_ptr<const KeptScene> kept_;  ///< until there is another one
  std::uint64_t given_ = 0;                ///< the session to whose leader it has been
  std::vector<std::thread> giving_;
  InputSample sample_;
  bool sampled_ = false;
  std::unique_ptr<InputDevice> input_;
  Tally tally_;
  std::unique_ptr<Bus> bus_;
};

}  // namespace stadion::cluster
