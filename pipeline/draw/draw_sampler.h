#pragma once
/// Times pieces of a frame's drawing, each alone, where a probe asks for it (engine/frame_probe.h). The
/// pieces are drawn in their place in the frame, over the depths that are there then, so that they cost what
/// they cost in it. No pixel changes.
///
/// Threads  the thread on which the context is current, in its turn.

#include "engine/frame_probe.h"
#include "pipeline/draw/lone_clock.h"

#include <algorithm>
#include <map>

namespace stadion {

class DrawSampler {
public:
  /// More of a mesh are several pieces. What is drawn alone must be much more than nothing, which is taken
  /// off it: about so large a part of what there is to draw.
  static constexpr float kPartsOfAFrame = 8;

  explicit DrawSampler(const GlTable& gl) : clock_(gl) {}

  /// `drawNothing` draws something that takes next to no time; it is measured, and taken off everything else.
  template <class DrawNothing>
  void beginFrame(FrameProbe& probe, std::uint64_t frame, std::uint32_t wall,
                  const DrawNothing& drawNothing) {
    probe_ = &probe;
    now_ = {frame, wall, 0, Span::Draw, 0, 0, 0};
    clock_.begin();
    drawNothing();
    now_.emptyMs = clock_.end();
  }
  /// An eye whose nodes are drawn in pieces, of which a few are timed. A piece is some instances next to each
  /// other; `starts` has the first of each that is to have a turn, ascending, and stays until endEye().
  void beginEye(std::uint32_t eye, std::span<const std::uint32_t> starts) {
    now_.eye = eye;
    timed_.clear();
    turn_ = {};
    if (starts.empty()) return;
    const std::size_t at = probe_->nextBatch(now_.wall, eye, starts.size());
    turn_ = starts.subspan(at, std::min(kBatchesAFrame, starts.size() - at));
  }
  template <class Work>
  void piece(Span what, const Work& work) {
    tell(what, timed(work), {});
  }
  /// The piece that begins with that instance, in one pass; a piece that is drawn in several took their sum.
  /// `shares` is asked for whose it is, if it is timed.
  template <class Shares, class Work>
  void nodes(std::uint32_t first, const Shares& shares, const Work& work) {
    if (!std::ranges::binary_search(turn_, first)) return work();
    Timed& t = timed_[first];
    if (t.shares.empty()) {
      const auto now = shares();
      t.shares.assign(now.begin(), now.end());
    }
    t.ms += timed(work);
  }
  /// All passes are over.
  void endEye() {
    for (const auto& [first, t] : timed_) tell(Span::Draw, t.ms, t.shares);
  }

private:
  struct Timed {
    double ms = 0;
    std::vector<NodeShare> shares;
  };

  /// Without what drawing nothing takes [ms].
  template <class Work>
  double timed(const Work& work) {
    clock_.begin();
    work();
    return clock_.end() - now_.emptyMs;
  }
  void tell(Span what, double ms, std::span<const NodeShare> nodes) {
    DrawnAlone drawn = now_;
    drawn.what = what, drawn.ms = ms;
    probe_->drewAlone(drawn, nodes);
  }

  LoneClock clock_;
  FrameProbe* probe_ = nullptr;
  DrawnAlone now_;
  std::span<const std::uint32_t> turn_;   ///< the first instances of the pieces that are timed
  std::map<std::uint32_t, Timed> timed_;  ///< by their first instance
};

}  // namespace stadion
