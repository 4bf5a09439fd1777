#pragma once
/// Times pieces of a frame's drawing, each alone, where a probe asks for it (engine/frame_probe.h). The
/// pieces are drawn in their place in the frame, over the depths that are there then, so that they cost what
/// they cost in it. No pixel changes.
///
/// Threads  the thread on which the context is current, in its turn.

#include "engine/frame_probe.h"
#include "pipeline/draw/lone_clock.h"

namespace stadion {

class DrawSampler {
public:
  /// More of a mesh are several batches. What is drawn alone must be much more than nothing, which is taken
  /// off it: about so large a part of what there is to draw.
  static constexpr float kPartsOfAFrame = 8;

  explicit DrawSampler(const GlTable& gl) : clock_(gl) {}

  /// `drawNothing` draws something that takes next to no time; it is measured, and taken off everything else.
  template <class DrawNothing>
  void beginFrame(FrameProbe& probe, std::uint64_t frame, std::uint32_t wall,
                  const DrawNothing& drawNothing) {
    probe_ = &probe;
    now_ = {frame, wall, 0, Span::Draw, 0, 0};
    clock_.begin();
    drawNothing();
    now_.emptyMs = clock_.end();
  }
  /// An eye whose nodes are drawn in so many batches, of which a few are timed.
  void beginEye(std::uint32_t eye, std::size_t batches) {
    now_.eye = eye;
    batch_ = 0, first_ = batches > 0 ? probe_->nextBatch(now_.wall, eye, batches) : 0;
  }
  template <class Work>
  void piece(Span what, const Work& work) {
    time(what, {}, work);
  }
  /// `shares` is asked for whose it is, if it is timed.
  template <class Shares, class Work>
  void batch(const Shares& shares, const Work& work) {
    const std::size_t at = batch_++;
    if (at >= first_ && at < first_ + kBatchesAFrame)
      time(Span::Draw, shares(), work);
    else
      work();
  }

private:
  template <class Work>
  void time(Span what, std::span<const NodeShare> nodes, const Work& work) {
    clock_.begin();
    work();
    DrawnAlone drawn = now_;
    drawn.what = what;
    drawn.ms = clock_.end() - now_.emptyMs;
    probe_->drewAlone(drawn, nodes);
  }

  LoneClock clock_;
  FrameProbe* probe_ = nullptr;
  DrawnAlone now_;
  std::size_t batch_ = 0, first_ = 0;
};

}  // namespace stadion
