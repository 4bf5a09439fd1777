#pragma once
/// All spans of a few stretches of a run: around the frames that came latest, and a normal one.
///
/// Which frames these are is known only when they are over, so the last frames are kept, and forgotten unless
/// they are chosen.
///
/// Memory   bounded: kRecent frames and the stretches chosen, in each the dearest kNodesAFrame spans of
/// nodes. Threads  SpanReader's.

#include "profiling/record/frame_facts.h"
#include "profiling/record/frame_log.h"

#include <map>
#include <optional>
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
  FrameFacts facts;  ///< once it has been shown
  bool sampled = false;
  std::vector<KeptSpan> spans;
};

/// Consecutive frames that were chosen for the one in the middle.
struct Stretch {
  std::uint64_t about = 0;
  double score = 0;  ///< [ms] the middle one's period, or how far the mean is from the median
  bool covers(std::uint64_t frame) const;
};

class KeptFrames final : public SpanReader {
public:
  static constexpr std::uint64_t kBefore = 13, kAfter = 10;  ///< frames of a stretch, beside the middle one
  static constexpr std::size_t kRecent = 96, kNodesAFrame = 40, kWorst = 3, kCandidates = 12;

  using SpanReader::take;
  void take(std::size_t track, const SpanRecord& record) override;
  /// A frame has been shown.
  void shown(const FrameFacts& facts);

  /// The worst first.
  const std::vector<Stretch>& worst() const { return worst_; }
  /// The candidate whose frames come most nearly at this distance [ms]; none in a very short run.
  const Stretch* normal(double period) const;
  const std::map<std::uint64_t, KeptFrame>& frames() const { return frames_; }

private:
  void add(std::uint64_t frame, std::size_t track, const SpanRecord& record);
  void consider(const FrameFacts& facts);
  void forget();

  struct Track {
    std::vector<SpanRecord> parts;
    std::optional<SpanRecord> wait;  ///< for a frame that is not known yet
  };
  ProfileClock::time_point began_ = ProfileClock::now();
  std::map<std::size_t, Track> tracks_;
  std::map<std::uint64_t, KeptFrame> frames_;
  std::vector<Stretch> worst_, candidates_;
  std::uint64_t candidateEvery_ = kBefore + kAfter + 1;
};

}  // namespace stadion
