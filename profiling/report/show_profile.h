#pragma once
/// Adds up what a show's frames were spent on: by node, by stage, by wall and eye.
///
/// App       each node's phases are timed in the frames that are recorded as a whole: all, unless App visits
///           very many nodes (FrameLog).
/// Cull      tests, filling, sorting are timed for a whole wall; in the frames that are sampled each node
/// gets
///           its part: all alike that were tested, all alike that are seen, all alike that cast shadows. So
///           does publishing, in App.
/// Draw      in the frames that are sampled a few batches are drawn alone, each in its place, until all have
///           been; instances of one batch share by the pixels they may cover and their triangles. A node's
///           cost in a frame is what it cost when drawn, by how often it was drawn. Nothing is normalised
///           here: ShowFigures scales the rows, and tells how far the sum was from the eye drawn whole.
///
/// A frame in which App or a wall's Cull was kept from the processor by others says how long the stage took,
/// but not who took it: whatever was under way has all of it. It counts for no node and no part of that
/// stage, unless half of its frames are so.
///
/// Nodes that go and come again with their file are the same nodes (NodeNames).
///
/// Units    milliseconds. Threads  SpanReader's; `names` may be asked meanwhile.

#include "profiling/record/cost_series.h"
#include "profiling/record/frame_log.h"
#include "profiling/record/node_names.h"

#include <map>
#include <unordered_map>

namespace stadion {

/// A node's cost on one wall, of both eyes.
struct WallCost {
  std::map<Span, std::uint64_t> shares;  ///< of tests, fillings and so on, in the frames sampled
  std::array<double, 2> draw{};          ///< alone, in all, by eye
  std::array<std::uint64_t, 2> drawn{};
  void add(const WallCost& other);
};

struct NodeProfile {
  std::array<double, 3> phases{};  ///< receive, simulate, dispatch, in all
  Allocations allocations;         ///< in all
  double settle = 0;               ///< whose turn it is, with which messages; what it changed is taken up
  std::uint64_t published = 0;     ///< how often, in the frames sampled
  CostSeries visit;                ///< all phases of a frame together, of the frames in which it was visited
  CostSeries drawing;              ///< each time it was drawn alone, on one wall for one eye
  std::map<std::uint32_t, WallCost> walls;
  void add(const NodeProfile& other);
};

/// One kind of span, in all.
struct SpanTotal {
  CostSeries ms;
  double kept = 0;  ///< [ms] of a stage: in the frames that its parts are of
  double own = 0;   ///< in none of its parts
  Allocations allocations;
  std::uint64_t counted = 0;  ///< spans whose allocations these are: those that the probe did not disturb
};

/// What an eye's drawing consists of, alone.
struct EyeCost {
  CostSeries whole;                  ///< without what drawing nothing takes
  std::map<Span, CostSeries> parts;  ///< sky, resolve: each time it was drawn
  CostSeries batches;
  CostSeries empty;  ///< what drawing nothing takes
};

/// Whose work is counted: a stage's, an eye's, or a node's.
struct Counted {
  Span of = Span::App;  ///< the stage; LeftEye, RightEye: of Draw
  std::uint32_t wall = kNoWall;
  NodeRef node;
  Count what = Count::Visits;
  auto operator<=>(const Counted&) const = default;
};

class ShowProfile final : public SpanReader {
public:
  /// Without names, every load brings other nodes. They must outlive the profile.
  explicit ShowProfile(const NodeNames* names = nullptr) : names_(names) {}

  using SpanReader::take;
  void take(std::size_t track, const SpanRecord& record) override;
  void take(const CountRecord& count) override;
  void take(const SharedSpan& shared) override;
  void take(const DrawnAlone& drawn, const std::vector<NodeShare>& nodes) override;

  const std::map<NodeRef, NodeProfile>& nodes() const { return nodes_; }
  /// By kind and wall (kNoWall: of no wall).
  const std::map<std::pair<Span, std::uint32_t>, SpanTotal>& spans() const { return spans_; }
  /// By wall and eye.
  const std::map<std::pair<std::uint32_t, std::uint32_t>, EyeCost>& eyes() const { return eyes_; }
  /// Each time it was counted.
  const std::map<Counted, CostSeries>& counts() const { return counts_; }
  std::uint64_t frames() const { return frames_; }
  /// Frames that the parts of that wall's Cull are of.
  std::uint64_t keptCulls(std::uint32_t wall) const;
  /// Frames in which every node's spans were recorded: what App's parts and its nodes took is of these.
  std::uint64_t wholeFrames() const { return wholeFrames_; }
  /// What App took in them, in all [ms].
  double wholeApp() const { return wholeApp_; }
  /// What nodes took on threads that help App, in all.
  double helped() const { return helped_; }
  /// Of all nodes together: how often they shared a span of that kind, in the frames sampled.
  std::uint64_t shares(Span what, std::uint32_t wall) const;
  /// Frames in which shares were told, by wall; kNoWall: of App.
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
  std::unordered_map<std::uint32_t, std::uint32_t> firstLoads_;  ///< as `names_` said
  std::map<NodeRef, NodeProfile> nodes_;
  /// By track: the parts of a stage that is not over.
  std::map<std::size_t, std::vector<SpanRecord>> parts_;
  struct Kept {
    std::uint64_t frames = 0, leftOut = 0;
  };
  std::map<std::pair<Span, std::uint32_t>, Kept> kept_;  ///< App, Cull by wall
  std::map<NodeRef, Visit> visits_;                      ///< that may not be over
  std::map<std::size_t, std::vector<NodeRef>> called_;   ///< by thread: since its last Span::Mail
  std::vector<NodeRef> visited_;                         ///< in the frame that App is at
  std::vector<SpanRecord> rounds_;  ///< in it, the spans of Mail in which nobody received
  std::map<std::pair<Span, std::uint32_t>, SpanTotal> spans_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, EyeCost> eyes_;
  std::map<std::uint32_t, std::uint64_t> sampled_;
  std::map<std::pair<Span, std::uint32_t>, std::uint64_t> shares_;
  std::map<Counted, CostSeries> counts_;
  std::uint64_t frames_ = 0, wholeFrames_ = 0;
  double wholeApp_ = 0;
  double helped_ = 0;
};

}  // namespace stadion
