#pragma once
/// The results and costs of a run, for people and for programs.
///
/// Units    seconds for the show, milliseconds for costs.
/// Threads  plain values, filled when the run has ended.
/// Errors   none; a number that is not finite is null in the JSON.

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

/// Returns the smallest value that at least `percent` of the values do not exceed (nearest rank, exact; no
/// interpolation). Returns 0 without values. Ignores values that are not finite.
double percentile(std::vector<double> values, double percent);

struct SampleStatistics {
  std::size_t count = 0;
  double min = 0, mean = 0, p50 = 0, p95 = 0, p99 = 0, max = 0;
};
/// Describes the finite values.
SampleStatistics sampleStatisticsOf(std::vector<double> values);

/// Duration of a stage in each frame.
struct StageTimes {
  std::string stage;  ///< app, cull, draw
  std::string wall;   ///< empty: the stage belongs to no wall
  SampleStatistics ms;
  std::string method;  ///< the method of timing, such as "cpu clock around draw + finish"
};

struct WallLatency {
  std::string wall;
  SampleStatistics ms;  ///< from the head's pose to the picture on the wall
};

/// A wall that sometimes kept an older picture because the new one was late.
struct WallLate {
  std::string wall;
  std::uint64_t frames = 0, inARow = 0;  ///< in all; at most in a row
};

/// Results of late latch (loop/head_latch.h).
struct LateLatchSummary {
  std::uint64_t frames = 0, beyond = 0;  ///< drawn from a newer head pose; of these, clamped to the edge of
                                         ///< the reach
  double farthest = 0, widest = 0;       ///< distance and turn of the head between App and Draw, at most [m],
                                         ///< [rad]
};

struct ImageHash {
  std::string wall;
  std::string eye;  ///< left, right
  std::uint64_t hash = 0;
};

/// Items drawn on a wall for one eye, in all frames; the same on every host.
struct DrawnCounts {
  std::string wall;
  std::string eye;  ///< left, right
  std::uint64_t frames = 0, calls = 0, instances = 0, triangles = 0;
};

/// The part of this host in a cluster.
struct ClusterSummary {
  std::string node;
  std::size_t nodes = 0;  ///< number of nodes in the cluster
  bool leads = false;
  std::uint64_t orders = 0;  ///< frames that it has ordered (leader) or received (follower)
  double orderBytes = 0;     ///< mean size of an order [byte]; known to the leader only
  std::uint64_t mostOrderBytes = 0;
  /// Waits of frames for which all others waited for this host: from the end of its drawing to the permission
  /// to show [ms].
  SampleStatistics barrier;
  std::uint64_t joined = 0, leftOut = 0;     ///< known to the leader only
  std::uint64_t compared = 0, differed = 0;  ///< scenes that were compared, and that differed
  bool stopped = false;                      ///< because they differed
};

/// An event in the show, such as an impact.
struct ShowEvent {
  double seconds = 0;  ///< show time [s]
  std::string event, node;
  std::optional<double> metres{};  ///< a measured distance
};

struct MeasuredDistance {
  double seconds = 0;  ///< show time [s]
  std::string node;    ///< the measuring node
  double metres = 0;
};

/// How a node kept its budget.
struct BudgetSummary {
  std::string node, file;  ///< path of the node, script
  std::uint32_t line = 0;
  double budget = 0;           ///< [ms]; 0 = it has none, but degrades to save the frame
  double mean = 0, worst = 0;  ///< [ms]
  std::uint64_t worstFrame = 0;
  std::string worstStage;                          ///< the stage with most of that
  std::uint64_t overruns = 0, changes = 0;         ///< frames; changes of the degradation level
  std::uint32_t highest = 0, now = 0, levels = 0;  ///< levels of its degradation ladder
  bool drawCounted = true;                         ///< false: these numbers exclude drawing
  bool drawMeasured = true;                        ///< false: drawing was never measured
};

/// A node's degradations in a replayed run, as the log orders them.
struct ReplayedDegradation {
  std::string node;
  std::uint64_t changes = 0;           ///< changes of the degradation level
  std::uint32_t highest = 0, now = 0;  ///< levels of its degradation ladder
};

