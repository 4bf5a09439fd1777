#pragma once
/// A machine's part in a cluster: `run --cluster FILE --node NAME`.
///
/// Threads  main, but for simulated(), which is App's.

#include "pipeline/cluster/follower.h"
#include "pipeline/cluster/lead.h"
#include "pipeline/record/run_summary.h"
#include "show/base/telling_thread.h"
#include "show/console/live_desk.h"
#include "show/settings/run_options.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

class Scene;

class ClusterPart {
public:
  /// Reads the cluster file and completes the options by it, which must outlive it: walls, and which of them
  /// are ours. Null without --cluster, or if something is wrong; then the findings say what.
  static std::unique_ptr<ClusterPart> create(RunOptions& options, Diagnostics& findings);

  bool leads() const { return node_ == file_.lead; }
  /// Waits for the others as far as needed to know how the show begins, and completes what it is opened with:
  /// who leads, where the others play already; who follows, for who leads. False: it is not to be; if the
  /// findings do not say why, nobody waits any longer.
  bool join(ShowOptions& show, Diagnostics& findings);
  /// The show was under way when we came, or came back.
  bool goesOn() const { return goesOn_; }
  /// Of a show that goes on, once it has been opened: whether its files are those that it is played with
  /// elsewhere.
  bool hasFiles(const Scene& scene) const { return scene.files() == files_; }
  /// They are not, or the scene that was sent cannot be put back with them. Who follows may come again when
  /// they are alike.
  void refuseFiles(Diagnostics& findings);
  /// The same for who leads: the show begins anew for all, with the files that are here. `found`: what was in
  /// the way. False, with findings: there is no network.
  bool beginAnew(const Diagnostics& found, Diagnostics& findings);
  /// The show has been opened. Who leads waits for the others, unless the operator has no patience. False,
  /// with findings: there is no network; or without: a window is gone. `takeKeys`: brings those of windows
  /// into `asked`; false: one is gone.
  bool begin(Player& player, const OperatorQueue& asked, const std::function<bool()>& takeKeys,
             Diagnostics& findings);
  /// The other machines' say in what is played, and what had been decided about a show that goes on. After
  /// begin().
  void addTo(FrameLoopOptions& loop, LiveDesk& desk);
  /// What the show's parts sample: the same on all machines. After begin().
  InputDevice* inputOf(Player& player);
  void simulated(const TimeSignature& now);
  /// The run has ended for want of an order, and the show is to be joined again.
  bool isToJoinAgain() const { return follower_ && follower_->isToJoinAgain(); }
  /// Another program plays this node already; it has been told, and this one is to end.
  bool hasDouble() const;
  /// join() has failed because who leads has ended the show: nothing is left to join.
  bool isOver() const { return over_; }
  /// The show is over, and its last frame was not shown here.
  bool missedTheEnd() const { return follower_ && follower_->missedTheEnd(); }
  /// There is no show because who leads has other files.
  bool hasOtherFiles() const { return otherFiles_; }
  /// What there is to tell is heard by all; who leads anew gets our scene if it asks for it. `over`: where we
  /// lead, the show ends for all.
  void finish(bool over);
  ClusterSummary summary() const;

private:
  ClusterPart(const RunOptions& options, ClusterFile file, std::size_t node)
      : options_(options), file_(std::move(file)), node_(node), teller_(options.say) {}
  void tell(const std::string& what);
  bool openLead(Diagnostics& findings);
  bool follow(ShowOptions& show, Diagnostics& findings);

  cluster::SavedScene saved() const;
  std::optional<cluster::Follower::Differs> differenceTo(const cluster::SavedScene& there) const;
  void plantDifference();

  const RunOptions& options_;
  ClusterFile file_;
  std::size_t node_;
  TellingThread teller_;
  std::optional<std::uint64_t>
      planted_;  ///< the frame after which a bit is changed, to see whether that is found
  Player* player_ = nullptr;
  bool goesOn_ = false, over_ = false, otherFiles_ = false;
  std::uint64_t files_ = 0;                ///< with which it went on elsewhere
  std::optional<TimeSignature> after_;     ///< the show goes on after that
  std::optional<OperatorState> operator_;  ///< and what had been decided about it
  TimeSignature last_;                     ///< simulated
  std::unique_ptr<cluster::Lead> lead_;
  std::unique_ptr<cluster::Follower> follower_;
  std::shared_ptr<const cluster::KeptScene> kept_;  ///< of the show that the follower before played
};

}  // namespace stadion
