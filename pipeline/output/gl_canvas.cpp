#include "pipeline/output/gl_canvas.h"

namespace stadion {

Result<std::unique_ptr<WindowCanvas>> GlCanvas::create(Window& window, std::size_t walls) {
  std::unique_ptr<GlCanvas> made(new GlCanvas(window));
  if (auto why = made->context_.makeCurrent()) return *why;
  auto pass = OutputPass::create(made->context_.gl());
  if (!pass) return pass.error();
  made->pass_ = std::move(pass.value());
  for (std::size_t i = 0; i < walls; ++i) made->eyes_.push_back(std::make_unique<Eyes>(made->context_.gl()));
  return std::unique_ptr<WindowCanvas>(std::move(made));
}

GlCanvas::~GlCanvas() {
  enter();
  overlays_.clear();
  eyes_.clear();
  pass_.reset();
  context_.release();
}

void GlCanvas::take(std::size_t wall, const std::vector<Picture>& eyes) {
  if (wall >= eyes_.size()) return;
  enter();
  Eyes& mine = *eyes_[wall];
  mine.count = eyes.size();
  if (mine.count > 0) mine.left.upload(eyes[0]);
  if (mine.count > 1) mine.right.upload(eyes[1]);
}

void GlCanvas::setOverlay(std::size_t number, const Picture& picture) {
  enter();
  while (overlays_.size() <= number) overlays_.push_back(std::make_unique<PictureTexture>(context_.gl()));
  if (!picture.empty()) overlays_[number]->upload(picture);
}

void GlCanvas::begin(CanvasBuffer buffer) {
  enter();
  const auto [width, height] = window_.size();
  constexpr GLenum kBuffers[] = {GL_BACK, GL_BACK_LEFT, GL_BACK_RIGHT};
  pass_->begin(width, height, kBuffers[static_cast<std::size_t>(buffer)]);
}

void GlCanvas::draw(const CanvasPane& pane) {
  const Eyes& eyes = *eyes_[pane.wall];
  if (eyes.count == 0) return;
  pass_->draw({&eyes.left, eyes.count > 1 ? &eyes.right : nullptr, pane.x, pane.y, pane.width, pane.height,
               pane.mix, pane.shape, pane.firstRow});
}

void GlCanvas::clip(const PixelRectangle& part) {
  pass_->clip(part.x, part.y, part.width, part.height);
}

void GlCanvas::overlay(std::size_t number, std::int32_t x, std::int32_t y) {
  pass_->overlay(*overlays_[number], x, y);
}

Picture GlCanvas::read() {
  return pass_->read();
}

void GlCanvas::show() {
  enter();
  context_.swap();
}

void GlCanvas::waitForDisplay(bool wait) {
  enter();
  context_.waitForDisplay(wait);
}

}  // namespace stadion
