#include "pipeline/draw/renderer.h"

#include "engine/run_stopped.h"
#include "pipeline/draw/picture_size.h"
#include "pipeline/draw/problem.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace stadion {
namespace {

constexpr GLuint64 kLongWait = 1'000'000'000;  // [ns]
constexpr int kMostErrorsRead = 16;            // a lost context may report errors for ever

const void* offset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);
}

bool isLocal(const DrawLight& light) {
  return light.kind != DrawLight::Kind::Directional;
}

std::size_t surfaceIndex(const SurfaceTraits& traits) {
  return std::size_t{traits.textured} | std::size_t{traits.localLights} << 1 |
         std::size_t{traits.blended} << 2;
}

/// Instances of one part keep their order within a call; with several parts, or with inner sides to draw
/// before the outer ones, each instance has to be finished before the next.
bool drawnTogether(const GlMesh& mesh) {
  const auto simple = [](const GlSubmesh& part) { return !part.transparent || !part.bothSides; };
  return mesh.transparentParts == 1 && std::all_of(mesh.parts.begin(), mesh.parts.end(), simple);
}

/// Where a processor rasterises with one sample a pixel, most triangles of distant things are in vain.
bool isSieved(const GlTable& gl, const RenderQuality& quality) {
  return quality.samples == 1 && quality.leavesOutUnseen && isSoftware(gl);
}

/// New storage each time, so that no frame waits for one that still reads the old.
template <class T>
void stream(const GlTable& gl, GLenum target, const GlBuffer& buffer, std::span<const T> data) {
  gl.BindBuffer(target, buffer.name());
  gl.BufferData(target, static_cast<GLsizeiptr>(data.size_bytes()), data.data(), GL_STREAM_DRAW);
}

}  // namespace

Result<std::unique_ptr<Renderer>> Renderer::create(const GlTable& gl, std::mutex& turns,
                                                   const MeshStore& meshes, std::uint32_t width,
                                                   std::uint32_t height, RenderQuality quality) {
  if (auto why = checkPictureSize(width, height)) return *why;
  std::unique_ptr<Renderer> renderer;
  std::optional<Diagnostic> why;
  {
    const std::lock_guard turn(turns);
    auto programs = buildPrograms(gl, quality.look);
    if (!programs) return programs.error();
    renderer.reset(new Renderer(gl, turns, meshes, width, height, quality, std::move(programs.value())));
    why = renderer->buffers_.check();
  }
  if (why) return *why;  // the renderer waits for a turn of its own to free what it has
  return renderer;
}

Renderer::Renderer(const GlTable& gl, std::mutex& turns, const MeshStore& meshes, std::uint32_t width,
                   std::uint32_t height, RenderQuality quality, Programs programs)
    : gl_(gl), turns_(turns), takesTurns_(isSoftware(gl)),
      basesInstances_(gl.DrawElementsInstancedBaseInstance && hasGlExtension(gl, "GL_ARB_base_instance")),
      width_(width), height_(height), quality_(quality), programs_(std::move(programs)),
      buffers_(gl, width, height, quality),
      cache_(gl, meshes, quality.look, isSieved(gl, quality) && basesInstances_), instances_(gl), scene_(gl),
      indices_(gl), views_{GlBuffer(gl), GlBuffer(gl)}, nothing_(gl) {
  if (isSieved(gl, quality) && basesInstances_) sieve_.emplace(width, height);
  setUnchangingState();
}

Renderer::~Renderer() {
  lastTurn_ = turn();
}

Renderer::MeshParts Renderer::partsOf(const GlMesh& mesh, std::uint32_t level) {
  const std::vector<GlSubmesh>& parts = mesh.partsAt(level);
  std::uint32_t triangles = 0;
  for (const GlSubmesh& part : parts) triangles += static_cast<std::uint32_t>(part.indexCount) / 3;
  return {&mesh, parts, triangles};
}

std::unique_lock<std::mutex> Renderer::turn() const {
  return takesTurns_ ? std::unique_lock(turns_) : std::unique_lock<std::mutex>();
}

Result<Renderer::Programs> Renderer::buildPrograms(const GlTable& gl, Look look) {
  Programs programs;
  SurfaceTraits common;
  common.look = look;
  auto surfaces = buildSurfaces(gl, common);
  if (!surfaces) return surfaces.error();
  programs.surface[0] = std::move(surfaces.value());
  auto sky = GlProgram::build(gl, skyVertexShader(), skyFragmentShader(look));
  if (!sky) return sky.error();
  programs.sky.push_back(std::move(sky.value()));
  return programs;
}

