#include "profiling/regression/span_times.h"

#include "profiling/regression/callgrind_request.h"

#include <algorithm>
#include <cstdio>

namespace stadion::regression {
namespace {

constexpr std::size_t kNodesWithFrames = 200;
constexpr std::uint64_t kFirstCounted = 2;

const char* nameOf(Stage stage) {
  switch (stage) {
  case Stage::App: return "app";
  case Stage::Cull: return "cull";
  case Stage::Draw: return "draw";
  default: return "swap";
  }
}

bool isPlantedIn(const std::optional<PlantedDelay>& planted, Stage stage, std::uint32_t wall) {
  if (!planted || planted->wall != wall) return false;
  return (stage == Stage::Cull && planted->where == PlantedDelay::Where::Cull) ||
         (stage == Stage::Draw && planted->where == PlantedDelay::Where::Draw);
}

}  // namespace

void SpanTimes::stageBegan(Stage stage, std::uint64_t frame, std::uint32_t wall) {
  if (stage == Stage::App && options_.turns) options_.turns->take();
  if (stage == Stage::App && frame == kFirstCounted && options_.countInstructions) {
    beginCountingInstructions();
    counting_ = true;
  }
  const Key key{stage, wall, {}};
  const std::lock_guard lock(mutex_);
  began(key);
  boundary(nullptr);
  stage_ = &costs_[key];
}

void SpanTimes::stageEnded(Stage stage, std::uint64_t frame, std::uint32_t wall) {
  if (isPlantedIn(options_.planted, stage, wall)) burn(options_.planted->iterations);
  {
    const std::lock_guard lock(mutex_);
    Cost& cost = ended({stage, wall, {}});
    boundary(&cost);
    stage_ = nullptr;
    cost.frames.emplace_back(frame, cost.now);
    cost.total += cost.now, cost.now = 0;
    if (stage == Stage::App) closeFrame(frame);
  }
  if (stage == Stage::Swap && options_.turns) options_.turns->give();
}

void SpanTimes::nodePhaseBegan(NodeRef node, NodePhase) {
  const std::lock_guard lock(mutex_);
  boundary(stage_);
  began({Stage::App, 0, node});
}

void SpanTimes::nodePhaseEnded(NodeRef node, NodePhase phase) {
  const auto& planted = options_.planted;
  if (planted && planted->where == PlantedDelay::Where::Simulate && phase == NodePhase::Simulate &&
      planted->node == node)
    burn(planted->iterations);
  const std::lock_guard lock(mutex_);
  const std::uint64_t before = costs_[{Stage::App, 0, node}].now;
  Cost& cost = ended({Stage::App, 0, node});
  boundary(&cost);
  if (before == 0) touched_.push_back(&cost);
}

void SpanTimes::began(const Key& key) {
  const auto [at, isNew] = costs_.try_emplace(key);
  if (isNew) at->second.row = costs_.size() - 1;
  at->second.began = threadNanoseconds();
}

SpanTimes::Cost& SpanTimes::ended(const Key& key) {
  Cost& cost = costs_[key];
  cost.now += std::max<std::uint64_t>(1, threadNanoseconds() - cost.began);
  return cost;
}

void SpanTimes::closeFrame(std::uint64_t frame) {
  for (Cost* node : touched_) {
    node->frames.emplace_back(frame, node->now);
    node->total += node->now, node->now = 0;
  }
  touched_.clear();
}

// Whatever was executed since the boundary before belongs to this row, or to nobody.
void SpanTimes::boundary(const Cost* cost) {
  if (!counting_) return;
  char label[32];
  std::snprintf(label, sizeof label, "row %zu", cost ? cost->row : costs_.size() + 1'000'000);
  dumpInstructionsAs(label);
}

std::vector<SpanRow> SpanTimes::rows(const std::vector<std::string>& walls,
                                     const std::function<void(NodeRef, SpanRow&)>& nameNode) const {
  std::vector<std::uint64_t> totals;
  for (const auto& [key, cost] : costs_)
    if (key.node.valid()) totals.push_back(cost.total);
  std::ranges::sort(totals, std::greater());
  const std::uint64_t dear = totals.size() > kNodesWithFrames ? totals[kNodesWithFrames] : 0;

  std::vector<SpanRow> all(costs_.size());
  for (const auto& [key, cost] : costs_) {
    SpanRow& row = all[cost.row];
    row.stage = nameOf(key.stage);
    const bool ofWall = key.stage == Stage::Cull || key.stage == Stage::Draw;
    if (ofWall && key.wall < walls.size()) row.wall = walls[key.wall];
    if (key.node.valid()) nameNode(key.node, row);
    row.count = cost.frames.size();
    if (row.count > 0) row.msMean = 1e-6 * static_cast<double>(cost.total) / static_cast<double>(row.count);
    if (key.node.valid() && cost.total < dear) continue;
    for (const auto& [frame, ns] : cost.frames) row.frames[frame] = 1e-3 * static_cast<double>(ns);
  }
  return all;
}

}  // namespace stadion::regression
