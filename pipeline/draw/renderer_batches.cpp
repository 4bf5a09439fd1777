// What of a list is drawn in which order, by which calls.

#include "pipeline/draw/renderer.h"

#include <algorithm>
#include <limits>

namespace stadion {
namespace {

/// Instances of one part keep their order within a call; with several parts, or with inner sides to draw
/// before the outer ones, each instance has to be finished before the next.
bool drawnTogether(const GlMesh& mesh) {
  const auto simple = [](const GlSubmesh& part) { return !part.transparent || !part.bothSides; };
  return mesh.transparentParts == 1 && std::all_of(mesh.parts.begin(), mesh.parts.end(), simple);
}

}  // namespace

/// Draws before everything else, into the empty picture. Returns true if OpenGL must continue with it. The
/// other walls wait meanwhile only if it is timed.
bool Renderer::drawSmallThings(const DrawView& from, std::uint32_t index, Turn& turn) {
  constexpr std::uint64_t kPixels = 64;  // to hand them over costs as much as a triangle in OpenGL
  isDrawn_.clear();
  if (!small_ || !SmallThings::serves(from, lit_)) return false;
  const std::uint64_t enough = (std::uint64_t{width_} * height_ + kPixels - 1) / kPixels;
  std::uint64_t triangles = 0;
  for (std::size_t i = 0; triangles < enough && hasOpaque(i); ++i) {
    const InstanceBatch b = batches_.opaque()[i].seenBy(index);
    if (const GlMesh* mesh = cache_.find(b.mesh); mesh && mesh->shading)
      triangles += std::uint64_t{b.count} * partsOf(*mesh, b.level).triangles;
  }
  if (triangles < enough) return false;
  std::array<float, 3> background{0, 0, 0};
  if (skyIsFlat_) std::copy_n(lit_.zenith.begin(), 3, background.begin());
  const bool away = turn.owns_lock() && sample_ == DrawSample::None;
  if (away) turn.unlock();
  part(Span::Sky, [&] { small_->begin(from, lit_, background); });
  drawSmallThings(index, away ? &turn : nullptr);
  if (!away) return true;
  const SpanScope span(probe_, Span::ForTurn);
  turn.lock();
  return true;
}

/// `away`: the turn that was given away; it is taken again for meshes that must be uploaded.
void Renderer::drawSmallThings(std::uint32_t eye, Turn* away) {
  const auto meshOf = [&](MeshId id) {
    if (!away || cache_.holds(id)) return cache_.find(id);
    away->lock();
    const GlMesh* mesh = cache_.find(id);
    away->unlock();
    return mesh;
  };
  for (std::size_t batch = 0; hasOpaque(batch); ++batch) {
    const InstanceBatch b = batches_.opaque()[batch].seenBy(eye);
    isDrawn_.resize(batches_.matrices().size());
    const GlMesh* mesh = b.count > 0 ? meshOf(b.mesh) : nullptr;
    if (!mesh || !mesh->shading) continue;
    const MeshParts parts = partsOf(*mesh, b.level);
    for (std::uint32_t i = b.first; i < b.first + b.count; ++i) {
      if (sample_ == DrawSample::Some) sampler_->next(i, DrawSampler::By::Us);
      stopIfAsked();
      isDrawn_[i] = drawSmallThing(parts, b, i);
    }
  }
  isDrawn_.resize(batches_.matrices().size());
  if (sample_ == DrawSample::Some) sampler_->endPass();
}

bool Renderer::drawSmallThing(const MeshParts& mesh, const InstanceBatch& batch, std::uint32_t instance) {
  using Facing = TriangleSieve::Facing;
  if (!small_->place(*mesh.gl->sieve, *mesh.gl->shading, batches_.matrices()[instance])) return false;
  for (const GlSubmesh& part : mesh.parts) {
    const Facing seen = part.bothSides   ? Facing::Both
                        : batch.mirrored ? Facing::Clockwise
                                         : Facing::CounterClockwise;
    constexpr std::size_t kTriangle = 3 * sizeof(std::uint32_t);
    counts_.triangles +=
        small_->draw(static_cast<std::uint32_t>(part.indexOffset / kTriangle),
                     static_cast<std::uint32_t>(part.indexCount) / 3, seen,
                     mesh.gl->shading->materials[part.material], part.firstVertex, part.endVertex);
    ++counts_.instances;
  }
  return true;
}

/// What is near, all else after it: of that, what is hidden then can be left out.
void Renderer::drawOpaque(std::uint32_t eye) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  const std::optional<float> near = nearQuarter(eye);
  drawnFrom_ = {0, near.value_or(kFar)};
  drawOpaqueBatches(eye);
  if (!near) return;
  depths_.resize(std::size_t{width_} * height_);
  buffers_.readDepths(eye, depths_);
  sieve_->hideBehind(depths_);
  drawnFrom_ = {*near, kFar};
  drawOpaqueBatches(eye);
}

