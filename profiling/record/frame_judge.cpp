#include "profiling/record/frame_judge.h"

#include <algorithm>
#include <utility>

namespace stadion {
namespace {

constexpr std::size_t kMostOpen = 64;  ///< frames that were not shown by then never will be

float milliseconds(ProfileClock::duration d) {
  return std::chrono::duration<float, std::milli>(d).count();
}

/// `under`: events within the stage.
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

FrameJudge::Open& FrameJudge::frame(std::uint64_t number) {
  if (const auto known = open_.find(number); known != open_.end()) return known->second;
  // Room is made first: the new frame may be older than all others.
  if (open_.size() == kMostOpen) open_.erase(open_.begin());
  Open& open = open_.try_emplace(number, walls_).first->second;
  open.facts.frame = open.facts.appFrame = number;
  open.facts.budget = budget_;
  open.facts.sequential = sequential_;
  return open;
}

void FrameJudge::take(std::size_t track, const SpanRecord& r) {
  Pending& pending = pending_[track];
  if (r.what == Span::ForSlot) pending.slot += static_cast<float>(r.took);
  if (r.frame == kNoFrame) return;
  switch (r.what) {
  case Span::ForTick: pending.tick += static_cast<float>(r.took); return;
  case Span::ForTurn: pending.under.turn += static_cast<float>(r.took); return;
  case Span::ForDraw: pending.rest += static_cast<float>(r.took); return;  // this time belongs to Cull
  case Span::ShadowMaps: pending.shadows += static_cast<float>(r.took); return;
  case Span::Loading:
  case Span::Upload: pending.under.loading += static_cast<float>(r.took); return;
  case Span::Swap: return show(r, factsOf(r, {}));
  case Span::App:
  case Span::Cull:
  case Span::Draw: break;
  default:
    if (isOfNode(r.what)) takeNode(frame(r.frame).facts, r);
    return;
  }
  StageFacts stage = factsOf(r, std::exchange(pending.under, {}));
  stage.ms -= std::exchange(pending.rest, 0.0f);
  const bool shadows = std::exchange(pending.shadows, 0.0f) > 0.5f * stage.ms;
  Open& open = frame(r.frame);
  if (r.what == Span::App)
    takeApp(open, r, stage, std::exchange(pending, {}));
  else if (r.wall < open.facts.walls) {
    (r.what == Span::Cull ? open.facts.cull : open.facts.draw)[r.wall] = stage;
    (r.what == Span::Cull ? open.cull : open.draw)[r.wall] = r.began;
    if (r.what == Span::Draw) open.shadows[r.wall] = shadows;
  }
  // Sampling delays the next frame, too.
  if (r.what == Span::Draw && r.disturbed) sampledUntil_ = std::max(sampledUntil_, r.frame + 2);
}

void FrameJudge::takeApp(Open& open, const SpanRecord& r, const StageFacts& stage, const Pending& before) {
  open.facts.app = stage;
  open.app = r.began;
  open.facts.tick = before.tick;
  open.facts.slot = before.slot;
  if (lastApp_ != ProfileClock::time_point{}) open.facts.sinceApp = milliseconds(r.began - lastApp_);
  lastApp_ = r.began;
}

void FrameJudge::takeNode(FrameFacts& facts, const SpanRecord& r) {
  if (r.took <= static_cast<double>(facts.nodeMs)) return;
  facts.nodeMs = static_cast<float>(r.took);
  facts.node[0] = r.node.load;
  facts.node[1] = r.node.position;
}

void FrameJudge::take(const CountRecord& c) {
  if (c.what == Count::Largest) largest_[c.wall] = c.node;
}

/// Keeps, for each part of Cull, the node with the largest share in the last sample.
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

NodeRef FrameJudge::mostExpensiveCulled(std::uint32_t wall) const {
  Culled mostExpensive;
  for (const auto& [part, culled] : culled_)
    if (part.first == wall && (!mostExpensive.node.valid() || culled.ms > mostExpensive.ms))
      mostExpensive = culled;
  return mostExpensive.node;
}

/// Returns an empty text if the node is unknown.
std::string FrameJudge::title(NodeRef node) const {
  const auto name = node.valid() ? names_.find(node) : std::nullopt;
  return name ? name->path + " " + name->file + ":" + std::to_string(name->line) : "";
}

/// If App catches up after a frame that will never be shown, that frame's delay also delays this one.
void FrameJudge::takePassedOver(Open& open) const {
  const auto held = [](const FrameFacts& f) { return f.app.ms + f.app.late + f.tick + f.slot; };
  for (const auto& [number, passed] : open_) {
    if (number >= open.facts.frame) return;
    const FrameFacts& f = passed.facts;
    if (held(f) <= held(open.facts)) continue;
    open.app = passed.app;
    open.facts.appFrame = number;
    open.facts.app = f.app;
    open.facts.tick = f.tick;
    open.facts.slot = f.slot;
    open.facts.sinceApp = f.sinceApp;
    open.facts.nodeMs = f.nodeMs;
    std::ranges::copy(f.node, open.facts.node);
  }
}

/// Places its stages in time, relative to the previous frame's swap.
void FrameJudge::place(Open& open, const SpanRecord& swap) {
  const auto placed = [&](StageFacts& stage, ProfileClock::time_point began) {
    if (began != ProfileClock::time_point{}) stage.at = milliseconds(began - lastShown_);
  };
  FrameFacts& f = open.facts;
  placed(f.app, open.app);
  placed(f.swap, swap.began);
  for (std::uint32_t wall = 0; wall < f.walls; ++wall) {
    placed(f.cull[wall], open.cull[wall]);
    placed(f.draw[wall], open.draw[wall]);
  }
}

void FrameJudge::show(const SpanRecord& swap, const StageFacts& stage) {
  Open& open = frame(swap.frame);
  open.facts.swap = stage;
  open.facts.sampled = swap.frame < sampledUntil_;
  takePassedOver(open);
  if (lastShown_ != ProfileClock::time_point{}) place(open, swap);
  FrameFacts facts = std::move(open.facts);
  const auto shadows = std::move(open.shadows);
  open_.erase(open_.begin(), open_.upper_bound(swap.frame));
  if (lastShown_ != ProfileClock::time_point{}) facts.period = milliseconds(swap.ended - lastShown_);
  lastShown_ = swap.ended;
  judge(facts);
  copyText(title(facts.mostExpensive()), facts.name);
  if (const auto at = largest_.find(facts.wall); facts.stage == Span::Draw && at != largest_.end())
    copyText(shadows[facts.wall] ? "the shadow maps" : title(at->second), facts.most);
  if (facts.stage == Span::Cull) copyText(title(mostExpensiveCulled(facts.wall)), facts.most);
  shown_(facts);
}

}  // namespace stadion
