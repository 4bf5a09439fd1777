#include "pipeline/gl_draw/passes/opaque_pass.h"

#include <algorithm>
#include <limits>

namespace stadion {

OpaquePass::OpaquePass(const PassContext& with, SurfaceDrawing& surfaces)
    : with_(with), surfaces_(surfaces), seenIndices_(with.gl) {
  if (with.scene.cullsTriangles()) culler_.emplace(with.width, with.height);
}

/// The near objects first: what they hide of the others can be left out.
void OpaquePass::draw(const DrawView& from, std::uint32_t view, const SmallObjectPass& small) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  surfaces_.forgetOpaque();
  if (culler_) culler_->setView(from);
  const std::optional<float> near = nearQuarter(view, small);
  drawBatches(view, small, {0, near.value_or(kFar)});
  if (!near) return;
  depths_.resize(static_cast<std::size_t>(with_.pixels()));
  with_.buffers.readDepths(view, depths_);
  culler_->hideBehind(depths_);
  drawBatches(view, small, {*near, kFar});
}

/// The distance of the farthest object of the nearest quarter of what the view sees [m]. Nothing if it does
/// not pay to look what that quarter hides, or if pieces are timed.
std::optional<float> OpaquePass::nearQuarter(std::uint32_t view, const SmallObjectPass& small) {
  constexpr std::uint64_t kPixels = 16;  // of which to read the depths costs as much as a triangle
  constexpr std::size_t kFewest = 16;
  if (!culler_ || with_.pieces.areTimed()) return {};
  distances_.clear();
  std::uint64_t triangles = 0;
  const InstanceBatches& batches = with_.scene.batches();
  for (std::size_t batch = 0; with_.scene.instances().hasOpaque(batch); ++batch) {
    const InstanceBatch b = batches.opaque()[batch].seenBy(view);
    const GlMesh* mesh = with_.scene.meshOf(b);
    if (!mesh || !mesh->culler) continue;
    const std::uint32_t ofOne = partsOf(*mesh, b.level).triangles;
    for (std::uint32_t i = b.first; i < b.first + b.count; ++i)
      if (!small.drew(i)) {
        distances_.push_back(batches.distances()[i]);
        triangles += ofOne;
      }
  }
  if (distances_.size() < kFewest || triangles * kPixels < with_.pixels()) return {};
  const auto quarter = distances_.begin() + static_cast<std::ptrdiff_t>(distances_.size() / 4);
  std::nth_element(distances_.begin(), quarter, distances_.end());
  return *quarter;
}

void OpaquePass::drawBatches(std::uint32_t view, const SmallObjectPass& small, Distances within) {
  for (std::size_t i = 0; with_.scene.instances().hasOpaque(i); ++i) {
    const InstanceBatch seen = with_.scene.batches().opaque()[i].seenBy(view);
    if (const GlMesh* mesh = with_.scene.meshOf(seen)) drawBatch(*mesh, seen, small, within);
    // Cull may still be finding more. What is known is drawn meanwhile.
    if (i + 1 == with_.scene.batches().opaque().size()) surfaces_.finishOpaque();
  }
  with_.pieces.endPass();
}

void OpaquePass::drawBatch(const GlMesh& mesh, const InstanceBatch& seen, const SmallObjectPass& small,
                           Distances within) {
  if (!mesh.culler) return surfaces_.drawOpaque(mesh, seen, false);
  surfaces_.forEachCall(mesh, seen, false,
                        [&](const MeshParts& of, std::uint32_t first, std::uint32_t count) {
                          keepSeen(of, first, count, seen.mirrored, small, within);
                          drawSeen(of, first, count);
                        });
}

/// Finds the triangles of each instance that the view may see.
void OpaquePass::keepSeen(const MeshParts& mesh, std::uint32_t first, std::uint32_t count, bool mirrored,
                          const SmallObjectPass& small, Distances within) {
  const InstanceBatches& batches = with_.scene.batches();
  culler_->clear();
  seen_.assign(count * mesh.parts.size(), {});
  for (std::uint32_t i = 0; i < count; ++i) {
    const float distance = batches.distances()[first + i];
    if (small.drew(first + i) || distance < within.from || distance >= within.to) continue;
    culler_->place(*mesh.gl->culler, batches.matrices()[first + i]);
    for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
      const GlSubmesh& part = mesh.parts[p];
      seen_[p * count + i] = culler_->keep(part.firstTriangle(), part.triangles(), facingOf(part, mirrored));
    }
  }
}

void OpaquePass::drawSeen(const MeshParts& mesh, std::uint32_t first, std::uint32_t count) {
  if (culler_->kept().empty()) return;
  DrawCalls& calls = with_.scene.calls();
  stream(with_.gl, GL_ELEMENT_ARRAY_BUFFER, seenIndices_, culler_->kept());
  for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
    calls.cull(false, !mesh.parts[p].bothSides);
    surfaces_.beginPart(*mesh.gl, mesh.parts[p], SurfaceWrites::Picture);
    for (std::uint32_t i = 0; i < count; ++i)
      if (const TriangleCuller::Range r = seen_[p * count + i]; r.count > 0)
        calls.drawIndices(r.first * sizeof(std::uint32_t), static_cast<GLsizei>(r.count), first + i, 1);
  }
  with_.gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh.gl->indices());  // its vertex array remembers it
}

}  // namespace stadion
