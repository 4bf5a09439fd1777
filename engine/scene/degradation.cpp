#include "engine/scene/degradation.h"

#include "engine/core/state_fields.h"
#include "engine/scene/placed_node.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stadion {
namespace {

/// Whether a node advances by steps: what it missed is one longer step.
bool takesSteps(const Node& node) {
  return node.type().traits.has(Trait::Collides);
}

/// Whether a node can run less often. The cycles of the others cost little, or something looks at their
/// results in every frame.
bool hasPace(const Node& node) {
  return node.type().traits.has(Trait::Degradable);
}

/// In which of four frames a node has its turn if it runs in one of so many. The golden ratio spreads nodes
/// evenly, also over every second or third position in a file.
std::uint64_t slotOf(std::uint32_t position) {
  return (position * 0x9E3779B9U) >> 30;
}

}  // namespace

const NodeTerms* Degradation::termsOf(NodeRef node) const {
  const LoadedScene* l = std::as_const(tree_).load(node.load);
  const auto at = l ? l->terms.find(node.position) : std::map<std::uint32_t, NodeTerms>::const_iterator{};
  return l && at != l->terms.end() ? &at->second : nullptr;
}

void Degradation::apply(const TimeSignature& now) {
  for (const DegradationDecision& d : now.decisions) apply(d);
  const bool nothing = levels_.empty() && degraded_.empty();
  if (now.decisions.count > 0 || (!nothing && treeVersion_ != tree_.version())) spread();
}

void Degradation::apply(const DegradationDecision& d) {
  const NodeRef node{d.load, d.position};
  if (!node.valid()) {
    stressLevel_ = std::min(d.level, kMostStress);
    return;
  }
  const NodeTerms* terms = termsOf(node);
  const std::uint32_t level = terms ? std::min(d.level, levelsOf(terms->gives)) : 0;
  if (level > 0)
    levels_[node] = level;
  else
    levels_.erase(node);
}

/// Finds the degradations of all nodes below those that were decided about.
void Degradation::spread() {
  std::map<NodeRef, NodeDegradation> before;
  before.swap(degraded_);
  for (const auto& [ref, level] : levels_) {
    const NodeDegradation own = degradationAt(termsOf(ref)->gives, level);
    // A static object cannot be hidden or changed in its chunk.
    if (own.hidden || own.lod != 1) {
      tree_.find(ref);
      tree_.promoteBelow(ref);
    }
  }
  for (const auto& [number, l] : tree_.loads())
    for (std::uint32_t i = 0; !levels_.empty() && i < l->nodes.size(); ++i) {
      NodeDegradation degradation;
      for (NodeRef at{number, i}; at.valid(); at = tree_.parentOf(at))
        if (const auto known = levels_.find(at); known != levels_.end())
          degradation = degradation.below(degradationAt(termsOf(at)->gives, known->second));
      if (degradation != NodeDegradation{}) degraded_[{number, i}] = degradation;
    }
  treeVersion_ = tree_.version();
  for (const auto& [ref, degradation] : degraded_)
    if (const auto at = before.find(ref); at == before.end() || at->second != degradation)
      degrade(ref, at == before.end() ? NodeDegradation{} : at->second, degradation);
  for (const auto& [ref, degradation] : before)
    if (!degraded_.contains(ref)) degrade(ref, degradation, {});
}

void Degradation::degrade(NodeRef ref, const NodeDegradation& before, const NodeDegradation& now) {
  const LoadedScene* l = std::as_const(tree_).load(ref.load);
  Node* node = l ? l->nodes[ref.position].get() : nullptr;
  if (!node) return;
  if (hasPace(*node)) {
    node->scheduleState().rests = now.rests;
    node->scheduleState().pace = now.pace;
  }
  const PlacedNode* placed = node->placed();
  if (!placed || placed->placement() == kNoPlacement) return;
  if (before.hidden != now.hidden) placements_.setShown(placed->placement(), !now.hidden, Hider::Degradation);
  if (before.lod != now.lod) instances_.markAt(placed->placement());
}

/// Nodes that share a pace take turns. A node that follows a tracker is never put off.
bool Degradation::isPutOff(Node& node) const {
  const Node::ScheduleState& s = node.scheduleState();
  if (!s.rests && s.pace == 0) return false;
  if (const PlacedNode* placed = node.placed(); placed && placed->attached()) return false;
  return s.rests || (time_.frame + slotOf(node.self().position)) % (std::uint64_t{1} << s.pace) != 0;
}

bool Degradation::putOff(Node& node) {
  if (!isPutOff(node)) return false;
  Node::ScheduleState& s = node.scheduleState();
  const Node::Missed missed = s.rests ? Node::Missed::Time : Node::Missed::Frames;
  // A node that is a function of time needs to know only of time that does not count.
  if (missed <= s.missed || !(s.rests || takesSteps(node))) return true;
  s.missed = missed;
  paced_.try_emplace(node.self(), Paced{time_.start, false}).first->second.rests = s.rests;
  return true;
}

Degradation::Turn Degradation::turnOf(Node& node, const TimeSignature& now) {
  Turn turn{now, false};
  const Node::Missed missed = std::exchange(node.scheduleState().missed, Node::Missed::Nothing);
  if (missed == Node::Missed::Nothing) return turn;
  const auto at = paced_.find(node.self());
  turn.rested = missed == Node::Missed::Time;
  if (!turn.rested) turn.now.step = now.time - at->second.since;
  paced_.erase(at);
  return turn;
}

void Degradation::forget(std::uint32_t load) {
  std::erase_if(levels_, [&](const auto& l) { return l.first.load == load; });
  std::erase_if(waiting_, [&](NodeRef ref) { return ref.load == load; });
  std::erase_if(paced_, [&](const auto& p) { return p.first.load == load; });
}

void Degradation::hash(StateHash& h) const {
  for (const auto& [ref, level] : levels_) {
    h.add(ref);
    h.add(level);
  }
  for (const auto& [ref, paced] : paced_) {
    h.add(ref);
    h.add(paced.since);
    h.add(paced.rests);
  }
}

void Degradation::state(StateFields& f) {
  f("relief levels", levels_), f("reliefs", degraded_), f("relief loads", treeVersion_);
  f("stress", stressLevel_), f("put off", waiting_), f("paced", paced_);
}

bool Degradation::consistent() const {
  if (stressLevel_ > kMostStress) return false;
  for (const auto& [node, degradation] : degraded_)
    if (degradation.pace > levelsOf(DegradationStep::Half) || !std::isfinite(degradation.lod)) return false;
  for (const auto& [number, l] : tree_.loads())
    for (const std::uint32_t position : l->enterOrder) {
      const Node& node = *l->nodes[position];
      if (node.scheduleState().missed == Node::Missed::Nothing) continue;
      const auto paced = paced_.find(node.self());
      if (paced == paced_.end() || paced->second.since < 0 || paced->second.since > time_.now) return false;
    }
  return true;
}

}  // namespace stadion
