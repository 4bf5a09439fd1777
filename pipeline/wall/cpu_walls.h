#pragma once
/// Draws the walls in this process without OpenGL (cpu_draw/cpu_renderer.h). Walls share meshes, shadow maps
/// and the threads of a pool.
///
/// Threads  as of a WallDrawing.

#include "pipeline/cpu_draw/cpu_renderer.h"
#include "pipeline/wall/drawing_here.h"
#include "pipeline/wall/wall_drawing.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace stadion {

struct CpuWallsParts {
  const MeshStore& meshes;
  DrawPool& pool;
  std::vector<PictureSize> walls;
  PictureRung rung{};
  std::function<bool()> giveUp{};  ///< see Renderer::draw
  FrameProbe* probe = nullptr;
};

class CpuWalls final : public WallDrawing {
public:
  explicit CpuWalls(CpuWallsParts parts);

  Failure open(std::size_t wall) override;
  Failure warmUp(std::size_t wall, const DrawList& list) override;
  DrawOutcome draw(std::size_t wall, const DrawList& list, bool read) override;
  Failure read(std::size_t wall, std::uint32_t view, std::span<std::uint8_t> rgba) override;
  void close(std::size_t wall) override;
  ViewTotals totals(std::size_t wall) const override;
  std::string glDescription(std::size_t wall) const override;

private:
  CpuWallsParts parts_;
  CpuRoom room_;
  std::vector<std::unique_ptr<CpuRenderer>> renderers_;  ///< by wall
};

}  // namespace stadion
