#include "pipeline/output/picture_rows.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace stadion {
namespace {

static_assert(std::endian::native == std::endian::little, "pixels are read as words");

constexpr std::uint32_t kOpaqueBlack = 0xff000000;

/// (1 - weight / 256) * a + weight / 256 * b, of each channel of one pixel or two, rounded.
template <class Pixels>
Pixels mixed(Pixels a, Pixels b, std::uint32_t weight) {
  constexpr auto kEven = static_cast<Pixels>(0x00ff00ff00ff00ff),
                 kHalves = static_cast<Pixels>(0x0080008000800080);
  const std::uint32_t rest = 256 - weight;
  const Pixels even = (a & kEven) * rest + (b & kEven) * weight + kHalves;
  const Pixels odd = (a >> 8 & kEven) * rest + (b >> 8 & kEven) * weight + kHalves;
  return (even >> 8 & kEven) | (odd & ~kEven);
}

/// A pixel and the one to its right.
std::uint64_t pairAt(const std::uint8_t* place) {
  std::uint64_t pair = 0;
  std::memcpy(&pair, place, sizeof pair);
  return pair;
}

/// The same for whole rows, as bytes, which the compiler makes vectors of.
void mixRows(const std::uint32_t* a, const std::uint32_t* b, std::uint32_t weight,
             std::span<std::uint32_t> to) {
  const auto* first = reinterpret_cast<const std::uint8_t*>(a);
  const auto* second = reinterpret_cast<const std::uint8_t*>(b);
  auto* out = reinterpret_cast<std::uint8_t*>(to.data());
  const auto w = static_cast<std::uint16_t>(weight), rest = static_cast<std::uint16_t>(256 - weight);
  for (std::size_t i = 0; i < 4 * to.size(); ++i) {
    const auto sum = static_cast<std::uint16_t>(static_cast<std::uint16_t>(first[i] * rest) +
                                                static_cast<std::uint16_t>(second[i] * w) + 128);
    out[i] = static_cast<std::uint8_t>(sum >> 8);
  }
}

}  // namespace

PictureRows::PictureRows(const Picture& picture, const OutputShape& shape, std::uint32_t width,
                         std::uint32_t height)
    : picture_(picture), width_(width), height_(height) {
  const Mat3 toPicture = pictureFromOutput(shape);
  for (std::size_t i = 0; i < toPicture_.size(); ++i)
    toPicture_[i] = static_cast<float>(toPicture(static_cast<int>(i / 3), static_cast<int>(i % 3)));
  const bool across = shape.rotate % 180 == 90;
  const bool same = picture.width == (across ? height : width) && picture.height == (across ? width : height);
  way_ = shape.warp ? Way::Warped : same ? Way::Copied : across ? Way::Warped : Way::Stretched;
  if (way_ == Way::Warped)
    for (std::vector<float>* v : {&across_, &down_, &depth_}) v->resize(width);
  if (way_ != Way::Stretched) return;
  for (std::vector<std::uint32_t>& row : wide_) row.resize(width);
  columns_.reserve(width);
  for (std::uint32_t x = 0; x < width; ++x) {
    const float share = (static_cast<float>(x) + 0.5f) / static_cast<float>(width);
    columns_.push_back(between(toPicture_[0] * share + toPicture_[2], picture.width));
  }
}

void PictureRows::read(std::uint32_t y, std::uint32_t begin, std::span<std::uint32_t> pixels) {
  switch (way_) {
  case Way::Copied: return copy(y, begin, pixels);
  case Way::Stretched: return stretch(y, begin, pixels);
  case Way::Warped: return warp(y, begin, pixels);
  }
}

/// The place between the middles of pixels, in 1/256 of a pixel from the middle of the first one.
std::int32_t PictureRows::placeOf(float share, std::uint32_t size) {
  return static_cast<std::int32_t>(share * static_cast<float>(size) * 256 + 0.5f) - 128;
}

PictureRows::Between PictureRows::between(float share, std::uint32_t size) {
  const auto last = static_cast<std::int32_t>(size) - 1;
  const std::int32_t place = placeOf(share, size);
  const auto neighbour = [&](std::int32_t at) { return static_cast<std::uint32_t>(std::clamp(at, 0, last)); };
  return {neighbour(place >> 8), neighbour((place >> 8) + 1), static_cast<std::uint32_t>(place & 255)};
}

// Counted from below and then turned round, as OpenGL does: the rounding is the same.
float PictureRows::down(std::uint32_t y) const {
  return 1 - (static_cast<float>(height_ - 1 - y) + 0.5f) / static_cast<float>(height_);
}

