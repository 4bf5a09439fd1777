#pragma once
/// The processes that play a cluster's nodes on this machine: begun together, looked after, ended together.
///
/// A node that dies, by a signal or with exit code 3, begins again: at once the first time, after pauses that
/// grow if it dies soon after it has begun. So does, every few seconds, a follower whose files are not those
/// of who leads, with exit code 4: somebody may be changing them. When who leads is gone for good, the others
/// have nobody to wait for. Who was asked to end and has not so long after hangs, and is killed. So is who
/// leads if it shows nothing any longer: of a follower the others notice by themselves.
///
/// Ownership  owns the processes; those that still run when it goes are killed.
/// Threads    main.

#include "pipeline/cluster/cluster_file.h"
#include "pipeline/platform/child_process.h"
#include "pipeline/process/restarts.h"
#include "pipeline/record/journal.h"
#include "pipeline/supervision/hang_watch.h"
#include "pipeline/supervision/shared_progress.h"

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
  /// What is not drawn five seconds after it was asked to end a node gives up by itself: one that is well has
  /// ended by then.
  static constexpr std::chrono::milliseconds kPatience{10000};

  /// `once`: nobody begins again. `patience`: with who is to end.
  ClusterNodes(const ClusterFile& cluster, bool once, std::chrono::milliseconds patience = kPatience)
      : lead_(cluster.lead), stopOnDifference_(cluster.stopOnDifference), once_(once), patience_(patience) {}
  /// In the file's order. `words`: the program and its arguments. What becomes of it is told in its journal,
  /// too, if it has one.
  void add(std::string name, std::vector<std::string> words, std::unique_ptr<Journal> journal = nullptr);

  /// What they write is to be whole: a node that is not done when the show has come to its end has failed.
  void needAll() { needsAll_ = true; }
  /// Who leads is killed if it shows nothing for so long [ns]; its words name the descriptor of `progress`.
  void watchLead(std::unique_ptr<SharedProgress> progress, Nanoseconds after);
  /// Begins them all and looks after them until all have ended. The exit code.
  int play();
  /// What the nodes have said: each under its name, or as one JSON object.
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
    int died = 0;                ///< how, the first time that it was begun again
    bool asked = false;          ///< by us, to end
    bool waitsForFiles = false;  ///< it has been told that they are others
    Clock::time_point begun{}, notBefore{};
    worker::Restarts restarts{};
    Descriptor said{};
    ChildProcess child{};
  };

  static void sayOf(const Node& node, const std::string& what);
  bool begin(Node& node);
  void look(Node& node);
  void ended(Node& node, int status);
  bool isStop(const Node& node) const;
  bool isDeath(const Node& node) const;
  bool isIncomplete(const Node& node) const;
  bool leadIsGone() const { return nodes_[lead_].state == State::Ended; }
  void endWithLead();
  void ask(int signal);
  void killWhoHangs();
  void killHangingLead();
  void endLeadOfNobody();
  bool anyLeft() const;
  int code() const;

  std::size_t lead_;
  bool stopOnDifference_, once_;
  std::chrono::milliseconds patience_;
  const std::atomic<bool>* stop_ = nullptr;
  std::deque<Node> nodes_;
  std::unique_ptr<SharedProgress> progress_;  ///< of who leads; null: nobody watches it
  Nanoseconds hangsAfter_ = 0;
  std::optional<HangWatch> watch_{};
  std::optional<Clock::time_point> goneSince_{};   ///< who leads
  std::optional<Clock::time_point> askedSince_{};  ///< the nodes, to end
  bool needsAll_ = false;
  bool othersAsked_ = false;  ///< to end after who leads
};

}  // namespace stadion
