#pragma once
/// The processes that play all hosts of a cluster on this machine.
///
/// - A process that crashes, or ends with kFailed, is restarted: at once the first time, later after growing
///   pauses.
/// - A follower that ends with kOtherFiles is restarted every few seconds, because its files may be changing.
/// - When the leader has ended for good, the followers are asked to end.
/// - A process that was asked to end and still runs after `patience` is killed.
/// - A leader that shows nothing is killed. The leader itself notices a follower that hangs.
///
/// Ownership  owns the processes, and kills those that still run when it is destroyed. The reporter must
///            outlive it.
/// Threads    main.

#include "pipeline/cluster/cluster_file.h"
#include "pipeline/platform/child_process.h"
#include "pipeline/process/restarts.h"
#include "pipeline/record/journal.h"
#include "pipeline/supervision/hang_watch.h"
#include "pipeline/supervision/shared_progress.h"
#include "show/base/reporter.h"

#include <atomic>
#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

class ClusterNodes {
public:
  /// Longer than a healthy process takes to end: it gives up its frames after five seconds.
  static constexpr std::chrono::milliseconds kPatience{10000};

  /// `once`: no process is restarted.
  ClusterNodes(const ClusterFile& cluster, bool once, Reporter& reporter,
               std::chrono::milliseconds patience = kPatience)
      : lead_(cluster.lead), stopOnDifference_(cluster.stopOnDifference), once_(once), reporter_(reporter),
        patience_(patience) {}
  /// In the file's order. `words`: the program and its arguments. Its journal, if it has one, also learns how
  /// it ends.
  void add(std::string name, std::vector<std::string> words, std::unique_ptr<Journal> journal = nullptr);

  /// All output must be complete: a process that is not done when the show has ended has failed.
  void needAll() { needsAll_ = true; }
  /// The leader is killed if it shows nothing for so long [ns]; its words name the descriptor of `progress`.
  void watchLead(std::unique_ptr<SharedProgress> progress, Nanoseconds after);
  /// Starts all processes and supervises them until all have ended. Returns the status of the whole
  /// (ProcessStatus).
  int play();
  /// The standard output of all processes: each under its name, or as one JSON object.
  std::string said() const;
  std::string saidAsJson() const;

private:
  using Clock = std::chrono::steady_clock;
  enum class State { Plays, Pauses, Ended };
  struct Node {
    std::string name;
    std::vector<std::string> words;
    std::unique_ptr<Journal> journal{};
    State state = State::Ended;
    int status = 0;  ///< the last exit status; 128 + signal
    unsigned starts = 0;
    int died = 0;                ///< how it ended before it was restarted the first time
    bool asked = false;          ///< by us, to end
    bool waitsForFiles = false;  ///< the node was reported as waiting for other files
    Clock::time_point begun{}, notBefore{};
    wall_process::Restarts restarts{};
    FileDescriptor said{};
    ChildProcess child{};
  };

  void say(const std::string& what) { reporter_.hint("cluster: " + what); }
  void sayOf(const Node& node, const std::string& what);
  bool begin(Node& node);
  void poll(Node& node);
  void ended(Node& node, int status);
  bool isStop(const Node& node) const;
  bool isDeath(const Node& node) const;
  bool isIncomplete(const Node& node) const;
  bool leadIsGone() const { return nodes_[lead_].state == State::Ended; }
  void endWithLead();
  void ask(int signal);
  void killHangingNodes();
  void killHangingLead();
  void endLeadOfEndedShow();
  bool anyLeft() const;
  int code() const;

  std::size_t lead_;
  bool stopOnDifference_, once_;
  Reporter& reporter_;
  std::chrono::milliseconds patience_;
  const std::atomic<bool>* stop_ = nullptr;
  std::deque<Node> nodes_;
  std::unique_ptr<SharedProgress> progress_;  ///< progress of the leader; null: the leader is not watched
  Nanoseconds hangsAfter_ = 0;
  std::optional<HangWatch> watch_{};
  std::optional<Clock::time_point> goneSince_{};   ///< the leader
  std::optional<Clock::time_point> askedSince_{};  ///< the nodes, to end
  bool needsAll_ = false;
  bool othersAsked_ = false;  ///< to end after the leader
};

}  // namespace stadion