/// How far the nearest quarter of what the eye sees reaches [m]; nothing if it does not pay to look what that
/// hides, or if all must be drawn by meshes that are not sieved.
std::optional<float> Renderer::nearQuarter(std::uint32_t eye) {
  constexpr std::uint64_t kPixels = 16;  // of which to read the depths costs as much as a triangle
  if (!sieve_ || sample_ == DrawSample::Some) return {};
  distances_.clear();
  std::uint64_t triangles = 0;
  for (std::size_t batch = 0; hasOpaque(batch); ++batch) {
    const InstanceBatch b = batches_.opaque()[batch].seenBy(eye);
    const GlMesh* mesh = cache_.find(b.mesh);
    if (!mesh || !mesh->sieve) continue;
    for (std::uint32_t i = b.first; i < b.first + b.count; ++i)
      if (!isDrawn(i))
        distances_.push_back(batches_.distances()[i]), triangles += partsOf(*mesh, b.level).triangles;
  }
  if (distances_.size() < 16 || triangles * kPixels < std::uint64_t{width_} * height_) return {};
  const auto quarter = distances_.begin() + static_cast<std::ptrdiff_t>(distances_.size() / 4);
  std::nth_element(distances_.begin(), quarter, distances_.end());
  return *quarter;
}

void Renderer::drawOpaqueBatches(std::uint32_t eye) {
  for (std::size_t i = 0; hasOpaque(i); ++i) drawBatch(batches_.opaque()[i], Pass::Opaque, eye);
  if (sample_ == DrawSample::Some) sampler_->endPass();
}

/// Expects that all opaque ones have been drawn.
void Renderer::drawTransparentBatches(Pass pass, std::uint32_t eye) {
  for (const InstanceBatch& batch : batches_.transparent()) drawBatch(batch, pass, eye);
  if (sample_ == DrawSample::Some) sampler_->endPass();
}

void Renderer::drawTransparent(const ViewBlock& view, std::uint32_t eye) {
  if (layersGlass_) {
    if (coverTransparent(view, eye)) drawLayers(eye);
    return;
  }
  gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);  // pictures stay opaque
  gl_.Enable(GL_BLEND);
  gl_.DepthMask(GL_FALSE);
  drawTransparentBatches(Pass::Transparent, eye);
  gl_.DepthMask(GL_TRUE);
  gl_.Disable(GL_BLEND);
}

/// Notes which parts of the picture what is transparent may cover; false: there is nothing.
bool Renderer::coverTransparent(const ViewBlock& view, std::uint32_t eye) {
  covered_.clear();
  for (const InstanceBatch& ofBoth : batches_.transparent()) {
    const InstanceBatch batch = ofBoth.seenBy(eye);
    const GlMesh* mesh = batch.count > 0 ? cache_.find(batch.mesh) : nullptr;
    if (!mesh || mesh->transparentParts == 0) continue;
    for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i) {
      const InstanceMatrix& m = batches_.matrices()[i];
      std::array<std::array<float, 4>, 8> corners{};
      for (std::size_t corner = 0; corner < corners.size(); ++corner) {
        std::array<float, 4> p{0, 0, 0, 1};
        for (std::size_t k = 0; k < 3; ++k) {
          const auto along = static_cast<int>(k);
          p[k] = static_cast<float>((corner >> k) & 1 ? mesh->bounds.hi[along] : mesh->bounds.lo[along]);
        }
        std::array<float, 4> w{0, 0, 0, 1};
        for (std::size_t k = 0; k < 3; ++k)
          w[k] = m[4 * k] * p[0] + m[4 * k + 1] * p[1] + m[4 * k + 2] * p[2] + m[4 * k + 3];
        for (std::size_t k = 0; k < 4; ++k)
          for (std::size_t from = 0; from < 4; ++from)
            corners[corner][k] += view.viewProjection[4 * from + k] * w[from];
      }
      covered_.cover(corners);
    }
  }
  return !covered_.bounds().empty();
}

