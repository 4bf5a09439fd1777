#include "pipeline/output/pixel_canvas.h"

#include <algorithm>
#include <utility>

namespace stadion {
namespace {

constexpr std::uint32_t kBlack = 0xff000000;

/// From 0xAABBGGRR to 0xAARRGGBB or back.
std::uint32_t redAndBlueSwapped(std::uint32_t p) {
  return (p & 0xff00ff00) | (p & 0xff) << 16 | (p >> 16 & 0xff);
}

/// a * b / 255, rounded.
std::uint32_t product(std::uint32_t a, std::uint32_t b) {
  return (a * b + 127) / 255;
}

/// `over` with an opacity of 0 to 255 on `under`, of one channel. Both parts are rounded, as OpenGL does.
std::uint32_t laid(std::uint32_t over, std::uint32_t under, std::uint32_t opacity) {
  return std::min(product(over, opacity) + product(under, 255 - opacity), 255u);
}

}  // namespace

void PixelCanvas::take(std::size_t wall, const std::vector<Picture>& eyes) {
  if (wall >= eyes_.size()) return;
  eyes_[wall] = {};
  for (std::size_t e = 0; e < std::min<std::size_t>(eyes.size(), 2); ++e)
    if (!eyes[e].empty()) eyes_[wall][e] = &eyes[e];
}

void PixelCanvas::setOverlay(std::size_t number, const Picture& picture) {
  if (overlays_.size() <= number) overlays_.resize(number + 1);
  overlays_[number] = picture;
}

void PixelCanvas::begin(CanvasBuffer) {
  const auto [width, height] = window_.size();
  rows_ = pixels_.begin(width, height);
  clip_ = {};
  clear_ = false;
}

PixelCanvas::Part PixelCanvas::whole() const {
  return {0, 0, static_cast<std::int32_t>(rows_.width), static_cast<std::int32_t>(rows_.height)};
}

PixelCanvas::Part PixelCanvas::cut(Part part, std::int32_t x, std::int32_t y, std::uint32_t width,
                                   std::uint32_t height) const {
  return {std::max(part.left, x), std::max(part.top, y),
          std::min(part.right, x + static_cast<std::int32_t>(width)),
          std::min(part.bottom, y + static_cast<std::int32_t>(height))};
}

/// Left out where a pane is drawn over the whole content.
void PixelCanvas::clear() {
  if (!std::exchange(clear_, true)) std::fill_n(rows_.first, std::size_t{rows_.width} * rows_.height, kBlack);
}

const PixelCanvas::Colours& PixelCanvas::coloursOf(const CanvasPane& pane) {
  std::optional<Colours>& known = colours_[pane.wall];
  if (!known || known->shape != pane.shape) known.emplace(pane.shape);
  return *known;
}

void PixelCanvas::draw(const CanvasPane& pane) {
  Eyes eyes = eyes_[pane.wall];
  if (!eyes[0]) return;
  if (!eyes[1]) eyes[1] = eyes[0];
  if (pane.shape.swapEyes) std::swap(eyes[0], eyes[1]);
  Part part = cut(whole(), pane.x, pane.y, pane.width, pane.height);
  if (clip_.width > 0) part = cut(part, clip_.x, clip_.y, clip_.width, clip_.height);
  if (part.empty()) return;
  const Part all = whole();
  if (part.left == 0 && part.top == 0 && part.right == all.right && part.bottom == all.bottom) clear_ = true;
  clear();
  drawRows(pane, part, eyes);
}

void PixelCanvas::drawRows(const CanvasPane& pane, const Part& part, const Eyes& eyes) {
  PictureRows left(*eyes[0], pane.shape, pane.width, pane.height);
  std::optional<PictureRows> right;
  if (pane.mix != EyeMix::Left) right.emplace(*eyes[1], pane.shape, pane.width, pane.height);
  const Colours& colours = coloursOf(pane);
  const auto width = static_cast<std::size_t>(part.right - part.left);
  const auto begin = static_cast<std::uint32_t>(part.left - pane.x);
  row_.resize(width);
  other_.resize(width);
  for (std::int32_t y = part.top; y < part.bottom; ++y) {
    const auto line = static_cast<std::uint32_t>(y - pane.y);
    const bool second = pane.mix == EyeMix::Right || pane.mix == EyeMix::Anaglyph ||
                        (pane.mix == EyeMix::Interlaced && ((y + (pane.firstRow & 1)) & 1) != 0);
    (second ? *right : left).read(line, begin, row_);
    if (colours.values.changes())
      for (std::uint32_t& p : row_) p = colours.values.changed(p);
    if (pane.mix == EyeMix::Anaglyph) {
      left.read(line, begin, other_);
      for (std::size_t i = 0; i < width; ++i) row_[i] = (row_[i] & ~0xffu) | colours.red(other_[i]);
    }
    std::uint32_t* const to = rows_.row(static_cast<std::uint32_t>(y)) + part.left;
    for (std::size_t i = 0; i < width; ++i) to[i] = kBlack | redAndBlueSwapped(row_[i]);
  }
}

void PixelCanvas::overlay(std::size_t number, std::int32_t x, std::int32_t y) {
  clear();
  const Picture& picture = overlays_[number];
  const Part part = cut(whole(), x, y, picture.width, picture.height);
  if (part.empty()) return;
  for (std::int32_t v = part.top; v < part.bottom; ++v) {
    const std::uint8_t* from =
        picture.at(static_cast<std::uint32_t>(part.left - x), static_cast<std::uint32_t>(v - y));
    std::uint32_t* to = rows_.row(static_cast<std::uint32_t>(v)) + part.left;
    for (std::int32_t u = part.left; u < part.right; ++u, ++to, from += 4) {
      const std::uint32_t under = *to, opacity = from[3];
      *to = kBlack | laid(from[0], under >> 16 & 255, opacity) << 16 |
            laid(from[1], under >> 8 & 255, opacity) << 8 | laid(from[2], under & 255, opacity);
    }
  }
}

Picture PixelCanvas::read() {
  clear();
  Picture picture(rows_.width, rows_.height);
  for (std::uint32_t y = 0; y < rows_.height; ++y)
    for (std::uint32_t x = 0; x < rows_.width; ++x) {
      const std::uint32_t p = rows_.row(y)[x];
      std::uint8_t* to = picture.at(x, y);
      to[0] = p >> 16 & 255;
      to[1] = p >> 8 & 255;
      to[2] = p & 255;
    }
  return picture;
}

void PixelCanvas::show() {
  clear();
  pixels_.show();
}

}  // namespace stadion
