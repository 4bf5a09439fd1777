#pragma once
/// What a run cost, row by row: of each stage and wall, and of the dearest nodes, as a table of JSON objects.
///
///     {"path": "sim_kick", "file": "scripts/kick.evs", "line": 12, "stage": "app", "wall": null,
///      "eye": null, "ms_mean": 0.012, "count": 180, "frame_us": {"0": 12.1, "1": 11.9, ...},
///      "frame_elapsed_us": {"0": 12.3, "1": 12.0, ...}}
///
/// `path` is null for a stage itself. `frame_us`, where there is one, has the processor time of each frame;
/// `frame_elapsed_us` has its duration by the clock on the wall. The stage "frame" is the whole frame: it has
/// durations only.
///
/// Threads  plain values, any thread.
/// Errors   rows that are none are left out.

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace stadion::regression {

struct SpanRow {
  std::string path;  ///< the node's name; empty: the stage itself
  std::string file;
  std::uint32_t line = 0;
  std::string stage;  ///< app, cull, draw
  std::string wall, eye;
  double msMean = 0;                       ///< a frame in which it had something to do
  std::size_t count = 0;                   ///< of such frames
  std::map<std::uint64_t, double> frames;  ///< cost [us] by frame; empty if it was not told
  std::map<std::uint64_t, double>
      elapsed{};            ///< duration by the clock on the wall [us], by frame; may be empty
  double elapsedUs = 0;     ///< of a stage: the typical frame, by the clock on the wall [us]
  double instructions = 0;  ///< a frame; 0 if nobody counted
  double plantedUs = 0;     ///< of a stage: how much of the typical frame was planted on purpose [us]

  bool isStage() const { return path.empty() && line == 0; }
  /// The same in another run has the same.
  std::string key() const {
    return stage + "|" + wall + "|" + eye + "|" + path + "|" + file + ":" + std::to_string(line);
  }
  /// Its node, whatever folder the show is in: "sim_kick", or "kick.evs:12" if it has no name.
  std::string node() const;
  /// How the stage that it belongs to is named: "app", "cull of wall front".
  std::string stageName() const { return stage + (wall.empty() ? "" : " of wall " + wall); }
  /// "sim_kick (scripts/kick.evs:12) in app", "cull of wall front".
  std::string name() const;
};

/// Of an array of such objects, or of an object whose "rows" or "nodes" it is.
std::vector<SpanRow> spanRows(const std::string& json);
std::string toJson(const std::vector<SpanRow>& rows);

/// The stages of a run's summary, without frames: each costs its typical frame. For builds that tell no more.
std::vector<SpanRow> stagesOfSummary(const std::string& summaryJson);
/// Of what `stadion profile --json` prints: a row for each node in App, in Cull of each wall, in Draw of each
/// wall and eye, and for each stage. Nothing if it is not that.
std::vector<SpanRow> profileRows(const std::string& profileJson);
/// Gives rows the instructions that were counted under "row N", a frame; of stages all that is in them.
void giveInstructions(std::vector<SpanRow>& rows, const std::map<std::string, double>& byLabel);

}  // namespace stadion::regression
