#include "pipeline/gl_draw/passes/shadow_maps.h"

#include "pipeline/gl/problem.h"
#include "pipeline/shader/shaders.h"
#include "pipeline/shader/uniform_blocks.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr auto kTile = static_cast<GLsizei>(kShadowTexels);
constexpr GLsizei kSide = 2 * kTile;
constexpr std::uint32_t kMostAtOnce = 1024;  // instances a call, as in the renderer
/// Away from the light, so that no surface shadows itself: by its slope, and by steps of the depth, of which
/// there are 2^24 or more in the ring.
constexpr float kSlopeOffset = -2, kStepOffset = -4;

void makeMap(const GlTable& gl, const GlTexture& texture, const GlFramebuffer& framebuffer) {
  gl.BindTexture(GL_TEXTURE_2D, texture.name());
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, kSide, kSide, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                nullptr);
  for (const GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    gl.TexParameteri(GL_TEXTURE_2D, filter, GL_LINEAR);
  for (const GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    gl.TexParameteri(GL_TEXTURE_2D, wrap, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture.name(), 0);
  gl.DrawBuffer(GL_NONE);
  gl.ReadBuffer(GL_NONE);
}

}  // namespace

Result<std::unique_ptr<ShadowMaps>> ShadowMaps::create(const GlTable& gl, ClipDepth clip, UploadRing* ring,
                                                       bool indirect) {
  auto program = GlProgram::build(gl, shadowVertexShader(), shadowFragmentShader(), shaderBindings());
  if (!program) return program.error();
  std::unique_ptr<ShadowMaps> maps(new ShadowMaps(gl, clip, ring, indirect, std::move(program.value())));
  for (const GlFramebuffer* into : {&maps->intoStill_, &maps->intoShown_}) {
    gl.BindFramebuffer(GL_FRAMEBUFFER, into->name());
    if (gl.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      return problem("this OpenGL cannot draw into a depth texture: no shadows");
  }
  return maps;
}

ShadowMaps::ShadowMaps(const GlTable& gl, ClipDepth clip, UploadRing* ring, bool indirect, GlProgram program)
    : gl_(gl), clip_(clip), program_(std::move(program)), still_(gl), shown_(gl), intoStill_(gl),
      intoShown_(gl), view_(gl, ring, GL_UNIFORM_BUFFER), block_(gl, ring, GL_UNIFORM_BUFFER),
      instances_(gl, ring, GL_ARRAY_BUFFER) {
  if (indirect) indirect_.emplace(gl, ring, IndirectDraws::Order::Any);
  makeMap(gl, still_, intoStill_);
  makeMap(gl, shown_, intoShown_);
}

ShadowMaps::Area ShadowMaps::tileOf(std::size_t ring) {
  return {static_cast<GLint>(ring % 2) * kTile, static_cast<GLint>(ring / 2) * kTile, kTile, kTile};
}

/// With a texel around, within the tile; empty if nothing moves there.
ShadowMaps::Area ShadowMaps::coveredBy(const DrawShadowRing& ring, const Area& tile) {
  const auto texel = [](float at) {
    return static_cast<GLint>(std::lround((0.5f + 0.5f * std::clamp(at, -1.0f, 1.0f)) * kTile));
  };
  const auto& a = ring.movingArea;
  if (!(a[0] < a[2] && a[1] < a[3])) return {};
  const GLint x0 = std::max(texel(a[0]) - 1, 0), y0 = std::max(texel(a[1]) - 1, 0);
  const GLint x1 = std::min(texel(a[2]) + 1, kTile), y1 = std::min(texel(a[3]) + 1, kTile);
  return {tile.x + x0, tile.y + y0, x1 - x0, y1 - y0};
}

ShadowMaps::Area ShadowMaps::around(const Area& a, const Area& b) {
  if (a.width <= 0) return b;
  if (b.width <= 0) return a;
  const GLint x = std::min(a.x, b.x), y = std::min(a.y, b.y);
  return {x, y, std::max(a.x + a.width, b.x + b.width) - x, std::max(a.y + a.height, b.y + b.height) - y};
}

void ShadowMaps::update(const DrawShadows& shadows, GpuScene& scene, const std::function<void()>& between) {
  gl_.UseProgram(program_.name());
  gl_.Enable(GL_POLYGON_OFFSET_FILL);
  gl_.PolygonOffset(kSlopeOffset, kStepOffset);
  gl_.Enable(GL_SCISSOR_TEST);
  for (std::size_t ring = 0; ring < kShadowRings; ++ring) updateRing(shadows, ring, scene, between);
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
  fillBlock(shadows);
}

void ShadowMaps::updateRing(const DrawShadows& shadows, std::size_t index, GpuScene& scene,
                            const std::function<void()>& between) {
  const DrawShadowRing& now = shadows.rings[index];
  Ring& held = rings_[index];
  const Area tile = tileOf(index), moved = coveredBy(now, tile);
  const bool redraw = !held.drawn || held.stillKey != now.stillKey;
  if (!redraw && held.movingKey == now.movingKey) return;
  held.drawn = false;  // until it is finished; what interrupts it leaves it void
  gl_.Viewport(tile.x, tile.y, tile.width, tile.height);
  gl_.Scissor(tile.x, tile.y, tile.width, tile.height);
  if (redraw) {
    gl_.BindFramebuffer(GL_FRAMEBUFFER, intoStill_.name());
    gl_.Clear(GL_DEPTH_BUFFER_BIT);
    if (now.still) drawCasters(shadows, index, *now.still, scene, between);
  }
  restore(redraw ? tile : around(held.moved, moved));
  gl_.BindFramebuffer(GL_FRAMEBUFFER, intoShown_.name());
  drawCasters(shadows, index, now.moving, scene, between);
  held = {now.stillKey, now.movingKey, true, moved};
}

void ShadowMaps::restore(const Area& a) {
  if (a.width <= 0) return;
  gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, intoStill_.name());
  gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, intoShown_.name());
  gl_.BlitFramebuffer(a.x, a.y, a.x + a.width, a.y + a.height, a.x, a.y, a.x + a.width, a.y + a.height,
                      GL_DEPTH_BUFFER_BIT, GL_NEAREST);
}

