#include "profiling/budget/node_costs.h"

#include "engine/scene/object_node.h"

#include <algorithm>
#include <optional>
#include <tuple>

namespace stadion {
namespace {

/// A sample older than this expires if no new one came in its turn: the node is out of sight, or drawn in
/// another way [frames].
constexpr std::uint64_t kOld = 600;
/// Wait for a sample after a change of how a node is drawn; without one it is out of sight [frames].
constexpr std::uint64_t kAwaited = 128;

}  // namespace

bool mayBeDrawn(const Node* node) {
  return !node || node->type().traits.meets({Trait::Placed, Trait::Drawn});
}

std::pair<std::vector<GovernedNode>, std::map<NodeRef, std::vector<std::size_t>>>
governedNodes(const Scene& scene) {
  std::vector<GovernedNode> nodes;
  std::map<NodeRef, std::size_t> places;
  scene.tree().forEachLoad([&](const LoadedScene& load) {
    for (const auto& [position, terms] : load.terms) {
      places[{load.number, position}] = nodes.size();
      nodes.push_back({{load.number, position}, terms, mayBeDrawn(load.nodes[position].get())});
    }
  });
  std::map<NodeRef, std::vector<std::size_t>> above;
  if (nodes.empty()) return {nodes, above};
  scene.tree().forEachLoad([&](const LoadedScene& load) {
    for (std::uint32_t i = 0; i < load.nodes.size(); ++i)
      for (NodeRef at{load.number, i}; at.valid(); at = scene.tree().parentOf(at))
        if (const auto place = places.find(at); place != places.end())
          above[{load.number, i}].push_back(place->second);
  });
  return {std::move(nodes), std::move(above)};
}

bool hasLevels(const Scene& scene) {
  bool any = false;
  const auto look = [&](const Node* node) {
    if (!node) return;
    const auto* object = dynamic_cast<const ObjectNode*>(node);
    const Mesh* mesh = object ? scene.instances().mesh(object->appearance().mesh) : nullptr;
    any |= node->kind() == "lod" || (mesh && !mesh->levels.empty());
  };
  scene.tree().forEachLoad([&](const LoadedScene& load) {
    for (const auto& node : load.nodes) look(node.get());
    for (const InstanceRecord& r : load.chunkRecords) any |= r.lodFactor > 0;
  });
  return any;
}

void NodeCosts::govern(std::vector<GovernedNode> nodes, std::map<NodeRef, std::vector<std::size_t>> above,
                       NodeRef sky) {
  // Keeps the data of remaining nodes under their new places.
  std::vector<std::optional<std::size_t>> place(nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const auto at = std::ranges::find(nodes, nodes_[i].node, &GovernedNode::node);
    if (at != nodes.end()) place[i] = static_cast<std::size_t>(at - nodes.begin());
  }
  std::map<SampleKey, Sample> samples;
  for (const auto& [key, sample] : samples_) {
    if (key.what == Span::Sky && key.node != sky) continue;  // another sky is visible now
    if (const auto to = place[key.governed]) samples[{*to, key.node, key.wall, key.eye, key.what}] = sample;
  }
  std::vector<Drawn> drawn(nodes.size());
  for (std::size_t i = 0; i < drawn_.size(); ++i)
    if (place[i]) drawn[*place[i]] = drawn_[i];
  for (auto& [frame, costs] : app_) {
    std::vector<double> moved(nodes.size());
    for (std::size_t i = 0; i < costs.size(); ++i)
      if (place[i]) moved[*place[i]] = costs[i];
    costs = std::move(moved);
  }
  samples_ = std::move(samples);
  drawn_ = std::move(drawn);
  nodes_ = std::move(nodes);
  above_ = std::move(above);
  sky_ = sky;
}

void NodeCosts::drawnOtherwise(std::size_t governed, std::uint64_t frame, bool hidden) {
  if (governed < drawn_.size()) {
    drawn_[governed].since = frame;
    drawn_[governed].hidden = hidden;
  }
}

void NodeCosts::take(const SpanRecord& r) {
  if (r.node.valid() && (isOfNode(r.what) || r.what == Span::Settle)) spend(r.frame, r.node, r.took);
}

void NodeCosts::take(const ShortVisits& v) {
  spend(v.frame, v.holder, v.ms);
}

void NodeCosts::spend(std::uint64_t frame, NodeRef node, double ms) {
  const auto at = above_.find(node);
  if (at == above_.end()) return;
  std::vector<double>& costs = app_[frame];
  costs.resize(nodes_.size());
  for (const std::size_t governed : at->second) costs[governed] += ms;
}

void NodeCosts::sample(const IsolatedDrawTime& s, std::span<const NodeShare> among) {
  for (const auto& [node, part] : among)
    if (const auto at = above_.find(node); at != above_.end())
      for (const std::size_t governed : at->second) {
        Sample& known = samples_[{governed, node, s.wall, s.eye, s.what}];
        // A node that is drawn in several pieces of a frame costs their sum.
        if (known.frame != s.frame) known = {0, known.until < s.frame ? 0 : known.ms, s.frame, 0};
        known.ms += s.ms * double{part};
        known.until = s.frame + std::max(kOld, 2 * s.round);
        if (s.what == Span::Draw) drawn_[governed].sampled = true;
        if (s.what == Span::Draw) drawn_[governed].round = std::max(drawn_[governed].round, s.round);
      }
}

void NodeCosts::take(const SharedSpan& s) {
  if (stageOf(s.what) != Span::Cull || s.wall == kNoWall || s.among.empty()) return;
  for (const NodeRef node : s.among)
    if (const auto at = above_.find(node); s.what == Span::Fill && at != above_.end())
      for (const std::size_t governed : at->second) drawn_[governed].seen = true;
  std::vector<NodeShare> alike;
  for (const NodeRef node : s.among) alike.push_back({node, 1.0f / static_cast<float>(s.among.size())});
  sample({s.frame, s.wall, 0, s.what, s.ms, 0, s.round}, alike);
}

void NodeCosts::take(const IsolatedDrawTime& d, const std::vector<NodeShare>& nodes) {
  if (d.what == Span::Draw) return sample(d, nodes);
  const NodeShare whole{sky_, 1};
  if (d.what == Span::Sky && sky_.valid()) sample(d, {&whole, 1});
}

std::vector<NodeCost> NodeCosts::of(std::uint64_t frame) const {
  std::vector<NodeCost> costs(nodes_.size());
  const auto app = app_.find(frame);
  for (std::size_t i = 0; i < costs.size() && app != app_.end(); ++i)
    costs[i].cost.app = costs[i].sure.app = app->second[i];
  std::map<std::tuple<std::size_t, bool, std::uint32_t>, double> stages;  // governed, Draw, wall
  std::vector<bool> sampled(costs.size());
  for (const auto& [key, s] : samples_) {
    const Drawn& drawn = drawn_[key.governed];
    const bool isSky = key.what == Span::Sky;  // the sky is visible even if nodes are hidden
    if (s.until < frame || s.frame > frame) continue;
    if (!isSky && (drawn.hidden || s.frame < drawn.since)) continue;
    sampled[key.governed] = sampled[key.governed] || key.what == Span::Draw;
    const double ms = std::max(0.0, s.ms);  // for very short times the clock may give negative values
    costs[key.governed].cost.drawn += ms;
    costs[key.governed].sure.drawn += std::min(ms, std::max(0.0, s.before));
    stages[{key.governed, isSky || key.what == Span::Draw, key.wall}] += ms;
  }
  for (std::size_t i = 0; i < costs.size(); ++i) {
    costs[i].drawKnown = !drawn_[i].seen || drawn_[i].sampled;
    costs[i].known = drawn_[i].since == 0 || drawn_[i].hidden || sampled[i] ||
                     frame > drawn_[i].since + std::max(kAwaited, 2 * drawn_[i].round);
  }
  std::vector<double> most(costs.size());
  for (std::size_t i = 0; i < costs.size(); ++i) most[i] = costs[i].cost.app;
  for (const auto& [stage, ms] : stages) {
    const auto& [governed, isDraw, wall] = stage;
    if (ms <= most[governed]) continue;
    most[governed] = ms;
    costs[governed].mostExpensive = isDraw ? Span::Draw : Span::Cull;
    costs[governed].wall = wall;
  }
  return costs;
}

void NodeCosts::forget(std::uint64_t upToFrame) {
  app_.erase(app_.begin(), app_.upper_bound(upToFrame));
  std::erase_if(samples_, [&](const auto& s) { return s.second.until < upToFrame; });
}

}  // namespace stadion