std::uint32_t PictureRows::pixel(std::uint32_t x, std::uint32_t y) const {
  std::uint32_t value = 0;
  std::memcpy(&value, picture_.at(x, y), sizeof value);
  return value;
}

void PictureRows::copy(std::uint32_t y, std::uint32_t begin, std::span<std::uint32_t> pixels) const {
  const auto& m = toPicture_;
  const std::uint32_t lastX = picture_.width - 1, lastY = picture_.height - 1;
  if (m[1] != 0 || m[3] != 0) {  // a quarter turn: down a column of the picture
    const std::uint32_t column = m[1] > 0 ? y : lastX - y;
    for (std::uint32_t i = 0; i < pixels.size(); ++i)
      pixels[i] = pixel(column, m[3] > 0 ? begin + i : lastY - begin - i);
    return;
  }
  const std::uint32_t row = m[4] > 0 ? y : lastY - y;
  if (m[0] > 0) {
    std::memcpy(pixels.data(), picture_.at(begin, row), pixels.size_bytes());
    return;
  }
  for (std::uint32_t i = 0; i < pixels.size(); ++i) pixels[i] = pixel(lastX - begin - i, row);
}

void PictureRows::stretch(std::uint32_t y, std::uint32_t begin, std::span<std::uint32_t> pixels) {
  const Between rows = between(toPicture_[4] * down(y) + toPicture_[5], picture_.height);
  const std::vector<std::uint32_t>& upper = wideRow(rows.first);
  const std::vector<std::uint32_t>& lower = wideRow(rows.second);
  mixRows(upper.data() + begin, lower.data() + begin, rows.weight, pixels);
}

// Neighbours have an even and an odd number: both stay.
const std::vector<std::uint32_t>& PictureRows::wideRow(std::uint32_t y) {
  std::vector<std::uint32_t>& row = wide_[y & 1];
  if (wideOf_[y & 1] == y) return row;
  wideOf_[y & 1] = y;
  for (std::uint32_t x = 0; x < width_; ++x) {
    const Between& at = columns_[x];
    row[x] = mixed(pixel(at.first, y), pixel(at.second, y), at.weight);
  }
  return row;
}

void PictureRows::warp(std::uint32_t y, std::uint32_t begin, std::span<std::uint32_t> pixels) {
  const std::array<float, 9> m = toPicture_;
  const float t = down(y), width = static_cast<float>(width_);
  float *const right = across_.data(), *const below = down_.data(), *const depth = depth_.data();
  const auto first = static_cast<std::int32_t>(begin), count = static_cast<std::int32_t>(pixels.size());
  for (std::int32_t i = 0; i < count; ++i) {  // without a branch: the compiler makes vectors of it
    const float s = (static_cast<float>(first + i) + 0.5f) / width;
    const float z = m[6] * s + m[7] * t + m[8];
    depth[i] = z;
    right[i] = (m[0] * s + m[1] * t + m[2]) / z;
    below[i] = (m[3] * s + m[4] * t + m[5]) / z;
  }
  for (std::int32_t i = 0; i < count; ++i)
    pixels[static_cast<std::size_t>(i)] = depth[i] > 0 ? sample(right[i], below[i]) : kOpaqueBlack;
}

std::uint32_t PictureRows::sample(float across, float down) const {
  if (!(across >= 0 && across <= 1 && down >= 0 && down <= 1)) return kOpaqueBlack;
  const std::int32_t right = placeOf(across, picture_.width), below = placeOf(down, picture_.height);
  const auto column = static_cast<std::uint32_t>(right >> 8), row = static_cast<std::uint32_t>(below >> 8);
  if (column < picture_.width - 1 && row < picture_.height - 1) {  // all four are there
    const std::uint64_t upper = pairAt(picture_.at(column, row)),
                        lower = pairAt(picture_.at(column, row + 1));
    const std::uint64_t first = (upper & 0xffffffff) | lower << 32;
    const std::uint64_t second = upper >> 32 | (lower >> 32 << 32);
    const std::uint64_t both = mixed(first, second, static_cast<std::uint32_t>(right & 255));
    return mixed(static_cast<std::uint32_t>(both), static_cast<std::uint32_t>(both >> 32),
                 static_cast<std::uint32_t>(below & 255));
  }
  const Between x = between(across, picture_.width), y = between(down, picture_.height);
  return mixed(mixed(pixel(x.first, y.first), pixel(x.second, y.first), x.weight),
               mixed(pixel(x.first, y.second), pixel(x.second, y.second), x.weight), y.weight);
}

}  // namespace stadion
