#include "profiling/budget/degradation_governor.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace stadion {
namespace {

constexpr double kToldApart = 10;              ///< [s], between reports of one node's overruns
constexpr double kMuchWorse = 3;               ///< ratio to the last report: such an overrun is reported at
                                               ///< once
constexpr std::uint64_t kFramesUnderWay = 64;  ///< frames that were not shown by then never will be
constexpr double kLevelSaves = 0.5;  ///< part of the frame's cost that one level is expected to leave

DegradationPolicy policyOf(const NodeTerms& terms, double rate) {
  return {{terms.budget > 0 ? terms.budget : HUGE_VAL, static_cast<std::uint64_t>(std::ceil(rate))},
          savingsOf(terms.gives)};
}

double mostOf(const std::map<std::uint32_t, double>& byWall) {
  double most = 0;
  for (const auto& [wall, ms] : byWall) most = std::max(most, ms);
  return most;
}

double sumOf(const std::map<std::uint32_t, double>& byWall) {
  double sum = 0;
  for (const auto& [wall, ms] : byWall) sum += ms;
  return sum;
}

/// Returns accounts for the nodes, to which the nodes below them belong, too; null: there are none.
std::shared_ptr<const NodeAccounts> accountsOf(const std::vector<GovernedNode>& nodes,
                                               const std::map<NodeRef, std::vector<std::size_t>>& above) {
  std::vector<NodeRef> holders;
  for (const GovernedNode& n : nodes) holders.push_back(n.node);
  if (holders.empty()) return nullptr;
  const auto accounts = std::make_shared<NodeAccounts>(std::move(holders));
  for (const auto& [node, governed] : above)
    accounts->add(node, static_cast<NodeAccounts::Account>(governed.front()));
  return accounts;
}

}  // namespace

std::string nameOfLevel(const std::vector<DegradationStep>& ladder, std::uint32_t level) {
  if (level == 0) return "nothing";
  for (const DegradationStep c : ladder) {
    if (level > levelsOf(c)) {
      level -= levelsOf(c);
      continue;
    }
    const std::string word(kDegradationNames[static_cast<std::size_t>(c)]);
    if (c == DegradationStep::Lod) return fmt::format("{} ({:.3g} times)", word, std::pow(kLodLevel, level));
    if (c == DegradationStep::Half) return fmt::format("{} (one frame of {})", word, 1U << level);
    return word;
  }
  return "nothing";
}

DegradationGovernor::DegradationGovernor(GovernorOptions options, const NodeNames& names)
    : options_(std::move(options)), names_(names), stress_(options_.stress) {
  // If stages overlap, shortening one does not shorten the other.
  if (options_.pipelined)
    jointLadders_ = {{true, false, {}, {}}, {false, true, {}, {}}};
  else
    jointLadders_ = {{true, true, {}, {}}};
}

// Input from the probe.

void DegradationGovernor::take(std::size_t, const SpanRecord& r) {
  if (r.frame == kNoFrame) return;
  const std::lock_guard lock(mutex_);
  switch (r.what) {
  case Span::App:
    times_[r.frame].app = r.took;
    appEnded_.push_back(r.frame);
    break;
  case Span::Cull: times_[r.frame].cull[r.wall] = r.took; break;
  case Span::Draw:
    times_[r.frame].draw[r.wall] = r.took;
    times_[r.frame].sampled |= r.disturbed;
    break;
  case Span::Swap: shown_.push_back(r.frame); break;
  default: costs_.take(r);
  }
}

void DegradationGovernor::take(const ShortVisits& visits) {
  const std::lock_guard lock(mutex_);
  costs_.take(visits);
}

void DegradationGovernor::take(const SharedSpan& shared) {
  const std::lock_guard lock(mutex_);
  costs_.take(shared);
}

void DegradationGovernor::take(const IsolatedDrawTime& drawn, const std::vector<NodeShare>& nodes) {
  const std::lock_guard lock(mutex_);
  costs_.take(drawn, nodes);
}

// Records of other threads that work for App, or for the swap, may come a little later than these.
void DegradationGovernor::caughtUp() {
  std::vector<std::string> lines;
  {
    const std::lock_guard lock(mutex_);
    for (const std::uint64_t frame : appEndedBefore_) judgeNodes(frame);
    for (const std::uint64_t frame : shownBefore_) judgeFrame(frame);
    appEndedBefore_.swap(appEnded_);
    shownBefore_.swap(shown_);
    appEnded_.clear();
    shown_.clear();
    lines.swap(lines_);
  }
  // Messages go out without the lock, so no thread waits for a terminal.
  for (const std::string& line : lines)
    if (options_.tell) options_.tell(line);
}

// Nodes.

