#pragma once
/// The content of a window: finished pictures in their places, with or without OpenGL.
///
/// A picture that is as large as its place and is not warped is copied pixel by pixel; others are filtered.
/// Both ways give the same pixels. Where they filter or compute colours, they differ by 1 of 255 at most.
///
/// Ownership  the window must outlive it. It refers to the pictures of the eyes, which must stay until others
///            are taken.
/// Threads    the thread of the window system.

#include "engine/base/diagnostic.h"
#include "engine/display/output.h"
#include "pipeline/picture/picture.h"
#include "pipeline/target/window.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace stadion {

/// How two eyes become one pane.
enum class EyeMix { Left, Right, Anaglyph, Interlaced };

/// One wall on the window.
struct CanvasPane {
  std::size_t wall = 0;
  std::int32_t x = 0, y = 0;            ///< upper left corner [pixels of the window]
  std::uint32_t width = 0, height = 0;  ///< [pixels]
  EyeMix mix = EyeMix::Left;
  OutputShape shape{};
  std::int32_t firstRow = 0;  ///< for Interlaced: the monitor's row that shows the top row of the window
};

/// The target of drawing: the window, or one of its buffers for each eye.
enum class CanvasBuffer { Whole, Left, Right };

class WindowCanvas {
public:
  /// With OpenGL or without, as the window is. For the pictures of so many walls.
  static Result<std::unique_ptr<WindowCanvas>> create(Window& window, std::size_t walls);
  virtual ~WindowCanvas() = default;
  WindowCanvas() = default;
  WindowCanvas(const WindowCanvas&) = delete;
  WindowCanvas& operator=(const WindowCanvas&) = delete;

  /// The pictures of a wall from now on: of both eyes, of one, or none.
  virtual void take(std::size_t wall, const std::vector<Picture>& eyes) = 0;
  /// A picture with transparency that may be laid over the walls.
  virtual void setOverlay(std::size_t number, const Picture& picture) = 0;

  /// Begins a new content of the window's current size: all black.
  virtual void begin(CanvasBuffer buffer = CanvasBuffer::Whole) = 0;
  virtual void draw(const CanvasPane& pane) = 0;
  /// From now on draws panes only there; without a width everywhere again.
  virtual void clip(const PixelRectangle& part) = 0;
  virtual void overlay(std::size_t number, std::int32_t x, std::int32_t y) = 0;
  /// Returns what has been drawn.
  virtual Picture read() = 0;
  /// Shows what has been drawn.
  virtual void show() = 0;
  /// Sets whether show() waits for the display's next picture. Only OpenGL can.
  virtual void waitForDisplay(bool wait) = 0;
};

}  // namespace stadion
