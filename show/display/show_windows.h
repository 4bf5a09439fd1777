#pragma once
/// The windows of a show: which walls stand where in them, and how both eyes become one picture.
///
/// Threads  the main thread alone.
/// Errors   open() says what stands against it; afterwards windows only show what they are given.

#include "engine/display/unfolding.h"
#include "pipeline/loop/show_stages.h"
#include "pipeline/output/window_canvas.h"
#include "pipeline/picture/stereo.h"
#include "pipeline/target/window.h"

#include <optional>
#include <string>
#include <vector>

namespace stadion {

/// Interlaced: the even rows of the monitor, counted from its top from 0, are for the left eye.
enum class WindowStereo { Mono, SideBySide, TopBottom, Anaglyph, Interlaced, Quad };

/// The way that a window shows a layout. For Pair it needs a buffer for each eye.
WindowStereo windowStereo(StereoLayout layout);

/// The only place that decides whether a window has OpenGL: if OpenGL draws the walls, or if the layout needs
/// a buffer for each eye. Else no OpenGL library is loaded for it.
WindowSurface windowSurface(bool drawnWithOpenGl, WindowStereo stereo);

/// A wall in a window.
struct WindowPane {
  std::size_t wall = 0;
  SheetPlace place;
  OutputShape shape{};
};

class ShowWindow {
public:
  /// `walls` = how many walls there are in all: pictures come for all of them.
  static Result<std::unique_ptr<ShowWindow>> open(WindowSystem& system, const WindowPlan& plan,
                                                  WindowStereo stereo, std::size_t walls);

  Window& window() { return *window_; }
  /// Takes the pictures of the walls among `wanted`. They must stay until others are taken.
  void take(const std::vector<EyePictures>& pictures, const std::vector<std::size_t>& wanted);
  /// A picture that lies over the walls, in a corner; an empty one is none.
  void setOverlay(std::size_t number, const Picture& picture, bool atBottom = false);
  /// Draws the panes and what lies over them. `keep`: and returns what was drawn.
  std::optional<Picture> draw(const std::vector<WindowPane>& panes, bool keep = false);
  /// Shows what was drawn.
  void show() { canvas_->show(); }
  /// Sets whether show() waits for the display's next picture. Without OpenGL it never does.
  void waitForDisplay(bool wait) { canvas_->waitForDisplay(wait); }

private:
  struct Overlay {
    std::uint32_t height = 0;  ///< 0: not shown
    bool atBottom = false;
  };

  ShowWindow(std::unique_ptr<Window> window, std::unique_ptr<WindowCanvas> canvas, WindowStereo stereo)
      : window_(std::move(window)), canvas_(std::move(canvas)), stereo_(stereo) {}
  void drawSide(const std::vector<WindowPane>& panes, CanvasBuffer buffer, EyeMix mix);
  void drawHalves(const std::vector<WindowPane>& panes, bool beside);
  void drawRows(const std::vector<WindowPane>& panes);
  void drawPane(const WindowPane& pane, EyeMix mix, std::int32_t firstRow = 0);
  void drawOverlays(std::int32_t x, std::int32_t y, std::int32_t bottom);

  std::unique_ptr<Window> window_;
  std::unique_ptr<WindowCanvas> canvas_;
  WindowStereo stereo_;
  std::vector<Overlay> overlays_;
};

}  // namespace stadion
