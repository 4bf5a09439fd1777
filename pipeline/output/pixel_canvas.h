#pragma once
/// The content of a window without OpenGL: each picture goes into the window's memory in one pass.
///
/// The buffers for each eye that a driver may offer need OpenGL: here, the last one drawn is shown.

#include "pipeline/output/output_colours.h"
#include "pipeline/output/picture_rows.h"
#include "pipeline/output/window_canvas.h"

#include <array>
#include <optional>
#include <vector>

namespace stadion {

class PixelCanvas final : public WindowCanvas {
public:
  /// Expects a window with pixels.
  PixelCanvas(Window& window, std::size_t walls)
      : window_(window), pixels_(*window.pixels()), eyes_(walls), colours_(walls) {}

  void take(std::size_t wall, const std::vector<Picture>& eyes) override;
  void setOverlay(std::size_t number, const Picture& picture) override;
  void begin(CanvasBuffer buffer) override;
  void draw(const CanvasPane& pane) override;
  void clip(const PixelRectangle& part) override { clip_ = part; }
  void overlay(std::size_t number, std::int32_t x, std::int32_t y) override;
  Picture read() override;
  void show() override;
  void waitForDisplay(bool) override {}

private:
  using Eyes = std::array<const Picture*, 2>;  ///< left, right; null: no picture
  /// The colours of a wall, while its shape is the same.
  struct Colours {
    explicit Colours(const OutputShape& s) : shape(s), values(s), red(s) {}
    OutputShape shape;
    OutputColours values;
    AnaglyphRed red;
  };
  /// A part of the window, in its pixels.
  struct Part {
    std::int32_t left, top, right, bottom;
    bool empty() const { return left >= right || top >= bottom; }
  };

  Part whole() const;
  Part cut(Part part, std::int32_t x, std::int32_t y, std::uint32_t width, std::uint32_t height) const;
  void clear();
  const Colours& coloursOf(const CanvasPane& pane);
  void drawRows(const CanvasPane& pane, const Part& part, const Eyes& eyes);

  Window& window_;
  WindowPixels& pixels_;
  std::vector<Eyes> eyes_;                       ///< by wall
  std::vector<std::optional<Colours>> colours_;  ///< by wall
  std::vector<Picture> overlays_;
  PixelRows rows_;
  PixelRectangle clip_;
  bool clear_ = false;                      ///< nothing of the last content is left
  std::vector<std::uint32_t> row_, other_;  ///< rows of a pane
};

}  // namespace stadion
