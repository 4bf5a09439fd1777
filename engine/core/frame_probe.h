#pragma once
/// Receives the costs of the frame loop, the stages and the nodes. The profiling layer implements it. Without
/// a probe, nothing is measured.
///
/// Spans of time nest strictly within a thread: a stage contains its parts, and these contain nodes. Time in
/// a stage that belongs to no part is the stage's own.
///
/// Work that cannot be timed for one node is timed for several together. `shared` names the nodes that share
/// it. `drewAlone` reports the cost of a few nodes when nothing else was drawn.
///
/// Threads  each function is called on the thread that does the work; an implementation takes calls of
///          several threads at a time.

#include "engine/base/time_signature.h"
#include "engine/core/message.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace stadion {

/// The kinds of work for which time is measured.
enum class Span : std::uint8_t {
  // The stages.
  App,
  Cull,
  Draw,
  Swap,
  // Of a node, within App (the paper's figure 4).
  Receive,
  Simulate,
  Dispatch,
  // Of App beside the nodes' cycles.
  Input,     ///< devices and logs are asked
  Loading,   ///< files take effect or go
  Mail,      ///< finds the nodes to visit, and their messages
  Workers,   ///< waits for nodes that simulate side by side
  Settle,    ///< takes up the changes of a node's cycle: its hash, and nodes that it wakes
  Publish,   ///< writes the changes into the slot
  Sound,     ///< finds the sounds that are heard
  Watching,  ///< observers: hashes, reports, records
  // Of Cull.
  Eyes,         ///< cameras and what they can see, lights, sky
  Test,         ///< spheres against what can be seen
  Fill,         ///< writes the visible objects into the draw list
  ShadowCasts,  ///< writes the shadow casters into the lists of the rings
  Sort,
  // Of Draw.
  Prepare,     ///< batches and buffers
  Upload,      ///< meshes on their first use, to the graphics
  ShadowMaps,  ///< casters, as the light sees them
  LeftEye,     ///< the left eye, or the only one
  RightEye,
  Sky,      ///< clearing, and the sky where nothing was drawn
  Resolve,  ///< samples become pixels
  Finish,   ///< the rasteriser, or the graphics processor, completes what it was told
  Read,     ///< pictures are read back
  Warp,     ///< pictures of facets become those of a projector
  // Waits.
  ForTick,   ///< App, for the clock
  ForSlot,   ///< App, for Cull to give a slot back
  ForFrame,  ///< Cull, for App
  ForList,   ///< Cull, for Draw to give a list back
  ForDraw,   ///< Draw, for Cull
  ForTurn,   ///< Draw, for other walls that use the rasteriser
  ForWalls,  ///< Draw, for the walls that are not done
};
constexpr std::size_t kSpans = static_cast<std::size_t>(Span::ForWalls) + 1;

constexpr bool isStage(Span s) {
  return s <= Span::Swap;
}
constexpr bool isOfNode(Span s) {
  return s >= Span::Receive && s <= Span::Dispatch;
}
constexpr bool isWait(Span s) {
  return s >= Span::ForTick;
}
std::string_view nameOf(Span span);

/// The stage that a span belongs to.
constexpr Span stageOf(Span s) {
  if (isStage(s)) return s;
  if (s <= Span::Watching || s == Span::ForTick || s == Span::ForSlot) return Span::App;
  if (s <= Span::Sort || s == Span::ForFrame || s == Span::ForList) return Span::Cull;
  return Span::Draw;
}

/// The counts of a frame. They count work, not time, so the same show has the same counts on every machine.
enum class Count : std::uint8_t {
  // Of App.
  Visits,     ///< nodes that had something to do
  Messages,   ///< delivered
  Published,  ///< records, into the slot
  // Of a dynamics node.
  Impacts,
  Contacts,  ///< points at which bodies lay on something, in all steps of the frame
  Substeps,  ///< flights from one event to the next, and steps in contact
  // Of Cull, on a wall.
  Tested,   ///< spheres, against what can be seen
  Seen,     ///< spheres among them that one eye or both can see
  Casters,  ///< moving objects that cast shadows
  // Of Draw, for an eye.
  Calls,
  Instances,
  Triangles,
  Pixels,
  // Of Draw, for a wall.
  Largest,  ///< work of the node that has the most to draw: pixels it may cover and eight for each triangle
};
constexpr std::size_t kCounts = static_cast<std::size_t>(Count::Largest) + 1;
std::string_view nameOf(Count count);

