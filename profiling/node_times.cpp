#include "profiling/node_times.h"

#include <algorithm>

namespace stadion {

void NodeTimes::nodePhaseBegan(NodeRef node, NodePhase) {
  const std::lock_guard lock(mutex_);
  began_[node] = Clock::now();
}

void NodeTimes::nodePhaseEnded(NodeRef node, NodePhase phase) {
  const Clock::time_point end = Clock::now();
  const std::lock_guard lock(mutex_);
  NodeCost& cost = costs_[node];
  cost.node = node;
  cost.ms[static_cast<std::size_t>(phase)] +=
      std::chrono::duration<double, std::milli>(end - began_[node]).count();
  if (phase == NodePhase::Receive) ++cost.visits;
}

std::vector<NodeCost> NodeTimes::dearest(std::size_t most) const {
  std::vector<NodeCost> costs;
  for (const auto& [node, cost] : costs_) costs.push_back(cost);
  std::sort(costs.begin(), costs.end(), [](const NodeCost& a, const NodeCost& b) {
    return a.total() != b.total() ? a.total() > b.total() : a.node < b.node;
  });
  costs.resize(std::min(most, costs.size()));
  return costs;
}

}  // namespace stadion
