#include "pipeline/picture/output_pattern.h"

#include "engine/maths/functions.h"
#include "pipeline/picture/lettering.h"
#include "pipeline/picture/sketch.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace stadion {
namespace {

constexpr Sketch::Colour kDark{16, 18, 20}, kLine{110, 118, 128}, kEdgeLine{255, 255, 255},
    kText{235, 235, 235}, kLeftName{90, 170, 255}, kRightName{255, 110, 90}, kNoLight{0, 0, 0},
    kAllLight{255, 255, 255};
constexpr std::uint32_t kEvery = 100;  ///< between lines [pixels]

Sketch::Colour greyOf(std::uint32_t value) {
  const auto v = static_cast<std::uint8_t>(value);
  return {v, v, v};
}

}  // namespace

Picture pixelPattern(const std::string& name, std::optional<Eye> eye, std::uint32_t width,
                     std::uint32_t height) {
  Sketch sketch(width, height, kDark);
  const double right = width, low = height;
  sketch.line({0, 0}, {right, low}, kLine);
  sketch.line({right, 0}, {0, low}, kLine);
  for (std::uint32_t x = kEvery; x < width; x += kEvery) sketch.line({double(x), 0}, {double(x), low}, kLine);
  for (std::uint32_t y = kEvery; y < height; y += kEvery)
    sketch.line({0, double(y)}, {right, double(y)}, kLine);
  for (std::uint32_t y = 0; y < height; y += kEvery)
    for (std::uint32_t x = 0; x < width; x += kEvery)
      letter(sketch.picture(), x + 3, y + 3, fmt::format("{},{}", x, y), kText, 1);
  sketch.border(kEdgeLine);
  const std::uint32_t scale = std::max(1u, std::min(width, height) / 100);
  const std::string text = eye ? fmt::format("{} {}", name, *eye == Eye::Left ? "L" : "R") : name;
  const auto letters = static_cast<std::uint32_t>(text.size()) * kLetterWidth * scale;
  letter(sketch.picture(), letters < width ? (width - letters) / 2 : 2, height / 3, text,
         !eye                ? kText
         : *eye == Eye::Left ? kLeftName
                             : kRightName,
         scale);
  return sketch.take();
}

Picture gammaPattern(std::uint32_t width, std::uint32_t height) {
  Sketch sketch(width, height, kNoLight);
  for (std::uint32_t y = 0; y < height; y += 2) sketch.fill(0, y, width, 1, kAllLight);
  constexpr std::uint32_t kSteps = 9;
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const double gamma = 1.6 + 0.15 * i;
    const auto value = static_cast<std::uint32_t>(255 * det::pow(0.5, 1 / gamma) + 0.5);
    const std::uint32_t left = width * (2 * i + 1) / (2 * kSteps + 1),
                        right = width * (2 * i + 2) / (2 * kSteps + 1);
    sketch.fill(left, height / 6, right - left, height * 2 / 3, greyOf(value));
    letter(sketch.picture(), left + 2, height / 2, fmt::format("{:.2f}", gamma), kNoLight,
           std::max(1u, (right - left) / 40));
  }
  return sketch.take();
}

Picture barPattern(std::uint32_t width, std::uint32_t height) {
  Sketch sketch(width, height, kNoLight);
  constexpr std::uint32_t kBars = 8, kGreys = 11;
  for (std::uint32_t i = 0; i < kBars; ++i) {
    const std::uint32_t bits = kBars - 1 - i;  // white, yellow, cyan, green, magenta, red, blue, black
    const auto on = [&](std::uint32_t bit) { return static_cast<std::uint8_t>(bits & bit ? 255 : 0); };
    sketch.fill(width * i / kBars, 0, width / kBars + 1, height * 2 / 3, {on(2), on(4), on(1)});
  }
  for (std::uint32_t i = 0; i < kGreys; ++i)
    sketch.fill(width * i / kGreys, height * 2 / 3, width / kGreys + 1, height,
                greyOf((255 * i + 5) / (kGreys - 1)));
  return sketch.take();
}

}  // namespace stadion
