#pragma once
/// What a run did and what it took, for people and for programs.
///
/// Units    seconds for the show, milliseconds for what it cost.
/// Threads  plain values, filled when the run has ended.
/// Errors   none; a figure that is not finite is left out of the JSON as null.

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

/// The smallest of the values that at least `percent` of them do not exceed (nearest rank, exact; no
/// interpolation). 0 for none. Values that are not finite are left out.
double percentile(std::vector<double> values, double percent);

struct Distribution {
  std::size_t count = 0;
  double min = 0, mean = 0, p50 = 0, p95 = 0, p99 = 0, max = 0;
};
/// Of the finite values.
Distribution distributionOf(std::vector<double> values);

/// How long a stage took, frame by frame.
struct StageTimes {
  std::string stage;  ///< app, cull, draw
  std::string wall;   ///< empty: not of one wall
  Distribution ms;
  std::string method;  ///< how it was timed, such as "cpu clock around draw + finish"
};

struct WallLatency {
  std::string wall;
  Distribution ms;  ///< from the head's pose to the picture on the wall
};

/// A wall that kept an older picture now and then, because it was not drawn in time.
struct WallLate {
  std::string wall;
  std::uint64_t frames = 0, inARow = 0;  ///< in all, and at most one after the other
};

/// What late latch did (loop/head_latch.h).
struct LateLatched {
  std::uint64_t frames = 0, beyond = 0;  ///< drawn from a newer head; of these, from the edge of the reach
  double farthest = 0, widest = 0;       ///< that it went and turned between App and Draw [m], [rad]
};

struct ImageHash {
  std::string wall;
  std::string eye;  ///< left, right
  std::uint64_t hash = 0;
};

/// What a wall was drawn with for one eye, in all frames: the same on every machine.
struct DrawnCounts {
  std::string wall;
  std::string eye;  ///< left, right
  std::uint64_t frames = 0, calls = 0, instances = 0, triangles = 0;
};

/// A machine's part in a cluster.
struct ClusterSummary {
  std::string node;
  std::size_t nodes = 0;  ///< of the cluster
  bool leads = false;
  std::uint64_t orders = 0;  ///< frames that it has told of, or was told of
  double orderBytes = 0;     ///< of each, on average; told by who leads
  std::uint64_t mostOrderBytes = 0;
  /// Of frames for which all others waited for it: from when it had drawn to when it might show that [ms].
  Distribution barrier;
  std::uint64_t joined = 0, leftOut = 0;     ///< told by who leads
  std::uint64_t compared = 0, differed = 0;  ///< scenes
  bool stopped = false;                      ///< because they differed
};

/// Something that happened in the show, such as an impact.
struct Happening {
  double seconds = 0;  ///< show time [s]
  std::string event, node;
  std::optional<double> metres{};  ///< of a distance that was measured
};

struct MeasuredDistance {
  double seconds = 0;  ///< show time [s]
  std::string node;    ///< the measure
  double metres = 0;
};

/// How a node kept its budget.
struct BudgetKept {
  std::string node, file;  ///< its path, the script
  std::uint32_t line = 0;
  double budget = 0;           ///< [ms]; 0 = it has none, but gives something up for the frame's sake
  double mean = 0, worst = 0;  ///< [ms]
  std::uint64_t worstFrame = 0;
  std::string worstStage;                   ///< where most of that was spent
  std::uint64_t overruns = 0, changes = 0;  ///< frames; times that something was given up or taken back
  std::uint32_t highest = 0, now = 0, levels = 0;  ///< of its ladder
  bool drawCounted = true;                         ///< else what drawing it took is in none of these
  bool drawMeasured = true;                        ///< else it was never looked at, and nothing is known
};

/// What a node of a replayed run gave up because the log says so.
struct Obeyed {
  std::string node;
  std::uint64_t changes = 0;           ///< times that something was given up or taken back
  std::uint32_t highest = 0, now = 0;  ///< of its ladder
};

/// What stress a show was under: everything counted as so many times farther away.
struct StressFelt {
  double highest = 1, atEnd = 1;
  std::uint64_t changes = 0;
};

/// Who drew the walls, and why they did.
struct HowDrawn {
  std::string workers;  ///< thread or process; empty: nothing was drawn
  std::uint32_t rasteriserThreads = 0;
  bool pinned = false;
  std::string why, text;  ///< `text`: the same in words
};

struct RunSummary {
  static constexpr std::size_t kMostHappenings = 5'000;  ///< kept; a show may run all day
  static constexpr std::size_t kHappeningsTold = 200;    ///< lines in the text
  /// What a node tells more often, such as the end of each pass of what loops, is counted in one line.
  static constexpr std::size_t kMostAlike = 5;

  std::string show, walls, mode, stereo;
  std::uint32_t width = 0, height = 0;
  double rate = 0;                ///< [frames/s]
  std::uint64_t frames = 0;       ///< shown
  std::uint64_t framesDrawn = 0;  ///< of these; nobody looks at the others, and the times are without them
  double seconds = 0;             ///< of show time
  double elapsedSeconds = 0;      ///< of the clock on the wall
  std::uint64_t groups = 1;       ///< of visitors; the other figures are of the last one
  double uptimeSeconds = 0;       ///< of all groups, and between them
  HowDrawn howDrawn{};
  double warmUpMs =
      0;  ///< before the first frame is drawn: contexts, shaders, uploads; no other figure has it
  std::uint64_t lateFrames = 0;
  Distribution frameMs;  ///< from one frame shown to the next
  std::vector<StageTimes> stages;
  std::uint64_t mostPassedOver = 0;  ///< ticks in a row that no wall showed a frame of
  std::vector<WallLatency> latency;  ///< motion to image
  std::vector<WallLate> lateWalls;   ///< those that were late at all
  std::optional<LateLatched> latched;
  std::optional<double> aimedAt;  ///< prediction, at the end: how long after a frame's start [ms]
  std::uint64_t lastFrame = 0;    ///< the hashes are of this one
  std::optional<std::uint64_t> stateHash;
  std::optional<std::uint64_t> historyHash;  ///< over the state hashes of all frames
  std::vector<ImageHash> imageHashes;
  std::vector<DrawnCounts> drawn;
  std::map<std::string, double> counters;  ///< anything else worth a number
  std::vector<std::string> files;          ///< written
  std::vector<std::string> remarks;        ///< what did not go as asked
  std::string stopped;                     ///< by which signal; empty = it played to its end
  std::string failure;                     ///< why it could not go on; empty = it could
  std::vector<Happening> happened;         ///< the first ones, at most kMostHappenings
  std::vector<MeasuredDistance> measured;  ///< the first ones, at most kMostHappenings
  std::uint64_t happenedCount = 0;         ///< all of them
  std::vector<BudgetKept> budgets;         ///< of nodes that have one or give something up
  std::vector<Obeyed> obeyed;              ///< of a replay: what its log has nodes give up
  std::optional<StressFelt> stress;        ///< of the whole show; nothing = nobody decided about it
  std::optional<ClusterSummary> cluster;
};

/// Without the failure, which is told as an error, and without what happened.
std::string toText(const RunSummary& summary);
/// What happened, one a line, the first kHappeningsTold of them; what comes again and again is counted where
/// it was first. Empty if nothing happened.
std::string happeningsText(const RunSummary& summary);
/// One JSON object on one line. Hashes are strings of 16 hexadecimal digits.
std::string toJson(const RunSummary& summary);

}  // namespace stadion
