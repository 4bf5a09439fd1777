#pragma once
/// The costs of watched nodes, frame by frame: all time spent on them and on the nodes below them.
///
/// App's cost is known for each frame. Costs of Cull and Draw are known from samples (FrameLog: shares of
/// culling, batches drawn alone). Between two samples the last one counts, until the next one is overdue by
/// two rounds of sampling. A sample may be disturbed, so decisions use the lesser of the last two.
///
/// Units    milliseconds.
/// Threads  the log's thread, except see(), which is App's; the owner locks names and terms.

#include "engine/scene/scene.h"
#include "profiling/budget/degradation_policy.h"
#include "profiling/record/frame_log.h"

#include <map>
#include <unordered_map>

namespace stadion {

/// A node with a budget or a degradation ladder.
struct GovernedNode {
  NodeRef node;
  NodeTerms terms;
  bool drawn = false;  ///< the node, or a node below it, may be drawn
};

/// The cost of such a node in one frame.
struct NodeCost {
  BudgetedCost cost;
  BudgetedCost sure;  ///< the part that two samples in a row confirm
  /// The node's drawing was sampled since the last change of how it is drawn.
  bool known = true;
  bool drawKnown = true;           ///< the node's drawing was sampled, or the node was never visible
  Span mostExpensive = Span::App;  ///< the most expensive stage
  std::uint32_t wall = kNoWall;    ///< wall of that stage
};

class NodeCosts {
public:
  /// Sets the nodes to measure. `above`: for each node below some of them, their places in the list. `sky`:
  /// the node that draws the background.
  void govern(std::vector<GovernedNode> nodes, std::map<NodeRef, std::vector<std::size_t>> above,
              NodeRef sky);
  const std::vector<GovernedNode>& governed() const { return nodes_; }

  void take(const SpanRecord& record);
  void take(const ShortVisits& visits);
  void take(const SharedSpan& shared);
  void take(const IsolatedDrawTime& drawn, const std::vector<NodeShare>& nodes);

  /// From that frame on a governed node is drawn in another way, or not at all: earlier samples are void.
  void drawnOtherwise(std::size_t governed, std::uint64_t frame, bool hidden);

  /// Returns the costs of the governed nodes in that frame, as far as known.
  std::vector<NodeCost> of(std::uint64_t frame) const;
  void forget(std::uint64_t upToFrame);

private:
  /// A sample of one wall and one eye's drawing, or of one part of culling.
  struct Sample {
    double ms = 0, before = 0;  ///< before: in the previous sample; 0 = none
    std::uint64_t frame = 0;
    std::uint64_t until = 0;  ///< last frame for which it counts
  };
  struct SampleKey {
    std::size_t governed;
    NodeRef node;
    std::uint32_t wall, eye;
    Span what;
    auto operator<=>(const SampleKey&) const = default;
  };
  void spend(std::uint64_t frame, NodeRef node, double ms);
  void sample(const IsolatedDrawTime& taken, std::span<const NodeShare> among);
  /// How a governed node is drawn, and since when.
  struct Drawn {
    std::uint64_t since = 0;
    bool hidden = false;
    bool seen = false, sampled = false;  ///< a wall has shown it; it has been drawn alone
    std::uint64_t round = 0;             ///< longest time until its drawing is sampled [frames]
  };

  std::vector<GovernedNode> nodes_;
  std::map<NodeRef, std::vector<std::size_t>> above_;
  NodeRef sky_;
  std::map<std::uint64_t, std::vector<double>> app_;  ///< by frame, then governed node [ms]
  std::map<SampleKey, Sample> samples_;
  std::vector<Drawn> drawn_;  ///< by governed node
};

/// Returns true if the show has levels of detail that stress affects.
bool hasLevels(const Scene& scene);

/// Returns true if the node, or a node below it, may be drawn. Null: a static object.
bool mayBeDrawn(const Node* node);

/// Returns the governed nodes of the present loads, and for each node those at or above it, the nearest
/// first.
std::pair<std::vector<GovernedNode>, std::map<NodeRef, std::vector<std::size_t>>>
governedNodes(const Scene& scene);

}  // namespace stadion
