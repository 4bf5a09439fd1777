#pragma once
/// Times pieces of a frame's drawing, each alone, where a probe asks for it (engine/core/frame_probe.h). The
/// pieces are drawn in their place in the frame, over the depths that are there then, so that they cost what
/// they cost in it. No pixel changes.
///
/// Threads  the thread on which the context is current, in its turn.

#include "engine/core/frame_probe.h"
#include "engine/display/wall.h"
#include "pipeline/gl_draw/sampling/isolated_draw_timer.h"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace stadion {

class DrawSampler {
public:
  /// A mesh with more than this part of the frame's work is split into batches. A batch must cost much more
  /// than drawing nothing, because that cost is subtracted from it.
  static constexpr float kPartsOfAFrame = 8;
  /// Meshes that follow each other are joined into a piece of at most this part of the frame's work. So at
  /// most twice as many pieces arise, however many meshes there are. Each piece is timed at least once in 600
  /// frames.
  static constexpr float kMostJoined = 32;

  explicit DrawSampler(const GlTable& gl) : clock_(gl) {}

  /// `drawNothing` draws something that takes next to no time; it is measured, and taken off everything else.
  template <class DrawNothing>
  void beginFrame(FrameProbe& probe, std::uint64_t frame, std::uint32_t wall,
                  const DrawNothing& drawNothing) {
    probe_ = &probe;
    now_ = {frame, wall, 0, Span::Draw, 0, 0, 0};
    for (int i = 0; i < kEmpties; ++i) {
      clock_.begin();
      drawNothing();
      empties_[emptiesTaken_++ % empties_.size()] = clock_.end();
    }
    now_.emptyMs = usualEmpty();
  }
  /// A view for that eye, whose nodes are drawn in pieces, of which a few are timed. A piece is some
  /// instances that are drawn one after the other; `starts` has the first of each, ascending, `wanted` the
  /// numbers of those that are to have a turn, ascending. Both must stay until endEye().
  void beginEye(Eye of, std::span<const std::uint32_t> starts, std::span<const std::size_t> wanted) {
    const auto eye = static_cast<std::uint32_t>(of);
    now_.eye = eye;
    timed_.clear();
    parts_.clear();
    starts_ = starts;
    turn_ = {};
    open_ = kNone;
    if (wanted.empty()) return;
    const std::size_t at = probe_->nextBatch(now_.wall, eye, wanted.size());
    turn_ = wanted.subspan(at, std::min(kBatchesAFrame, wanted.size() - at));
    timed_.resize(turn_.size());
  }
  template <class Work>
  void piece(Span what, const Work& work) {
    report(what, timed(work), {});
  }
  /// A part of an eye that is no node's: with others of the kind, their sum.
  template <class Work>
  void part(Span what, const Work& work) {
    parts_[what] += timed(work);
  }
  enum class By { OpenGl, Us };
  /// In this pass, instances from this one on are drawn next. A piece that is drawn in several passes took
  /// their sum.
  void next(std::uint32_t first, By by = By::OpenGl) {
    const auto after = std::ranges::upper_bound(starts_, first);
    const std::size_t piece = static_cast<std::size_t>(after - starts_.begin()) - 1;
    const auto at = std::ranges::lower_bound(turn_, piece);
    const bool timed = at != turn_.end() && *at == piece;
    const std::size_t now = timed ? static_cast<std::size_t>(at - turn_.begin()) : kNone;
    if (now == open_) return;
    endPass();
    if (!timed) return;
    open_ = now;
    less_ = by == By::OpenGl ? now_.emptyMs : 0;
    clock_.begin();
  }
  void endPass() {
    if (open_ == kNone) return;
    timed_[open_] += clock_.end() - less_;
    open_ = kNone;
  }
  /// All passes are over. `shares` is asked whose the pieces are that were timed: (first instance, end).
  template <class Shares>
  void endEye(const Shares& shares) {
    for (const auto& [what, ms] : parts_) report(what, ms, {});
    for (std::size_t i = 0; i < turn_.size(); ++i) {
      const std::size_t end = turn_[i] + 1;
      report(Span::Draw, timed_[i],
             shares(starts_[turn_[i]], end < starts_.size() ? starts_[end] : ~std::uint32_t{0}));
    }
  }

private:
  static constexpr std::size_t kNone = ~std::size_t{0};
  static constexpr int kEmpties = 3;  ///< a frame

  /// Returns the median of the last frames' costs of drawing nothing, which is taken off every piece. A
  /// single measurement would be disturbed too easily.
  double usualEmpty() {
    std::array<double, 33> sorted = empties_;
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(std::min(emptiesTaken_, sorted.size()));
    const auto middle = sorted.begin() + (end - sorted.begin()) / 2;
    std::nth_element(sorted.begin(), middle, end);
    return *middle;
  }
  /// Without what drawing nothing takes [ms].
  template <class Work>
  double timed(const Work& work) {
    clock_.begin();
    work();
    return clock_.end() - now_.emptyMs;
  }
  void report(Span what, double ms, std::span<const NodeShare> nodes) {
    IsolatedDrawTime drawn = now_;
    drawn.what = what;
    drawn.ms = ms;
    probe_->drewAlone(drawn, nodes);
  }

  IsolatedDrawTimer clock_;
  FrameProbe* probe_ = nullptr;
  IsolatedDrawTime now_;
  std::array<double, 33> empties_{};  ///< costs of drawing nothing in the last frames [ms]
  std::size_t emptiesTaken_ = 0;
  std::span<const std::uint32_t> starts_;
  std::span<const std::size_t> turn_;  ///< the pieces that are timed
  std::size_t open_ = kNone;           ///< index in `turn_` of the piece that is drawn now
  double less_ = 0;                    ///< cost taken off the open piece [ms]
  std::vector<double> timed_;          ///< by piece of the turn [ms]
  std::map<Span, double> parts_;
};

}  // namespace stadion
