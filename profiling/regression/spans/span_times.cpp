#include "profiling/regression/spans/span_times.h"

#include "engine/maths/median.h"
#include "profiling/regression/spans/callgrind_request.h"

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace stadion::regression {
namespace {

constexpr std::size_t kNodesWithFrames = 200;
constexpr std::uint64_t kFirstCounted = 2;

const char* nameOfStage(Span stage) {
  switch (stage) {
  case Span::App: return "app";
  case Span::Cull: return "cull";
  case Span::Draw: return "draw";
  default: return "swap";
  }
}

bool isPlantedIn(const std::optional<PlantedDelay>& planted, Span stage, std::uint32_t wall) {
  if (!planted || planted->wall != wall) return false;
  return (stage == Span::Cull && planted->where == PlantedDelay::Where::Cull) ||
         (stage == Span::Draw && planted->where == PlantedDelay::Where::Draw);
}

bool isPlantedIn(const std::optional<PlantedDelay>& planted, Span phase, NodeRef node) {
  return planted && planted->where == PlantedDelay::Where::Simulate && phase == Span::Simulate &&
         planted->node == node;
}

double microseconds(std::chrono::steady_clock::duration d) {
  return std::chrono::duration<double, std::micro>(d).count();
}

double typicalElapsed(const SpanRow& row) {
  std::vector<double> us;
  for (const auto& [frame, value] : row.elapsed) us.push_back(value);
  return median(std::move(us));
}

}  // namespace

void SpanTimes::began(Span what, std::uint64_t frame, std::uint32_t wall) {
  if (!isStage(what)) return;  // a wait
  const bool waits = what == Span::App && options_.turns;
  const auto waiting = waits ? Clock::now() : Clock::time_point{};
  if (waits) options_.turns->take();
  if (what == Span::App && frame == kFirstCounted && options_.countInstructions) {
    if (!options_.instructions) beginCountingInstructions();
    counting_ = true;
  }
  const Key key{what, wall == kNoWall ? 0 : wall, {}};
  const std::lock_guard lock(mutex_);
  open_[std::this_thread::get_id()] = {key, frame, {}};
  if (what == Span::App) appFrame_ = frame;
  if (what == Span::App && frameEndedAt_ == Clock::time_point{})
    frameEndedAt_ = Clock::now();
  else if (waits)
    frameEndedAt_ += Clock::now() - waiting;
  begin(key);
  boundary(nullptr);
  stage_ = &costs_[key];
}

void SpanTimes::began(Span what, NodeRef node) {
  if (!isOfNode(what) || !node.valid()) return;
  const std::lock_guard lock(mutex_);
  boundary(stage_);
  open_[std::this_thread::get_id()].node = node;
  begin({Span::App, 0, node});
}

void SpanTimes::ended(Span what) {
  if (!isStage(what) && !isOfNode(what)) return;
  Open open;
  std::uint64_t appFrame = 0;
  {
    const std::lock_guard lock(mutex_);
    open = open_[std::this_thread::get_id()];
    appFrame = appFrame_;
  }
  if (isStage(what)) {
    if (isPlantedIn(options_.planted, what, open.stage.wall)) plantIn(open.frame);
    stageEnded(open);
    if (what == Span::App && options_.planted && options_.planted->where == PlantedDelay::Where::Frame)
      plantIn(open.frame);
    if (what == Span::Swap) frameEnded(open.frame);
    if (what == Span::Swap && options_.turns) options_.turns->give();
  } else if (open.node.valid()) {
    if (isPlantedIn(options_.planted, what, open.node)) plantIn(appFrame);
    nodeEnded(open.node);
  }
}

// A node's cycle may simulate in two parts: the delay is planted once. Reading the real-time clock is nearly
// free, so the planted time is that of burn().
void SpanTimes::plantIn(std::uint64_t frame) {
  if (!options_.planted->isIn(frame)) return;
  {
    const std::lock_guard lock(mutex_);
    if (plantedFrame_ == frame) return;
    plantedFrame_ = frame;
  }
  const auto start = Clock::now();
  options_.planted->spend();
  const auto took = Clock::now() - start;
  const std::lock_guard lock(mutex_);
  planted_.push_back(static_cast<std::uint64_t>(std::chrono::nanoseconds(took).count()));
}

/// Returns true if the planted delay lengthens this stage.
bool SpanTimes::isPlanted(const Key& key) const {
  if (key.node.valid() || planted_.empty()) return false;
  return isPlantedIn(options_.planted, key.stage, key.wall) ||
         (key.stage == Span::App && options_.planted->where == PlantedDelay::Where::Simulate);
}

void SpanTimes::stageEnded(const Open& open) {
  const std::lock_guard lock(mutex_);
  Cost& cost = end(open.stage);
  boundary(&cost);
  stage_ = nullptr;
  cost.frames.push_back({open.frame, cost.now, cost.elapsed});
  cost.total += cost.now;
  cost.now = 0;
  cost.elapsed = {};
  if (open.stage.stage == Span::App) closeFrame(open.frame);
}

/// The whole frame; if two runs alternate, without the wait for the other run.
void SpanTimes::frameEnded(std::uint64_t frame) {
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  wholeFrames_.emplace_back(frame, now - frameEndedAt_);
  frameEndedAt_ = now;
}

void SpanTimes::nodeEnded(NodeRef node) {
  const std::lock_guard lock(mutex_);
  open_[std::this_thread::get_id()].node = {};
  const std::uint64_t before = costs_[{Span::App, 0, node}].now;
  Cost& cost = end({Span::App, 0, node});
  boundary(&cost);
  if (before == 0) touched_.push_back(&cost);
}

void SpanTimes::begin(const Key& key) {
  const auto [at, isNew] = costs_.try_emplace(key);
  if (isNew) at->second.row = costs_.size() - 1;
  at->second.beganAt = Clock::now();
  at->second.began = threadNanoseconds();
}

SpanTimes::Cost& SpanTimes::end(const Key& key) {
  Cost& cost = costs_[key];
  cost.now += std::max<std::uint64_t>(1, threadNanoseconds() - cost.began);
  cost.elapsed += Clock::now() - cost.beganAt;
  return cost;
}

void SpanTimes::closeFrame(std::uint64_t frame) {
  for (Cost* node : touched_) {
    node->frames.push_back({frame, node->now, node->elapsed});
    node->total += node->now;
    node->elapsedTotal += node->elapsed;
    node->now = 0;
    node->elapsed = {};
  }
  touched_.clear();
}

// Instructions since the previous boundary belong to this row, or to none.
void SpanTimes::boundary(const Cost* cost) {
  if (!counting_) return;
  if (options_.instructions) {
    const std::uint64_t now = options_.instructions();
    if (cost && now > counted_) executed_[cost->row] += static_cast<double>(now - counted_);
    counted_ = options_.instructions();  // instructions of this function belong to no row
    return;
  }
  char label[32];
  std::snprintf(label, sizeof label, "row %zu", cost ? cost->row : costs_.size() + 1'000'000);
  dumpInstructionsAs(label);
}

std::vector<SpanRow> SpanTimes::rows(const std::vector<std::string>& walls,
                                     const std::function<void(NodeRef, SpanRow&)>& nameNode) const {
  std::vector<Clock::rep> totals;
  for (const auto& [key, cost] : costs_)
    if (key.node.valid()) totals.push_back(cost.elapsedTotal.count());
  std::ranges::sort(totals, std::greater());
  const Clock::rep dear = totals.size() > kNodesWithFrames ? totals[kNodesWithFrames] : 0;

  std::vector<SpanRow> all(costs_.size());
  for (const auto& [key, cost] : costs_) {
    SpanRow& row = all[cost.row];
    row.stage = nameOfStage(key.stage);
    const bool ofWall = key.stage == Span::Cull || key.stage == Span::Draw;
    if (ofWall && key.wall < walls.size()) row.wall = walls[key.wall];
    if (key.node.valid()) nameNode(key.node, row);
    row.count = cost.frames.size();
    if (isPlanted(key)) row.plantedUs = 1e-3 * median({planted_.begin(), planted_.end()});
    if (row.count > 0) row.msMean = 1e-6 * static_cast<double>(cost.total) / static_cast<double>(row.count);
    if (key.node.valid() && cost.elapsedTotal.count() < dear) continue;
    for (const OfFrame& of : cost.frames) {
      row.frames[of.frame] = 1e-3 * static_cast<double>(of.processor);
      row.elapsed[of.frame] = microseconds(of.elapsed);
    }
    if (row.isStage() && !row.elapsed.empty()) row.elapsedUs = typicalElapsed(row);
  }
  std::map<std::string, double> byLabel;
  for (const auto& [row, count] : executed_) byLabel["row " + std::to_string(row)] = count;
  if (!byLabel.empty()) giveInstructions(all, byLabel);
  if (!wholeFrames_.empty()) {
    SpanRow& whole = all.emplace_back();
    whole.stage = "frame";
    whole.count = wholeFrames_.size();
    for (const auto& [frame, took] : wholeFrames_) whole.elapsed[frame] = microseconds(took);
    whole.elapsedUs = typicalElapsed(whole);
  }
  return all;
}

}  // namespace stadion::regression
