#include "pipeline/gl_draw/sampling/draw_pieces.h"

#include <algorithm>

namespace stadion {

void DrawPieces::beginFrame(const DrawList& list, FrameProbe* probe,
                            const std::function<void()>& drawNothing) {
  const std::uint64_t frame = list.ticket.signature.frame;
  probe_ = probe;
  // The very first list is not timed: everything is slower then.
  sample_ = probe_ && scene_.isLit() ? probe_->drawSample(frame, list.wall) : DrawSample::None;
  if (!timesAnything()) return;
  if (!sampler_) {
    sampler_ = std::make_unique<DrawSampler>(gl_);
    drawNothing();  // the first time the driver compiles: that would be taken off all that is timed
    gl_.Finish();
  }
  sampler_->beginFrame(*probe_, frame, list.wall, drawNothing);
}

void DrawPieces::beginList() {
  if (!timesAnything()) return;
  scene_.instances().takeAll();
  weigh();
}

void DrawPieces::endList() {
  if (probe_ && !timesAnything()) weigh();
}

void DrawPieces::beginView(const DrawView& view, std::uint32_t index) {
  if (!areTimed()) return;
  findPieces(index);
  sampler_->beginEye(view.eye, pieces_, wanted_);
}

void DrawPieces::endView(std::uint32_t index) {
  if (!areTimed()) return;
  sampler_->endEye([&](std::uint32_t first, std::uint32_t end) { return sharesOf(index, first, end); });
}

float DrawPieces::workOf(std::size_t instance, const MeshParts& mesh) const {
  constexpr float kOfTriangle = 8;  // as much as so many pixels, on the processor
  return scene_.batches().pixels()[instance] + kOfTriangle * static_cast<float>(mesh.triangles);
}

/// Calls `f` with each batch of which anything is drawn in any pass, and its mesh.
template <class F>
void DrawPieces::forEachBatch(const F& f) {
  const InstanceBatches& all = scene_.batches();
  for (const auto batches : {all.opaque(), all.transparent()})
    for (const InstanceBatch& b : batches)
      if (const GlMesh* mesh = scene_.meshes().find(b.mesh)) f(b, partsOf(*mesh, b.level));
}

/// Adds up the work of the list. Reports the instance with the most, if that is a large part of all.
void DrawPieces::weigh() {
  constexpr float kMuch = 0.25f;  // of all
  NodeRef owner;
  float most = 0;
  work_ = 0;
  forEachBatch([&](const InstanceBatch& b, const MeshParts& mesh) {
    for (std::size_t i = b.first; i < b.first + b.count; ++i) {
      const float work = workOf(i, mesh);
      work_ += work;
      if (work > most) {
        most = work;
        owner = scene_.batches().owners()[i];
      }
    }
  });
  if (most < kMuch * work_) owner = {};
  if (most > 0) probe_->counted(Count::Largest, static_cast<std::uint64_t>(most), owner);
}

std::uint32_t DrawPieces::togetherFrom(const InstanceBatch& b, std::uint32_t done,
                                       const MeshParts& mesh) const {
  const std::uint32_t left = std::min(b.count - done, mostAtOnce_);
  if (!areTimed()) return left;
  const float piece = work_ / DrawSampler::kPartsOfAFrame;
  float sum = workOf(b.first + done, mesh);
  std::uint32_t count = 1;
  while (count < left && sum + workOf(b.first + done + count, mesh) <= piece)
    sum += workOf(b.first + done + count++, mesh);
  return count;
}

/// The pieces are those that the passes draw, in one pass or in two. Small objects are joined: alone, each
/// would be measured with the cost of drawing next to nothing, and hundreds of them were a third off in all.
void DrawPieces::findPieces(std::uint32_t view) {
  const float most = work_ / DrawSampler::kMostJoined;
  float joined = most;
  bool wanted = false;
  pieces_.clear();
  wanted_.clear();
  forEachBatch([&](const InstanceBatch& batch, const MeshParts& mesh) {
    const InstanceBatch b = batch.seenBy(view);
    for (std::uint32_t done = 0, count = 0; done < b.count; done += count) {
      count = togetherFrom(b, done, mesh);
      float work = 0;
      for (std::uint32_t i = 0; i < count; ++i) work += workOf(b.first + done + i, mesh);
      if (pieces_.empty() || joined + work > most) {
        pieces_.push_back(b.first + done);
        joined = 0;
        wanted = false;
      }
      joined += work;
      if (wanted || !probe_->wantsAlone(scene_.batches().owners().subspan(b.first + done, count))) continue;
      wanted_.push_back(pieces_.size() - 1);
      wanted = true;
    }
  });
}

/// The nodes of the instances [first, end), and the share of each in the work for that view.
std::span<const NodeShare> DrawPieces::sharesOf(std::uint32_t view, std::uint32_t first, std::uint32_t end) {
  shares_.clear();
  float sum = 0;
  forEachBatch([&](const InstanceBatch& batch, const MeshParts& mesh) {
    const InstanceBatch b = batch.seenBy(view);
    for (std::uint32_t i = std::max(first, b.first); i < std::min(end, b.first + b.count); ++i) {
      shares_.push_back({scene_.batches().owners()[i], workOf(i, mesh)});
      sum += shares_.back().part;
    }
  });
  for (NodeShare& share : shares_)
    share.part = sum > 0 ? share.part / sum : 1.0f / static_cast<float>(shares_.size());
  return shares_;
}

}  // namespace stadion
