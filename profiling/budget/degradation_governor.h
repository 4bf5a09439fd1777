#pragma once
/// Measures the cost of a live show's nodes and frames, reports overruns, and decides which nodes degrade.
///
/// Each node with a budget has a degradation ladder of its own (degradation_policy.h). The whole show has two
/// means. The first is stress (stress_filter.h). Once stress can do no more, the second is the ladders of all
/// nodes, one after the other, the lowest priority first. A node applies the higher of its own level and the
/// frame's level.
///
/// Decisions are made on the log's thread; App takes them at the start of its next frame.
///
/// Threads  SpanReader's on the log's thread; decide() and followLoads() on App's; reports from any.
///
/// Size     more than 20 fields: one mutex guards them, because a decision reads costs, levels and reports
///          together.

#include "engine/core/cost_budget.h"
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
  bool paced = true;               ///< frames come by the clock: a frame longer than its period is late
  bool pipelined = true;           ///< true: stages overlap; false: their times add up
  bool acts = true;                ///< true: nodes degrade; false: overruns are only reported
  bool drawnElsewhere = false;     ///< other processes draw: its cost by node is not known
  std::vector<std::string> walls;  ///< names
  StressOptions stress;
  std::function<void(const std::string&)> tell;  ///< receives a line; on the log's thread
};

/// How a node kept its budget, over all loads of its file.
struct BudgetReport {
  std::string name, file;
  std::uint32_t line = 0;
  double budget = 0;  ///< [ms]; 0 = none
  std::uint64_t frames = 0, overruns = 0;
  double mean = 0, worst = 0;  ///< [ms]
  std::uint64_t worstFrame = 0;
  std::string worstStage;     ///< "App", "Draw of wall front"
  bool drawCounted = true;    ///< false: these exclude drawing
  bool drawMeasured = true;   ///< false: drawing was never measured: the node was not visible, or hidden
                              ///< before its turn
  std::uint64_t changes = 0;  ///< changes of the degradation level
  std::uint32_t highest = 0, now = 0, levels = 0;  ///< levels of its ladder
};

/// The stress of the show: the factor on all distances when levels of detail are chosen.
struct StressReport {
  double highest = 1, now = 1;
  std::uint64_t changes = 0;
};

class DegradationGovernor final : public SpanReader, public DegradationDecider {
public:
  DegradationGovernor(GovernorOptions options, const NodeNames& names);

  // For the log's thread.
  using SpanReader::take;
  void take(std::size_t track, const SpanRecord& record) override;
  void take(const ShortVisits& visits) override;
  void take(const SharedSpan& shared) override;
  void take(const IsolatedDrawTime& drawn, const std::vector<NodeShare>& nodes) override;
  void caughtUp() override;
  /// Returns the worst overrun of a frame that ended recently.
  std::optional<Overrun> overrunOf(std::uint64_t frame) const;

  // For App's thread.
  /// Returns true if it watches other nodes than before.
  bool followLoads(const Scene& scene);
  /// Returns the watched nodes and the accounts of their costs; null: none.
  std::shared_ptr<const NodeAccounts> accounts() const { return accounts_; }
  FrameDecisions decide(std::uint64_t frame) override;

  /// By file and line.
  std::vector<BudgetReport> reports() const;
  /// Returns nothing if it only reports.
  std::optional<StressReport> stress() const;

private:
  struct Governed {
    GovernedNode subject;
    DegradationPolicy policy;
    std::uint32_t forFrame = 0;  ///< the level that the whole frame requires
    std::uint32_t applied = 0;
    BudgetReport report;
    double sum = 0;
    double toldAt = -1e9;      ///< [s]
    double toldMs = 0;         ///< cost of the node at the last report [ms]
    std::uint64_t untold = 0;  ///< overruns since then
    std::uint32_t wanted() const { return std::max(policy.wanted(), forFrame); }
  };
  /// Durations of a frame's stages [ms].
  struct StageTimes {
    double app = 0;
    std::map<std::uint32_t, double> cull, draw;  ///< by wall
    bool sampled = false;                        ///< drawing was sampled, and took longer for it
  };

  /// By file, line and path: a node that is loaded repeatedly is one node.
  using Reports = std::map<std::tuple<std::string, std::uint32_t, std::string>, BudgetReport>;
  static void addTo(Reports& all, const BudgetReport& report);
  void judgeNodes(std::uint64_t frame);
  void judgeFrame(std::uint64_t frame);
  using FrameLadder = std::vector<std::pair<NodeRef, std::uint32_t>>;
  /// The levels of all ladders together, one after the other, for the frame.
  struct JointLadder {
    bool app = false, drawn = false;          ///< stages that take too long: App, or Cull and Draw
    std::optional<DegradationPolicy> policy;  ///< nothing: no node can degrade
    FrameLadder ladder;  ///< for each of its levels, from 1 on: the node and the level of
                         ///< that node's ladder
    /// Returns how many levels of a ladder shorten that, with the levels before them.
    std::uint32_t usefulOf(const std::vector<DegradationStep>& gives) const;
  };
  void takeOver(const std::vector<GovernedNode>& nodes);
  Governed newlyGoverned(const GovernedNode& node) const;
  void orderByPriority();
  void spreadFrameLevels();
  void layFrameLadder(JointLadder& joint);
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
  std::vector<std::size_t> byPriority_;    ///< nodes that can degrade, the lowest priority first
  std::vector<JointLadder> jointLadders_;  ///< pipelined: for App, for Cull and Draw; else one for all
  std::uint64_t sampledUntil_ = 0;         ///< frames before it include the cost of sampling
  StressFilter stress_;
  std::uint32_t stressApplied_ = 0, highestStress_ = 0;
  std::uint64_t stressChanges_ = 0, stressFrom_ = 0;
  double toldStressAt_ = -1e9, toldMostStressAt_ = -1e9;  ///< [s], of the report that there is stress, and of
                                                          ///< the report of its maximum
  bool scalable_ = false;                                 ///< the show has nodes that stress affects
  std::map<std::uint64_t, StageTimes> times_;
  std::vector<std::uint64_t> appEnded_, appEndedBefore_, shown_, shownBefore_;
  std::vector<std::string> lines_;               ///< reports to be sent by the log's thread
  std::uint64_t loadsSeen_ = ~std::uint64_t{0};  ///< version of the scene tree that followLoads() saw last
  std::shared_ptr<const NodeAccounts> accounts_;
  bool toldUncounted_ = false;
  Reports gone_;
  double now_ = 0;  ///< [s]
};

/// Returns a name such as "half (every 4th frame)", "lod (1.5 times)": the step from the level below.
std::string nameOfLevel(const std::vector<DegradationStep>& ladder, std::uint32_t level);

}  // namespace stadion
