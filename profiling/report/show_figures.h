#pragma once
/// A show's frame budget as text: a row for each node and each stage, and the part of the frame that they
/// explain.
///
/// Units    milliseconds a frame, means over all frames recorded.
/// Threads  plain values.

#include "profiling/record/node_names.h"
#include "profiling/report/show_profile.h"

#include <map>
#include <string>

namespace stadion {

struct NodeOnWall {
  double cull = 0;
  /// In proportion to each node's time drawn alone. With the eye's parts they sum to the eye's whole time.
  std::array<double, 2> draw{};  ///< left or only eye, right
  /// False: no sample was taken, so 0 does not mean that it costs nothing.
  bool cullMeasured = true;
  std::array<bool, 2> drawMeasured{true, true};
};

/// The costs of a node. It has more than 20 fields: one for each number of the row.
struct NodeRow {
  NodeRef node;
  NodeName name;
  double receive = 0, simulate = 0, dispatch = 0;
  double settle = 0;                       ///< applying its changes
  double publish = 0;                      ///< publishing its records into the slot
  double app = 0;                          ///< the sum of these
  double visitP95 = 0, visitMost = 0;      ///< visit times in the frames in which App visited the node [ms]
  double visits = 0;                       ///< a frame
  double drawingP95 = 0, drawingMost = 0;  ///< times of drawing the node alone, on one wall for one eye [ms]
  std::uint64_t drawings = 0;              ///< number of these drawings
  double allocations = 0, bytes = 0;       ///< memory that App allocated for it, a frame
  std::vector<NodeOnWall> walls;
  double cull = 0, draw = 0;  ///< costs on all walls, for all eyes
  /// False: some wall with the node has not been sampled yet; the numbers cover the other walls.
  bool cullMeasured = true, drawMeasured = true;
  /// The node was drawn alone, but too fast for the clock: its 0 means less than can be measured.
  bool drawTooLittle = false;
  bool drawKnown() const { return drawMeasured && !(drawTooLittle && draw <= 0); }
  double total = 0;  ///< sum of the measured costs
  double share = 0;  ///< relative to all stages of all walls
};

/// The cost of a stage as a whole, or of its parts outside nodes.
struct StageRow {
  std::string stage, wall, eye;  ///< "draw", "front", "left"; empty: no wall, no eye
  std::string part;              ///< empty: the stage itself, or the eye; else "eyes", "sky", "for turn"
  bool alone = false;            ///< an eye drawn alone
  double ms = 0, p95 = 0, most = 0;
  std::uint64_t count = 0;
  bool wait = false;
  double allocations = 0, bytes = 0;  ///< memory allocated each time
  /// "cull front", "draw front left, alone".
  std::string name() const;
};

/// Counted work, a frame.
struct CountRow {
  std::string of;    ///< "app", "cull front", "draw front left", or a node's path
  std::string what;  ///< "triangles"
  double mean = 0, most = 0;
};

/// The part of a stage that is explained.
struct StageBreakdown {
  std::string stage;    ///< app, cull, draw, alone
  double measured = 0;  ///< cost on all walls, for all eyes
  double nodes = 0;
  double named = 0;  ///< by parts of the stage itself
  /// Returns the explained part: 0 if costs were found but the total is unknown; 1 if the stage was empty.
  double covered() const {
    return measured > 0 ? (nodes + named) / measured : nodes + named != 0 || measured < 0 ? 0 : 1;
  }
};

struct ShowFigures {
  std::uint64_t frames = 0;
  std::vector<std::string> walls;
  std::vector<std::size_t> eyes;  ///< number of eyes by wall: 1, 2; 0 if nothing was drawn
  std::vector<NodeRow> nodes;     ///< the most expensive first
  std::vector<StageRow> stages;
  std::vector<CountRow> counts;
  /// By the clock, as the show was played. Nodes and parts get their shares of the eye drawn alone, scaled to
  /// the eye's time.
  StageBreakdown app, cull, draw;
  /// The eyes drawn alone, and their nodes and parts drawn alone, before scaling.
  StageBreakdown alone;
  double warmUpMs = 0;     ///< before the first frame is drawn; in no other number. 0: nothing was drawn
  std::string drawMethod;  ///< empty: nothing was drawn
  std::map<std::string, double> counters;  ///< numbers of the whole run by name, such as the cost of --guard
  std::uint64_t wholeFrames = 0;           ///< number of `frames` with recorded nodes in App
  std::uint64_t framesNeeded = 0;  ///< frames that would measure every node, estimated; 0: these did, or no
                                   ///< number would
  std::array<const StageBreakdown*, 4> breakdowns() const { return {&app, &cull, &draw, &alone}; }
};

/// Returns true if this OpenGL, by its name, draws on the processor, so that drawing is measured as processor
/// time. Mesa's EGL may, too.
bool drawnBySoftware(std::string_view gl);

/// Returns true if this renderer, by its description, draws without OpenGL.
bool drawnByCpuRenderer(std::string_view renderer);

/// Returns "LP_NUM_THREADS=2": the setting of llvmpipe's drawing threads.
std::string rasteriserThreadsText();

/// `gl`: OpenGL's name in the run; empty: nothing was drawn.
ShowFigures figuresOf(const ShowProfile& profile, const NodeNames& names,
                      const std::vector<std::string>& walls, std::string_view gl);

/// Returns the most expensive nodes and the stages, for a terminal.
std::string toText(const ShowFigures& figures, std::size_t mostNodes);
/// Returns one JSON object on one line: "frames", "nodes", "stages", "counts", "explained".
std::string toJson(const ShowFigures& figures);
/// Returns times: a row a node, stage, wall and eye; a row a stage, part, wall and eye.
std::string toCsv(const ShowFigures& figures);

}  // namespace stadion
