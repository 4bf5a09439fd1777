#pragma once
/// A machine's part in a cluster, as its leader or as a follower.
///
/// Threads  main, but for simulated(), which is App's.

#include "engine/scene/scene_snapshot.h"
#include "pipeline/cluster/cluster_leader.h"
#include "pipeline/cluster/follower.h"
#include "pipeline/record/run_summary.h"
#include "show/base/async_log_writer.h"
#include "show/cluster/cluster_settings.h"
#include "show/console/operator_console.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

class Scene;

class ClusterSession {
public:
  /// Reads the cluster file and completes `show` by it: the walls, and which of them are drawn here. `show`
  /// must outlive it. Null if the settings name no cluster, or with the reason in the findings.
  static std::unique_ptr<ClusterSession> create(const ClusterSettings& settings, ShowOptions& show,
                                                StereoLayout layout,
                                                std::function<void(const std::string&)> say,
                                                Diagnostics& findings);

  /// False: this machine has no walls. Then it takes the frames of another one's wall, and draws nothing.
  bool hasWalls() const { return !file_.nodes[node_].walls.empty(); }
  bool leads() const { return node_ == file_.lead; }
  /// Waits until it is known how the show begins, and completes `show` by it. The leader takes the show from
  /// followers that already play it; a follower waits for the leader. False: there is no show; if the
  /// findings do not say why, the wait was given up.
  bool join(ShowOptions& show, Diagnostics& findings);
  /// The show was already playing when this machine joined it.
  bool goesOn() const { return goesOn_; }
  /// Returns true if the other machines play the same files. For a show that goes on, once it has been
  /// opened.
  bool hasFiles(const Scene& scene) const { return SceneSnapshot::filesOf(scene) == files_; }
  /// The files differ, or the snapshot that was sent cannot be restored with them. A follower may come again
  /// when they are equal.
  void refuseFiles(Diagnostics& findings);
  /// Restarts the show for all machines, with the files of the leader. `found`: the reason. Returns false,
  /// with findings, if there is no network.
  bool restartShow(const Diagnostics& found, Diagnostics& findings);
  /// The show has been opened. The leader waits for the followers, until the operator hurries. `takeKeys`
  /// brings keys of windows into `asked`; it returns false if a window was lost. False, with findings: there
  /// is no network; without: a window was lost.
  bool begin(Player& player, const OperatorQueue& asked, const std::function<bool()>& takeKeys,
             Diagnostics& findings);
  /// Adds the orders of the other machines, and the operator's decisions about a show that goes on. After
  /// begin().
  void addTo(FrameLoopOptions& loop, OperatorConsole& console);
  /// Returns the input that the show's parts sample: it is the same on all machines. Call it after begin().
  InputDevice* inputOf(Player& player);
  void simulated(const TimeSignature& now);
  /// The run has ended because no order came, and the show is to be joined again.
  bool mustRejoin() const { return follower_ && follower_->mustRejoin(); }
  /// Another program already plays this node; it was reported, and this program is to end.
  bool hasDouble() const;
  /// join() has failed because the leader has ended the show.
  bool isOver() const { return over_; }
  /// The show is over, and its last frame was not shown here.
  bool missedTheEnd() const { return follower_ && follower_->missedTheEnd(); }
  /// There is no show because the leader has other files.
  bool hasOtherFiles() const { return otherFiles_; }
  /// Waits until all machines have the last messages. A new leader gets this machine's scene if it asks for
  /// it. `over`: if this machine leads, the show ends for all.
  void finish(bool over);
  ClusterSummary summary() const;
  /// Returns how all hosts are, as the leader knows; none on a follower. On the App thread.
  std::vector<cluster::HostState> hosts() const {
    return lead_ ? lead_->hosts() : std::vector<cluster::HostState>();
  }

private:
  ClusterSession(const ShowOptions& show, StereoLayout layout, ClusterFile file, std::size_t node,
                 std::function<void(const std::string&)> say)
      : show_(show), layout_(layout), file_(std::move(file)), node_(node), log_(std::move(say)) {}
  void report(const std::string& what);
  bool openLead(Diagnostics& findings);
  bool follow(ShowOptions& show, Diagnostics& findings);

  cluster::SavedScene saved() const;
  std::optional<cluster::Follower::Differs> differenceTo(const cluster::SavedScene& there) const;
  void plantDifference();

  const ShowOptions& show_;
  StereoLayout layout_;
  ClusterFile file_;
  std::size_t node_;
  AsyncLogWriter log_;
  std::optional<std::uint64_t>
      planted_;  ///< the frame after which a bit is changed, to see whether that is found
  Player* player_ = nullptr;
  bool goesOn_ = false, over_ = false, otherFiles_ = false;
  std::uint64_t files_ = 0;                ///< hash of the files with which the show went on elsewhere
  std::optional<TimeSignature> after_;     ///< the show goes on after that
  std::optional<OperatorState> operator_;  ///< the operator's decisions about that show
  TimeSignature last_;                     ///< simulated
  std::unique_ptr<cluster::ClusterLeader> lead_;
  std::unique_ptr<cluster::Follower> follower_;
  std::shared_ptr<const cluster::ResumableScene> kept_;  ///< scene of the show that the follower played before
};

}  // namespace stadion
