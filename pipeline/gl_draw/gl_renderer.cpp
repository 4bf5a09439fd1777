#include "pipeline/gl_draw/gl_renderer.h"

#include "pipeline/gl/picture_size.h"
#include "pipeline/target/target.h"

#include <algorithm>
#include <cassert>

namespace stadion {
namespace {

constexpr GLuint64 kLongWait = 1'000'000'000;  // [ns]
constexpr int kMostErrorsRead = 16;            // a lost context may report errors for ever

}  // namespace

Result<std::unique_ptr<GlRenderer>> GlRenderer::create(const GlTable& gl, std::mutex& turns,
                                                       const MeshStore& meshes, std::uint32_t width,
                                                       std::uint32_t height, RenderQuality quality) {
  if (auto why = checkPictureSize(width, height)) return *why;
  std::unique_ptr<GlRenderer> renderer;
  std::optional<Diagnostic> why;
  {
    const std::lock_guard turn(turns);
    renderer.reset(new GlRenderer(gl, turns, meshes, width, height, quality));
    why = renderer->build();
  }
  if (why) return *why;  // the renderer waits for a turn of its own to free what it has
  return renderer;
}

GlRenderer::GlRenderer(const GlTable& gl, std::mutex& turns, const MeshStore& meshes, std::uint32_t width,
                       std::uint32_t height, RenderQuality quality)
    : gl_(gl), turns_(turns), takesTurns_(isSoftware(gl)), look_(quality.look), clipDepth_(setClipDepth(gl)),
      scene_(gl, meshes, quality, !GlassLayers::isSupported(gl), problems_),
      buffers_(gl, width, height, quality),
      pieces_(gl, scene_, quality.mostAtOnce), context_{gl, scene_, buffers_, pieces_, stop_, width, height},
      surfaces_(context_), shadows_(context_, clipDepth_, problems_), small_(context_, quality),
      opaque_(context_, surfaces_), transparent_(context_, surfaces_, quality.mostFragments, problems_) {}

/// Builds what every list needs. Returns why that failed, or nothing.
std::optional<Diagnostic> GlRenderer::build() {
  if (auto why = scene_.surfaces().build()) return why;
  auto sky = SkyPass::create(gl_, scene_, look_, problems_);
  if (!sky) return sky.error();
  sky_ = std::move(sky.value());
  return buffers_.check();
}

GlRenderer::~GlRenderer() {
  lastTurn_ = turn();
}

GlRenderer::Turn GlRenderer::turn() const {
  return takesTurns_ ? Turn(turns_) : Turn();
}

std::optional<Diagnostic> GlRenderer::draw(const DrawList& list, const std::function<bool()>& giveUp,
                                           FrameProbe* probe) {
  drawViews({list, 0, std::min<std::uint32_t>(list.viewCount, DrawList::kMostViews)}, giveUp, probe);
  return collectProblems();
}

std::optional<Diagnostic> GlRenderer::draw(const DrawList& list, std::uint32_t view) {
  assert(view < list.views.size());
  drawViews({list, view, view + 1}, {}, nullptr);
  return collectProblems();
}

void GlRenderer::drawViews(const Views& of, const std::function<bool()>& giveUp, FrameProbe* probe) {
  GLsync drawn = nullptr;
  stop_.ask(giveUp);
  {
    Turn mine = [&] {
      const SpanScope span(probe, Span::ForTurn, of.list.ticket.signature.frame, of.list.wall);
      return turn();
    }();
    scene_.growTo(of.end);
    if (const auto why = buffers_.growTo(of.end)) problems_.report(why->message);
    pieces_.beginFrame(of.list, probe, [this] { drawNothing(); });
    submit(of, probe, mine);
    drawn = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl_.Flush();
  }
  const SpanScope span(probe, Span::Finish);
  while (gl_.ClientWaitSync(drawn, 0, kLongWait) == GL_TIMEOUT_EXPIRED) {
  }
  gl_.DeleteSync(drawn);
}

/// Gives OpenGL everything to draw.
void GlRenderer::submit(const Views& of, FrameProbe* probe, Turn& turn) {
  begin(of.list, probe);
  scene_.light(of.list, drawShadows(of.list, probe));
  for (std::uint32_t view = of.first; view < of.end; ++view) {
    const DrawView& from = of.list.views[view];
    const SpanScope span(probe, DrawPieces::spanOf(from));
    pieces_.view(from, [&] { drawView(from, view, probe, turn); });
    if (probe) reportCounts(*probe);
  }
  scene_.instances().takeAll();
  if (scene_.batches().refused() > 0) problems_.report("an object is left out: its matrix is not finite");
  pieces_.endList();
}

void GlRenderer::begin(const DrawList& list, FrameProbe* probe) {
  const SpanScope span(probe, Span::Prepare);
  pieces_.piece(Span::Prepare, [&] {
    scene_.begin(list, probe);
    pieces_.beginList();
  });
}

/// Returns whether the list's light casts shadows.
bool GlRenderer::drawShadows(const DrawList& list, FrameProbe* probe) {
  if (list.shadows.light < 0 || look_ != Look::Full) return false;
  const SpanScope span(probe, Span::ShadowMaps);
  bool drawn = false;
  pieces_.piece(Span::ShadowMaps, [&] { drawn = shadows_.draw(list.shadows); });
  return drawn;
}

void GlRenderer::drawView(const DrawView& from, std::uint32_t index, FrameProbe* probe, Turn& turn) {
  scene_.calls().beginView();
  ViewBlock view;
  if (!fillView(from, clipDepth_, view)) {
    problems_.report("a view's matrices are not finite or have no inverse: its picture is not drawn");
    return;
  }
  pieces_.beginView(from, index);
  const bool hasSmallObjects = small_.draw(from, index, turn, probe);
  scene_.setView(index, view);
  scene_.bindView(index);
  gl_.Disable(GL_FRAMEBUFFER_SRGB);  // the shaders encode
  beginPicture(index, hasSmallObjects);
  opaque_.draw(from, index, small_);
  transparent_.drawOpaqueParts(index);
  pieces_.part(Span::Sky, [&] {
    if (!scene_.skyIsFlat()) sky_->draw();
  });
  // Blending and averaging of samples act on linear light.
  if (look_ == Look::Full) gl_.Enable(GL_FRAMEBUFFER_SRGB);
  transparent_.draw(view, index);
  pieces_.part(Span::Resolve, [&] { buffers_.resolve(index); });
  pieces_.endView(index);
  totals_[index].add(counts());
}

/// Measured alone, clearing costs as much as writing the whole picture. In a real view it is done together with
/// the first pass. So its time counts as the sky's.
void GlRenderer::beginPicture(std::uint32_t view, bool withSmallObjects) {
  if (!withSmallObjects) return buffers_.begin(view);
  const SmallObjectRasterizer& picture = small_.picture();
  pieces_.part(Span::Sky, [&] { buffers_.begin(view, picture.colours(), picture.depths()); });
}

/// Draws a pixel that is not written.
void GlRenderer::drawNothing() {
  buffers_.bind(0);
  gl_.Enable(GL_SCISSOR_TEST);
  gl_.Scissor(0, 0, 1, 1);
  gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  gl_.DepthMask(GL_FALSE);
  scene_.bindView(0);
  sky_->draw();
  gl_.DepthMask(GL_TRUE);
  gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl_.Disable(GL_SCISSOR_TEST);
}

/// Reports the counts of the last view.
void GlRenderer::reportCounts(FrameProbe& probe) const {
  probe.counted(Count::Calls, counts().calls);
  probe.counted(Count::Instances, counts().instances);
  probe.counted(Count::Triangles, counts().triangles);
  probe.counted(Count::Pixels, context_.pixels());
}

std::optional<Diagnostic> GlRenderer::read(std::uint32_t view, std::span<std::uint8_t> rgba) {
  assert(view < scene_.views() && rgba.size() == context_.pixels() * 4);
  {
    const auto mine = turn();
    buffers_.read(view, rgba);
  }
  return collectProblems();
}

std::string GlRenderer::description() const {
  return describeGl(gl_);
}

std::optional<Diagnostic> GlRenderer::collectProblems() {
  if (auto why = scene_.meshes().takeProblem()) problems_.report(why->message);
  for (int i = 0; i < kMostErrorsRead; ++i) {
    const GLenum error = gl_.GetError();
    if (error == GL_NO_ERROR) break;
    contextIsLost_ = contextIsLost_ || error == GL_CONTEXT_LOST;
    problems_.report(std::string("OpenGL says ") + glErrorName(error));
  }
  return problems_.take();
}

}  // namespace stadion
