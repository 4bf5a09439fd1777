#pragma once
/// Draws the walls in this process with OpenGL, each wall on its own thread and in its own context. If a
/// context is lost (a graphics card was reset), the renderer reports it, creates a new context and draws the
/// frame again.

#include "engine/asset/mesh_store.h"
#include "pipeline/platform/processor_set.h"
#include "pipeline/wall/wall_contexts.h"
#include "pipeline/wall/wall_renderer.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace stadion {

struct GlWallRendererParts {
  GlProvider& provider;
  const MeshStore& meshes;
  std::vector<WallPicture> walls;
  RenderQuality quality{};
  /// Contexts to use, which must outlive this; null: the walls make their own.
  WallContexts* contexts = nullptr;
  std::function<bool()> giveUp{};  ///< see Renderer::draw
  FrameProbe* probe = nullptr;
  std::vector<ProcessorSet> processors{};  ///< by wall: those that its Draw thread may use; none: all of them
  std::vector<std::string> names{};        ///< names of the walls, for messages
  /// Receives reports about lost contexts; called on Draw threads.
  std::function<void(const std::string&)> tell{};
};

class GlWallRenderer final : public WallRenderer {
public:
  explicit GlWallRenderer(GlWallRendererParts parts);

  Failure open(std::size_t wall) override;
  Failure warmUp(std::size_t wall, const DrawList& list) override;
  DrawOutcome draw(std::size_t wall, const DrawList& list, bool read) override;
  Failure read(std::size_t wall, std::uint32_t view, std::span<std::uint8_t> rgba) override;
  void close(std::size_t wall) override;
  ViewTotals totals(std::size_t wall) const override;
  std::string drawnBy(std::size_t wall) const override;

private:
  using Draw = std::function<std::optional<Diagnostic>(Renderer&)>;

  DrawOutcome drawWith(std::size_t wall, const DrawList& list, const Draw& draw);
  std::optional<Failure> drawOnce(std::size_t wall, const Draw& draw);
  std::string nameOf(std::size_t wall) const;

  GlWallRendererParts parts_;
  WallContexts ownContexts_;
  WallContexts& contexts_;
};

}  // namespace stadion
