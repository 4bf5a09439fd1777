#pragma once
/// Puts the spans of each frame together and judges it when it has been shown.
///
/// Threads    SpanReader's.
/// Ownership  borrows the names, which must outlive it.

#include "profiling/frame_facts.h"
#include "profiling/frame_log.h"
#include "profiling/node_names.h"

#include <functional>
#include <map>

namespace stadion {

class FrameJudge final : public SpanReader {
public:
  using Shown = std::function<void(const FrameFacts&)>;
  /// `rate` in frames a second: 0 = nobody waits for frames, none is late. `shown` learns of each frame, in
  /// the order in which they were shown.
  FrameJudge(double rate, std::size_t walls, const NodeNames& names, Shown shown)
      : budget_(rate > 0 ? static_cast<float>(1e3 / rate) : 0),
        walls_(static_cast<std::uint32_t>(std::min(walls, FrameFacts::kMostWalls))), names_(names),
        shown_(std::move(shown)) {}

  using SpanReader::take;
  void take(std::size_t track, const SpanRecord& record) override;
  void take(const CountRecord& count) override;

private:
  FrameFacts& frame(std::uint64_t number);
  std::string title(NodeRef node) const;
  static void takeNode(FrameFacts& facts, const SpanRecord& record);
  void show(const SpanRecord& swap);

  float budget_;  ///< [ms]
  std::uint32_t walls_;
  const NodeNames& names_;
  Shown shown_;
  std::map<std::uint64_t, FrameFacts> open_;   ///< not shown yet
  std::map<std::size_t, StageFacts> pending_;  ///< by track: of the stage that is under way
  std::map<std::uint32_t, NodeRef> largest_;   ///< by wall: who has most to draw, as far as is known
  ProfileClock::time_point lastShown_{};
};

}  // namespace stadion
