// What nodes have to do without, because they cost too much. Decided elsewhere (engine/load_control.h); here
// it is obeyed, at the start of the frame whose signature says so.

#include "engine/nodes/object_node.h"
#include "engine/scene/scene.h"

#include <algorithm>

namespace stadion {
namespace {

/// Those that run on from where they stopped, however long ago that was. What others do in a frame costs
/// little, or somebody looks at it in every frame.
bool hasPace(NodeKind kind) {
  return kind == NodeKind::Dynamics || kind == NodeKind::Collision;
}

}  // namespace

const NodeTerms* Scene::termsOf(NodeRef node) const {
  const Load* l = load(node.load);
  const auto at = l ? l->terms.find(node.position) : std::map<std::uint32_t, NodeTerms>::const_iterator{};
  return l && at != l->terms.end() ? &at->second : nullptr;
}

Relief Scene::reliefOf(NodeRef node) const {
  if (reliefs_.empty()) return {};
  const auto at = reliefs_.find(node);
  return at == reliefs_.end() ? Relief{} : at->second;
}

void Scene::obey(const TimeSignature& now) {
  for (const LoadDecision& d : now.load) obey(d);
  const bool nothing = reliefLevels_.empty() && reliefs_.empty();
  if (now.load.count > 0 || (!nothing && reliefLoads_ != loadsVersion_)) spreadRelief();
}

/// A log may have been written for another version of the script: what makes no sense is left.
void Scene::obey(const LoadDecision& d) {
  const NodeRef node{d.load, d.position};
  if (!node.valid()) {
    stressLevel_ = std::min(d.level, kMostStress);
    return;
  }
  const NodeTerms* terms = termsOf(node);
  const std::uint32_t level = terms ? std::min(d.level, levelsOf(terms->gives)) : 0;
  if (level > 0)
    reliefLevels_[node] = level;
  else
    reliefLevels_.erase(node);
}

/// From those that were decided about to all below them.
void Scene::spreadRelief() {
  std::map<NodeRef, Relief> before;
  before.swap(reliefs_);
  for (const auto& [ref, level] : reliefLevels_) {
    const Relief own = reliefAt(termsOf(ref)->gives, level);
    // What stands still in a chunk cannot be hidden or changed there.
    if (own.hidden || own.lod != 1) find(ref), promoteBelow(ref);
  }
  for (const auto& [number, l] : loads_)
    for (std::uint32_t i = 0; !reliefLevels_.empty() && i < l->nodes.size(); ++i) {
      Relief relief;
      for (NodeRef at{number, i}; at.valid(); at = parentOf(at))
        if (const auto known = reliefLevels_.find(at); known != reliefLevels_.end())
          relief = relief.below(reliefAt(termsOf(at)->gives, known->second));
      if (relief != Relief{}) reliefs_[{number, i}] = relief;
    }
  reliefLoads_ = loadsVersion_;
  for (const auto& [ref, relief] : reliefs_)
    if (const auto at = before.find(ref); at == before.end() || at->second != relief)
      relieve(ref, at == before.end() ? Relief{} : at->second, relief);
  for (const auto& [ref, relief] : before)
    if (!reliefs_.contains(ref)) relieve(ref, relief, {});
}

void Scene::relieve(NodeRef ref, const Relief& before, const Relief& now) {
  const Load* l = load(ref.load);
  const auto* placed = l ? dynamic_cast<const PlacedNode*>(l->nodes[ref.position].get()) : nullptr;
  if (!placed || placed->placement() == kNoPlacement) return;
  if (before.hidden != now.hidden) placements_.setShown(placed->placement(), !now.hidden, Hider::Relief);
  if (before.lod != now.lod) markInstancesAt(placed->placement());
}

/// Whether its cycle does not run in this frame. Those that share a pace take turns.
bool Scene::isPutOff(NodeRef ref) const {
  const auto at = reliefs_.find(ref);
  if (at == reliefs_.end() || (!at->second.rests && at->second.pace == 0)) return false;
  const Load* l = load(ref.load);
  if (!l || !l->nodes[ref.position] || !hasPace(l->nodes[ref.position]->kind())) return false;
  return at->second.rests || (frame_ + ref.position) % (std::uint64_t{1} << at->second.pace) != 0;
}

/// The same; if so, it is noted for when its turn has come.
bool Scene::putOff(NodeRef ref, Nanoseconds frameStart) {
  if (reliefs_.empty() || !isPutOff(ref)) return false;
  putOff_.insert(ref);
  Paced& paced = paced_.try_emplace(ref, Paced{frameStart, false}).first->second;
  paced.rests |= reliefs_.at(ref).rests;
  return true;
}

Scene::Cycle Scene::cycleOf(Node& node, const TimeSignature& now) {
  Cycle cycle{&node, now, false};
  const auto at = paced_.find(node.self());
  if (at == paced_.end()) return cycle;
  cycle.rested = at->second.rests;
  if (!cycle.rested) cycle.now.step = now.time - at->second.since;
  paced_.erase(at);
  return cycle;
}

void Scene::hashRelief(StateHash& h) const {
  for (const auto& [ref, level] : reliefLevels_) h.add(ref), h.add(level);
  for (const auto& [ref, paced] : paced_) h.add(ref), h.add(paced.since), h.add(paced.rests);
}

}  // namespace stadion