void Renderer::drawLayers(std::uint32_t eye) {
  if (!layers_) {
    auto made = GlassLayers::create(gl_, width_, height_, buffers_.samples(), quality_.mostFragments);
    usedProgram_ = 0;
    if (!made) {
      report(made.error().message);
      return;
    }
    layers_ = std::move(made.value());
  }
  // It may take several times, of which one counts.
  const DrawCounts before = counts_;
  const DrawSample sample = sample_;
  DrawCounts once;
  bool first = true;
  layers_->draw(buffers_, eye, covered_, [&] {
    usedProgram_ = 0, layerTriangles_ = 0;
    if (!first) sample_ = DrawSample::None;
    drawTransparentBatches(Pass::Layers, eye);
    if (first) once = counts_;
    first = false;
  });
  sample_ = sample;
  usedProgram_ = 0;
  counts_ = first ? before : once;
  counts_.calls += 1;  // that blends them
}

void Renderer::drawBatch(const InstanceBatch& ofBoth, Pass pass, std::uint32_t eye) {
  const InstanceBatch batch = ofBoth.seenBy(eye);
  const GlMesh* mesh = batch.count > 0 ? cache_.find(batch.mesh) : nullptr;
  if (!mesh) return;
  if ((pass == Pass::Transparent || pass == Pass::Layers) && mesh->transparentParts == 0) return;
  if (pass == Pass::OpaqueParts && mesh->transparentParts == mesh->parts.size()) return;
  uploadInstances();
  gl_.BindVertexArray(mesh->vertexArray.name());
  gl_.FrontFace(batch.mirrored ? GL_CW : GL_CCW);
  mirrored_ = batch.mirrored;
  if (basesInstances_) pointAtInstances(gl_, instances_, 0);
  const MeshParts parts = partsOf(*mesh, batch.level);
  for (std::uint32_t done = 0, count = 0; done < batch.count; done += count) {
    count = togetherFrom(batch, done, parts);
    drawInstances(parts, batch.first + done, count, pass);
  }
}

void Renderer::drawInstances(const MeshParts& mesh, std::uint32_t first, std::uint32_t count, Pass pass) {
  const bool oneByOne = pass == Pass::Transparent && !drawnTogether(*mesh.gl);
  const std::uint32_t step = oneByOne ? 1 : count;
  if (sample_ == DrawSample::Some) sampler_->next(first);
  if (pass == Pass::Opaque && mesh.gl->sieve) return drawSieved(mesh, first, count);
  for (std::uint32_t i = first; i < first + count; i += step) {
    stopIfAsked();
    if (!basesInstances_) pointAtInstances(gl_, instances_, i);
    if (pass == Pass::Layers)
      drawLayeredParts(mesh, i, step);
    else if (pass == Pass::Transparent)
      drawTransparentParts(mesh, i, step);
    else
      drawOpaqueParts(mesh, i, step, pass);
  }
}

/// Each instance with the triangles that this eye may see of it.
void Renderer::drawSieved(const MeshParts& mesh, std::uint32_t first, std::uint32_t count) {
  using Facing = TriangleSieve::Facing;
  stopIfAsked();
  sieve_->clear();
  sieved_.assign(count * mesh.parts.size(), {});
  for (std::uint32_t i = 0; i < count; ++i) {
    const float distance = batches_.distances()[first + i];
    if (isDrawn(first + i) || distance < drawnFrom_[0] || distance >= drawnFrom_[1]) continue;
    sieve_->place(*mesh.gl->sieve, batches_.matrices()[first + i]);
    for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
      const GlSubmesh& part = mesh.parts[p];
      const Facing seen = part.bothSides ? Facing::Both
                          : mirrored_    ? Facing::Clockwise
                                         : Facing::CounterClockwise;
      constexpr std::size_t kTriangle = 3 * sizeof(std::uint32_t);
      sieved_[p * count + i] = sieve_->keep(static_cast<std::uint32_t>(part.indexOffset / kTriangle),
                                            static_cast<std::uint32_t>(part.indexCount) / 3, seen);
    }
  }
  if (sieve_->kept().empty()) return;
  stream(gl_, GL_ELEMENT_ARRAY_BUFFER, indices_, sieve_->kept());
  for (std::size_t p = 0; p < mesh.parts.size(); ++p) {
    cull(false, !mesh.parts[p].bothSides);
    beginPart(*mesh.gl, mesh.parts[p], false);
    for (std::uint32_t i = 0; i < count; ++i)
      if (const TriangleSieve::Range r = sieved_[p * count + i]; r.count > 0)
        drawIndices(r.first * sizeof(std::uint32_t), static_cast<GLsizei>(r.count), first + i, 1);
  }
  gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, mesh.gl->indices.name());  // which its vertex array remembers
}