void DegradationGovernor::judgeNodes(std::uint64_t frame) {
  now_ = static_cast<double>(frame) / options_.rate;
  const std::vector<NodeCost> costs = costs_.of(frame);
  for (std::size_t i = 0; i < governed_.size() && i < costs.size(); ++i) {
    Governed& g = governed_[i];
    BudgetReport& r = g.report;
    const double ms = costs[i].cost.total();
    r.drawMeasured = costs[i].drawKnown || !r.drawCounted;
    if (r.drawMeasured) {
      ++r.frames;
      g.sum += ms;
      r.mean = g.sum / static_cast<double>(r.frames);
    }
    if (r.drawMeasured && ms > r.worst) {
      r.worst = ms;
      r.worstFrame = frame;
      r.worstStage = stageText(costs[i]);
    }
    if (r.budget > 0 && costs[i].sure.total() > r.budget) noteOverrun(g, frame, costs[i]);
    const bool acts = options_.acts && r.levels > 0 && r.budget > 0 && costs[i].known;
    if (acts) g.policy.take(frame, costs[i].sure);
  }
  if (frame >= kFramesUnderWay) costs_.forget(frame - kFramesUnderWay);
}

void DegradationGovernor::noteOverrun(Governed& g, std::uint64_t frame, const NodeCost& cost) {
  ++g.report.overruns;
  ++g.untold;
  const bool muchWorse = cost.sure.total() > kMuchWorse * g.toldMs;
  if (now_ - g.toldAt < kToldApart && !muchWorse) return;
  const std::string others =
      g.untold > 1 ? fmt::format("; {} frames since this was told last", g.untold) : std::string();
  lines_.push_back(fmt::format("over budget: {} took {:.3g} ms of {:g} in frame {}, most of it {}{}",
                               titleOf(g.subject.node), cost.sure.total(), g.report.budget, frame,
                               stageText(cost), others));
  g.toldAt = now_;
  g.toldMs = cost.sure.total();
  g.untold = 0;
}

std::string DegradationGovernor::stageText(const NodeCost& cost) const {
  std::string stage(nameOf(cost.mostExpensive));
  stage[0] = static_cast<char>(stage[0] - 'a' + 'A');
  return cost.wall < options_.walls.size() ? stage + " of wall " + options_.walls[cost.wall] : stage;
}

std::string DegradationGovernor::titleOf(NodeRef node) const {
  const auto name = names_.find(node);
  return name ? fmt::format("\"{}\" {}:{}", name->path, name->file, name->line) : "a removed node";
}

std::optional<Overrun> DegradationGovernor::overrunOf(std::uint64_t frame) const {
  const std::lock_guard lock(mutex_);
  const std::vector<NodeCost> costs = costs_.of(frame);
  std::optional<Overrun> worst;
  for (std::size_t i = 0; i < governed_.size() && i < costs.size(); ++i) {
    const double ms = costs[i].sure.total(), budget = governed_[i].report.budget;
    if (budget > 0 && ms > budget && (!worst || ms - budget > worst->ms - worst->budget))
      worst = Overrun{titleOf(governed_[i].subject.node), ms, budget};
  }
  return worst;
}

// The whole frame.

void DegradationGovernor::judgeFrame(std::uint64_t frame) {
  const auto at = times_.find(frame);
  if (at == times_.end()) return;
  const StageTimes t = at->second;
  times_.erase(times_.begin(), times_.upper_bound(frame >= kFramesUnderWay ? frame - kFramesUnderWay : 0));
  // The cost of sampling belongs to no node; it delays the next frame, too.
  if (t.sampled) sampledUntil_ = frame + 2;
  if (!options_.paced || !options_.acts || frame < sampledUntil_) return;
  const double period = 1e3 / options_.rate;
  const double drawn =
      options_.pipelined ? std::max(mostOf(t.cull), mostOf(t.draw)) : sumOf(t.cull) + sumOf(t.draw);
  if (scalable_ && frame >= stressFrom_) stress_.take((options_.pipelined ? drawn : t.app + drawn) / period);
  for (JointLadder& joint : jointLadders_) {
    if (!joint.policy) continue;
    const bool stressFirst = joint.drawn && scalable_ && !stress_.exhausted();
    if (stressFirst && joint.policy->wanted() == 0) continue;
    joint.policy->take(frame, {(joint.app ? t.app : 0) + (joint.drawn ? drawn : 0), 0});
  }
  spreadFrameLevels();
}

std::uint32_t DegradationGovernor::JointLadder::usefulOf(const std::vector<DegradationStep>& gives) const {
  std::uint32_t levels = 0, useful = 0;
  for (const DegradationStep c : gives) {
    levels += levelsOf(c);
    const bool ofApp = c == DegradationStep::Half || c == DegradationStep::Rest;
    if (ofApp ? app : drawn) useful = levels;
  }
  return useful;
}

