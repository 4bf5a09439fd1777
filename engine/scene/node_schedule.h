#pragma once
/// The schedule of nodes: which are visited in a frame, and in what order.
///
/// A frame is one round. It visits the busy nodes, nodes with mail, nodes whose alarm rings, nodes that watch
/// a placement that moved, and nodes that another node wakes. The order is by rank, level, load number and
/// position in the file. It is the same on every machine and for every number of threads.
///
/// Units      show time in nanoseconds.
/// Ownership  borrows its collaborators and, within a round, the nodes.
/// Threads    App only.
/// Errors     calls for nodes that are not loaded are ignored.

#include "engine/scene/degradation.h"
#include "engine/scene/placements.h"
#include "engine/scene/scene_tree.h"
#include "engine/scene/visit_queue.h"

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace stadion {

class NodeSchedule {
public:
  NodeSchedule(SceneTree& tree, Placements& placements, Degradation& degradation)
      : tree_(tree), placements_(placements), degradation_(degradation) {}

  // For nodes.

  /// Visits `node` in the frame in which `when` falls.
  void wakeAt(Nanoseconds when, NodeRef node) { alarms_.insert({when, node}); }
  /// Visits `node` in this frame if its turn is still to come, else in the next frame.
  void wakeNow(NodeRef node);
  /// Wakes `watcher` whenever the placement moves.
  void watch(PlacementId placement, NodeRef watcher);
  void unwatch(PlacementId placement, NodeRef watcher);
  /// Visits `node` in the frame after a load came, and in the frame in which one goes.
  void watchLoads(NodeRef node) { loadWatchers_.insert(node); }
  void unwatchLoads(NodeRef node) { loadWatchers_.erase(node); }

  // For the scene: a round.

  /// Begins a round with the busy nodes.
  void begin(const Scene& scene);
  /// Adds a node to the round before it is sorted; false if the node is not loaded.
  bool call(NodeRef ref);
  /// Adds all nodes that are due at `now` and sorts the round.
  void callDue(Nanoseconds now);
  /// The next node of the round; null at its end. It stays the next one until take().
  const VisitQueue::Entry* next() const { return queue_.next(); }
  /// Takes the next node, which is then the current one.
  void take() {
    current_ = queue_.next()->visit;
    queue_.take();
  }
  /// Makes a node current again that was taken before.
  void setCurrent(const Node& node) { current_ = Visit::of(node); }
  void end() { current_.reset(); }
  bool inRound() const { return current_.has_value(); }
  /// Wakes the nodes that watch placements that have moved.
  void wakeWatchers();
  /// Wakes the nodes that watch loads.
  void wakeLoadWatchers() {
    for (const NodeRef watcher : loadWatchers_) wakeNow(watcher);
  }

  // For the scene: nodes that come and go.

  /// Notes whether the node is busy.
  void update(Node& node) { queue_.setBusy(node, node.busy()); }
  /// The node leaves; updateBusy() before it is destroyed.
  void remove(Node& node) { queue_.setBusy(node, false); }
  void updateBusy() { queue_.updateBusy(); }
  /// Drops the alarms of a load's nodes.
  void forget(std::uint32_t load) {
    std::erase_if(alarms_, [&](const Alarm& a) { return a.node.load == load; });
  }

  void hash(StateHash& h) const {
    for (const Alarm& a : alarms_) {
      h.add(a.at);
      h.add(a.node);
    }
  }
  void stateOfAlarms(StateFields& f);
  void stateOfWatchers(StateFields& f);
  void stateOfLevels(StateFields& f);
  bool consistent() const;
  /// After restoring: nodes that were busy before had no levels yet.
  void resume() { queue_.reorder(); }

private:
  struct Alarm {
    Nanoseconds at = 0;
    NodeRef node;
    auto operator<=>(const Alarm&) const = default;

    template <class Self, class Fields>
    static void fields(Self& a, Fields& f) {
      f("at", a.at), f("node", a.node);
    }
  };

  void findLevels(const Scene& scene);

  SceneTree& tree_;
  Placements& placements_;
  Degradation& degradation_;
  VisitQueue queue_;
  std::optional<Visit> current_;      ///< visit of the node whose cycle runs
  std::vector<NodeRef> wokenLate_;    ///< after their turn: for the next round
  std::vector<NodeRef> wokenBefore_;  ///< callDue()'s own
  std::set<Alarm> alarms_;
  std::multimap<PlacementId, NodeRef> watchers_;
  std::set<NodeRef> loadWatchers_;
  std::uint64_t loadsTold_ = 0;    ///< the tree's version that load watchers know
  std::uint64_t levelsLoads_ = 0;  ///< the tree's version when levels were found, ...
  bool levelsSettled_ = false;     ///< ... and the nodes that move things were known
};

}  // namespace stadion
