#include "profiling/regression/statistics/node_cost_comparison.h"

#include "profiling/regression/statistics/time_comparison.h"

namespace stadion::regression {

CostsByNode nodeInstructions(const std::vector<SpanRow>& rows) {
  CostsByNode all;
  for (const SpanRow& r : rows)
    if (!r.isStage() && r.instructions > 0) all[r.stageName()][r.node()] += r.instructions;
  return all;
}

CostsByNode noticeableNodes(const CostsByNode& costs, const std::map<std::string, double>& stages) {
  CostsByNode dear;
  for (const auto& [stage, nodes] : costs) {
    const auto whole = stages.find(stage);
    if (whole == stages.end()) continue;
    for (const auto& [node, cost] : nodes)
      if (cost >= kLeastKept * whole->second) dear[stage][node] = cost;
  }
  return dear;
}

std::string culpritSince(const std::string& stage, double before, double growth,
                         const CostsByNode& nodesBefore, const CostsByNode& nodesNow,
                         const std::vector<SpanRow>& rows) {
  const auto was = nodesBefore.find(stage), is = nodesNow.find(stage);
  if (was == nodesBefore.end() || is == nodesNow.end()) return stage;
  std::vector<std::pair<SpanRow, double>> grown;
  for (const SpanRow& row : rows) {
    if (row.isStage() || row.stageName() != stage) continue;
    const auto now = is->second.find(row.node()), kept = was->second.find(row.node());
    if (now == is->second.end()) continue;
    grown.emplace_back(row, now->second - (kept == was->second.end() ? kLeastKept * before : kept->second));
  }
  return culpritIn(stage, grown, growth);
}

}  // namespace stadion::regression
