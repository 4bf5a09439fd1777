// What nodes have to do without, because they cost too much. Decided elsewhere (engine/core/load_control.h);
// here it is obeyed, at the start of the frame whose signature says so.

#include "engine/scene/object_node.h"
#include "engine/scene/scene.h"

#include <algorithm>
#include <utility>

namespace stadion {
namespace {

/// Those that go on from where they stopped step by step: what they have missed is one longer step.
bool takesSteps(const Node& node) {
  return node.type().traits.has(Trait::Collides);
}

/// What others do in a frame costs little, or somebody looks at it in every frame.
bool hasPace(const Node& node) {
  return node.type().traits.has(Trait::Degradable);
}

/// In which of four frames a node has its turn, when it runs in one of so many: spread evenly, also over
/// every second or third position in a file (the golden ratio).
std::uint64_t turnOf(std::uint32_t position) {
  return (position * 0x9E3779B9U) >> 30;
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
  Node* node = l ? l->nodes[ref.position].get() : nullptr;
  if (!node) return;
  if (hasPace(*node)) node->standing().rests = now.rests, node->standing().pace = now.pace;
  const PlacedNode* placed = node->placed();
  if (!placed || placed->placement() == kNoPlacement) return;
  if (before.hidden != now.hidden) placements_.setShown(placed->placement(), !now.hidden, Hider::Relief);
  if (before.lod != now.lod) markInstancesAt(placed->placement());
}

/// Whether its cycle does not run in this frame. Those that share a pace take turns; what is in somebody's
/// hand goes along with it.
bool Scene::isPutOff(Node& node) const {
  const Node::Standing& s = node.standing();
  if (!s.rests && s.pace == 0) return false;
  if (const PlacedNode* placed = node.placed(); placed && placed->attached()) return false;
  return s.rests || (frame_ + turnOf(node.self().position)) % (std::uint64_t{1} << s.pace) != 0;
}

/// The same; if so, what it misses is noted, once. What goes by the time needs to know only of time that does
/// not count.
bool Scene::putOff(Node& node) {
  if (!isPutOff(node)) return false;
  Node::Standing& s = node.standing();
  const Node::Missed missed = s.rests ? Node::Missed::Time : Node::Missed::Frames;
  if (missed <= s.missed || !(s.rests || takesSteps(node))) return true;
  s.missed = missed;
  paced_.try_emplace(node.self(), Paced{frameStart_, false}).first->second.rests = s.rests;
  return true;
}

Scene::Cycle Scene::cycleOf(Node& node, const TimeSignature& now) {
  Cycle cycle{&node, now, false};
  const Node::Missed missed = std::exchange(node.standing().missed, Node::Missed::Nothing);
  if (missed == Node::Missed::Nothing) return cycle;
  const auto at = paced_.find(node.self());
  cycle.rested = missed == Node::Missed::Time;
  if (!cycle.rested) cycle.now.step = now.time - at->second.since;
  paced_.erase(at);
  return cycle;
}

void Scene::hashRelief(StateHash& h) const {
  for (const auto& [ref, level] : reliefLevels_) h.add(ref), h.add(level);
  for (const auto& [ref, paced] : paced_) h.add(ref), h.add(paced.since), h.add(paced.rests);
}

}  // namespace stadion
