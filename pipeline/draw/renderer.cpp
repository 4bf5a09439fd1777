#include "pipeline/draw/renderer.h"

#include "engine/base/run_stopped.h"
#include "pipeline/draw_list/list_filling.h"
#include "pipeline/gl/picture_size.h"
#include "pipeline/gl/problem.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>

namespace stadion {
namespace {

constexpr GLuint64 kLongWait = 1'000'000'000;  // [ns]
constexpr int kMostErrorsRead = 16;            // a lost context may report errors for ever

bool isLocal(const DrawLight& light) {
  return light.kind != DrawLight::Kind::Directional;
}

/// Where a processor rasterises with one sample a pixel, most triangles of distant things are in vain.
bool isSieved(const GlTable& gl, const RenderQuality& quality) {
  return quality.samples == 1 && quality.leavesOutUnseen && isSoftware(gl);
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
      clipDepth_(settleClipDepth(gl)), layersGlass_(GlassLayers::isSupported(gl)), width_(width),
      height_(height), quality_(quality), programs_(std::move(programs)),
      buffers_(gl, width, height, quality),
      cache_(gl, meshes, quality.look, isSieved(gl, quality) && basesInstances_), instances_(gl), scene_(gl),
      indices_(gl), nothing_(gl), covered_(width, height) {
  views_.emplace_back(gl);
  if (isSieved(gl, quality) && basesInstances_) sieve_.emplace(width, height);
  if (sieve_ && quality.look == Look::Plain && quality.drawsSmallThings) small_.emplace(width, height);
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
  if (auto why = buildSurfaces(gl, common, programs.surface[0])) return *why;
  auto sky = GlProgram::build(gl, skyVertexShader(), skyFragmentShader(look), shaderBindings());
  if (!sky) return sky.error();
  programs.sky.push_back(std::move(sky.value()));
  return programs;
}

/// All of the usual ones, or none.
std::optional<Diagnostic> Renderer::buildSurfaces(const GlTable& gl, const SurfaceTraits& common,
                                                  Surfaces& set) {
  set.common = common;
  for (std::size_t i = SurfaceTraits::kUsual; i-- > 0;) {  // the first one last: it says that all are there
    SurfaceTraits traits = common;
    traits.textured = (i & 1) != 0, traits.localLights = (i & 2) != 0;
    traits.writes = (i & 4) != 0 ? SurfaceWrites::Blended : SurfaceWrites::Picture;
    assert(traits.index() == i);
    auto built =
        GlProgram::build(gl, surfaceVertexShader(traits), surfaceFragmentShader(traits), shaderBindings());
    if (!built) return built.error();
    set.programs[i].emplace(std::move(built.value()));
  }
  return {};
}

/// Where that cannot be built, the usual one next to it.
const GlProgram& Renderer::surfaceFor(SurfaceTraits traits) {
  const std::size_t i = traits.index();
  std::optional<GlProgram>& program = surfaces_->programs[i];
  if (!program && !surfaces_->failed[i]) {
    const SurfaceTraits& common = surfaces_->common;
    traits.look = common.look, traits.shadowed = common.shadowed, traits.hazy = common.hazy;
    traits.lights = common.lights;
    auto built =
        GlProgram::build(gl_, surfaceVertexShader(traits), surfaceFragmentShader(traits), shaderBindings());
    if (built) {
      program.emplace(std::move(built.value()));
    } else {
      surfaces_->failed[i] = true;
      report(built.error().message);
    }
    usedProgram_ = 0;
  }
  return program ? *program : *surfaces_->programs[i % SurfaceTraits::kUsual];
}

void Renderer::chooseSurfaces(bool shadowed, bool hazy, std::size_t lights) {
  const bool counted = quality_.look == Look::Plain && lights <= kMostCounted;
  SurfaceTraits common;
  common.shadowed = shadowed, common.hazy = hazy, common.look = quality_.look;
  common.lights = counted ? static_cast<int>(lights) : -1;
  const auto which = static_cast<std::size_t>(common.lights + 1);
  Surfaces& set = programs_.surface[std::size_t{shadowed} | std::size_t{hazy} << 1 | which << 2];
  if (set.empty())
    if (const auto why = buildSurfaces(gl_, common, set)) report(why->message);
  surfaces_ = set.empty() ? &programs_.surface[0] : &set;
}

// A drawing that was given up may have left it otherwise.
void Renderer::settleState() {
  gl_.Disable(GL_SCISSOR_TEST);
  gl_.Disable(GL_POLYGON_OFFSET_FILL);
  gl_.Disable(GL_BLEND);
  gl_.DepthMask(GL_TRUE);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void Renderer::setUnchangingState() {
  gl_.Enable(GL_MULTISAMPLE);
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(GL_GEQUAL);  // depths are 1 at the near plane and 0 at the far one
  gl_.ClearDepth(0);
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
  drawViews(list, 0, std::min<std::uint32_t>(list.viewCount, DrawList::kMostViews));
  return collectProblems();
}

void Renderer::drawViews(const DrawList& list, std::uint32_t first, std::uint32_t end) {
  GLsync drawn = nullptr;
  {
    Turn mine = [&] {
      const SpanScope span(probe_, Span::ForTurn, list.ticket.signature.frame, list.wall);
      return turn();
    }();
    while (views_.size() < end) views_.emplace_back(gl_);
    if (const auto why = buffers_.growTo(end)) report(why->message);
    beginSampling(list);
    submitViews(list, first, end, mine);
    drawn = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl_.Flush();
  }
  const SpanScope span(probe_, Span::Finish);
  while (gl_.ClientWaitSync(drawn, 0, kLongWait) == GL_TIMEOUT_EXPIRED) {
  }
  gl_.DeleteSync(drawn);
}

void Renderer::submitViews(const DrawList& list, std::uint32_t first, std::uint32_t end, Turn& turn) {
  {
    const SpanScope span(probe_, Span::Prepare);
    if (sample_ == DrawSample::Some)
      sampler_->piece(Span::Prepare, [&] { prepare(list); });
    else
      prepare(list);
  }
  if (list.shadows.light >= 0 && quality_.look == Look::Full) {
    const SpanScope span(probe_, Span::ShadowMaps);
    if (sample_ == DrawSample::Some)
      sampler_->piece(Span::ShadowMaps, [&] { prepareShadows(list); });
    else
      prepareShadows(list);
  }
  prepareScene(list);
  for (std::uint32_t view = first; view < end; ++view) {
    const SpanScope span(probe_, spanOf(list.views[view]));
    if (sample_ == DrawSample::Whole)
      drawViewAlone(list.views[view], view, turn);
    else
      drawView(list.views[view], view, turn);
    if (probe_) tellCounts();
  }
  while (takeMore()) {
  }
  if (batches_.refused() > 0) report("an object is left out: its matrix is not finite");
  if (probe_ && sample_ == DrawSample::None) weigh();
}

/// Of the last view.
void Renderer::tellCounts() const {
  probe_->counted(Count::Calls, counts_.calls);
  probe_->counted(Count::Instances, counts_.instances);
  probe_->counted(Count::Triangles, counts_.triangles);
  probe_->counted(Count::Pixels, std::uint64_t{width_} * height_);
}

void Renderer::stopIfAsked() const {
  if (giveUp_ && (*giveUp_)()) throw RunStopped();
}

std::optional<Diagnostic> Renderer::draw(const DrawList& list, std::uint32_t view) {
  assert(view < list.views.size());
  drawViews(list, view, view + 1);
  return collectProblems();
}

void Renderer::prepare(const DrawList& list) {
  settleState();
  cache_.freeUnused();
  list_ = &list, complete_ = false, uploaded_ = 0;
  batches_.begin(probe_ != nullptr);
  if (list.lights.size() > DrawList::kMaxLights)
    report("more than " + std::to_string(DrawList::kMaxLights) + " lights: the rest are left out");
  localLights_ = std::any_of(list.lights.begin(), list.lights.end(), isLocal);
  takeMore();
  if (sample_ == DrawSample::None) return;
  while (takeMore()) {
  }
  weigh();
}

/// Takes up what there is of the list beyond what was taken, and waits until there is something; false: that
/// was all.
bool Renderer::takeMore() {
  if (complete_) return false;
  std::size_t there = ListFilling::kAll;
  if (list_->filling) {
    const SpanScope span(probe_, Span::ForDraw, list_->ticket.signature.frame, list_->wall);
    there = list_->filling->await(batches_.taken());
  }
  complete_ = there == ListFilling::kAll;
  if (complete_ && list_->filling && list_->filling->isVoid()) return false;  // it will not be shown
  batches_.addOpaque(list_->opaque, std::min(there, list_->opaque.size()));
  if (complete_ && layersGlass_) batches_.addTransparent(list_->transparent);
  if (complete_ && !layersGlass_) {
    sorted_ = list_->transparent;
    std::ranges::stable_sort(sorted_, std::greater<>{}, &DrawItem::distance);
    batches_.addTransparent(sorted_);
  }
  return true;
}

/// Whether there is such a batch, once the list is filled.
bool Renderer::hasOpaque(std::size_t batch) {
  while (batch >= batches_.opaque().size())
    if (!takeMore()) return false;
  return true;
}

void Renderer::uploadInstances() {
  const std::span<const InstanceMatrix> all = batches_.matrices();
  if (uploaded_ == all.size()) return;
  if (complete_ && uploaded_ == 0) {
    stream(gl_, GL_ARRAY_BUFFER, instances_, all);
  } else {
    const auto bytes = [](std::size_t instances) {
      return static_cast<GLsizeiptr>(instances * sizeof(InstanceMatrix));
    };
    gl_.BindBuffer(GL_ARRAY_BUFFER, instances_.name());
    const std::size_t most = list_->opaque.size() + list_->transparent.size();
    if (uploaded_ == 0) gl_.BufferData(GL_ARRAY_BUFFER, bytes(most), nullptr, GL_STREAM_DRAW);
    gl_.BufferSubData(GL_ARRAY_BUFFER, bytes(uploaded_), bytes(all.size() - uploaded_),
                      all.data() + uploaded_);
  }
  uploaded_ = all.size();
}

void Renderer::prepareScene(const DrawList& list) {
  shadowed_ = shadowed_ && list.shadows.light >= 0;
  lit_ = fillScene(list.sky, list.lights, quality_.look, shadowed_ ? list.shadows.light : -1);
  skyIsFlat_ = quality_.look == Look::Plain && lit_.zenith == lit_.horizon && lit_.zenith == lit_.ground;
  if (skyIsFlat_) gl_.ClearColor(lit_.zenith[0], lit_.zenith[1], lit_.zenith[2], 1);
  stream(gl_, GL_UNIFORM_BUFFER, scene_, std::span<const SceneBlock>(&lit_, 1));
  chooseSurfaces(shadowed_, list.sky.hazeDistance > 0, std::min(list.lights.size(), DrawList::kMaxLights));
}

void Renderer::prepareShadows(const DrawList& list) {
  shadowed_ = list.shadows.light >= 0 && !noShadows_;
  if (!shadowed_) return;
  if (!shadows_) {
    auto made = ShadowMaps::create(gl_, clipDepth_);
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

void Renderer::drawView(const DrawView& from, std::uint32_t index, Turn& turn) {
  counts_ = {};
  usedProgram_ = 0;
  boundMaterial_ = {};
  ViewBlock view;
  if (!fillView(from, clipDepth_, view)) {
    report("a view's matrices are not finite or have no inverse: its picture is not drawn");
    return;
  }
  if (sample_ == DrawSample::Some) findPieces(index), sampler_->beginEye(from.eye, pieces_, wanted_);
  const bool begun = drawSmallThings(from, index, turn);
  stream(gl_, GL_UNIFORM_BUFFER, views_[index], std::span<const ViewBlock>(&view, 1));
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, kViewBinding, views_[index].name());
  gl_.BindBufferBase(GL_UNIFORM_BUFFER, kSceneBinding, scene_.name());

  if (sieve_) sieve_->look(from);
  gl_.Disable(GL_FRAMEBUFFER_SRGB);  // the shaders encode
  // Alone, clearing is writing the whole picture to memory. In a view drawn whole that is done once, with
  // what comes next: it is a part of what the sky takes alone.
  if (begun)
    part(Span::Sky, [&] { buffers_.begin(index, small_->colours(), small_->depths()); });
  else
    buffers_.begin(index);
  drawOpaque(index);
  drawTransparentBatches(Pass::OpaqueParts, index);
  part(Span::Sky, [&] { drawBackground(); });
  // Blending and averaging of samples act on linear light.
  if (quality_.look == Look::Full) gl_.Enable(GL_FRAMEBUFFER_SRGB);
  drawTransparent(view, index);
  part(Span::Resolve, [&] { buffers_.resolve(index); });
  if (sample_ == DrawSample::Some)
    sampler_->endEye([&](std::uint32_t first, std::uint32_t end) { return sharesOf(index, first, end); });
  totals_[index].add(counts_);
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

std::optional<Diagnostic> Renderer::read(std::uint32_t view, std::span<std::uint8_t> rgba) {
  assert(view < views_.size() && rgba.size() == std::size_t{width_} * height_ * 4);
  {
    const auto mine = turn();
    buffers_.read(view, rgba);
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
    contextIsLost_ = contextIsLost_ || error == GL_CONTEXT_LOST;
    report(std::string("OpenGL says ") + glErrorName(error));
  }
  return std::exchange(problem_, std::nullopt);
}

}  // namespace stadion