void ShadowMaps::drawCasters(const DrawShadows& shadows, std::size_t index, std::span<const DrawItem> casters,
                             GpuScene& scene, const std::function<void()>& between) {
  if (casters.empty()) return;
  setView(shadows, index);
  sorted_.assign(casters.begin(), casters.end());
  std::ranges::sort(sorted_, {}, &DrawItem::mesh);
  batches_.build(sorted_, {});
  instances_.fill(batches_.matrices());
  if (indirect_) indirect_->clear();
  for (const InstanceBatch& batch : batches_.opaque()) {
    const GlMesh* mesh = scene.meshOf(batch);
    if (!mesh) continue;
    if (indirect_) collect(*mesh, batch);
    drawBatch(*mesh, batch, between);
  }
  if (indirect_) indirect_->draw(instances_);
}

/// Looks along the light into a ring.
void ShadowMaps::setView(const DrawShadows& shadows, std::size_t index) {
  ViewBlock view{};
  Mat4 toClip = Mat4::Identity();
  for (int k = 0; k < 3; ++k) {
    const auto along = [&](int axis) { return double{shadows.axes[static_cast<std::size_t>(3 * axis + k)]}; };
    toClip(0, k) = along(0) / kShadowReach[index];
    toClip(1, k) = along(1) / kShadowReach[index];
    toClip(2, k) = 0.5 * along(2) / kShadowDepth;
  }
  toClip(2, 3) = 0.5;
  fillViewProjection(toClip, clip_, view);
  view_.fill(std::span<const ViewBlock>(&view, 1));
  view_.bindBlock(kViewBinding);
}

/// What has no holes is drawn later, all at once.
void ShadowMaps::collect(const GlMesh& mesh, const InstanceBatch& batch) {
  for (const GlSubmesh& part : mesh.parts)
    if (!part.masked)
      indirect_->add(
          {&program_, mesh.place.page.get(), mesh.packedMaterials(), {}, part.bothSides, batch.mirrored},
          mesh, part, batch.first, batch.count);
}