Result<std::vector<GlProgram>> Renderer::buildSurfaces(const GlTable& gl, const SurfaceTraits& common) {
  std::vector<GlProgram> programs;
  for (std::size_t i = 0; i < 8; ++i) {
    SurfaceTraits traits = common;
    traits.textured = (i & 1) != 0, traits.localLights = (i & 2) != 0, traits.blended = (i & 4) != 0;
    auto built = GlProgram::build(gl, surfaceVertexShader(traits), surfaceFragmentShader(traits));
    if (!built) return built.error();
    assert(surfaceIndex(traits) == i);
    programs.push_back(std::move(built.value()));
  }
  return programs;
}

void Renderer::chooseSurfaces(bool shadowed, bool hazy, std::size_t lights) {
  const bool counted = quality_.look == Look::Plain && lights <= kMostCounted;
  SurfaceTraits common;
  common.shadowed = shadowed, common.hazy = hazy, common.look = quality_.look;
  common.lights = counted ? static_cast<int>(lights) : -1;
  const auto which = static_cast<std::size_t>(common.lights + 1);
  std::vector<GlProgram>& set =
      programs_.surface[std::size_t{shadowed} | std::size_t{hazy} << 1 | which << 2];
  if (set.empty()) {
    auto built = buildSurfaces(gl_, common);
    if (built)
      set = std::move(built.value());
    else
      report(built.error().message);
  }
  surfaces_ = set.empty() ? &programs_.surface[0] : &set;
}

// A drawing that was given up may have left it otherwise.
void Renderer::settleState() {
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
  gl_.Disable(GL_BLEND);
  gl_.DepthMask(GL_TRUE);
}

void Renderer::setUnchangingState() {
  gl_.Enable(GL_MULTISAMPLE);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_LEQUAL);
  gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);  // pictures stay opaque
  gl_.ClearColor(0, 0, 0, 1);
  gl_.ActiveTexture(GL_TEXTURE0);
}

std::optional<Diagnostic> Renderer::draw(const DrawList& list, const std::function<bool()>& giveUp,
                                         FrameProbe* probe) {
  const struct Forget {  // also when it is given up
    Renderer& r;
    ~Forget() { r.giveUp_ = nullptr, r.probe_ = nullptr, r.cache_.tell(nullptr); }
  } forget{*this};
  giveUp_ = giveUp ? &giveUp : nullptr;
  probe_ = probe;
  cache_.tell(probe);
  drawEyes(list, 0, std::min<std::uint32_t>(list.eyeCount, 2));
  return collectProblems();
}

void Renderer::drawEyes(const DrawList& list, std::uint32_t first, std::uint32_t end) {
  GLsync drawn = nullptr;
  {
    const auto mine = [&] {
      const SpanScope span(probe_, Span::ForTurn, list.ticket.signature.frame, list.wall);
      return turn();
    }();
    beginSampling(list);
    submitEyes(list, first, end);
    drawn = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl_.Flush();
  }
  const SpanScope span(probe_, Span::Finish);
  while (gl_.ClientWaitSync(drawn, 0, kLongWait) == GL_TIMEOUT_EXPIRED) {
  }
  gl_.DeleteSync(drawn);
}

void Renderer::submitEyes(const DrawList& list, std::uint32_t first, std::uint32_t end) {
  {
    const SpanScope span(probe_, Span::Prepare);
    piece(Span::Prepare, [&] { prepare(list); });
  }
  if (list.shadows.light >= 0 && quality_.look == Look::Full) {
    const SpanScope span(probe_, Span::ShadowMaps);
    piece(Span::ShadowMaps, [&] { prepareShadows(list); });
  }
  prepareScene(list);
  for (std::uint32_t eye = first; eye < end; ++eye) {
    const SpanScope span(probe_, eye == 0 ? Span::LeftEye : Span::RightEye);
    if (sample_ == DrawSample::Whole)
      drawEyeAlone(list.eyes[eye], eye);
    else
      drawEye(list.eyes[eye], eye);
    if (probe_) tellCounts();
  }
}