void Renderer::drawOpaqueParts(const MeshParts& mesh, std::uint32_t first, std::uint32_t count, Pass pass) {
  for (const GlSubmesh& part : mesh.parts) {
    if (pass == Pass::OpaqueParts && part.transparent) continue;
    cull(false, !part.bothSides);
    drawPart(*mesh.gl, part, first, count, false);
  }
}

void Renderer::drawTransparentParts(const MeshParts& mesh, std::uint32_t first, std::uint32_t count) {
  for (const GlSubmesh& part : mesh.parts) {
    if (!part.transparent) continue;
    if (part.bothSides) {
      cull(true, false);
      drawPart(*mesh.gl, part, first, count, true);
    }
    cull(false, true);
    drawPart(*mesh.gl, part, first, count, true);
  }
}

/// Both sides at once, and any number of instances: they are sorted later. Triangles are numbered through the
/// whole list, so that those at the same depth have an order.
void Renderer::drawLayeredParts(const MeshParts& mesh, std::uint32_t first, std::uint32_t count) {
  std::uint32_t before = 0;
  for (const GlSubmesh& part : mesh.parts) {
    if (part.transparent) {
      cull(false, !part.bothSides);
      beginPart(*mesh.gl, part, true);
      const GlProgram& program = surfaceFor(surfaceTraits(part, true));
      layers_->setSurface(program, layerTriangles_ + before, mesh.triangles);
      drawIndices(part.indexOffset, part.indexCount, first, count);
    }
    before += static_cast<std::uint32_t>(part.indexCount) / 3;
  }
  layerTriangles_ += mesh.triangles * count;
}

void Renderer::drawPart(const GlMesh& mesh, const GlSubmesh& part, std::uint32_t first,
                        std::uint32_t instances, bool blended) {
  beginPart(mesh, part, blended);
  drawIndices(part.indexOffset, part.indexCount, first, instances);
}

SurfaceTraits Renderer::surfaceTraits(const GlSubmesh& part, bool blended) const {
  SurfaceTraits traits;
  traits.textured = part.texture != 0, traits.localLights = localLights_;
  if (blended) traits.writes = layersGlass_ ? SurfaceWrites::Layers : SurfaceWrites::Blended;
  traits.masked = part.masked, traits.glowing = part.glowTexture != 0;
  return traits;
}

void Renderer::beginPart(const GlMesh& mesh, const GlSubmesh& part, bool blended) {
  use(surfaceFor(surfaceTraits(part, blended)));
  if (part.texture) gl_.BindTexture(GL_TEXTURE_2D, part.texture);
  if (part.glowTexture) {
    gl_.ActiveTexture(GL_TEXTURE0 + kGlowUnit);
    gl_.BindTexture(GL_TEXTURE_2D, part.glowTexture);
    gl_.ActiveTexture(GL_TEXTURE0);
  }
  bindMaterial(mesh.materials.name(), part.materialOffset);
}

/// `from`: in the bound index buffer [bytes].
void Renderer::drawIndices(std::uintptr_t from, GLsizei count, std::uint32_t first, std::uint32_t instances) {
  const auto times = static_cast<GLsizei>(instances);
  if (basesInstances_)
    gl_.DrawElementsInstancedBaseInstance(GL_TRIANGLES, count, GL_UNSIGNED_INT, inBuffer(from), times, first);
  else
    gl_.DrawElementsInstanced(GL_TRIANGLES, count, GL_UNSIGNED_INT, inBuffer(from), times);
  ++counts_.calls;
  counts_.instances += instances;
  counts_.triangles += std::uint64_t{instances} * static_cast<std::uint64_t>(count / 3);
}

/// Binding what is bound already costs a software rasteriser as much as drawing some triangles.
void Renderer::bindMaterial(GLuint buffer, GLintptr at) {
  if (boundMaterial_ == std::pair(buffer, at)) return;
  boundMaterial_ = {buffer, at};
  gl_.BindBufferRange(GL_UNIFORM_BUFFER, kMaterialBinding, buffer, at, sizeof(MaterialBlock));
}

}  // namespace stadion
