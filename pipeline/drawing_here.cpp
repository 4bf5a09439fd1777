#include "pipeline/drawing_here.h"

#include "pipeline/draw/list_filling.h"

namespace stadion {
namespace {

Failure toFailure(const std::optional<Diagnostic>& d) {
  return d ? Failure(Reason(*d)) : std::nullopt;
}

}  // namespace

DrawingHere::DrawingHere(DrawingHereParts parts)
    : parts_(std::move(parts)), contexts_(parts_.contexts ? *parts_.contexts : ownContexts_) {
  contexts_.resize(parts_.walls.size());
}

Failure DrawingHere::open(std::size_t wall) {
  const PictureSize size = parts_.walls[wall];
  if (Failure f =
          contexts_.open(wall, parts_.provider, parts_.meshes, size.width, size.height, parts_.quality))
    return f;
  contexts_.renderer(wall).forgetTotals();
  // Not before: with the first context the rasteriser starts threads, which are bound as this one is.
  if (wall < parts_.processors.size()) parts_.processors[wall].bindThisThread();
  return {};
}

DrawOutcome DrawingHere::draw(std::size_t wall, const DrawList& list, bool) {
  if (Failure f = contexts_.enter(wall)) return {std::move(f)};
  const auto problem = contexts_.renderer(wall).draw(list, parts_.giveUp, parts_.probe);
  if (list.filling && list.filling->isVoid()) return {{}, false};
  return {toFailure(problem)};
}

Failure DrawingHere::read(std::size_t wall, std::uint32_t eye, std::span<std::uint8_t> rgba) {
  if (Failure f = contexts_.enter(wall)) return f;
  return toFailure(contexts_.renderer(wall).read(eye, rgba));
}

void DrawingHere::close(std::size_t wall) {
  if (contexts_.hasContext(wall)) contexts_.enter(wall);  // another wall may be current on this thread
  if (parts_.contexts)
    contexts_.leave(wall);
  else
    contexts_.close(wall);
}

std::array<DrawTotals, 2> DrawingHere::totals(std::size_t wall) const {
  return contexts_.renderer(wall).totals();
}

std::string DrawingHere::glDescription(std::size_t wall) const {
  return describeGl(contexts_.gl(wall));
}

}  // namespace stadion