/// The stress of a show: the factor by which all distances are multiplied.
struct StressSummary {
  double highest = 1, atEnd = 1;
  std::uint64_t changes = 0;
};

/// The renderer of the walls, threads or processes, and the reasons.
struct DrawingSummary {
  std::string renderer;       ///< cpu or gl
  std::string chosen;         ///< why this renderer; empty: it was asked for
  std::string drawnBy;        ///< thread or process; empty: nothing was drawn
  std::uint32_t threads = 0;  ///< threads of the CPU renderer or of OpenGL's rasteriser, in each process
  bool pinned = false;
  std::string why, text;  ///< `text`: the same in words
};

/// A run's results. It has more than 20 fields: one for each number of the report.
struct RunSummary {
  static constexpr std::size_t kMostEvents = 5'000;  ///< kept; a show may run for days
  static constexpr std::size_t kEventsInText = 200;  ///< lines in the text
  /// A node's further events of one kind are counted in one line, such as the end of each pass of a loop.
  static constexpr std::size_t kMostAlike = 5;

  std::string show, walls, mode, stereo;
  std::uint32_t width = 0, height = 0;
  double rate = 0;                ///< [frames/s]
  std::uint64_t frames = 0;       ///< shown
  std::uint64_t framesDrawn = 0;  ///< frames that were drawn; times cover only these
  double seconds = 0;             ///< duration in show time
  double elapsedSeconds = 0;      ///< duration in real time
  std::uint64_t groups = 1;       ///< groups of visitors; the other numbers describe the last one
  double uptimeSeconds = 0;       ///< real time of all groups and the pauses between them
  DrawingSummary drawing{};
  double warmUpMs = 0;  ///< before the first frame is drawn: contexts, shaders, uploads; counted here only
  std::uint64_t lateFrames = 0;
  SampleStatistics frameMs;  ///< from one frame shown to the next
  std::vector<StageTimes> stages;
  std::uint64_t mostTicksWithoutFrame = 0;  ///< ticks in a row without a frame on any wall
  std::vector<WallLatency> latency;         ///< motion to image
  std::vector<WallLate> lateWalls;          ///< walls that were late at least once
  std::optional<LateLatchSummary> lateLatch;
  std::optional<double> aimedAt;  ///< prediction at the end: time after a frame's start [ms]
  std::uint64_t lastFrame = 0;    ///< the frame of the hashes
  std::optional<std::uint64_t> stateHash;
  std::optional<std::uint64_t> historyHash;  ///< over the state hashes of all frames
  std::vector<ImageHash> imageHashes;
  std::vector<DrawnCounts> drawn;
  std::map<std::string, double> counters;  ///< further numbers
  std::vector<std::string> files;          ///< written
  std::vector<std::string> remarks;        ///< deviations from the request
  std::string stopped;                     ///< the signal that stopped the run; empty = it played to its end
  std::string failure;                     ///< the reason for stopping early; empty = none
  std::vector<ShowEvent> events;           ///< the first ones, at most kMostEvents
  std::vector<MeasuredDistance> measured;  ///< the first ones, at most kMostEvents
  std::uint64_t eventCount = 0;            ///< all of them
  std::vector<BudgetSummary> budgets;      ///< budgets and costs of nodes with a budget or with degradations
  std::vector<ReplayedDegradation> replayedDegradations;  ///< degradations that a replay took from its log
  /// Stress control over the whole show; nothing = stress was not controlled.
  std::optional<StressSummary> stress;
  std::optional<ClusterSummary> cluster;
};

/// Returns the summary without its failure, which is logged as an error, and without events.
std::string toText(const RunSummary& summary);
/// Returns the first kEventsInText events, one a line. Repeated events are counted at their first
/// occurrence. Empty if there were no events.
std::string eventsText(const RunSummary& summary);
/// Returns one JSON object on one line. Hashes are strings of 16 hexadecimal digits.
std::string toJson(const RunSummary& summary);

}  // namespace stadion
