#include "pipeline/gl_draw/passes/transparent_pass.h"

#include <algorithm>
#include <array>
#include <span>

namespace stadion {
namespace {

/// Whether instances may share a draw call. Instances of one part keep their order within a call. With
/// several parts, or with inner sides to draw before the outer ones, each instance has to be finished before
/// the next.
bool drawnTogether(const GlMesh& mesh) {
  const auto simple = [](const GlSubmesh& part) { return !part.transparent || !part.bothSides; };
  return mesh.transparentParts == 1 && std::all_of(mesh.parts.begin(), mesh.parts.end(), simple);
}

/// The corners of a box in clip space.
std::array<std::array<float, 4>, 8> cornersOf(const Aabb& box, const InstanceMatrix& m,
                                              const ViewBlock& from) {
  std::array<std::array<float, 4>, 8> corners{};
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    std::array<float, 4> p{0, 0, 0, 1};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto along = static_cast<int>(k);
      p[k] = static_cast<float>((corner >> k) & 1 ? box.hi[along] : box.lo[along]);
    }
    std::array<float, 4> w{0, 0, 0, 1};
    for (std::size_t k = 0; k < 3; ++k)
      w[k] = m[4 * k] * p[0] + m[4 * k + 1] * p[1] + m[4 * k + 2] * p[2] + m[4 * k + 3];
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t along = 0; along < 4; ++along)
        corners[corner][k] += from.viewProjection[4 * along + k] * w[along];
  }
  return corners;
}

}  // namespace

TransparentPass::TransparentPass(const PassContext& with, SurfaceDrawing& surfaces,
                                 std::uint32_t mostFragments, ProblemLog& problems)
    : with_(with), surfaces_(surfaces), mostFragments_(mostFragments), problems_(problems),
      layered_(GlassLayers::isSupported(with.gl)), covered_(with.width, with.height) {}

/// The calls for all objects with a transparent part.
template <class Draw>
void TransparentPass::forEachCall(std::uint32_t view, bool oneByOne, const Draw& draw) {
  for (const InstanceBatch& batch : with_.scene.batches().transparent()) {
    const InstanceBatch seen = batch.seenBy(view);
    const GlMesh* mesh = with_.scene.meshOf(seen);
    if (!mesh || mesh->transparentParts == 0) continue;
    surfaces_.forEachCall(*mesh, seen, oneByOne && !drawnTogether(*mesh), draw);
  }
  with_.pieces.endPass();
}

void TransparentPass::drawOpaqueParts(std::uint32_t view) {
  for (const InstanceBatch& batch : with_.scene.batches().transparent()) {
    const InstanceBatch seen = batch.seenBy(view);
    const GlMesh* mesh = with_.scene.meshOf(seen);
    if (!mesh || mesh->transparentParts == mesh->parts.size()) continue;
    surfaces_.drawOpaque(*mesh, seen, true);
  }
  surfaces_.finishOpaque();
  with_.pieces.endPass();
}

void TransparentPass::draw(const ViewBlock& from, std::uint32_t view) {
  if (!layered_)
    drawSorted(view);
  else if (findCovered(from, view) && makeLayers())
    drawLayers(view);
}

void TransparentPass::drawSorted(std::uint32_t view) {
  const GlTable& gl = with_.gl;
  gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);  // pictures stay opaque
  gl.Enable(GL_BLEND);
  gl.DepthMask(GL_FALSE);
  forEachCall(view, true, [&](const MeshParts& mesh, std::uint32_t first, std::uint32_t count) {
    drawBackToFront(mesh, first, count);
  });
  gl.DepthMask(GL_TRUE);
  gl.Disable(GL_BLEND);
}

/// Inner sides first.
void TransparentPass::drawBackToFront(const MeshParts& mesh, std::uint32_t first, std::uint32_t count) {
  DrawCalls& calls = with_.scene.calls();
  for (const GlSubmesh& part : mesh.parts) {
    if (!part.transparent) continue;
    if (part.bothSides) {
      calls.cull(true, false);
      surfaces_.drawPart(*mesh.gl, part, first, count, SurfaceWrites::Blended);
    }
    calls.cull(false, true);
    surfaces_.drawPart(*mesh.gl, part, first, count, SurfaceWrites::Blended);
  }
}

/// Notes which parts of the picture transparent objects may cover. False: none.
bool TransparentPass::findCovered(const ViewBlock& from, std::uint32_t view) {
  covered_.clear();
  const InstanceBatches& batches = with_.scene.batches();
  for (const InstanceBatch& batch : batches.transparent()) {
    const InstanceBatch seen = batch.seenBy(view);
    const GlMesh* mesh = with_.scene.meshOf(seen);
    if (!mesh || mesh->transparentParts == 0) continue;
    for (std::uint32_t i = seen.first; i < seen.first + seen.count; ++i)
      covered_.cover(cornersOf(mesh->bounds, batches.matrices()[i], from));
  }
  return !covered_.bounds().empty();
}

bool TransparentPass::makeLayers() {
  if (layers_) return true;
  auto made =
      GlassLayers::create(with_.gl, with_.width, with_.height, with_.buffers.samples(), mostFragments_);
  with_.scene.calls().forgetProgram();
  if (made)
    layers_ = std::move(made.value());
  else
    problems_.report(made.error().message);
  return layers_ != nullptr;
}

/// The surfaces may be drawn several times, of which one is counted and timed.
void TransparentPass::drawLayers(std::uint32_t view) {
  DrawCalls& calls = with_.scene.calls();
  const auto surfaces = [&] {
    calls.forgetProgram();
    triangles_ = 0;
    forEachCall(view, false, [&](const MeshParts& mesh, std::uint32_t first, std::uint32_t count) {
      drawIntoLayers(mesh, first, count);
    });
  };
  const DrawCounts before = calls.counts();
  DrawCounts once;
  bool first = true;
  layers_->draw(with_.buffers, view, covered_, [&] {
    if (!first) return with_.pieces.untimed(surfaces);
    surfaces();
    once = calls.counts();
    first = false;
  });
  calls.forgetProgram();
  calls.counts() = first ? before : once;
  calls.counts().calls += 1;  // that blends them
}

/// Both sides at once, and any number of instances: they are sorted later. Triangles are numbered through the
/// whole list, so that those at the same depth have an order.
void TransparentPass::drawIntoLayers(const MeshParts& mesh, std::uint32_t first, std::uint32_t count) {
  DrawCalls& calls = with_.scene.calls();
  std::uint32_t before = 0;
  for (const GlSubmesh& part : mesh.parts) {
    if (part.transparent) {
      calls.cull(false, !part.bothSides);
      const GlProgram& program = surfaces_.beginPart(*mesh.gl, part, SurfaceWrites::Layers);
      layers_->setSurface(program, triangles_ + before, mesh.triangles);
      calls.drawIndices(part.indexOffset, part.indexCount, first, count);
    }
    before += part.triangles();
  }
  triangles_ += mesh.triangles * count;
}

}  // namespace stadion
