#pragma once
/// The content of a window with OpenGL.

#include "pipeline/output/output_pass.h"
#include "pipeline/output/window_canvas.h"

#include <memory>
#include <vector>

namespace stadion {

class GlCanvas final : public WindowCanvas {
public:
  /// Expects a window with a context.
  static Result<std::unique_ptr<WindowCanvas>> create(Window& window, std::size_t walls);
  ~GlCanvas() override;

  void take(std::size_t wall, const std::vector<Picture>& eyes) override;
  void setOverlay(std::size_t number, const Picture& picture) override;
  void begin(CanvasBuffer buffer) override;
  void draw(const CanvasPane& pane) override;
  void clip(const PixelRectangle& part) override;
  void overlay(std::size_t number, std::int32_t x, std::int32_t y) override;
  Picture read() override;
  void show() override;
  void waitForDisplay(bool wait) override;

private:
  struct Eyes {
    explicit Eyes(const GlTable& gl) : left(gl), right(gl) {}
    PictureTexture left, right;
    std::size_t count = 0;
  };

  explicit GlCanvas(Window& window) : window_(window), context_(*window.context()) {}
  /// Windows take turns: each call makes its own context current.
  void enter() { context_.makeCurrent(); }

  Window& window_;
  WindowContext& context_;
  std::unique_ptr<OutputPass> pass_;
  std::vector<std::unique_ptr<Eyes>> eyes_;  ///< by wall
  std::vector<std::unique_ptr<PictureTexture>> overlays_;
};

}  // namespace stadion
