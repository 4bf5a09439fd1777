#pragma once
/// Applies the degradation of nodes that cost too much: they run less often, simplify their meshes or hide.
///
/// Decisions are made elsewhere (engine/core/cost_budget.h). They arrive with the time signature of a frame
/// and take effect at its start. A decision about a node also holds for all nodes below it.
///
/// Ownership  borrows its collaborators.
/// Threads    App only.
/// Errors     decisions that name no such node or level are ignored: a log may belong to another version of
///            the script.

#include "engine/core/cost_budget.h"
#include "engine/scene/instances.h"
#include "engine/scene/placements.h"
#include "engine/scene/scene_time.h"
#include "engine/scene/scene_tree.h"

#include <cstdint>
#include <map>
#include <set>

namespace stadion {

class Degradation {
public:
  /// The time for which a node's cycle runs.
  struct Turn {
    TimeSignature now;  ///< signature whose step includes the frames that the node missed
    bool rested;        ///< the node's own time stood still up to this frame's start
  };

  Degradation(SceneTree& tree, Placements& placements, Instances& instances, const SceneTime& time)
      : tree_(tree), placements_(placements), instances_(instances), time_(time) {}

  // For nodes.

  /// Returns how far the node is degraded, because it or a node above it costs too much.
  NodeDegradation of(NodeRef node) const {
    if (degraded_.empty()) return {};
    const auto at = degraded_.find(node);
    return at == degraded_.end() ? NodeDegradation{} : at->second;
  }
  /// Factor by which everything counts as farther away when levels of detail are chosen.
  double stress() const { return stressOf(stressLevel_); }

  // For the scene.

  void apply(const TimeSignature& now);
  /// Returns true if any node is degraded.
  bool any() const { return !degraded_.empty(); }
  /// Returns true if the node's cycle does not run in this frame. If so, notes once what the node misses.
  bool putOff(Node& node);
  /// Keeps a node waiting that was woken and is put off.
  void keepWaiting(NodeRef node) { waiting_.insert(node); }
  /// Calls `wake` for each waiting node that is put off no longer, also if it was removed.
  template <class Wake>
  void wakeWaiting(const Wake& wake) {
    std::erase_if(waiting_, [&](NodeRef ref) {
      Node* node = tree_.find(ref);
      if (node && putOff(*node)) return false;
      wake(ref);
      return true;
    });
  }
  /// The turn of a node whose cycle runs in this frame. It has then missed nothing.
  Turn turnOf(Node& node, const TimeSignature& now);
  void forget(std::uint32_t load);

  void hash(StateHash& h) const;
  void state(StateFields& f);
  bool consistent() const;

private:
  struct Paced {
    Nanoseconds since = 0;  ///< when its last cycle ended
    bool rests = false;

    template <class Self, class Fields>
    static void fields(Self& p, Fields& f) {
      f("since", p.since), f("rests", p.rests);
    }
  };

  void apply(const DegradationDecision& decision);
  void spread();
  void degrade(NodeRef node, const NodeDegradation& before, const NodeDegradation& now);
  const NodeTerms* termsOf(NodeRef node) const;
  bool isPutOff(Node& node) const;

  SceneTree& tree_;
  Placements& placements_;
  Instances& instances_;
  const SceneTime& time_;
  std::map<NodeRef, std::uint32_t> levels_;      ///< levels of the nodes with a decision
  std::map<NodeRef, NodeDegradation> degraded_;  ///< degradation of these nodes and of all below them
  std::uint64_t treeVersion_ = 0;                ///< the tree's when degraded_ were found
  std::uint32_t stressLevel_ = 0;
  std::set<NodeRef> waiting_;       ///< woken and put off
  std::map<NodeRef, Paced> paced_;  ///< nodes that missed something
};

}  // namespace stadion