/// Draws the parts that are not drawn later.
void ShadowMaps::drawBatch(const GlMesh& mesh, const InstanceBatch& batch,
                           const std::function<void()>& between) {
  const auto isMasked = [](const GlSubmesh& part) { return part.masked; };
  if (indirect_ && std::ranges::none_of(mesh.parts, isMasked)) return between();
  gl_.BindVertexArray(mesh.vertexArray());
  gl_.FrontFace(batch.mirrored ? GL_CW : GL_CCW);
  for (std::uint32_t done = 0; done < batch.count; done += kMostAtOnce) {
    between();
    pointAtInstances(gl_, instances_, batch.first + done);
    const auto count = static_cast<GLsizei>(std::min(batch.count - done, kMostAtOnce));
    for (const GlSubmesh& part : mesh.parts)
      if (!indirect_ || part.masked) drawPart(mesh, part, count);
  }
}

const GlProgram& ShadowMaps::programFor(const GlSubmesh& part) {
  if (!part.masked) return program_;
  SurfaceTraits traits;
  traits.masked = true;
  traits.textured = part.maps[kBaseMap] != 0;
  traits.ownPlaces = traits.textured && part.ownPlaces;
  const auto which = std::size_t{traits.textured} | std::size_t{traits.ownPlaces} << 1;
  if (!masked_[which] && !maskedFailed_[which]) {
    auto built =
        GlProgram::build(gl_, shadowVertexShader(traits), shadowFragmentShader(traits), shaderBindings());
    if (built)
      masked_[which].emplace(std::move(built.value()));
    else
      maskedFailed_[which] = true;
  }
  return masked_[which] ? *masked_[which] : program_;
}

void ShadowMaps::drawPart(const GlMesh& mesh, const GlSubmesh& part, GLsizei instances) {
  gl_.UseProgram(programFor(part).name());
  if (part.masked) {
    if (part.maps[kBaseMap]) gl_.BindTexture(GL_TEXTURE_2D, part.maps[kBaseMap]);
    gl_.BindBufferRange(GL_UNIFORM_BUFFER, kMaterialBinding, mesh.materials.name(), part.materialOffset,
                        sizeof(MaterialBlock));
  }
  if (part.bothSides)
    gl_.Disable(GL_CULL_FACE);
  else
    gl_.Enable(GL_CULL_FACE);
  gl_.CullFace(GL_BACK);
  gl_.DrawElementsInstanced(GL_TRIANGLES, part.indexCount, GL_UNSIGNED_INT,
                            reinterpret_cast<const void*>(part.indexOffset), instances);
}

void ShadowMaps::fillBlock(const DrawShadows& shadows) {
  constexpr float kWithin = 1;  // of a texel: how far along its normal a surface is looked up
  ShadowBlock out{};
  const auto& a = shadows.axes;
  const auto depth = static_cast<float>(kShadowDepth);
  out.right = {a[0], a[1], a[2], 0};
  out.up = {a[3], a[4], a[5], 0};
  out.towards = {a[6], a[7], a[8], 0.5f / depth};
  for (std::size_t i = 0; i < kShadowRings; ++i) {
    const Area tile = tileOf(i);
    const auto& offset = shadows.rings[i].offset;
    const auto reach = static_cast<float>(kShadowReach[i]);
    const auto middle = [](GLint corner) { return (static_cast<float>(corner) + 0.5f * kTile) / kSide; };
    const float scale = 0.25f / reach;
    out.rings[i] = {middle(tile.x) + offset[0] * scale, middle(tile.y) + offset[1] * scale,
                    0.5f + 0.5f * offset[2] / depth, scale};
    out.lift[i] = kWithin * 2 * reach / kTile;
  }
  block_.fill(std::span<const ShadowBlock>(&out, 1));
}

void ShadowMaps::bind() const {
  block_.bindBlock(kShadowBinding);
  gl_.ActiveTexture(GL_TEXTURE0 + kShadowUnit);
  gl_.BindTexture(GL_TEXTURE_2D, shown_.name());
  gl_.ActiveTexture(GL_TEXTURE0);
}

}  // namespace stadion
