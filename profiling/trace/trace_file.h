#pragma once
/// Writes every span of a run into a file for a trace viewer (Perfetto, chrome://tracing), while it runs.
///
/// A thread of the run is a thread of the trace. Its slices nest strictly: stages hold their parts, which
/// hold nodes. Waits have a category of their own. Arrows lead from App to Cull to Draw of one frame, for
/// each wall. A counter shows the time between each shown frame and the previous one.
///
/// Memory     one stage's spans a thread, and the names of the visible nodes.
/// Threads    SpanReader's; finish() after the log's.
/// Ownership  borrows the names, which must outlive it. The file appears complete, with finish(), or not at
///            all.

#include "profiling/record/frame_log.h"
#include "profiling/record/frame_waits.h"
#include "profiling/record/node_names.h"
#include "profiling/record/thread_names.h"
#include "profiling/trace/trace_events.h"

#include "engine/base/atomic_file.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

struct TraceOptions {
  std::string file;
  std::uint64_t first = 0, last = kNoFrame;  ///< frames to be written
  std::uint64_t mostBytes = 100'000'000;     ///< no frame is begun beyond this; frames already begun are
                                             ///< finished
  std::string show;
  std::vector<std::string> walls;  ///< names
};

class TraceFile final : public SpanReader {
public:
  TraceFile(TraceOptions options, const NodeNames& names);

  using SpanReader::take;
  void take(std::size_t track, const SpanRecord& record) override;
  void take(const CountRecord& count) override;
  bool takesFirstFrames() const override { return true; }

  /// Returns why there will be no file, such as a missing folder.
  const std::optional<Diagnostic>& error() const { return file_.error(); }
  /// Completes the file. Returns nothing on success, else why there is none.
  std::optional<Diagnostic> finish();
  /// Returns the requested part that is missing: "frames 412 to 599: the run ended with frame 411", or empty.
  /// For use after finish().
  std::string leftOut() const;

private:
  struct Track {
    std::vector<SpanRecord> spans;  ///< spans of the stage under way
    FrameWaits waits;
  };
  struct Name {
    std::string text, args;  ///< as JSON
    std::string path;
  };

  bool isAsked(std::uint64_t frame) const {
    return frame >= options_.first && frame <= options_.last && frame < cutFrom_;
  }
  void write(std::size_t track, const SpanRecord& root);
  void writeSpan(std::size_t track, const SpanRecord& record, std::uint64_t frame);
  void writeFlow(std::size_t track, const SpanRecord& stage);
  bool isFirst(Span stage, std::uint32_t wall, std::uint64_t frame);
  const Name& nameOfNode(NodeRef node);
  trace::Ticks ticks(ProfileClock::time_point t) const;
  void flush();

  TraceOptions options_;
  const NodeNames& names_;
  AtomicFile file_;
  ProfileClock::time_point began_ = ProfileClock::now();
  std::map<std::size_t, Track> tracks_;
  ThreadNames threads_;
  std::map<NodeRef, Name> nodes_;
  Name unknown_;
  std::map<std::pair<Span, std::uint32_t>, std::uint64_t> newest_;  ///< frame, by stage and wall
  std::map<std::string, std::uint64_t> lastCounts_;                 ///< by name: "triangles, front left"
  std::optional<trace::Ticks> lastShown_;
  std::uint64_t oldestFrame_ = kNoFrame, newestFrame_ = 0;  ///< frames that App reported
  std::uint64_t cutFrom_ = kNoFrame;                        ///< first frame left out for size
  std::uint64_t bytes_ = 0;
  std::string text_;
};

}  // namespace stadion
