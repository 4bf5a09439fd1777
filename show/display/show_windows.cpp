#include "show/display/show_windows.h"

namespace stadion {
namespace {

constexpr std::int32_t kMargin = 8;  ///< of what lies over the walls [pixels]

}  // namespace

WindowStereo windowStereo(StereoLayout layout) {
  switch (layout) {
  case StereoLayout::Pair: return WindowStereo::Quad;
  case StereoLayout::SideBySide: return WindowStereo::SideBySide;
  case StereoLayout::TopBottom: return WindowStereo::TopBottom;
  case StereoLayout::Anaglyph: return WindowStereo::Anaglyph;
  case StereoLayout::Interlaced: return WindowStereo::Interlaced;
  case StereoLayout::Off: break;
  }
  return WindowStereo::Mono;
}

WindowSurface windowSurface(bool drawnWithOpenGl, WindowStereo stereo) {
  return drawnWithOpenGl || stereo == WindowStereo::Quad ? WindowSurface::OpenGl : WindowSurface::Pixels;
}

Result<std::unique_ptr<ShowWindow>> ShowWindow::open(WindowSystem& system, const WindowPlan& plan,
                                                     WindowStereo stereo, std::size_t walls) {
  WindowPlan wanted = plan;
  wanted.quadBuffer = stereo == WindowStereo::Quad;
  auto window = system.create(wanted);
  if (!window) return window.error();
  auto canvas = WindowCanvas::create(*window.value(), walls);
  if (!canvas) return canvas.error();
  return std::unique_ptr<ShowWindow>(
      new ShowWindow(std::move(window.value()), std::move(canvas.value()), stereo));
}

void ShowWindow::take(const std::vector<EyePictures>& pictures, const std::vector<std::size_t>& wanted) {
  static const std::vector<Picture> kNone;
  for (const std::size_t wall : wanted)
    canvas_->take(wall, wall < pictures.size() ? pictures[wall].eyes : kNone);
}

void ShowWindow::setOverlay(std::size_t number, const Picture& picture, bool atBottom) {
  if (overlays_.size() <= number) overlays_.resize(number + 1);
  overlays_[number] = {picture.height, atBottom};
  canvas_->setOverlay(number, picture);
}

void ShowWindow::drawPane(const WindowPane& pane, EyeMix mix, std::int32_t firstRow) {
  const SheetPlace& p = pane.place;
  canvas_->draw({pane.wall, p.x, p.y, p.width, p.height, mix, pane.shape, firstRow});
}

// From the upper left corner down, and from the lower left corner up.
void ShowWindow::drawOverlays(std::int32_t x, std::int32_t y, std::int32_t bottom) {
  std::int32_t top = y + kMargin;
  bottom -= kMargin;
  for (std::size_t i = 0; i < overlays_.size(); ++i) {
    const auto high = static_cast<std::int32_t>(overlays_[i].height);
    if (high == 0) continue;
    const bool atBottom = overlays_[i].atBottom;
    if (atBottom) bottom -= high;
    canvas_->overlay(i, x + kMargin, atBottom ? bottom : top);
    if (!atBottom) top += high + kMargin;
  }
}

void ShowWindow::drawSide(const std::vector<WindowPane>& panes, CanvasBuffer buffer, EyeMix mix) {
  const auto [width, height] = window_->size();
  canvas_->begin(buffer);
  for (const WindowPane& pane : panes) drawPane(pane, mix);
  drawOverlays(0, 0, static_cast<std::int32_t>(height));
}

// Monitors side by side may show a row of the window in an even and in an odd row of theirs.
void ShowWindow::drawRows(const std::vector<WindowPane>& panes) {
  const auto [width, height] = window_->size();
  canvas_->begin();
  const std::vector<MonitorPart> parts = window_->monitorParts();
  const auto odd = [](const MonitorPart& part) { return part.firstRow & 1; };
  for (const MonitorPart& part : parts) {
    const bool first = &part == &parts.front();
    if (!first && odd(part) == odd(parts.front())) continue;
    if (!first) canvas_->clip(part.place);
    for (const WindowPane& pane : panes) drawPane(pane, EyeMix::Interlaced, part.firstRow);
  }
  canvas_->clip({});
  drawOverlays(0, 0, static_cast<std::int32_t>(height));
}

// A display for such pictures stretches each half to its whole content.
void ShowWindow::drawHalves(const std::vector<WindowPane>& panes, bool beside) {
  const auto [width, height] = window_->size();
  const auto right = static_cast<std::int32_t>(beside ? width / 2 : 0),
             down = static_cast<std::int32_t>(beside ? 0 : height / 2);
  canvas_->begin();
  for (WindowPane pane : panes) {
    SheetPlace& p = pane.place;
    if (beside) {
      p.x /= 2;
      p.width = std::max(1u, p.width / 2);
    } else {
      p.y /= 2;
      p.height = std::max(1u, p.height / 2);
    }
    drawPane(pane, EyeMix::Left);
    p.x += right;
    p.y += down;
    drawPane(pane, EyeMix::Right);
  }
  const auto bottom = static_cast<std::int32_t>(height);
  drawOverlays(0, 0, beside ? bottom : down);
  drawOverlays(right, down, bottom);
}

std::optional<Picture> ShowWindow::draw(const std::vector<WindowPane>& panes, bool keep) {
  switch (stereo_) {
  case WindowStereo::Mono: drawSide(panes, CanvasBuffer::Whole, EyeMix::Left); break;
  case WindowStereo::SideBySide: drawHalves(panes, true); break;
  case WindowStereo::TopBottom: drawHalves(panes, false); break;
  case WindowStereo::Anaglyph: drawSide(panes, CanvasBuffer::Whole, EyeMix::Anaglyph); break;
  case WindowStereo::Interlaced: drawRows(panes); break;
  case WindowStereo::Quad:
    drawSide(panes, CanvasBuffer::Right, EyeMix::Right);
    drawSide(panes, CanvasBuffer::Left, EyeMix::Left);
    break;
  }
  if (!keep) return std::nullopt;
  return canvas_->read();
}

}  // namespace stadion
