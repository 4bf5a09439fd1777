#pragma once
/// Records the parts of a report that are no sums: each frame, and a few stretches in full.
///
/// Threads    SpanReader's.
/// Ownership  borrows the names, which must outlive it.

#include "profiling/record/frame_judge.h"
#include "profiling/record/thread_names.h"
#include "profiling/report/frame_series.h"
#include "profiling/report/kept_frames_table.h"

namespace stadion {

class ReportRecording final : public SpanReader {
public:
  /// `rate` in frames a second: the intended one.
  ReportRecording(double rate, const std::vector<std::string>& walls, const NodeNames& names)
      : threads_(walls), judge_(rate, walls.size(), names, [this](const FrameFacts& facts) {
          series_.add(facts);
          kept_.shown(facts);
        }) {}

  using SpanReader::take;
  void take(std::size_t track, const SpanRecord& record) override {
    if (record.depth == 0) threads_.see(track, record);
    kept_.take(track, record);
    judge_.take(track, record);
  }

  const FrameSeries& series() const { return series_; }
  const KeptFrames& kept() const { return kept_; }
  const ThreadNames& threads() const { return threads_; }

private:
  FrameSeries series_;
  KeptFrames kept_;
  ThreadNames threads_;
  FrameJudge judge_;
};

}  // namespace stadion
