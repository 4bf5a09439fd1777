#pragma once
/// The costs of a run as rows: for each stage and wall, and for the most expensive nodes, as a table of JSON
/// objects.
///
///     {"path": "sim_kick", "file": "scripts/kick.evs", "line": 12, "stage": "app", "wall": null,
///      "eye": null, "ms_mean": 0.012, "count": 180, "frame_us": {"0": 12.1, "1": 11.9, ...},
///      "frame_elapsed_us": {"0": 12.3, "1": 12.0, ...}}
///
/// `path` is null for a stage itself. The optional `frame_us` has the processor time of each frame, and
/// `frame_elapsed_us` its real time. The stage "frame" is the whole frame: it has durations only.
///
/// Threads  plain values, any thread.
/// Errors   invalid rows are left out.

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
  double msMean = 0;                          ///< mean of the frames in which it worked
  std::size_t count = 0;                      ///< number of these frames
  std::map<std::uint64_t, double> frames;     ///< cost [us] by frame; may be empty
  std::map<std::uint64_t, double> elapsed{};  ///< real time [us], by frame; may be empty
  double elapsedUs = 0;                       ///< for a stage: real time of the typical frame [us]
  double instructions = 0;                    ///< a frame; 0: not counted
  double plantedUs = 0;                       ///< for a stage: planted part of the typical frame [us]

  bool isStage() const { return path.empty() && line == 0; }
  /// Identifies the same row in another run.
  std::string key() const {
    return stage + "|" + wall + "|" + eye + "|" + path + "|" + file + ":" + std::to_string(line);
  }
  /// Returns its node, independent of the show's folder: "sim_kick", or "kick.evs:12" if it has no name.
  std::string node() const;
  /// Returns the name of its stage: "app", "cull of wall front".
  std::string stageName() const { return stage + (wall.empty() ? "" : " of wall " + wall); }
  /// "sim_kick (scripts/kick.evs:12) in app", "cull of wall front".
  std::string name() const;
};

/// Reads an array of such objects, or an object that has them as "rows" or "nodes".
std::vector<SpanRow> spanRows(const std::string& json);
std::string toJson(const std::vector<SpanRow>& rows);

/// Returns the stages of a run's summary, without frames: each costs its typical frame. For builds that
/// report no more.
std::vector<SpanRow> stagesOfSummary(const std::string& summaryJson);
/// Reads the output of `stadion profile --json`: a row for each node in App, in Cull of each wall, in Draw of
/// each wall and eye, and for each stage. Returns nothing if the text is something else.
std::vector<SpanRow> profileRows(const std::string& profileJson);
/// Adds to rows the instructions a frame that were counted under "row N"; a stage gets the sum of its parts.
void giveInstructions(std::vector<SpanRow>& rows, const std::map<std::string, double>& byLabel);

}  // namespace stadion::regression
