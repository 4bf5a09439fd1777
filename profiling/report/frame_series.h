#pragma once
/// The durations of a run's frames in order, and the late frames.
///
/// Sampling of drawing lengthens a frame and delays the next one. These frames are kept apart, and count
/// neither in distributions nor among the late ones.
///
/// Units    milliseconds. Memory  40 bytes a frame and 8 for each wall: 16 MB an hour of four walls at 60 Hz.
/// Threads  plain values.

#include "profiling/record/frame_facts.h"
#include "profiling/record/frame_log.h"

#include <map>
#include <span>
#include <vector>

namespace stadion {

/// The main figures of a frame.
struct FrameRow {
  std::uint64_t frame = 0;
  float period = 0;  ///< since the previous swap; 0 = unknown
  float app = 0;
  bool sampled = false;  ///< drawing of this frame or of the frame before was sampled
  Cause cause = Cause::None;
};

class FrameSeries {
public:
  static constexpr std::size_t kMostLate = 60;  ///< number of late frames kept with all facts: the latest
                                                ///< ones

  void add(const FrameFacts& facts);

  const std::vector<FrameRow>& rows() const { return rows_; }
  /// By wall, of row number `row`. All frames of a run have the same walls.
  std::span<const float> cull(std::size_t row) const { return stages(2 * row); }
  std::span<const float> draw(std::size_t row) const { return stages(2 * row + 1); }
  /// Frames that were judged, by cause; Cause::None: in time.
  const std::map<Cause, std::uint64_t>& causes() const { return causes_; }
  /// Returns the latest frames, in the order of frames.
  std::vector<FrameFacts> late() const;

private:
  std::span<const float> stages(std::size_t row) const {
    return std::span(stages_).subspan(row * walls_, walls_);
  }

  std::vector<FrameRow> rows_;
  std::size_t walls_ = 0;
  std::vector<float> stages_;  ///< (2 rows x walls): Cull, Draw
  std::map<Cause, std::uint64_t> causes_;
  std::multimap<float, FrameFacts> late_;  ///< by period
};

}  // namespace stadion
