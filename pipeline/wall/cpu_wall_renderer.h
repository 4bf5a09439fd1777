#pragma once
/// Draws the walls in this process without OpenGL (cpu_draw/cpu_renderer.h). Walls share meshes, shadow maps
/// and the threads of a pool.
///
/// Threads  see WallRenderer.

#include "pipeline/cpu_draw/cpu_renderer.h"
#include "pipeline/wall/wall_renderer.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace stadion {

struct CpuWallRendererParts {
  const MeshStore& meshes;
  DrawPool& pool;
  std::vector<WallPicture> walls;
  PictureRung rung{};
  std::function<bool()> giveUp{};  ///< see Renderer::draw
  FrameProbe* probe = nullptr;
};

class CpuWallRenderer final : public WallRenderer {
public:
  explicit CpuWallRenderer(CpuWallRendererParts parts);

  Failure open(std::size_t wall) override;
  Failure warmUp(std::size_t wall, const DrawList& list) override;
  DrawOutcome draw(std::size_t wall, const DrawList& list, bool read) override;
  Failure read(std::size_t wall, std::uint32_t view, std::span<std::uint8_t> rgba) override;
  void close(std::size_t wall) override;
  ViewTotals totals(std::size_t wall) const override;
  std::string drawnBy(std::size_t wall) const override;

private:
  CpuWallRendererParts parts_;
  CpuRoom room_;
  std::vector<std::unique_ptr<CpuRenderer>> renderers_;  ///< by wall
};

}  // namespace stadion