/// Number of batches that a sampled frame draws alone, for each eye.
constexpr std::size_t kBatchesAFrame = 4;

constexpr std::uint64_t kNoFrame = ~std::uint64_t{0};
constexpr std::uint32_t kNoWall = ~std::uint32_t{0};

/// The samples that a probe wants of a wall's drawing of a frame, beside its spans. They change no pixel, but
/// take time.
enum class DrawSample : std::uint8_t {
  None,
  Whole,  ///< each eye alone, from an idle rasteriser to an idle rasteriser: the cost that the nodes explain
  Some,   ///< a few of the batches, each alone
};

/// Drawing that nothing else overlapped.
struct IsolatedDrawTime {
  std::uint64_t frame = 0;
  std::uint32_t wall = 0;
  std::uint32_t eye = 0;  ///< 0 left or the only one, 1 right
  Span what =
      Span::LeftEye;   ///< the eye: everything of it; Draw: nodes; Sky, Resolve, ShadowMaps, Prepare: these
  double ms = 0;       ///< without what drawing nothing takes
  double emptyMs = 0;  ///< cost of drawing nothing [ms]
  /// After so many frames it has its turn again, if there is as much to draw. The sampler sets it.
  std::uint64_t round = 0;
};

/// A node's part of what several cost together; the parts sum to 1.
struct NodeShare {
  NodeRef node;
  float part = 1;
};

class FrameProbe {
public:
  virtual ~FrameProbe() = default;

  /// A stage, or a wait. kNoFrame: the frame is not known yet; kNoWall: it belongs to no wall.
  virtual void began(Span what, std::uint64_t frame, std::uint32_t wall) = 0;
  /// Anything within a stage; of a node if that is valid.
  virtual void began(Span what, NodeRef node) = 0;
  virtual void ended(Span what) = 0;
  /// Adds to a count of the span that runs on this thread; for a node, if that is valid.
  virtual void counted(Count, std::uint64_t, NodeRef = {}) {}

  /// Returns true if each phase of a node's visit is reported as a span. Otherwise only visited() is called.
  /// Asked once in App.
  virtual bool wantsSpansOfVisits() const { return true; }
  /// The visit of this node is over. It began when the visit before it was over, or when all mail was
  /// delivered.
  virtual void visited(NodeRef) {}

  /// Returns true if `shared` is wanted for this frame of that wall.
  virtual bool wantsShares(std::uint64_t, std::uint32_t) const { return false; }
  /// The last such span of this frame and wall was spent on these nodes, on all alike; a node named twice
  /// cost twice. An invalid node stands for the visitor. LeftEye, RightEye: the nodes that eye will draw.
  virtual void shared(Span, std::uint64_t, std::uint32_t, std::span<const NodeRef>) {}

  /// How this frame of that wall is sampled, which is now being drawn. Asked once a frame.
  virtual DrawSample drawSample(std::uint64_t, std::uint32_t) { return DrawSample::None; }
  /// Returns true if a batch of these nodes is to have a turn of being drawn alone.
  virtual bool wantsAlone(std::span<const NodeRef>) const { return true; }
  /// Which of `batches` batches that are to have one is drawn alone next; those that follow it may be, too.
  virtual std::size_t nextBatch(std::uint32_t, std::uint32_t, std::size_t) { return 0; }
  /// Receives the cost of drawing alone, with the nodes that were drawn, if any were.
  virtual void drewAlone(const IsolatedDrawTime&, std::span<const NodeShare>) {}
};

/// A span as a scope. Without a probe it does nothing.
class SpanScope {
public:
  SpanScope(FrameProbe* probe, Span what, NodeRef node = {}) : probe_(probe), what_(what) {
    if (probe_) probe_->began(what_, node);
  }
  SpanScope(FrameProbe* probe, Span what, std::uint64_t frame, std::uint32_t wall)
      : probe_(probe), what_(what) {
    if (probe_) probe_->began(what_, frame, wall);
  }
  ~SpanScope() {
    if (probe_) probe_->ended(what_);
  }
  SpanScope(const SpanScope&) = delete;
  SpanScope& operator=(const SpanScope&) = delete;

private:
  FrameProbe* probe_;
  Span what_;
};

}  // namespace stadion
