#pragma once
/// Looks at what a live show's nodes and frames cost, tells overruns, and decides who gives up what.
///
/// Each node with a budget has a ladder of its own (relief_policy.h). The whole show has two means: stress
/// (stress_filter.h), and, once stress can do no more, the ladders of all nodes one after the other, the
/// lowest priority first: what is given up for the frame's sake and for the node's own, the greater counts.
///
/// Decisions are made on the log's thread and taken by App at the start of its next frame.
///
/// Threads  SpanReader's on the log's thread; decide() and see() on App's; reports from any.

#include "engine/core/load_control.h"
#include "profiling/budget/node_costs.h"
#include "profiling/budget/stress_filter.h"
#include "profiling/record/frame_facts.h"
#include "profiling/record/node_names.h"

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <tuple>

namespace stadion {

struct GovernorOptions {
  double rate = 60;                ///< [1/s]
  bool paced = true;               ///< frames come by the clock: what takes longer than one is late
  bool pipelined = true;           ///< else the stages' times add up
  bool acts = true;                ///< else it only tells
  bool drawnElsewhere = false;     ///< other processes draw: what that takes is not known by node
  std::vector<std::string> walls;  ///< names
  StressOptions stress;
  std::function<void(const std::string&)> tell;  ///< a line; on the log's thread
};

/// How a node kept its budget, each time that its file was there.
struct BudgetReport {
  std::string name, file;
  std::uint32_t line = 0;
  double budget = 0;  ///< [ms]; 0 = none
  std::uint64_t frames = 0, overruns = 0;
  double mean = 0, worst = 0;  ///< [ms]
  std::uint64_t worstFrame = 0;
  std::string worstStage;     ///< "App", "Draw of wall front"
  bool drawCounted = true;    ///< else what drawing it took is not in these
  bool drawMeasured = true;   ///< else it was never looked at: it was not seen, or hidden before its turn
  std::uint64_t changes = 0;  ///< times that something was given up or taken back
  std::uint32_t highest = 0, now = 0, levels = 0;  ///< of its ladder
};

/// What stress there was: everything counts as so many times farther away when levels of detail are chosen.
struct StressReport {
  double highest = 1, now = 1;
  std::uint64_t changes = 0;
};

class LoadGovernor final : public SpanReader, public LoadDecider {
public:
  LoadGovernor(GovernorOptions options, const NodeNames& names);

  // Of the log's thread.
  using SpanReader::take;
  void take(std::size_t track, const SpanRecord& record) override;
  void take(const ShortVisits& visits) override;
  void take(const SharedSpan& shared) override;
  void take(const DrawnAlone& drawn, const std::vector<NodeShare>& nodes) override;
  void caughtUp() override;
  /// The worst overrun of a frame that is not over for long.
  std::optional<Overrun> overrunOf(std::uint64_t frame) const;

  // Of App's thread.
  /// Whether it watches others than before.
  bool see(const Scene& scene);
  /// Whom, and on whose account their costs go; null: nobody.
  std::shared_ptr<const NodeAccounts> accounts() const { return accounts_; }
  FrameLoad decide(std::uint64_t frame) override;

  /// By file and line.
  std::vector<BudgetReport> reports() const;
  /// Nothing if it only tells.
  std::optional<StressReport> stress() const;

private:
  struct Governed {
    GovernedNode of;
    ReliefPolicy policy;
    std::uint32_t forFrame = 0;  ///< the level that the whole frame asks of it
    std::uint32_t applied = 0;
    BudgetReport report;
    double sum = 0;
    double toldAt = -1e9;      ///< [s]
    double toldMs = 0;         ///< what it took then
    std::uint64_t untold = 0;  ///< overruns since then
    std::uint32_t wanted() const { return std::max(policy.wanted(), forFrame); }
  };
  /// What a frame's stages took [ms].
  struct StageTimes {
    double app = 0;
    std::map<std::uint32_t, double> cull, draw;  ///< by wall
    bool sampled = false;                        ///< its drawing took longer, for it was looked at
  };

  /// By file, line and path: what comes and goes all day is one node.
  using Reports = std::map<std::tuple<std::string, std::uint32_t, std::string>, BudgetReport>;
  static void addTo(Reports& all, const BudgetReport& report);
  void judgeNodes(std::uint64_t frame);
  void judgeFrame(std::uint64_t frame);
  using FrameLadder = std::vector<std::pair<NodeRef, std::uint32_t>>;
  /// What all ladders give up together, one after the other, for the frame's sake.
  struct FrameRelief {
    bool app = false, drawn = false;     ///< what takes too long: App, or Cull and Draw
    std::optional<ReliefPolicy> policy;  ///< nothing: there is nothing to give up
    FrameLadder ladder;                  ///< its levels, from 1 on: whose, and which of its own
    /// How many levels of a ladder make that shorter, with those that come before them.
    std::uint32_t usefulOf(const std::vector<Concession>& gives) const;
  };
  void spreadFrameLevels();
  void layFrameLadder(FrameRelief& relief);
  void tellUncounted();
  void noteOverrun(Governed& g, std::uint64_t frame, const NodeCost& cost);
  void applyStress(std::uint64_t frame);
  void tellChange(const Governed& g, std::uint32_t before, std::uint64_t frame);
  std::string stageText(const NodeCost& cost) const;
  std::string titleOf(NodeRef node) const;

  GovernorOptions options_;
  const NodeNames& names_;
  mutable std::mutex mutex_;
  NodeCosts costs_;
  std::vector<Governed> governed_;
  std::vector<std::size_t> byPriority_;  ///< of those that can give up something, the lowest first
  std::vector<FrameRelief> frame_;       ///< pipelined: for App, for Cull and Draw; else one for all
  std::uint64_t sampledUntil_ = 0;       ///< frames before it show what looking at drawing took
  StressFilter stress_;
  std::uint32_t stressApplied_ = 0, highestStress_ = 0;
  std::uint64_t stressChanges_ = 0, stressFrom_ = 0;
  double toldStressAt_ = -1e9, toldMostStressAt_ = -1e9;  ///< [s], that there is some, and the most
  bool scalable_ = false;                                 ///< there is something that stress acts on
  std::map<std::uint64_t, StageTimes> times_;
  std::vector<std::uint64_t> appEnded_, appEndedBefore_, shown_, shownBefore_;
  std::vector<std::string> lines_;  ///< to be told, by the log's thread
  std::uint64_t seen_ = ~std::uint64_t{0};
  std::shared_ptr<const NodeAccounts> accounts_;
  bool toldUncounted_ = false;
  Reports gone_;
  double now_ = 0;  ///< [s]
};

/// "half (every 4th frame)", "lod (1.5 times)": what the level gives up beyond the one below it.
std::string nameOfLevel(const std::vector<Concession>& ladder, std::uint32_t level);

}  // namespace stadion
