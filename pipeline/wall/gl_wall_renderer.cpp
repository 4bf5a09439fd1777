#include "pipeline/wall/gl_wall_renderer.h"

#include "pipeline/draw_list/list_filling.h"

namespace stadion {
namespace {

constexpr int kMostContexts = 4;  ///< for one frame

Failure toFailure(const std::optional<Diagnostic>& d) {
  return d ? Failure(Reason(*d)) : std::nullopt;
}

}  // namespace

GlWallRenderer::GlWallRenderer(GlWallRendererParts parts)
    : parts_(std::move(parts)), contexts_(parts_.contexts ? *parts_.contexts : ownContexts_) {
  contexts_.resize(parts_.walls.size());
}

Failure GlWallRenderer::open(std::size_t wall) {
  if (Failure f = contexts_.open(wall, parts_.provider, parts_.meshes, parts_.walls[wall], parts_.quality))
    return f;
  contexts_.renderer(wall).forgetTotals();
  // Not before: with the first context the rasteriser starts threads, which are bound as this one is.
  if (wall < parts_.processors.size()) parts_.processors[wall].bindThisThread();
  return kNoFailure;
}

Failure GlWallRenderer::warmUp(std::size_t wall, const DrawList& list) {
  return drawWith(wall, list, [&](Renderer& r) { return r.warmUp(list, parts_.giveUp); }).failure;
}

DrawOutcome GlWallRenderer::draw(std::size_t wall, const DrawList& list, bool) {
  return drawWith(wall, list, [&](Renderer& r) { return r.draw(list, parts_.giveUp, parts_.probe); });
}

/// Makes another context, if the wall's was lost, and draws with it.
DrawOutcome GlWallRenderer::drawWith(std::size_t wall, const DrawList& list, const Draw& draw) {
  const auto about = [&](const std::string& what) {
    return "wall " + nameOf(wall) + ", frame " + std::to_string(list.ticket.signature.frame) + ": " + what;
  };
  for (int contexts = 1; contexts <= kMostContexts; ++contexts) {
    if (auto drawn = drawOnce(wall, draw)) {
      if (list.filling && list.filling->isVoid()) return {{}, false};
      return {std::move(*drawn)};
    }
    if (parts_.tell) parts_.tell(about("its OpenGL context was lost; a new one is created"));
    contexts_.close(wall);
    if (Failure f = open(wall))
      return {Reason(about("its OpenGL context was lost, and there is no other: " + f->message))};
  }
  return {Reason(about("its OpenGL context was lost again and again"))};
}

/// Returns the outcome, or nothing if the context is lost.
std::optional<Failure> GlWallRenderer::drawOnce(std::size_t wall, const Draw& draw) {
  if (contexts_.enter(wall)) return {};
  Renderer& renderer = contexts_.renderer(wall);
  const auto problem = draw(renderer);
  if (renderer.isLost()) return {};
  return toFailure(problem);
}

std::string GlWallRenderer::nameOf(std::size_t wall) const {
  return wall < parts_.names.size() ? parts_.names[wall] : std::to_string(wall + 1);
}

Failure GlWallRenderer::read(std::size_t wall, std::uint32_t view, std::span<std::uint8_t> rgba) {
  if (Failure f = contexts_.enter(wall)) return f;
  return toFailure(contexts_.renderer(wall).read(view, rgba));
}

void GlWallRenderer::close(std::size_t wall) {
  if (contexts_.hasContext(wall)) contexts_.enter(wall);  // another wall may be current on this thread
  if (parts_.contexts)
    contexts_.leave(wall);
  else
    contexts_.close(wall);
}

ViewTotals GlWallRenderer::totals(std::size_t wall) const {
  return contexts_.renderer(wall).totals();
}

std::string GlWallRenderer::drawnBy(std::size_t wall) const {
  return std::as_const(contexts_).renderer(wall).description();
}

}  // namespace stadion