/// Spreads the frame's levels over the ladders of the nodes, the lowest priority first.
void DegradationGovernor::spreadFrameLevels() {
  for (Governed& g : governed_) g.forFrame = 0;
  for (const JointLadder& joint : jointLadders_) {
    std::uint32_t left = joint.policy ? joint.policy->wanted() : 0;
    for (const std::size_t i : byPriority_) {
      const std::uint32_t taken = std::min(left, joint.usefulOf(governed_[i].subject.terms.gives));
      governed_[i].forFrame = std::max(governed_[i].forFrame, taken);
      left -= taken;
    }
  }
}

// App.

bool DegradationGovernor::followLoads(const Scene& scene) {
  if (loadsSeen_ == scene.tree().version()) return false;
  loadsSeen_ = scene.tree().version();
  auto [nodes, above] = governedNodes(scene);
  const bool scalable = hasLevels(scene);
  const std::lock_guard lock(mutex_);
  scalable_ = scalable;
  takeOver(nodes);
  orderByPriority();
  for (JointLadder& joint : jointLadders_) layFrameLadder(joint);
  spreadFrameLevels();
  tellUncounted();
  accounts_ = accountsOf(nodes, above);
  costs_.govern(std::move(nodes), std::move(above), scene.lights().sky());
  return true;
}

/// Governs these nodes: known ones keep their state. Files the reports of those that are gone.
void DegradationGovernor::takeOver(const std::vector<GovernedNode>& nodes) {
  std::vector<Governed> known;
  known.swap(governed_);
  for (const GovernedNode& n : nodes) {
    const auto before =
        std::ranges::find_if(known, [&](const Governed& g) { return g.subject.node == n.node; });
    if (before == known.end()) {
      governed_.push_back(newlyGoverned(n));
      continue;
    }
    governed_.push_back(std::move(*before));
    known.erase(before);
  }
  for (Governed& gone : known) {
    gone.report.now = 0;
    addTo(gone_, gone.report);
  }
}

DegradationGovernor::Governed DegradationGovernor::newlyGoverned(const GovernedNode& node) const {
  Governed g{node, policyOf(node.terms, options_.rate), 0, 0, {}};
  g.report.budget = node.terms.budget;
  g.report.levels = levelsOf(node.terms.gives);
  g.report.drawCounted = !(node.drawn && options_.drawnElsewhere);
  if (const auto name = names_.find(node.node)) {
    g.report.name = name->path;
    g.report.file = name->file;
    g.report.line = name->line;
  }
  return g;
}

void DegradationGovernor::orderByPriority() {
  byPriority_.clear();
  for (std::size_t i = 0; i < governed_.size(); ++i)
    if (governed_[i].report.levels > 0) byPriority_.push_back(i);
  std::ranges::stable_sort(byPriority_, {},
                           [&](std::size_t i) { return governed_[i].subject.terms.priority; });
}

/// Reports once that budgets seem to be kept although some costs are unknown.
void DegradationGovernor::tellUncounted() {
  const auto g = std::ranges::find_if(
      governed_, [](const Governed& each) { return each.report.budget > 0 && !each.report.drawCounted; });
  if (g == governed_.end() || std::exchange(toldUncounted_, true)) return;
  lines_.push_back(
      fmt::format("the budget of {} counts App and Cull only, as all budgets do while processes draw "
                  "the walls: what drawing takes is known with --wall-workers thread",
                  titleOf(g->subject.node)));
}

/// Builds the ladder from the present nodes. Degradations stay in place if their nodes still exist.
void DegradationGovernor::layFrameLadder(JointLadder& joint) {
  FrameLadder ladder;
  std::map<std::pair<NodeRef, std::uint32_t>, std::uint32_t> levelOf;
  for (const std::size_t i : byPriority_)
    for (std::uint32_t l = 1; l <= joint.usefulOf(governed_[i].subject.terms.gives); ++l) {
      ladder.push_back({governed_[i].subject.node, l});
      levelOf[ladder.back()] = static_cast<std::uint32_t>(ladder.size());
    }
  std::vector<std::uint32_t> becomes{0};
  for (const auto& step : joint.ladder) {
    const auto at = levelOf.find(step);
    becomes.push_back(at == levelOf.end() ? becomes.back() : std::max(becomes.back(), at->second));
  }
  joint.ladder = std::move(ladder);
  if (joint.ladder.empty()) return joint.policy.reset();
  std::vector<LevelSavings> savings;
  for (std::size_t l = 0; l <= joint.ladder.size(); ++l)
    savings.push_back({std::pow(kLevelSaves, static_cast<double>(l)), 1, 1});
  if (joint.policy)
    joint.policy->relay(std::move(savings), becomes);
  else
    joint.policy.emplace(
        DegradationPolicy::Options{1e3 / options_.rate, static_cast<std::uint64_t>(std::ceil(options_.rate))},
        std::move(savings));
}