/// Of the last eye.
void Renderer::tellCounts() const {
  probe_->counted(Count::Calls, counts_.calls);
  probe_->counted(Count::Instances, counts_.instances);
  probe_->counted(Count::Triangles, counts_.triangles);
  probe_->counted(Count::Pixels, std::uint64_t{width_} * height_);
}

// Sampling.

void Renderer::beginSampling(const DrawList& list) {
  sample_ = probe_ ? probe_->drawSample(list.ticket.signature.frame, list.wall) : DrawSample::None;
  if (!surfaces_) sample_ = DrawSample::None;  // nothing has been drawn yet: all is slower the first time
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

template <class Work>
void Renderer::piece(Span what, const Work& work) {
  if (sample_ == DrawSample::Some)
    sampler_->piece(what, work);
  else
    work();
}

void Renderer::drawEyeAlone(const DrawEye& eye, std::uint32_t index) {
  sampler_->beginEye(index, {});
  sampler_->piece(index == 0 ? Span::LeftEye : Span::RightEye, [&] { drawEye(eye, index); });
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

/// How much there is to draw, and of whom the most.
void Renderer::weigh() {
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

/// As drawBatches() will draw them, in one pass or in two.
std::span<const std::uint32_t> Renderer::piecesToSample(std::uint32_t eye) {
  pieces_.clear();
  forEachBatch([&](const InstanceBatch& batch, const MeshParts& mesh) {
    const InstanceBatch b = batch.seenBy(eye);
    for (std::uint32_t done = 0, count = 0; done < b.count; done += count) {
      count = togetherFrom(b, done, mesh);
      const auto owners = batches_.owners().subspan(b.first + done, count);
      if (probe_->wantsAlone(owners)) pieces_.push_back(b.first + done);
    }
  });
  return pieces_;
}

void Renderer::stopIfAsked() const {
  if (giveUp_ && (*giveUp_)()) throw RunStopped();
}

std::optional<Diagnostic> Renderer::draw(const DrawList& list, std::uint32_t eye) {
  assert(eye < list.eyes.size());
  drawEyes(list, eye, eye + 1);
  return collectProblems();
}

void Renderer::prepare(const DrawList& list) {
  settleState();
  cache_.freeUnused();
  batches_.build(list, probe_ != nullptr);
  if (batches_.refused() > 0) report("an object is left out: its matrix is not finite");
  if (list.lights.size() > DrawList::kMaxLights)
    report("more than " + std::to_string(DrawList::kMaxLights) + " lights: the rest are left out");
  stream(gl_, GL_ARRAY_BUFFER, instances_, batches_.matrices());
  localLights_ = std::any_of(list.lights.begin(), list.lights.end(), isLocal);
  if (probe_) weigh();
}

void Renderer::prepareScene(const DrawList& list) {
  shadowed_ = shadowed_ && list.shadows.light >= 0;
  const SceneBlock scene =
      fillScene(list.sky, list.lights, quality_.look, shadowed_ ? list.shadows.light : -1);
  skyIsFlat_ = quality_.look == Look::Plain && scene.zenith == scene.horizon && scene.zenith == scene.ground;
  if (skyIsFlat_) gl_.ClearColor(scene.zenith[0], scene.zenith[1], scene.zenith[2], 1);
  stream(gl_, GL_UNIFORM_BUFFER, scene_, std::span(&scene, 1));
  chooseSurfaces(shadowed_, list.sky.hazeDistance > 0, std::min(list.lights.size(), DrawList::kMaxLights));
}

void Renderer::prepareShadows(const DrawList& list) {
  shadowed_ = list.shadows.light >= 0 && !noShadows_;
  if (!shadowed_) return;
  if (!shadows_) {
    auto made = ShadowMaps::create(gl_);
    if (made)
      shadows_ = std::move(made.value());
    else
      report(made.error().message);
    noShadows_ = !made, shadowed_ = !noShadows_;
  }
  if (!shadowed_) return;
  shadows_->update(list.shadows, cache_, [this] { stopIfAsked(); });
  shadows_->bind();
}

void Renderer::drawEye(const DrawEye& eye, std::uint32_t index) {
  counts_ = {};
  usedProgram_ = 0;
  boundMaterial_ = {};
  ViewBlock view;
  if (!fillView(eye, view)) {
    report("an eye's matrices are not finite or have no inverse: its picture is not drawn");
    return;
  }
  stream(gl_, GL_UNIFORM_BUFFER, views_[index], std::span<const ViewBlock>(&view, 1));
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, kViewBinding, views_[index].name());
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, kSceneBinding, scene_.name());

  if (sieve_) sieve_->look(eye);
  if (sample_ == DrawSample::Some) sampler_->beginEye(index, piecesToSample(index));
  gl_.Disable(GL_FRAMEBUFFER_SRGB);  // the shaders encode
  // Alone, clearing is writing the whole picture to memory. In an eye drawn whole that is done once, with
  // what comes next: it is a part of what the sky takes alone.
  buffers_.begin(index);
  drawOpaque(index);
  drawBatches(batches_.transparent(), Pass::OpaqueParts, index);
  piece(Span::Sky, [&] { drawBackground(); });
  // Blending and averaging of samples act on linear light.
  if (quality_.look == Look::Full) gl_.Enable(GL_FRAMEBUFFER_SRGB);
  gl_.Enable(GL_BLEND);
  gl_.DepthMask(GL_FALSE);
  drawBatches(batches_.transparent(), Pass::Transparent, index);
  gl_.DepthMask(GL_TRUE);
  gl_.Disable(GL_BLEND);
  piece(Span::Resolve, [&] { buffers_.resolve(index); });
  if (sample_ == DrawSample::Some) sampler_->endEye();
  totals_[index].add(counts_);
}

/// What is near, all else after it: of that, what is hidden then can be left out.
void Renderer::drawOpaque(std::uint32_t eye) {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  const std::optional<float> near = nearQuarter(eye);
  drawnFrom_ = {0, near.value_or(kFar)};
  drawBatches(batches_.opaque(), Pass::Opaque, eye);
  if (!near) return;
  depths_.resize(std::size_t{width_} * height_);
  buffers_.readDepths(eye, depths_);
  sieve_->hideBehind(depths_);
  drawnFrom_ = {*near, kFar};
  drawBatches(batches_.opaque(), Pass::Opaque, eye);
}

/// How far the nearest quarter of what the eye sees reaches [m]; nothing if it does not pay to look what that
/// hides, or if all must be drawn by meshes that are not sieved.
std::optional<float> Renderer::nearQuarter(std::uint32_t eye) {
  constexpr std::uint64_t kPixels = 16;  // of which to read the depths costs as much as a triangle
  if (!sieve_ || sample_ == DrawSample::Some) return {};
  distances_.clear();
  std::uint64_t triangles = 0;
  for (const InstanceBatch& batch : batches_.opaque()) {
    const InstanceBatch b = batch.seenBy(eye);
    const GlMesh* mesh = cache_.find(b.mesh);
    if (!mesh || !mesh->sieve) continue;
    const auto of = batches_.distances().subspan(b.first, b.count);
    distances_.insert(distances_.end(), of.begin(), of.end());
    triangles += std::uint64_t{b.count} * partsOf(*mesh, b.level).triangles;
  }
  if (distances_.size() < 16 || triangles * kPixels < std::uint64_t{width_} * height_) return {};
  const auto quarter = distances_.begin() + static_cast<std::ptrdiff_t>(distances_.size() / 4);
  std::nth_element(distances_.begin(), quarter, distances_.end());
  return *quarter;
}

void Renderer::drawBatches(std::span<const InstanceBatch> batches, Pass pass, std::uint32_t eye) {
  for (const InstanceBatch& ofBoth : batches) {
    const InstanceBatch batch = ofBoth.seenBy(eye);
    const GlMesh* mesh = batch.count > 0 ? cache_.find(batch.mesh) : nullptr;
    if (!mesh) continue;
    if (pass == Pass::Transparent && mesh->transparentParts == 0) continue;
    if (pass == Pass::OpaqueParts && mesh->transparentParts == mesh->parts.size()) continue;
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
}

void Renderer::drawInstances(const MeshParts& mesh, std::uint32_t first, std::uint32_t count, Pass pass) {
  const bool oneByOne = pass == Pass::Transparent && !drawnTogether(*mesh.gl);
  const std::uint32_t step = oneByOne ? 1 : count;
  const auto draw = [&] {
    if (pass == Pass::Opaque && mesh.gl->sieve) return drawSieved(mesh, first, count);
    for (std::uint32_t i = first; i < first + count; i += step) {
      stopIfAsked();
      if (!basesInstances_) pointAtInstances(gl_, instances_, i);
      if (pass == Pass::Transparent)
        drawTransparentParts(mesh, i, step);
      else
        drawOpaqueParts(mesh, i, step, pass);
    }
  };
  if (sample_ == DrawSample::Some)
    sampler_->nodes(
        first, [&] { return sharesOf(mesh, first, count); }, draw);
  else
    draw();
}

/// Who has which part in drawing these.
std::span<const NodeShare> Renderer::sharesOf(const MeshParts& mesh, std::uint32_t first,
                                              std::uint32_t count) {
  shares_.clear();
  float sum = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    shares_.push_back({batches_.owners()[i], workOf(i, mesh)});
    sum += shares_.back().part;
  }
  for (NodeShare& share : shares_) share.part = sum > 0 ? share.part / sum : 1.0f / static_cast<float>(count);
  return shares_;
}

/// Each instance with the triangles that this eye may see of it.
void Renderer::drawSieved(const MeshParts& mesh, std::uint32_t first, std::uint32_t count) {
  using Facing = TriangleSieve::Facing;
  stopIfAsked();
  sieve_->clear();
  sieved_.assign(count * mesh.parts.size(), {});
  for (std::uint32_t i = 0; i < count; ++i) {
    const float distance = batches_.distances()[first + i];
    if (distance < drawnFrom_[0] || distance >= drawnFrom_[1]) continue;
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

void Renderer::drawPart(const GlMesh& mesh, const GlSubmesh& part, std::uint32_t first,
                        std::uint32_t instances, bool blended) {
  beginPart(mesh, part, blended);
  drawIndices(part.indexOffset, part.indexCount, first, instances);
}

void Renderer::beginPart(const GlMesh& mesh, const GlSubmesh& part, bool blended) {
  use((
      *surfaces_)[surfaceIndex({part.texture != 0, localLights_, false, false, blended, quality_.look, -1})]);
  if (part.texture) gl_.BindTexture(GL_TEXTURE_2D, part.texture);
  bindMaterial(mesh.materials.name(), part.materialOffset);
}

/// `from`: in the bound index buffer [bytes].
void Renderer::drawIndices(std::uintptr_t from, GLsizei count, std::uint32_t first, std::uint32_t instances) {
  const auto times = static_cast<GLsizei>(instances);
  if (basesInstances_)
    gl_.DrawElementsInstancedBaseInstance(GL_TRIANGLES, count, GL_UNSIGNED_INT, offset(from), times, first);
  else
    gl_.DrawElementsInstanced(GL_TRIANGLES, count, GL_UNSIGNED_INT, offset(from), times);
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

void Renderer::drawBackground() {
  if (!skyIsFlat_) drawSky();
}

void Renderer::drawSky() {
  use(programs_.sky.front());
  gl_.BindVertexArray(nothing_.name());
  gl_.FrontFace(GL_CCW);
  cull(false, false);
  gl_.DrawArrays(GL_TRIANGLES, 0, 3);
  ++counts_.calls;
}

void Renderer::cull(bool front, bool back) {
  if (!front && !back) {
    gl_.Disable(GL_CULL_FACE);
    return;
  }
  gl_.Enable(GL_CULL_FACE);
  gl_.CullFace(front ? GL_FRONT : GL_BACK);
}

void Renderer::use(const GlProgram& program) {
  if (usedProgram_ == program.name()) return;
  usedProgram_ = program.name();
  gl_.UseProgram(usedProgram_);
}

std::optional<Diagnostic> Renderer::read(std::uint32_t eye, std::span<std::uint8_t> rgba) {
  assert(eye < 2 && rgba.size() == std::size_t{width_} * height_ * 4);
  {
    const auto mine = turn();
    buffers_.read(eye, rgba);
  }
  return collectProblems();
}

void Renderer::report(std::string what) {
  if (reported_.insert(what).second && !problem_) problem_ = problem(std::move(what));
}

std::optional<Diagnostic> Renderer::collectProblems() {
  if (auto why = cache_.takeProblem()) report(why->message);
  for (int i = 0; i < kMostErrorsRead; ++i) {
    const GLenum error = gl_.GetError();
    if (error == GL_NO_ERROR) break;
    report(std::string("OpenGL says ") + glErrorName(error));
  }
  return std::exchange(problem_, std::nullopt);
}

}  // namespace stadion
