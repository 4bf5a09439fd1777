#include "pipeline/wall/cpu_wall_renderer.h"

#include "pipeline/draw_list/list_filling.h"

#include <utility>

namespace stadion {
namespace {

Failure failureOf(const std::optional<Diagnostic>& d) {
  return d ? Failure(Reason(*d)) : std::nullopt;
}

}  // namespace

CpuWallRenderer::CpuWallRenderer(CpuWallRendererParts parts)
    : parts_(std::move(parts)), room_(parts_.meshes, parts_.rung.look, parts_.pool),
      renderers_(parts_.walls.size()) {}

Failure CpuWallRenderer::open(std::size_t wall) {
  const WallPicture size = parts_.walls[wall];
  auto made = CpuRenderer::create(room_, size.width, size.height, parts_.rung);
  if (!made) return Reason(made.error());
  renderers_[wall] = std::move(made.value());
  return kNoFailure;
}

Failure CpuWallRenderer::warmUp(std::size_t wall, const DrawList& list) {
  return failureOf(renderers_[wall]->warmUp(list, parts_.giveUp));
}

DrawOutcome CpuWallRenderer::draw(std::size_t wall, const DrawList& list, bool) {
  const auto problem = renderers_[wall]->draw(list, parts_.giveUp, parts_.probe);
  if (list.filling && list.filling->isVoid()) return {{}, false};
  return {failureOf(problem)};
}

Failure CpuWallRenderer::read(std::size_t wall, std::uint32_t view, std::span<std::uint8_t> rgba) {
  return failureOf(renderers_[wall]->read(view, rgba));
}

void CpuWallRenderer::close(std::size_t wall) {
  renderers_[wall].reset();
}

ViewTotals CpuWallRenderer::totals(std::size_t wall) const {
  return renderers_[wall]->totals();
}

std::string CpuWallRenderer::drawnBy(std::size_t wall) const {
  return renderers_[wall]->description();
}

}  // namespace stadion
