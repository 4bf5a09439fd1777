#include "profiling/report/show_profile.h"

namespace stadion {
namespace {

/// Cache limit: more loads than this are looked up again.
constexpr std::size_t kMostLoads = 256;

}  // namespace

void NodeWallCost::add(const NodeWallCost& other) {
  for (const auto& [what, count] : other.shares) shares[what] += count;
  for (std::size_t eye = 0; eye < 2; ++eye) {
    draw[eye] += other.draw[eye];
    drawn[eye] += other.drawn[eye];
  }
}

void NodeProfile::add(const NodeProfile& other) {
  for (std::size_t i = 0; i < phases.size(); ++i) phases[i] += other.phases[i];
  allocations += other.allocations;
  settle += other.settle;
  published += other.published;
  visit.add(other.visit);
  drawing.add(other.drawing);
  for (const auto& [wall, cost] : other.walls) walls[wall].add(cost);
}

NodeRef ShowProfile::firstOf(NodeRef node) {
  if (!names_ || !node.valid()) return node;
  if (const auto at = firstLoads_.find(node.load); at != firstLoads_.end())
    return {at->second, node.position};
  const auto first = names_->firstLoad(node.load);
  if (!first) return node;  // it has just come, and gets its name later
  if (firstLoads_.size() >= kMostLoads) firstLoads_.clear();
  firstLoads_[node.load] = *first;
  if (*first != node.load) adopt(node.load, *first);
  return {*first, node.position};
}

/// Adds the figures from before the load was named.
void ShowProfile::adopt(std::uint32_t load, std::uint32_t first) {
  for (auto at = nodes_.lower_bound({load, 0}); at != nodes_.end() && at->first.load == load;
       at = nodes_.erase(at))
    nodes_[{first, at->first.position}].add(at->second);
  for (auto at = visits_.lower_bound({load, 0}); at != visits_.end() && at->first.load == load;
       at = visits_.erase(at)) {
    Visit& visit = visits_[{first, at->first.position}];
    if (visit.frame != kNoFrame) nodes_[{first, at->first.position}].visit.add(visit.ms);
    visit = at->second;
  }
  for (auto at = counts_.begin(); at != counts_.end();) {
    if (at->first.node.load != load) {
      ++at;
      continue;
    }
    CountKey as = at->first;
    as.node.load = first;
    counts_[as].add(at->second);
    at = counts_.erase(at);
  }
}

/// Returns true if the parts of this stage count in this frame.
bool ShowProfile::keeps(const SpanRecord& r) {
  constexpr double kMuch = 0.05;  // of the stage
  if (r.what != Span::App && r.what != Span::Cull) return true;
  Kept& kept = kept_[{r.what, r.wall}];
  const bool leftOut = r.use.delayed > kMuch * r.took && kept.leftOut <= kept.frames;
  ++(leftOut ? kept.leftOut : kept.frames);
  return !leftOut;
}

std::uint64_t ShowProfile::keptCulls(std::uint32_t wall) const {
  const auto at = kept_.find({Span::Cull, wall});
  return at == kept_.end() ? 0 : at->second.frames;
}

void ShowProfile::take(std::size_t track, const SpanRecord& r) {
  std::vector<SpanRecord>& parts = parts_[track];
  if (r.depth > 0) {
    parts.push_back(r);
    return;
  }
  const bool kept = keeps(r);
  if (kept)
    for (const SpanRecord& part : parts) takePart(track, part);
  parts.clear();
  if (kept || r.what != Span::App) {
    takePart(track, r);
    if (kept) spans_[{r.what, r.wall}].kept += r.took;
    return;
  }
  // Counts as a frame that was not recorded as a whole.
  SpanRecord app = r;
  app.whole = false;
  takePart(track, app);
}

void ShowProfile::takePart(std::size_t track, const SpanRecord& r) {
  const bool partOfApp = r.what > Span::Swap && r.what <= Span::Watching;
  if (partOfApp && !r.whole) return;
  if (r.what == Span::Receive) {
    called_[track].push_back(r.node);
    visited_.push_back(r.node);
  }
  if (r.what == Span::Mail) return takeMail(track, r);
  if (r.what == Span::App) shareRounds();
  add(r);
}

void ShowProfile::add(const SpanRecord& r) {
  SpanTotal& total = spans_[{r.what, r.wall}];
  total.ms.add(r.took);
  total.own += r.own;
  if (!r.disturbed) {
    total.allocations += r.allocations;
    ++total.counted;
  }
  if (r.what == Span::App) {
    ++frames_;
    if (r.whole) {
      ++wholeFrames_;
      wholeApp_ += r.took;
    }
  }
  if (r.node.valid()) addPhase(r.node, r);
  if (r.depth == 0 && isOfNode(r.what)) helped_ += r.took;
}

/// The span belongs to the nodes that received messages in it.
void ShowProfile::takeMail(std::size_t track, const SpanRecord& r) {
  std::vector<NodeRef>& called = called_[track];
  for (const NodeRef ref : called) profileOf(ref).settle += r.own / static_cast<double>(called.size());
  if (called.empty()) rounds_.push_back(r);
  called.clear();
}

/// The search for the nodes to visit is shared by all nodes visited.
void ShowProfile::shareRounds() {
  for (const SpanRecord& r : rounds_) {
    for (const NodeRef ref : visited_) profileOf(ref).settle += r.own / static_cast<double>(visited_.size());
    if (visited_.empty()) add(r);
  }
  rounds_.clear();
  visited_.clear();
}

void ShowProfile::addPhase(NodeRef told, const SpanRecord& r) {
  const NodeRef ref = firstOf(told);
  NodeProfile& node = nodes_[ref];
  const double ms = r.own;
  node.allocations += r.allocations;
  if (isOfNode(r.what))
    node.phases[static_cast<std::size_t>(r.what) - static_cast<std::size_t>(Span::Receive)] += ms;
  else
    node.settle += ms;
  // The first phase of a later frame shows that the earlier frame's phases are complete.
  Visit& visit = visits_[ref];
  if (visit.frame != r.frame) {
    if (visit.frame != kNoFrame) node.visit.add(visit.ms);
    visit = {r.frame, 0};
  }
  visit.ms += ms;
}

void ShowProfile::take(const CountRecord& c) {
  if (c.what == Count::Largest) return;  // an estimate, for late frames
  const bool ofEye = c.within == Span::LeftEye || c.within == Span::RightEye;
  counts_[{ofEye ? c.within : stageOf(c.within), c.wall, firstOf(c.node), c.what}].add(
      static_cast<double>(c.amount));
}

void ShowProfile::take(const SharedSpan& s) {
  if (s.what == Span::Publish || s.what == Span::Fill) ++sampled_[s.wall];
  shares_[{s.what, s.wall}] += s.among.size();
  for (const NodeRef ref : s.among)
    if (s.what == Span::Publish)
      ++profileOf(ref).published;
    else
      ++profileOf(ref).walls[s.wall].shares[s.what];
}

void ShowProfile::take(const IsolatedDrawTime& d, const std::vector<NodeShare>& nodes) {
  EyeCost& eye = eyes_[{d.wall, d.eye}];
  eye.empty.add(d.emptyMs);
  if (d.what == Span::LeftEye || d.what == Span::RightEye)
    eye.whole.add(d.ms);
  else if (d.what != Span::Draw)
    eye.parts[d.what].add(d.ms);
  if (nodes.empty()) return;
  eye.batches.add(d.ms);
  for (const auto& [node, part] : nodes) {
    NodeWallCost& wall = profileOf(node).walls[d.wall];
    wall.draw[d.eye] += d.ms * double{part};
    ++wall.drawn[d.eye];
    profileOf(node).drawing.add(std::max(0.0, d.ms * double{part}));
  }
}

std::uint64_t ShowProfile::shares(Span what, std::uint32_t wall) const {
  const auto at = shares_.find({what, wall});
  return at == shares_.end() ? 0 : at->second;
}

std::uint64_t ShowProfile::sampled(std::uint32_t wall) const {
  const auto at = sampled_.find(wall);
  return at == sampled_.end() ? 0 : at->second;
}

}  // namespace stadion
