#include "engine/scene/node_schedule.h"

#include "engine/core/state_fields.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace stadion {

void NodeSchedule::begin(const Scene& scene) {
  findLevels(scene);
  queue_.begin();
  if (degradation_.any()) queue_.leaveOut([&](Node& node) { return degradation_.putOff(node); });
  degradation_.wakeWaiting([&](NodeRef ref) { wokenLate_.push_back(ref); });
}

bool NodeSchedule::call(NodeRef ref) {
  Node* node = tree_.find(ref);
  if (node) queue_.call(*node);
  return node != nullptr;
}

void NodeSchedule::callDue(Nanoseconds now) {
  while (!alarms_.empty() && alarms_.begin()->at <= now) {
    call(alarms_.begin()->node);
    alarms_.erase(alarms_.begin());
  }
  wokenBefore_.swap(wokenLate_);
  for (const NodeRef ref : wokenBefore_) call(ref);
  wokenBefore_.clear();
  if (loadsTold_ != tree_.version())
    for (const NodeRef ref : loadWatchers_) call(ref);
  loadsTold_ = tree_.version();
  queue_.sort();
  wakeWatchers();
}

namespace {

/// By node: the nodes that move what it looks at.
using Movers = std::map<NodeRef, std::vector<NodeRef>>;

/// Returns true if `from` looks at `to`, directly or through others.
bool looksAt(const Movers& movers, NodeRef from, NodeRef to) {
  std::set<NodeRef> seen{from};
  std::vector<NodeRef> open{from};
  while (!open.empty()) {
    const auto at = movers.find(open.back());
    open.pop_back();
    if (at == movers.end()) continue;
    for (const NodeRef next : at->second) {
      if (next == to) return true;
      if (seen.insert(next).second) open.push_back(next);
    }
  }
  return false;
}

/// If two nodes look at each other, the one that comes first in the file comes first here.
void breakCycles(Movers& movers) {
  std::vector<std::pair<NodeRef, NodeRef>> mutual;
  for (const auto& [ref, before] : movers)
    for (const NodeRef mover : before)
      if (ref < mover && looksAt(movers, mover, ref)) mutual.emplace_back(ref, mover);
  for (const auto& [ref, mover] : mutual) std::erase(movers[ref], mover);
}

/// Returns the node's level: one more than the highest of its movers. Expects no cycle.
std::uint16_t levelOf(const Movers& movers, NodeRef ref, std::map<NodeRef, std::uint16_t>& known) {
  if (const auto at = known.find(ref); at != known.end()) return at->second;
  std::uint16_t level = 0;
  if (const auto at = movers.find(ref); at != movers.end())
    for (const NodeRef mover : at->second)
      level = std::max<std::uint16_t>(level, levelOf(movers, mover, known) + 1);
  return known[ref] = level;
}

}  // namespace

/// Finds the levels: a node comes after the nodes whose results it looks at. Which node moves what is known
/// one round after it has entered.
void NodeSchedule::findLevels(const Scene& scene) {
  if (levelsLoads_ == tree_.version() && levelsSettled_) return;
  levelsSettled_ = levelsLoads_ == tree_.version();
  levelsLoads_ = tree_.version();
  Movers movers;
  for (const NodeRef ref : loadWatchers_)
    if (const Node* node = tree_.find(ref)) node->addMovers(scene, movers[ref]);
  std::erase_if(movers, [](const auto& entry) { return entry.second.empty(); });
  breakCycles(movers);
  std::map<NodeRef, std::uint16_t> levels;
  bool changed = false;
  for (const NodeRef ref : loadWatchers_) {
    Node* node = tree_.find(ref);
    if (!node) continue;
    const std::uint16_t level = levelOf(movers, ref, levels);
    changed |= std::exchange(node->scheduleState().level, level) != level;
  }
  if (changed) queue_.reorder();
}

void NodeSchedule::wakeNow(NodeRef ref) {
  Node* node = tree_.find(ref);
  if (!node) return;
  const Visit v = Visit::of(*node);
  if (current_ && *current_ < v)
    queue_.callNow(*node);
  else if (!current_ || *current_ != v)
    wokenLate_.push_back(ref);
}

void NodeSchedule::watch(PlacementId placement, NodeRef watcher) {
  watchers_.insert({placement, watcher});
  placements_.watch(placement);
}

void NodeSchedule::unwatch(PlacementId placement, NodeRef watcher) {
  const auto [first, last] = watchers_.equal_range(placement);
  const auto at = std::find_if(first, last, [&](const auto& w) { return w.second == watcher; });
  if (at != last) watchers_.erase(at);
}

void NodeSchedule::wakeWatchers() {
  for (const PlacementId p : placements_.takeMovedWatched()) {
    const auto [first, last] = watchers_.equal_range(p);
    // A node that moves what it watches does not wake itself.
    for (auto at = first; at != last; ++at) {
      const NodeRef ref = at->second;
      if (current_ && current_->node == ref) continue;
      Node* node = degradation_.any() ? tree_.find(ref) : nullptr;
      if (node && degradation_.putOff(*node))
        degradation_.keepWaiting(ref);
      else
        wakeNow(ref);
    }
  }
}

void NodeSchedule::stateOfAlarms(StateFields& f) {
  f("wakes", alarms_), f("woken", wokenLate_);
}

void NodeSchedule::stateOfWatchers(StateFields& f) {
  f("watchers", watchers_), f("load watchers", loadWatchers_);
}

void NodeSchedule::stateOfLevels(StateFields& f) {
  f("loads told", loadsTold_), f("levels' loads", levelsLoads_), f("levels settled", levelsSettled_);
}

bool NodeSchedule::consistent() const {
  return std::ranges::all_of(watchers_, [&](const auto& w) { return placements_.has(w.first); });
}

}  // namespace stadion
