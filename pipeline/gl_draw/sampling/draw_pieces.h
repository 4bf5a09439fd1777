#pragma once
/// Splits the drawing of a frame into pieces where a probe wants to know their costs.
///
/// Decides which instances one draw call draws, which pieces are drawn alone and timed (draw_sampler.h), and
/// to which nodes the cost of a piece belongs. Without a probe, everything is drawn in as few calls as
/// possible. No pixel changes.
///
/// Units    work is an estimate of cost [pixels].
/// Threads  the thread on which the context is current, in its turn.

#include "pipeline/gl_draw/gpu/gpu_scene.h"
#include "pipeline/gl_draw/sampling/draw_sampler.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace stadion {

class DrawPieces {
public:
  /// `mostAtOnce`: instances in a draw call.
  DrawPieces(const GlTable& gl, GpuScene& scene, std::uint32_t mostAtOnce)
      : gl_(gl), scene_(scene), mostAtOnce_(mostAtOnce) {}

  /// Decides what of a list is timed; before anything of it is drawn. `drawNothing` draws something that
  /// costs next to nothing. Call the functions below in this order.
  void beginFrame(const DrawList& list, FrameProbe* probe, const std::function<void()>& drawNothing);
  /// The scene has begun the list. If pieces are timed, waits for the whole list.
  void beginList();
  /// Draws a view with `work`: alone, if views are timed as a whole.
  template <class Work>
  void view(const DrawView& view, const Work& work) {
    if (sample_ != DrawSample::Whole) return work();
    sampler_->beginEye(view.eye, {}, {});
    sampler_->piece(spanOf(view), work);
  }
  void beginView(const DrawView& view, std::uint32_t index);
  void endView(std::uint32_t index);
  /// The whole list is drawn.
  void endList();

  /// Returns true if pieces are timed: then everything must be known before it is drawn.
  bool areTimed() const { return sample_ == DrawSample::Some; }
  /// Returns true if anything is timed.
  bool timesAnything() const { return sample_ != DrawSample::None; }

  /// Does `work`, which is a piece of the frame but of no view.
  template <class Work>
  void piece(Span what, const Work& work) {
    if (areTimed())
      sampler_->piece(what, work);
    else
      work();
  }
  /// Does `work`, which is a part of a view but of no node. Parts of the same kind are added up.
  template <class Work>
  void part(Span what, const Work& work) {
    if (areTimed())
      sampler_->part(what, work);
    else
      work();
  }

  /// The number of the batch's instances that one call draws, after the first `done`. Timed pieces have about
  /// equal work; an instance with much work is a piece of its own.
  std::uint32_t togetherFrom(const InstanceBatch& batch, std::uint32_t done, const MeshParts& mesh) const;
  /// The instances from `first` on are drawn next.
  void next(std::uint32_t first, DrawSampler::By by = DrawSampler::By::OpenGl) {
    if (areTimed()) sampler_->next(first, by);
  }
  void endPass() {
    if (areTimed()) sampler_->endPass();
  }
  /// Calls `work` without timing it, for what is drawn once more.
  template <class Work>
  void untimed(const Work& work) {
    const DrawSample sample = std::exchange(sample_, DrawSample::None);
    work();
    sample_ = sample;
  }

  static Span spanOf(const DrawView& view) { return view.eye == Eye::Left ? Span::LeftEye : Span::RightEye; }

private:
  float workOf(std::size_t instance, const MeshParts& mesh) const;
  template <class F>
  void forEachBatch(const F& f);
  void weigh();
  void findPieces(std::uint32_t view);
  std::span<const NodeShare> sharesOf(std::uint32_t view, std::uint32_t first, std::uint32_t end);

  const GlTable& gl_;
  GpuScene& scene_;
  std::uint32_t mostAtOnce_;
  FrameProbe* probe_ = nullptr;           ///< probe of the current frame; null = none
  DrawSample sample_ = DrawSample::None;  ///< pieces of the current frame that are timed
  std::unique_ptr<DrawSampler> sampler_;  ///< from the first frame on that is timed
  float work_ = 0;                        ///< work of the whole list; only with a probe
  std::vector<NodeShare> shares_;         ///< by node: its share of a timed piece
  std::vector<std::uint32_t> pieces_;     ///< the first instance of each
  std::vector<std::size_t> wanted_;       ///< numbers of the pieces that the probe asks for
};

}  // namespace stadion
