#include "pipeline/gl_draw/passes/small_object_pass.h"

#include <algorithm>
#include <array>

namespace stadion {

SmallObjectPass::SmallObjectPass(const PassContext& with, RenderQuality quality) : with_(with) {
  if (with.scene.cullsTriangles() && quality.look == Look::Plain && quality.drawsSmallObjects)
    small_.emplace(with.width, with.height);
}

bool SmallObjectPass::draw(const DrawView& from, std::uint32_t view, std::unique_lock<std::mutex>& turn,
                           FrameProbe* probe) {
  const SceneBlock& lighting = with_.scene.lighting();
  drew_.clear();
  if (!small_ || !SmallObjectRasterizer::serves(from, lighting) || !pays(view)) return false;
  std::array<float, 3> background{0, 0, 0};
  if (with_.scene.skyIsFlat()) std::copy_n(lighting.zenith.begin(), 3, background.begin());
  const bool away = turn.owns_lock() && !with_.pieces.timesAnything();
  if (away) turn.unlock();
  with_.pieces.part(Span::Sky, [&] { small_->begin(from, lighting, background); });
  drawAll(view, away ? &turn : nullptr);
  if (!away) return true;
  const SpanScope span(probe, Span::ForTurn);
  turn.lock();
  return true;
}

/// Whether the view has enough triangles that may be small.
bool SmallObjectPass::pays(std::uint32_t view) {
  constexpr std::uint64_t kPixels = 64;  // to hand them over costs as much as a triangle in OpenGL
  const std::uint64_t enough = (with_.pixels() + kPixels - 1) / kPixels;
  std::uint64_t triangles = 0;
  for (std::size_t i = 0; triangles < enough && with_.scene.instances().hasOpaque(i); ++i) {
    const InstanceBatch b = with_.scene.batches().opaque()[i].seenBy(view);
    if (const GlMesh* mesh = with_.scene.meshOf(b); mesh && mesh->shading)
      triangles += std::uint64_t{b.count} * partsOf(*mesh, b.level).triangles;
  }
  return triangles >= enough;
}

/// `away`: the turn that was given away. It is taken again for meshes that must be uploaded. Figures and
/// painted meshes are none of the small objects.
const GlMesh* SmallObjectPass::meshOf(const InstanceBatch& seen, std::unique_lock<std::mutex>* away) {
  if (seen.figure != 0 || seen.paint != 0) return nullptr;
  if (!away || seen.count == 0 || with_.scene.meshes().holds(seen.mesh)) return with_.scene.meshOf(seen);
  away->lock();
  const GlMesh* mesh = with_.scene.meshOf(seen);
  away->unlock();
  return mesh;
}

void SmallObjectPass::drawAll(std::uint32_t view, std::unique_lock<std::mutex>* away) {
  const InstanceBatches& batches = with_.scene.batches();
  for (std::size_t batch = 0; with_.scene.instances().hasOpaque(batch); ++batch) {
    const InstanceBatch b = batches.opaque()[batch].seenBy(view);
    drew_.resize(batches.matrices().size());
    const GlMesh* mesh = meshOf(b, away);
    if (!mesh || !mesh->shading) continue;
    const MeshParts parts = partsOf(*mesh, b.level);
    for (std::uint32_t i = b.first; i < b.first + b.count; ++i) {
      with_.pieces.next(i, DrawSampler::By::Us);
      with_.stop.check();
      drew_[i] = drawOne(parts, b, i);
    }
  }
  drew_.resize(batches.matrices().size());
  with_.pieces.endPass();
}

bool SmallObjectPass::drawOne(const MeshParts& mesh, const InstanceBatch& batch, std::uint32_t instance) {
  const InstanceMatrix& model = with_.scene.batches().matrices()[instance];
  if (!small_->place(*mesh.gl->culler, *mesh.gl->shading, model)) return false;
  DrawCounts& counts = with_.scene.calls().counts();
  for (const GlSubmesh& part : mesh.parts) {
    counts.triangles +=
        small_->draw(part.firstTriangle(), part.triangles(), facingOf(part, batch.mirrored),
                     mesh.gl->shading->materials[part.material], part.firstVertex, part.endVertex);
    ++counts.instances;
  }
  return true;
}

}  // namespace stadion