FrameDecisions DegradationGovernor::decide(std::uint64_t frame) {
  FrameDecisions decisions;
  const std::lock_guard lock(mutex_);
  if (!options_.acts) return decisions;
  if (stress_.level() != stressApplied_ && decisions.add({0, 0, stress_.level()})) applyStress(frame);
  bool all = true;
  for (std::size_t i = 0; i < governed_.size(); ++i) {
    Governed& g = governed_[i];
    const std::uint32_t wanted = g.wanted(), before = g.applied;
    if (wanted != before) {
      if (!decisions.add({g.subject.node.load, g.subject.node.position, wanted})) {
        all = false;
        continue;
      }
      g.applied = wanted;
      const NodeDegradation was = degradationAt(g.subject.terms.gives, before),
                            is = degradationAt(g.subject.terms.gives, wanted);
      if (was.hidden != is.hidden || was.lod != is.lod) costs_.drawnOtherwise(i, frame, is.hidden);
      BudgetReport& r = g.report;
      ++r.changes;
      r.highest = std::max(r.highest, wanted);
      r.now = wanted;
      tellChange(g, before, frame);
    }
    g.policy.applied(frame);
  }
  for (JointLadder& joint : jointLadders_)
    if (joint.policy && all) joint.policy->applied(frame);
  return decisions;
}

/// Reports when stress begins and when it can do no more, each as rarely as a node's overruns.
void DegradationGovernor::applyStress(std::uint64_t frame) {
  const std::uint32_t before = std::exchange(stressApplied_, stress_.level());
  stressFrom_ = frame;
  ++stressChanges_;
  highestStress_ = std::max(highestStress_, stressApplied_);
  const bool most = stressApplied_ == stress_.most();
  if (stressApplied_ == 0 || (before > 0 && !most)) return;
  const double at = static_cast<double>(frame) / options_.rate;
  double& toldAt = most ? toldMostStressAt_ : toldStressAt_;
  if (at - toldAt < kToldApart) return;
  toldAt = at;
  lines_.push_back(
      fmt::format("under stress: from frame {} on everything counts as {:.3g} times farther away{}", frame,
                  stressOf(stressApplied_), most ? ", the most it may" : ""));
}

void DegradationGovernor::tellChange(const Governed& g, std::uint32_t before, std::uint64_t frame) {
  const std::vector<DegradationStep>& ladder = g.subject.terms.gives;
  const std::string title = titleOf(g.subject.node);
  if (g.applied > before)
    lines_.push_back(
        fmt::format("from frame {} on {} gives up: {}", frame, title, nameOfLevel(ladder, g.applied)));
  else
    lines_.push_back(fmt::format("from frame {} on {} has something back; still given up: {}", frame, title,
                                 nameOfLevel(ladder, g.applied)));
}

// Reports.

void DegradationGovernor::addTo(Reports& all, const BudgetReport& r) {
  const auto [at, first] = all.try_emplace({r.file, r.line, r.name}, r);
  if (first) return;
  BudgetReport sum = r;
  const BudgetReport& before = at->second;
  sum.frames += before.frames;
  sum.overruns += before.overruns;
  sum.changes += before.changes;
  if (sum.frames > 0)
    sum.mean += (before.mean - r.mean) * static_cast<double>(before.frames) / static_cast<double>(sum.frames);
  if (before.worst > r.worst) {
    sum.worst = before.worst;
    sum.worstFrame = before.worstFrame;
    sum.worstStage = before.worstStage;
  }
  sum.drawMeasured = r.drawMeasured || before.drawMeasured;
  sum.highest = std::max(sum.highest, before.highest);
  sum.now = std::max(sum.now, before.now);
  at->second = std::move(sum);
}

std::vector<BudgetReport> DegradationGovernor::reports() const {
  const std::lock_guard lock(mutex_);
  Reports all = gone_;
  for (const Governed& g : governed_) addTo(all, g.report);
  std::vector<BudgetReport> reports;
  for (auto& [written, report] : all) reports.push_back(std::move(report));
  return reports;
}

std::optional<StressReport> DegradationGovernor::stress() const {
  if (!options_.acts) return {};
  const std::lock_guard lock(mutex_);
  return StressReport{stressOf(highestStress_), stressOf(stressApplied_), stressChanges_};
}

}  // namespace stadion
