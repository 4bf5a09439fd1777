#include "profiling/frame_judge.h"

#include <algorithm>
#include <utility>

namespace stadion {
namespace {

constexpr std::size_t kMostOpen = 64;  ///< frames that nobody has shown yet; older ones never will be

/// `under`: what was going on within it.
StageFacts factsOf(const SpanRecord& r, StageFacts stage) {
  stage.ms = static_cast<float>(r.took) - stage.turn;
  stage.processor = static_cast<float>(r.use.processor);
  stage.switches = static_cast<std::uint32_t>(r.use.switches);
  stage.faults = static_cast<std::uint32_t>(r.use.faults);
  stage.delayed = static_cast<float>(r.use.delayed);
  stage.late = static_cast<float>(r.use.late);
  return stage;
}

}  // namespace

FrameFacts& FrameJudge::frame(std::uint64_t number) {
  const auto [at, isNew] = open_.try_emplace(number);
  if (isNew) {
    at->second.frame = number;
    at->second.walls = walls_;
    at->second.budget = budget_;
    at->second.sequential = sequential_;
    if (open_.size() > kMostOpen) open_.erase(open_.begin());
  }
  return open_[number];
}

void FrameJudge::take(std::size_t track, const SpanRecord& r) {
  if (r.frame == kNoFrame) return;
  StageFacts& under = pending_[track];
  switch (r.what) {
  case Span::ForTurn: under.turn += static_cast<float>(r.took); return;
  case Span::Loading:
  case Span::Upload: under.loading += static_cast<float>(r.took); return;
  case Span::Swap: return show(r, factsOf(r, {}));
  case Span::App:
  case Span::Cull:
  case Span::Draw: break;
  default:
    if (isOfNode(r.what)) takeNode(frame(r.frame), r);
    return;
  }
  const StageFacts stage = factsOf(r, std::exchange(under, {}));
  FrameFacts& facts = frame(r.frame);
  if (r.what == Span::App)
    facts.app = stage;
  else if (r.wall < facts.walls)
    (r.what == Span::Cull ? facts.cull : facts.draw)[r.wall] = stage;
  // It holds up the next frame, too.
  if (r.what == Span::Draw && r.disturbed) sampledUntil_ = std::max(sampledUntil_, r.frame + 2);
}

void FrameJudge::takeNode(FrameFacts& facts, const SpanRecord& r) {
  if (r.took <= static_cast<double>(facts.nodeMs)) return;
  facts.nodeMs = static_cast<float>(r.took);
  facts.node[0] = r.node.load, facts.node[1] = r.node.position;
}

void FrameJudge::take(const CountRecord& c) {
  if (c.what == Count::Largest) largest_[c.wall] = c.node;
}

/// Of each part of Cull, the node that had most of it the last time that it was shared.
void FrameJudge::take(const SharedSpan& s) {
  if (stageOf(s.what) != Span::Cull || s.wall == kNoWall || s.among.empty()) return;
  std::map<NodeRef, std::size_t> parts;
  for (const NodeRef node : s.among)
    if (node.valid()) ++parts[node];
  const auto most = std::ranges::max_element(parts, {}, [](const auto& part) { return part.second; });
  if (most == parts.end()) return;
  const double share = static_cast<double>(most->second) / static_cast<double>(s.among.size());
  culled_[{s.wall, s.what}] = {s.ms * share, most->first};
}

NodeRef FrameJudge::dearestCulled(std::uint32_t wall) const {
  Culled dearest;
  for (const auto& [part, culled] : culled_)
    if (part.first == wall && (!dearest.node.valid() || culled.ms > dearest.ms)) dearest = culled;
  return dearest.node;
}

/// Empty if nobody knows it.
std::string FrameJudge::title(NodeRef node) const {
  const auto name = node.valid() ? names_.find(node) : std::nullopt;
  return name ? name->path + " " + name->file + ":" + std::to_string(name->line) : "";
}

void FrameJudge::show(const SpanRecord& swap, const StageFacts& stage) {
  FrameFacts facts = frame(swap.frame);
  facts.swap = stage, facts.sampled = swap.frame < sampledUntil_;
  open_.erase(open_.begin(), open_.upper_bound(swap.frame));
  if (lastShown_ != ProfileClock::time_point{})
    facts.period = std::chrono::duration<float, std::milli>(swap.ended - lastShown_).count();
  lastShown_ = swap.ended;
  judge(facts);
  copyText(title(facts.dearest()), facts.name);
  if (const auto at = largest_.find(facts.wall); facts.stage == Span::Draw && at != largest_.end())
    copyText(title(at->second), facts.most);
  if (facts.stage == Span::Cull) copyText(title(dearestCulled(facts.wall)), facts.most);
  shown_(facts);
}

}  // namespace stadion
