#pragma once
/// The interface of what draws the walls' lists. There are four renderers: in this process with OpenGL
/// (gl_wall_renderer.h) or without (cpu_wall_renderer.h), in one process for each wall
/// (process/per_wall_process_renderer.h), and in one process for each view
/// (process/per_view_process_renderer.h). The three with OpenGL draw the same pixels.
///
/// Threads  a wall's functions on its Draw thread, several walls at a time; destroyed when all walls are
///          closed.

#include "pipeline/draw_list/draw_counts.h"
#include "pipeline/wall/stages.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace stadion {

/// How a wall's list was drawn.
struct DrawOutcome {
  Failure failure{};
  /// False: not in time, or the list is void; the wall shows the last picture it has. Nothing else is wrong.
  bool drawn = true;
};

/// The size of the pictures of a wall's views [pixels], and the graphics card that draws them.
struct WallPicture {
  std::uint32_t width = 0, height = 0;
  std::optional<std::uint32_t> card{};  ///< with OpenGL (GlProvider::createOn); none: the provider's choice

  bool operator==(const WallPicture&) const = default;
};

class WallRenderer {
public:
  virtual ~WallRenderer() = default;

  virtual Failure open(std::size_t wall) = 0;
  /// Draws the list, which is complete, so that shaders are compiled and meshes uploaded; it is not counted.
  /// Waits as long as that takes. May throw RunStopped.
  virtual Failure warmUp(std::size_t wall, const DrawList& list) = 0;
  /// Draws all views of the list, which may still be filled, and waits until that is done. `read`: read()
  /// will be called for all of them, and the list is not there any more then. May throw RunStopped.
  virtual DrawOutcome draw(std::size_t wall, const DrawList& list, bool read) = 0;
  /// The view's picture of the list that was drawn last (see Renderer::read).
  virtual Failure read(std::size_t wall, std::uint32_t view, std::span<std::uint8_t> rgba) = 0;
  virtual void close(std::size_t wall) = 0;

  /// Returns totals of what the wall has drawn so far. Call it after draw().
  virtual ViewTotals totals(std::size_t wall) const = 0;
  /// Describes what draws the wall: the version of OpenGL, or the kernels of the CPU renderer. After open().
  virtual std::string drawnBy(std::size_t wall) const = 0;
};

}  // namespace stadion
