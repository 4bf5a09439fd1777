#pragma once
/// All spans of a few stretches of a run: around the latest frames, and a normal one.
///
/// These frames are known only when they are over, so the last frames are kept, and dropped unless they are
/// chosen.
///
/// Memory   bounded: kRecent frames and the chosen stretches, with at most kNodesAFrame spans of nodes in
///          each frame, the most expensive ones.
/// Threads  SpanReader's.

#include "profiling/record/frame_facts.h"
#include "profiling/record/frame_log.h"
#include "profiling/record/frame_waits.h"

#include <map>
#include <string>
#include <vector>

namespace stadion {

struct KeptSpan {
  std::size_t track = 0;
  Span what = Span::App;
  std::uint32_t wall = kNoWall;
  NodeRef node;
  std::uint8_t depth = 0;
  std::int64_t began = 0, ended = 0;  ///< [ns] since recording began
  float ms = 0;                       ///< without recording
};

struct KeptFrame {
  FrameFacts facts;  ///< known once it has been shown
  bool sampled = false;
  std::vector<KeptSpan> spans;
};

/// Consecutive frames around a chosen one.
struct Stretch {
  std::uint64_t about = 0;
  double score = 0;  ///< [ms] the middle frame's period, or the distance of the mean from the median
  bool covers(std::uint64_t frame) const;
};

class KeptFrames final : public SpanReader {
public:
  static constexpr std::uint64_t kBefore = 13, kAfter = 10;  ///< frames of a stretch before and after the
                                                             ///< middle one
  static constexpr std::size_t kRecent = 96, kNodesAFrame = 40, kWorst = 3, kCandidates = 12;

  using SpanReader::take;
  void take(std::size_t track, const SpanRecord& record) override;
  /// Reports that a frame has been shown.
  void shown(const FrameFacts& facts);

  /// Returns the stretches, the worst first.
  const std::vector<Stretch>& worst() const { return worst_; }
  /// Returns the candidate with frame periods closest to `period` [ms]; none in a very short run.
  const Stretch* normal(double period) const;
  const std::map<std::uint64_t, KeptFrame>& frames() const { return frames_; }

private:
  void add(std::uint64_t frame, std::size_t track, const SpanRecord& record);
  void consider(const FrameFacts& facts);
  void forget();

  struct Track {
    std::vector<SpanRecord> parts;
    FrameWaits waits;
  };
  ProfileClock::time_point began_ = ProfileClock::now();
  std::map<std::size_t, Track> tracks_;
  std::map<std::uint64_t, KeptFrame> frames_;
  std::vector<Stretch> worst_, candidates_;
  std::uint64_t candidateEvery_ = kBefore + kAfter + 1;
};

}  // namespace stadion
