#pragma once
/// Adds up the costs of a show's frames: by node, by stage, by wall and eye.
///
/// App       Each node's phases are timed in the frames that are recorded as a whole: all, unless App visits
///           very many nodes (FrameLog).
/// Cull      Tests, filling and sorting are timed for a whole wall. In sampled frames each node gets its
///           share: equal shares for all tested, all visible, and all shadow-casting instances. Publishing in
///           App is shared the same way.
/// Draw      In sampled frames a few batches are drawn alone, each in its place, until all have been.
///           Instances of one batch share its cost by the pixels they may cover and by their triangles. A
///           node's cost in a frame is its cost when drawn, times how often it was drawn. ShowFigures scales
///           the rows, and reports how far their sum was from the eye drawn whole.
///
/// In some frames other programs keep App or a wall's Cull from the processor. Such a frame gives the stage's
/// duration, but no shares: the span under way would get all of it. It counts for no node and no part of that
/// stage, unless half of the stage's frames are so.
///
/// Nodes that are unloaded and loaded again with their file are the same nodes (NodeNames).
///
/// Units    milliseconds.
/// Threads  SpanReader's; `names` may be used meanwhile.

#include "profiling/record/cost_series.h"
#include "profiling/record/frame_log.h"
#include "profiling/record/node_names.h"

#include <map>
#include <unordered_map>

namespace stadion {

/// A node's cost on one wall, for both eyes.
struct NodeWallCost {
  std::map<Span, std::uint64_t> shares;  ///< time of tests, fillings and so on, in sampled frames
  std::array<double, 2> draw{};          ///< drawn alone, in all, by eye
  std::array<std::uint64_t, 2> drawn{};
  void add(const NodeWallCost& other);
};

struct NodeProfile {
  std::array<double, 3> phases{};  ///< receive, simulate, dispatch, in all
  Allocations allocations;         ///< in all
  double settle = 0;               ///< order and messages of its visit; applying its changes
  std::uint64_t published = 0;     ///< number of times, in sampled frames
  CostSeries visit;                ///< all phases of a frame together, in frames with a visit
  CostSeries drawing;              ///< times of drawing the node alone, on one wall for one eye
  std::map<std::uint32_t, NodeWallCost> walls;
  void add(const NodeProfile& other);
};

/// The total of one kind of span.
struct SpanTotal {
  CostSeries ms;
  double kept = 0;  ///< [ms] of a stage: in the frames of its parts
  double own = 0;   ///< outside its parts
  Allocations allocations;
  std::uint64_t counted = 0;  ///< spans of these allocations: those without allocations of the probe
};

/// The parts of an eye's drawing, drawn alone.
struct EyeCost {
  CostSeries whole;                  ///< without the fixed cost of drawing nothing
  std::map<Span, CostSeries> parts;  ///< sky, resolve: each time it was drawn
  CostSeries batches;
  CostSeries empty;  ///< the fixed cost of drawing nothing
};

/// The owner of counted work: a stage, an eye, or a node.
struct CountKey {
  Span of = Span::App;  ///< the stage; LeftEye, RightEye: of Draw
  std::uint32_t wall = kNoWall;
  NodeRef node;
  Count what = Count::Visits;
  auto operator<=>(const CountKey&) const = default;
};

class ShowProfile final : public SpanReader {
public:
  /// Without names, every load brings other nodes. They must outlive the profile.
  explicit ShowProfile(const NodeNames* names = nullptr) : names_(names) {}

  using SpanReader::take;
  void take(std::size_t track, const SpanRecord& record) override;
  void take(const CountRecord& count) override;
  void take(const SharedSpan& shared) override;
  void take(const IsolatedDrawTime& drawn, const std::vector<NodeShare>& nodes) override;

  const std::map<NodeRef, NodeProfile>& nodes() const { return nodes_; }
  /// Returns totals by kind and wall (kNoWall: no wall).
  const std::map<std::pair<Span, std::uint32_t>, SpanTotal>& spans() const { return spans_; }
  /// By wall and eye.
  const std::map<std::pair<std::uint32_t, std::uint32_t>, EyeCost>& eyes() const { return eyes_; }
  /// Returns the series of each count.
  const std::map<CountKey, CostSeries>& counts() const { return counts_; }
  std::uint64_t frames() const { return frames_; }
  /// Returns the number of frames with parts of that wall's Cull.
  std::uint64_t keptCulls(std::uint32_t wall) const;
  /// Returns the number of frames in which every node's spans were recorded; App's parts and nodes are from
  /// these.
  std::uint64_t wholeFrames() const { return wholeFrames_; }
  /// Returns App's total time in them [ms].
  double wholeApp() const { return wholeApp_; }
  /// Returns the total time of nodes on threads that help App.
  double helped() const { return helped_; }
  /// Returns how often all nodes together shared a span of that kind, in sampled frames.
  std::uint64_t shares(Span what, std::uint32_t wall) const;
  /// Returns the number of frames with shares, by wall; kNoWall: of App.
  std::uint64_t sampled(std::uint32_t wall) const;

private:
  NodeProfile& profileOf(NodeRef node) { return nodes_[firstOf(node)]; }
  NodeRef firstOf(NodeRef node);
  void adopt(std::uint32_t load, std::uint32_t first);
  bool keeps(const SpanRecord& stage);
  void takePart(std::size_t track, const SpanRecord& record);
  void addPhase(NodeRef node, const SpanRecord& record);
  void add(const SpanRecord& record);
  void takeMail(std::size_t track, const SpanRecord& record);
  void shareRounds();

  struct Visit {
    std::uint64_t frame = kNoFrame;
    double ms = 0;
  };
  const NodeNames* names_;
  std::unordered_map<std::uint32_t, std::uint32_t> firstLoads_;  ///< from `names_`
  std::map<NodeRef, NodeProfile> nodes_;
  /// By track: the parts of an unfinished stage.
  std::map<std::size_t, std::vector<SpanRecord>> parts_;
  struct Kept {
    std::uint64_t frames = 0, leftOut = 0;
  };
  std::map<std::pair<Span, std::uint32_t>, Kept> kept_;  ///< App, Cull by wall
  std::map<NodeRef, Visit> visits_;                      ///< unfinished visits
  std::map<std::size_t, std::vector<NodeRef>> called_;   ///< by thread: since its last Span::Mail
  std::vector<NodeRef> visited_;                         ///< in App's current frame
  std::vector<SpanRecord> rounds_;                       ///< in it, the spans of Mail without a receiver
  std::map<std::pair<Span, std::uint32_t>, SpanTotal> spans_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, EyeCost> eyes_;
  std::map<std::uint32_t, std::uint64_t> sampled_;
  std::map<std::pair<Span, std::uint32_t>, std::uint64_t> shares_;
  std::map<CountKey, CostSeries> counts_;
  std::uint64_t frames_ = 0, wholeFrames_ = 0;
  double wholeApp_ = 0;
  double helped_ = 0;
};

}  // namespace stadion
