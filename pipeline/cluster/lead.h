#pragma once
/// The machine whose clock and trackers count: says what frame comes next, and when all may show it.
///
/// A frame is shown once all members have drawn it. Who is not heard of for the deadline is left out, and the
/// others go on; who comes later gets the scene's state between two frames, and is a member again once it has
/// caught up. If another program led before and has died, the others hold their picture, and the show goes on
/// from the scene of one of them.
///
/// Threads  takeOver() and begin() before there is an App thread; issue(), simulated() and sampling on the
/// App thread; mayShow() on the Draw thread that
///          arrived last; the rest on the network's.

#include "engine/input/input_device.h"
#include "pipeline/cluster/agreement.h"
#include "pipeline/cluster/bus.h"
#include "pipeline/cluster/cluster_file.h"
#include "pipeline/cluster/orders.h"
#include "pipeline/cluster/scene_parcel.h"
#include "pipeline/cluster/tally.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace stadion::cluster {

struct LeadOptions {
  ClusterFile cluster;
  Agreement terms;
  std::chrono::seconds patience{};  ///< with nodes that have not come; then the show begins without them
  std::function<void(const std::string&)> tell;
  std::function<bool()> stop;  ///< nobody waits any longer
  std::uint64_t above = 0;     ///< the session's number is: that of the show before
  /// Nodes, by bits, that are waited for; another one only if it is there. After a show: who was there.
  std::uint32_t expected = ~std::uint32_t{0};
};

/// The operator's, with nodes that have not come.
enum class Patience {
  Lasts,
  Ends,     ///< the show is to begin without them
  GivesUp,  ///< it is not to begin
};
using OperatorsPatience = std::function<Patience(bool told)>;

/// A show that the others play already.
struct ShowUnderWay {
  TimeSignature last;                                      ///< of the frame after which it goes on
  std::shared_ptr<const std::vector<std::uint8_t>> state;  ///< of its scene
  std::uint64_t files = 0;                                 ///< Scene::files()
  Standstill still{};                                      ///< whether it stood
  Presentation shown{};                                    ///< how that frame was shown
};

class Lead final : public FrameOrders, public BusListener {
public:
  /// Deadlines: a node that lives but draws nothing is left out after so many.
  static constexpr double kStuck = 10;

  static Result<std::unique_ptr<Lead>> open(LeadOptions options);
  /// One that hears only what hear() is given, and sends no scene to anybody.
  static std::unique_ptr<Lead> unconnected(LeadOptions options, std::uint64_t session);
  ~Lead() override;

  /// Looks for a show that the others play, since who led them has died, and has one of them send its scene.
  /// Nothing: there is none, so the show begins. Takes two seconds at most where nodes are missing. Expects
  /// that none of our own has begun.
  std::optional<ShowUnderWay> takeOver();
  /// Waits until all nodes have opened the show, or patience is at its end; `operators` is asked for the
  /// operator's again and again, and told whether he has heard for whom is waited. `rate` in 1/s. False: he
  /// gives up, and nothing has begun.
  bool begin(
      double rate, const OperatorsPatience& operators = [](bool) { return Patience::Lasts; });
  /// The nodes that played with us at the end or shortly before, by bits. After finish().
  std::uint32_t played() const;
  bool hasBegun() const;
  std::uint64_t session() const;  ///< its number
  /// What becomes of the show's input: each sample goes to all. `inner` must outlive it.
  InputDevice& input(InputDevice& inner);
  /// How the scene's state is written down, between two frames.
  void saveWith(std::function<SavedScene()> save) { save_ = std::move(save); }
  /// The scene after a frame, where it is compared: its digest().
  bool compares(std::uint64_t frame) const { return frame % options_.cluster.hashEvery == 0; }
  void simulated(std::uint64_t frame, std::uint64_t digest);
  Tally tally() const;
  /// Another program leads this cluster already: ours is to end.
  bool hasDouble() const;
  /// Waits until all have heard what there was to hear; `over`: and that the show has been ended for all.
  void finish(bool over);

  bool leads() const override { return true; }
  void issue(FrameOrder& order) override;
  std::optional<FrameOrder> next() override { return {}; }
  bool mayShow(const TimeSignature& now) override;

  using BusListener::hear;
  void hear(const Session& session) override;
  void hear(const Presence& presence) override;
  void hear(const Drawn& drawn) override;
  void hear(const SceneHash& hash) override;
  void hear(const Difference& difference) override;
  void hear(const StatePart& part) override;
  void left(std::uint8_t node, std::uint64_t incarnation) override;

private:
  class SampledInput;
  using Clock = std::chrono::steady_clock;

  struct Follower {
    std::uint64_t incarnation = 0;  ///< 0: it is not there
    std::uint64_t session = 0;      ///< that it is in; 0: none
    std::uint64_t plays = 0;        ///< the session of which it has a scene; 0: none
    std::uint64_t serial = 0;       ///< of the order after which that is
    std::uint64_t show = 0;         ///< Agreement::show() of that session
    Phase phase = Phase::Waiting;
    bool member = false, asks = false;
    bool differs = false;  ///< its scene, and it has not joined again since
  };
  /// What was heard last of a node, there or not.
  struct Word {
    std::uint64_t incarnation = 0, count = 0;
    std::optional<Clock::time_point> gone{};  ///< when it played no longer
  };
  /// An order that not all have drawn.
  struct Round {
    std::uint64_t serial = 0, frame = 0;
    std::uint32_t awaited = 0;
    std::optional<Clock::time_point> drawnHere{};
  };

  Lead(LeadOptions options, std::uint64_t session);
  std::optional<std::size_t> newestOf(std::uint32_t nodes) const;
  void send(const InputSample* input);
  void answerWhoAsks();
  void sendParcels();
  void leaveOut(std::size_t node, const std::string& why);
  void letGo(std::size_t node);
  void leaveOutWhoIsStuck();
  std::vector<std::string> missing() const;
  void release();
  void compare(std::size_t node, std::uint64_t frame, std::uint64_t hash);
  bool waits() const { return !double_ && !options_.stop(); }
  const std::string& nameOf(std::size_t node) const { return options_.cluster.nodes[node].name; }

  LeadOptions options_;
  Session session_{};
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Follower> followers_;  ///< by node
  std::vector<Word> words_;          ///< by node
  std::uint32_t played_ = ~std::uint32_t{0};
  FrameOrder pending_;
  bool awaitsInput_ = false;   ///< an order waits for its input
  std::uint32_t explain_ = 0;  ///< who is to say with it where its scene differs
  bool stop_ = false;          ///< scenes differ, and that is to end the show
  std::uint64_t serial_ = 0, go_ = 0, shown_ = 0;
  std::deque<Round> rounds_;                                    ///< by serial
  std::uint8_t latest_ = 0;                                     ///< who has drawn last
  std::deque<std::pair<std::uint64_t, std::uint64_t>> hashes_;  ///< ours: frame, hash
  std::vector<SceneHash> early_;                                ///< of frames that we have not simulated yet
  std::deque<SceneParcel> parcels_;
  IncomingScene incoming_;  ///< of who gives us the show
  bool ending_ = false, double_ = false;
  std::function<SavedScene()> save_;
  std::unique_ptr<SampledInput> input_;
  WrittenOrder written_;
  Tally tally_;
  std::unique_ptr<Bus> bus_;
  std::thread sender_;
};

}  // namespace stadion::cluster
