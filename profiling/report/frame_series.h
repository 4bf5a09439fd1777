#pragma once
/// How long the frames of a run took, one after the other, and which of them were late.
///
/// Frames whose drawing was sampled took longer for it, and held up the next one: they are kept apart, and
/// count neither in distributions nor among the late.
///
/// Units    milliseconds. Memory  80 bytes a frame: 17 MB an hour at 60 Hz.
/// Threads  plain values.

#include "profiling/record/frame_facts.h"
#include "profiling/record/frame_log.h"

#include <map>
#include <vector>

namespace stadion {

/// A frame in a few figures.
struct FrameRow {
  std::uint64_t frame = 0;
  float period = 0;  ///< since the frame before was shown; 0 = unknown
  float app = 0;
  std::array<float, FrameFacts::kMostWalls> cull{}, draw{};
  bool sampled = false;  ///< its drawing or that of the frame before
  Cause cause = Cause::None;
};

class FrameSeries {
public:
  static constexpr std::size_t kMostLate = 60;  ///< that are remembered with all their facts: the latest

  void add(const FrameFacts& facts);

  const std::vector<FrameRow>& rows() const { return rows_; }
  /// Frames that were judged, by cause; Cause::None: in time.
  const std::map<Cause, std::uint64_t>& causes() const { return causes_; }
  /// Those that came latest, in the order of frames.
  std::vector<FrameFacts> late() const;

private:
  std::vector<FrameRow> rows_;
  std::map<Cause, std::uint64_t> causes_;
  std::multimap<float, FrameFacts> late_;  ///< by period
};

}  // namespace stadion
