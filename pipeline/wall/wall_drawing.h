#pragma once
/// Draws the walls' lists: in this process (drawing_here.h), or in one process for each wall
/// (process/drawing_in_workers.h) or for each view (process/views_in_workers.h). The pixels are the same.
///
/// Threads  a wall's functions on its Draw thread, several walls at a time; destroyed when all walls are
/// closed.

#include "pipeline/draw_list/draw_counts.h"
#include "pipeline/wall/stages.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace stadion {

/// How a wall's list was drawn.
struct DrawOutcome {
  Failure failure{};
  /// False: not in time, or the list is void; the wall shows the last picture it has. Nothing else is wrong.
  bool drawn = true;
};

class WallDrawing {
public:
  virtual ~WallDrawing() = default;

  virtual Failure open(std::size_t wall) = 0;
  /// Draws the list, which is complete, so that shaders are compiled and meshes uploaded; it is not counted.
  /// Waits as long as that takes. May throw RunStopped.
  virtual Failure warmUp(std::size_t wall, const DrawList& list) = 0;
  /// Draws all views of the list, which may still be filled, and waits until that is done. `read`: read() will
  /// be called for all of them, and the list is not there any more then. May throw RunStopped.
  virtual DrawOutcome draw(std::size_t wall, const DrawList& list, bool read) = 0;
  /// The view's picture of the list that was drawn last (see Renderer::read).
  virtual Failure read(std::size_t wall, std::uint32_t view, std::span<std::uint8_t> rgba) = 0;
  virtual void close(std::size_t wall) = 0;

  /// What the wall was drawn with so far. After draw().
  virtual ViewTotals totals(std::size_t wall) const = 0;
  /// Of the OpenGL that draws the wall. After open().
  virtual std::string glDescription(std::size_t wall) const = 0;
};

}  // namespace stadion
