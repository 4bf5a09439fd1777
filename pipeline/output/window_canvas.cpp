#include "pipeline/output/window_canvas.h"

#include "pipeline/output/gl_canvas.h"
#include "pipeline/output/pixel_canvas.h"

namespace stadion {

Result<std::unique_ptr<WindowCanvas>> WindowCanvas::create(Window& window, std::size_t walls) {
  if (window.context()) return GlCanvas::create(window, walls);
  return std::unique_ptr<WindowCanvas>(std::make_unique<PixelCanvas>(window, walls));
}

}  // namespace stadion
