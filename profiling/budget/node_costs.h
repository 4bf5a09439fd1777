#pragma once
/// What nodes with terms cost, frame by frame: all that is spent on them and on what stands below them.
///
/// App is known of each frame. Cull and Draw are known from samples (FrameLog: who shared in culling, which
/// batches were drawn alone); between two samples the last one counts, until another has not come for two
/// rounds of sampling. A sample may be disturbed: what is to be acted on is the lesser of the last two.
///
/// Units    milliseconds. Threads  the log's thread, but see(), which is App's; names and terms are locked by
///          the owner.

#include "engine/scene/scene.h"
#include "profiling/budget/relief_policy.h"
#include "profiling/record/frame_log.h"

#include <map>
#include <unordered_map>

namespace stadion {

/// A node that has a budget or something to give up.
struct GovernedNode {
  NodeRef node;
  NodeTerms terms;
  bool drawn = false;  ///< something of it, or below it, may be drawn
};

/// What one of them cost in one frame.
struct NodeCost {
  LoadCost cost;
  LoadCost sure;  ///< as far as two samples in a row say so
  /// Whether what is drawn of it has been looked at since it was drawn otherwise than before.
  bool known = true;
  bool drawKnown = true;         ///< drawing it has been looked at, or nothing of it was ever seen
  Span dearest = Span::App;      ///< the stage in which it cost most
  std::uint32_t wall = kNoWall;  ///< of that stage
};

class NodeCosts {
public:
  /// Whose costs are kept from now on. `above`: of each node that stands below some of them, these, by their
  /// places in the list. `sky`: who is drawn where nothing else is.
  void govern(std::vector<GovernedNode> nodes, std::map<NodeRef, std::vector<std::size_t>> above,
              NodeRef sky);
  const std::vector<GovernedNode>& governed() const { return nodes_; }

  void take(const SpanRecord& record);
  void take(const ShortVisits& visits);
  void take(const SharedSpan& shared);
  void take(const DrawnAlone& drawn, const std::vector<NodeShare>& nodes);

  /// From that frame on a governed node is drawn otherwise, or not at all: what was known of it is void.
  void drawnOtherwise(std::size_t governed, std::uint64_t frame, bool hidden);

  /// What the governed nodes cost in that frame, as far as it is known now.
  std::vector<NodeCost> of(std::uint64_t frame) const;
  void forget(std::uint64_t upToFrame);

private:
  /// Of one wall and one eye's drawing, or of one part of culling.
  struct Sample {
    double ms = 0, before = 0;  ///< before: in the sample before; 0 = there was none
    std::uint64_t frame = 0;
    std::uint64_t until = 0;  ///< frame after which it says nothing any more
  };
  struct SampleKey {
    std::size_t governed;
    NodeRef node;
    std::uint32_t wall, eye;
    Span what;
    auto operator<=>(const SampleKey&) const = default;
  };
  void spend(std::uint64_t frame, NodeRef node, double ms);
  void sample(const DrawnAlone& taken, std::span<const NodeShare> among);
  /// How a governed node has been drawn, and since when.
  struct Drawn {
    std::uint64_t since = 0;
    bool hidden = false;
    bool seen = false, sampled = false;  ///< a wall has shown something of it; that has been drawn alone
    std::uint64_t round = 0;             ///< so long a sample of its drawing may take to come [frames]
  };

  std::vector<GovernedNode> nodes_;
  std::map<NodeRef, std::vector<std::size_t>> above_;
  NodeRef sky_;
  std::map<std::uint64_t, std::vector<double>> app_;  ///< by frame, then governed node [ms]
  std::map<SampleKey, Sample> samples_;
  std::vector<Drawn> drawn_;  ///< by governed node
};

/// Whether the show has anything that stress acts on.
bool hasLevels(const Scene& scene);

/// Whether something of the node, or below it, may be drawn. Null: a static object.
bool mayBeDrawn(const Node* node);

/// The governed nodes of the loads that are there, and of each node those at or above it, the nearest first.
std::pair<std::vector<GovernedNode>, std::map<NodeRef, std::vector<std::size_t>>>
governedNodes(const Scene& scene);

}  // namespace stadion
