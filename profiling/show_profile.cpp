#include "profiling/show_profile.h"

namespace stadion {

void ShowProfile::take(std::size_t track, const SpanRecord& r) {
  const bool partOfApp = r.what > Span::Swap && r.what <= Span::Watching;
  if (partOfApp && !r.whole) return;
  if (r.what == Span::Receive) called_[track].push_back(r.node), visited_.push_back(r.node);
  if (r.what == Span::Mail) return takeMail(track, r);
  if (r.what == Span::App) shareRounds();
  add(r);
}

void ShowProfile::add(const SpanRecord& r) {
  SpanTotal& total = spans_[{r.what, r.wall}];
  total.ms.add(r.took);
  total.own += r.own;
  if (!r.disturbed) total.allocations += r.allocations, ++total.counted;
  if (r.what == Span::App) {
    ++frames_;
    if (r.whole) ++wholeFrames_, wholeApp_ += r.took;
  }
  if (r.node.valid()) addPhase(r.node, r);
  if (r.depth == 0 && isOfNode(r.what)) helped_ += r.took;
}

/// Nodes that received within it are those for whom it was.
void ShowProfile::takeMail(std::size_t track, const SpanRecord& r) {
  std::vector<NodeRef>& called = called_[track];
  for (const NodeRef ref : called) nodes_[ref].settle += r.own / static_cast<double>(called.size());
  if (called.empty()) rounds_.push_back(r);
  called.clear();
}

/// Who is to be visited in a frame was found out for all that were.
void ShowProfile::shareRounds() {
  for (const SpanRecord& r : rounds_) {
    for (const NodeRef ref : visited_) nodes_[ref].settle += r.own / static_cast<double>(visited_.size());
    if (visited_.empty()) add(r);
  }
  rounds_.clear(), visited_.clear();
}

void ShowProfile::addPhase(NodeRef ref, const SpanRecord& r) {
  NodeProfile& node = nodes_[ref];
  const double ms = r.own;
  node.allocations += r.allocations;
  if (isOfNode(r.what))
    node.phases[static_cast<std::size_t>(r.what) - static_cast<std::size_t>(Span::Receive)] += ms;
  else
    node.settle += ms;
  // The first phase of a later frame tells that the earlier one's are complete.
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
  counts_[{ofEye ? c.within : stageOf(c.within), c.wall, c.node, c.what}].add(static_cast<double>(c.amount));
}

void ShowProfile::take(const SharedSpan& s) {
  if (s.what == Span::Publish || s.what == Span::Fill) ++sampled_[s.wall];
  shares_[{s.what, s.wall}] += s.among.size();
  for (const NodeRef ref : s.among)
    if (s.what == Span::Publish)
      ++nodes_[ref].published;
    else
      ++nodes_[ref].walls[s.wall].shares[s.what];
}

void ShowProfile::take(const DrawnAlone& d, const std::vector<NodeShare>& nodes) {
  EyeCost& eye = eyes_[{d.wall, d.eye}];
  eye.empty.add(d.emptyMs);
  if (d.what == Span::LeftEye || d.what == Span::RightEye)
    eye.whole.add(d.ms);
  else if (d.what != Span::Draw)
    eye.parts[d.what].add(d.ms);
  if (nodes.empty()) return;
  eye.batches.add(d.ms);
  for (const auto& [node, part] : nodes) {
    WallCost& wall = nodes_[node].walls[d.wall];
    wall.draw[d.eye] += d.ms * double{part};
    ++wall.drawn[d.eye];
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
