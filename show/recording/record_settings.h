#pragma once
/// What a run records: its input, pictures, poses of nodes, costs, and its last frames.

#include "profiling/trace/trace_file.h"
#include "show/output/run_output.h"
#include "show/recording/span_options.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

struct RecordSettings {
  std::string input;         ///< the input log to write; empty: none
  std::string out;           ///< folder for pictures, tables and the summary; empty: none
  PictureChoice pictures{};  ///< frames whose pictures go to `out`
  bool sheets = false;       ///< a contact sheet beside each frame's pictures
  bool video = false;
  bool hashes = false;  ///< hashes of every picture: into `out`, or without it to hashLines
  std::function<void(const std::string&)> hashLines{};  ///< receives lines; on a thread that may wait
  std::vector<std::string> nodes;  ///< nodes whose poses are written as tables into `out`
  std::string blackBox;            ///< the file of the last frames; empty: one in the user's folder for them
  std::optional<TraceOptions> trace{};  ///< every span of every thread
  SpanOptions spans{};                  ///< costs by frame, for comparisons
  bool profile = false;                 ///< costs by node, for the report
  bool countWork = false;               ///< pixels, contacts and so on, for the summary
  bool unrecorded = false;  ///< costs of frames are not recorded at all, to measure what recording costs

  /// Returns true if the drawing itself is measured. Then this process must draw.
  bool measuresDrawing() const {
    return profile || trace.has_value() || !spans.file.empty() || countWork || unrecorded;
  }
  /// Returns true if pictures are kept, as files, as a video or as hashes.
  bool keepsPictures() const {
    return !out.empty() && (pictures.kind != PictureChoice::Kind::None || video || hashes);
  }
};

}  // namespace stadion
