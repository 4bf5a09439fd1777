// What is drawn alone, and timed, where a probe asks for it.

#include "pipeline/draw/renderer.h"

#include <algorithm>

namespace stadion {

void Renderer::beginSampling(const DrawList& list) {
  // Before anything has been drawn all is slower.
  sample_ =
      probe_ && surfaces_ ? probe_->drawSample(list.ticket.signature.frame, list.wall) : DrawSample::None;
  if (sample_ == DrawSample::None) return;
  if (!sampler_) {
    sampler_ = std::make_unique<DrawSampler>(gl_);
    drawNothing();  // the first time the driver compiles: that would be taken off all that is timed
    gl_.Finish();
  }
  sampler_->beginFrame(*probe_, list.ticket.signature.frame, list.wall, [this] { drawNothing(); });
}

/// A pixel that is not written.
void Renderer::drawNothing() {
  buffers_.bind(0);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.Scissor(0, 0, 1, 1);
  gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  gl_.DepthMask(GL_FALSE);
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, kViewBinding, views_[0].name());
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, kSceneBinding, scene_.name());
  drawSky();
  gl_.DepthMask(GL_TRUE);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl_.Disable(GL_SCISSOR_TEST);
}

void Renderer::drawViewAlone(const DrawView& view, std::uint32_t index, Turn& turn) {
  sampler_->beginEye(view.eye, {}, {});
  sampler_->piece(spanOf(view), [&] { drawView(view, index, turn); });
}

/// How much there is to draw of one instance: an estimate, for profiling.
float Renderer::workOf(std::size_t instance, const MeshParts& mesh) const {
  constexpr float kOfTriangle = 8;  // as much as so many pixels, on the processor
  return batches_.pixels()[instance] + kOfTriangle * static_cast<float>(mesh.triangles);
}

/// Calls `f` with each batch of which anything is drawn in any pass, and its mesh.
template <class F>
void Renderer::forEachBatch(const F& f) {
  for (const auto batches : {batches_.opaque(), batches_.transparent()})
    for (const InstanceBatch& b : batches)
      if (const GlMesh* mesh = cache_.find(b.mesh)) f(b, partsOf(*mesh, b.level));
}

/// Counts how much there is to draw, and finds the node with the most, if that is much.
void Renderer::weigh() {
  constexpr float kMuch = 0.25f;  // of all
  NodeRef whose;
  float most = 0;
  work_ = 0;
  forEachBatch([&](const InstanceBatch& b, const MeshParts& mesh) {
    for (std::size_t i = b.first; i < b.first + b.count; ++i) {
      const float work = workOf(i, mesh);
      work_ += work;
      if (work > most) most = work, whose = batches_.owners()[i];
    }
  });
  if (most < kMuch * work_) whose = {};
  if (most > 0) probe_->counted(Count::Largest, static_cast<std::uint64_t>(most), whose);
}

/// How many instances of the batch, from one of them on, are drawn by one call. Where pieces are drawn alone,
/// the pieces are alike in size: what is large is a piece of its own.
std::uint32_t Renderer::togetherFrom(const InstanceBatch& b, std::uint32_t done,
                                     const MeshParts& mesh) const {
  const std::uint32_t left = std::min(b.count - done, quality_.mostAtOnce);
  if (sample_ != DrawSample::Some) return left;
  const float piece = work_ / DrawSampler::kPartsOfAFrame;
  float sum = workOf(b.first + done, mesh);
  std::uint32_t count = 1;
  while (count < left && sum + workOf(b.first + done + count, mesh) <= piece)
    sum += workOf(b.first + done + count++, mesh);
  return count;
}

/// As drawBatches() will draw them, in one pass or in two. Small things are joined: alone, each would be
/// measured with what it takes to draw next to nothing, and hundreds of them were a third off in all.
void Renderer::findPieces(std::uint32_t eye) {
  const float most = work_ / DrawSampler::kMostJoined;
  float joined = most;
  bool wanted = false;
  pieces_.clear(), wanted_.clear();
  forEachBatch([&](const InstanceBatch& batch, const MeshParts& mesh) {
    const InstanceBatch b = batch.seenBy(eye);
    for (std::uint32_t done = 0, count = 0; done < b.count; done += count) {
      count = togetherFrom(b, done, mesh);
      float work = 0;
      for (std::uint32_t i = 0; i < count; ++i) work += workOf(b.first + done + i, mesh);
      if (pieces_.empty() || joined + work > most)
        pieces_.push_back(b.first + done), joined = 0, wanted = false;
      joined += work;
      if (wanted || !probe_->wantsAlone(batches_.owners().subspan(b.first + done, count))) continue;
      wanted_.push_back(pieces_.size() - 1), wanted = true;
    }
  });
}

/// Returns each node's share in drawing these for that eye.
std::span<const NodeShare> Renderer::sharesOf(std::uint32_t eye, std::uint32_t first, std::uint32_t end) {
  shares_.clear();
  float sum = 0;
  forEachBatch([&](const InstanceBatch& batch, const MeshParts& mesh) {
    const InstanceBatch b = batch.seenBy(eye);
    for (std::uint32_t i = std::max(first, b.first); i < std::min(end, b.first + b.count); ++i) {
      shares_.push_back({batches_.owners()[i], workOf(i, mesh)});
      sum += shares_.back().part;
    }
  });
  for (NodeShare& share : shares_)
    share.part = sum > 0 ? share.part / sum : 1.0f / static_cast<float>(shares_.size());
  return shares_;
}

}  // namespace stadion
