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

Result<std::unique_ptr<ShowWindow>> ShowWindow::open(WindowSystem& system, const WindowPlan& plan,
                                                     WindowStereo stereo, std::size_t walls) {
  WindowPlan wanted = plan;
  wanted.quadBuffer = stereo == WindowStereo::Quad;
  auto window = system.create(wanted);
  if (!window) return window.error();
  std::unique_ptr<ShowWindow> made(new ShowWindow(std::move(window.value()), stereo));
  if (auto why = made->window_->makeCurrent()) return *why;
  auto pass = OutputPass::create(made->window_->gl());
  if (!pass) return pass.error();
  made->pass_ = std::move(pass.value());
  for (std::size_t i = 0; i < walls; ++i) made->eyes_.push_back(std::make_unique<Eyes>(made->window_->gl()));
  return made;
}

ShowWindow::~ShowWindow() {
  enter();
  overlays_.clear(), eyes_.clear(), pass_.reset();
  window_->release();
}

void ShowWindow::enter() {
  window_->makeCurrent();
}

void ShowWindow::take(const std::vector<EyePictures>& pictures, const std::vector<std::size_t>& wanted) {
  enter();
  for (const std::size_t wall : wanted) {
    if (wall >= pictures.size() || wall >= eyes_.size()) continue;
    const std::vector<Picture>& eyes = pictures[wall].eyes;
    Eyes& mine = *eyes_[wall];
    mine.two = eyes.size() > 1;
    if (!eyes.empty()) mine.left.upload(eyes[0]);
    if (mine.two) mine.right.upload(eyes[1]);
  }
}

void ShowWindow::setOverlay(std::size_t number, const Picture& picture, bool atBottom) {
  enter();
  while (overlays_.size() <= number) overlays_.push_back(std::make_unique<Overlay>(window_->gl()));
  Overlay& o = *overlays_[number];
  o.shown = !picture.empty(), o.atBottom = atBottom;
  if (o.shown) o.picture.upload(picture);
}

void ShowWindow::drawPane(const WindowPane& pane, EyeMix mix, std::int32_t firstRow) {
  const Eyes& eyes = *eyes_[pane.wall];
  pass_->draw({&eyes.left, eyes.two ? &eyes.right : nullptr, pane.place.x, pane.place.y, pane.place.width,
               pane.place.height, mix, pane.shape, firstRow});
}

// From the upper left corner down, and from the lower left corner up.
void ShowWindow::drawOverlays(std::int32_t x, std::int32_t y, std::int32_t bottom) {
  std::int32_t top = y + kMargin;
  bottom -= kMargin;
  for (const auto& o : overlays_) {
    if (!o->shown) continue;
    const auto high = static_cast<std::int32_t>(o->picture.height());
    if (o->atBottom) bottom -= high;
    pass_->overlay(o->picture, x + kMargin, o->atBottom ? bottom : top);
    if (!o->atBottom) top += high + kMargin;
  }
}

void ShowWindow::drawSide(const std::vector<WindowPane>& panes, GLenum buffer, EyeMix mix) {
  const auto [width, height] = window_->size();
  pass_->begin(width, height, buffer);
  for (const WindowPane& pane : panes) drawPane(pane, mix);
  drawOverlays(0, 0, static_cast<std::int32_t>(height));
}

// Monitors side by side may show a row of the window in an even and in an odd row of theirs.
void ShowWindow::drawRows(const std::vector<WindowPane>& panes) {
  const auto [width, height] = window_->size();
  pass_->begin(width, height);
  const std::vector<MonitorPart> parts = window_->monitorParts();
  const auto odd = [](const MonitorPart& part) { return part.firstRow & 1; };
  for (const MonitorPart& part : parts) {
    const bool first = &part == &parts.front();
    if (!first && odd(part) == odd(parts.front())) continue;
    const PixelRectangle& r = part.place;
    if (!first) pass_->clip(r.x, r.y, r.width, r.height);
    for (const WindowPane& pane : panes) drawPane(pane, EyeMix::Interlaced, part.firstRow);
  }
  pass_->clip(0, 0, 0, 0);
  drawOverlays(0, 0, static_cast<std::int32_t>(height));
}

// A display for such pictures stretches each half to its whole content.
void ShowWindow::drawHalves(const std::vector<WindowPane>& panes, bool beside) {
  const auto [width, height] = window_->size();
  const auto right = static_cast<std::int32_t>(beside ? width / 2 : 0),
             down = static_cast<std::int32_t>(beside ? 0 : height / 2);
  pass_->begin(width, height);
  for (WindowPane pane : panes) {
    SheetPlace& p = pane.place;
    if (beside)
      p.x /= 2, p.width = std::max(1u, p.width / 2);
    else
      p.y /= 2, p.height = std::max(1u, p.height / 2);
    drawPane(pane, EyeMix::Left);
    p.x += right, p.y += down;
    drawPane(pane, EyeMix::Right);
  }
  const auto bottom = static_cast<std::int32_t>(height);
  drawOverlays(0, 0, beside ? bottom : down);
  drawOverlays(right, down, bottom);
}

std::optional<Picture> ShowWindow::draw(const std::vector<WindowPane>& panes, bool keep) {
  enter();
  switch (stereo_) {
  case WindowStereo::Mono: drawSide(panes, GL_BACK, EyeMix::Left); break;
  case WindowStereo::SideBySide: drawHalves(panes, true); break;
  case WindowStereo::TopBottom: drawHalves(panes, false); break;
  case WindowStereo::Anaglyph: drawSide(panes, GL_BACK, EyeMix::Anaglyph); break;
  case WindowStereo::Interlaced: drawRows(panes); break;
  case WindowStereo::Quad:
    drawSide(panes, GL_BACK_RIGHT, EyeMix::Right);
    drawSide(panes, GL_BACK_LEFT, EyeMix::Left);
    break;
  }
  if (!keep) return std::nullopt;
  return pass_->read();
}

void ShowWindow::swap() {
  enter();
  window_->swap();
}

}  // namespace stadion
