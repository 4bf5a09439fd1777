#pragma once
/// A show's frame budget, told: a row for each node and each stage, and how much of the frame they explain.
///
/// Units    milliseconds a frame, means over all frames recorded.
/// Threads  plain values.

#include "profiling/record/node_names.h"
#include "profiling/report/show_profile.h"

namespace stadion {

struct NodeOnWall {
  double cull = 0;
  /// In the proportion of what each took drawn alone; with the eye's parts they sum to what it took as a
  /// whole.
  std::array<double, 2> draw{};  ///< left or only eye, right
  /// False: 0 means that no sample was taken, not that it costs nothing.
  bool cullMeasured = true;
  std::array<bool, 2> drawMeasured{true, true};
};

struct NodeRow {
  NodeRef node;
  NodeName name;
  double receive = 0, simulate = 0, dispatch = 0;
  double settle = 0;                       ///< taking up what it changed
  double publish = 0;                      ///< its records, into the slot
  double app = 0;                          ///< the sum of these
  double visitP95 = 0, visitMost = 0;      ///< of the frames in which App visited it
  double visits = 0;                       ///< a frame
  double drawingP95 = 0, drawingMost = 0;  ///< of what it took alone, on one wall for one eye
  std::uint64_t drawings = 0;              ///< of these there were so many
  double allocations = 0, bytes = 0;       ///< of memory, by App for it, a frame
  std::vector<NodeOnWall> walls;
  double cull = 0, draw = 0;  ///< of all walls and eyes
  /// False: some wall that it is on has not been sampled yet; what is there is of the others.
  bool cullMeasured = true, drawMeasured = true;
  /// Somewhere it was drawn alone, and the clock could not tell that from drawing nothing: its 0 is less than
  /// can be measured.
  bool drawTooLittle = false;
  bool drawKnown() const { return drawMeasured && !(drawTooLittle && draw <= 0); }
  double total = 0;  ///< of what was measured
  double share = 0;  ///< of all stages of all walls
};

/// What a stage took besides nodes, or in all.
struct StageRow {
  std::string stage, wall, eye;  ///< "draw", "front", "left"; empty: of no wall, of no eye
  std::string part;              ///< empty: the stage itself, or the eye; else "eyes", "sky", "for turn"
  bool alone = false;            ///< an eye drawn while nothing else was
  double ms = 0, p95 = 0, most = 0;
  std::uint64_t count = 0;
  bool wait = false;
  double allocations = 0, bytes = 0;  ///< of memory, each time
  /// "cull front", "draw front left, alone".
  std::string name() const;
};

/// Work that is counted, a frame.
struct CountRow {
  std::string of;    ///< "app", "cull front", "draw front left", or a node's path
  std::string what;  ///< "triangles"
  double mean = 0, most = 0;
};

/// How much of a stage is explained.
struct Explained {
  std::string stage;    ///< app, cull, draw, alone
  double measured = 0;  ///< of all walls and eyes
  double nodes = 0;
  double named = 0;  ///< parts of the stage itself
  /// 0 where things were found, but what was measured cannot be; 1 where there was nothing.
  double covered() const {
    return measured > 0 ? (nodes + named) / measured : nodes + named != 0 || measured < 0 ? 0 : 1;
  }
};

struct ShowFigures {
  std::uint64_t frames = 0;
  std::vector<std::string> walls;
  std::vector<std::size_t> eyes;  ///< of each wall: 1, 2; 0 where nothing was drawn
  std::vector<NodeRow> nodes;     ///< the dearest first
  std::vector<StageRow> stages;
  std::vector<CountRow> counts;
  /// By the clock, as it was played. Of an eye's time nodes and parts have as much as they had, scaled, of
  /// the eye drawn alone.
  Explained app, cull, draw;
  /// The eyes drawn alone, and what was drawn alone in them, before it was scaled to that.
  Explained alone;
  double warmUpMs = 0;     ///< before the first frame is drawn; in no other figure. 0: nothing was drawn
  std::string drawMethod;  ///< empty: nothing was drawn
  std::uint64_t wholeFrames = 0;   ///< of `frames`: those that App by node is of
  std::uint64_t framesNeeded = 0;  ///< about so many would measure every node; 0: these did, or none would
  std::array<const Explained*, 4> explained() const { return {&app, &cull, &draw, &alone}; }
};

/// Whether that OpenGL draws on the processor, where drawing is measured as processor time: by its name, as a
/// run tells it. Mesa's EGL may, too.
bool drawnBySoftware(std::string_view gl);

/// "LP_NUM_THREADS=2", as llvmpipe found it: with how many threads it draws.
std::string rasteriserThreadsText();

/// `gl`: what drew, as a run tells it; empty: nothing was drawn.
ShowFigures figuresOf(const ShowProfile& profile, const NodeNames& names,
                      const std::vector<std::string>& walls, std::string_view gl);

/// The dearest nodes and the stages, for a terminal.
std::string toText(const ShowFigures& figures, std::size_t mostNodes);
/// One JSON object on one line: "frames", "nodes", "stages", "counts", "explained".
std::string toJson(const ShowFigures& figures);
/// Times: a row a node, stage, wall and eye; a row a stage, part, wall and eye.
std::string toCsv(const ShowFigures& figures);

}  // namespace stadion
