#include "bench/looks/disparity.h"

#include <algorithm>
#include <cmath>

namespace stadion::bench {
namespace {

constexpr std::uint32_t kSide = PictureBlock::kSide;
constexpr int kFarthest = 2;          ///< shift of a detail in one eye [pixels]
constexpr int kMostDisparity = 48;    ///< between the eyes [pixels]
constexpr std::uint32_t kMargin = 5;  ///< from the edges: shifts and the cubic's neighbours
constexpr double kLeastContrast = 6;  ///< mean square of the slope [1/pixel^2]
constexpr double kMostResidual = 60;  ///< mean square between eyes; else the block shows something else
constexpr int kSteps = 8;

bool hasRoom(double x, std::uint32_t y, const Brightness& b) {
  return x >= kMargin && x + kSide + kMargin <= b.width() && y + kSide <= b.height();
}

/// Mean square of the differences between a block and one `by` pixels beside it.
double residual(const PictureBlock& block, const Brightness& a, const Brightness& b, int by) {
  double sum = 0;
  for (std::uint32_t y = block.y; y < block.y + kSide; ++y)
    for (std::uint32_t x = block.x; x < block.x + kSide; ++x) {
      const double d = a.at(x, y) - b.at(static_cast<std::uint32_t>(static_cast<int>(x) + by), y);
      sum += d * d;
    }
  return sum / (kSide * kSide);
}

double contrast(const PictureBlock& block, const Brightness& b) {
  double sum = 0;
  for (std::uint32_t y = block.y; y < block.y + kSide; ++y)
    for (std::uint32_t x = block.x; x < block.x + kSide; ++x) {
      const double slope = (b.at(x + 1, y) - b.at(x - 1, y)) / 2;
      sum += slope * slope;
    }
  return sum / (kSide * kSide);
}

/// The whole-pixel offset with the least residual; nothing if none has room.
std::optional<int> bestOffset(const PictureBlock& block, const Brightness& a, const Brightness& b, int least,
                              int most) {
  std::optional<int> best;
  double bestResidual = 0;
  for (int by = least; by <= most; ++by) {
    if (!hasRoom(static_cast<double>(block.x) + by, block.y, b)) continue;
    const double r = residual(block, a, b, by);
    if (!best || r < bestResidual) {
      best = by;
      bestResidual = r;
    }
  }
  return best;
}

/// One step of Gauss and Newton for picture(x) = reference(x - shift): by how much the shift is to change.
double refinement(const PictureBlock& block, const Brightness& picture, const Brightness& reference,
                  double shift) {
  double slopes = 0, products = 0;
  for (std::uint32_t y = block.y; y < block.y + kSide; ++y)
    for (std::uint32_t x = block.x; x < block.x + kSide; ++x) {
      const double at = x - shift;
      const double slope = (reference.between(at + 0.5, y) - reference.between(at - 0.5, y));
      const double d = picture.at(x, y) - reference.between(at, y);
      slopes += slope * slope;
      products += slope * d;
    }
  return slopes > 0 ? -products / slopes : 0;
}

}  // namespace

Brightness::Brightness(const Picture& picture)
    : width_(picture.width), height_(picture.height), values_(std::size_t{picture.width} * picture.height) {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const std::uint8_t* p = &picture.rgba[4 * i];
    values_[i] = 0.299F * p[0] + 0.587F * p[1] + 0.114F * p[2];
  }
}

float Brightness::between(double x, std::uint32_t y) const {
  const auto i = static_cast<std::uint32_t>(x);
  const auto t = static_cast<float>(x - i);
  const float a = at(i - 1, y), b = at(i, y), c = at(i + 1, y), d = at(i + 2, y);
  return b + t * ((c - a) / 2 + t * (a - 2.5F * b + 2 * c - d / 2 + t * (1.5F * (b - c) + (d - a) / 2)));
}

std::optional<double> shiftOf(const PictureBlock& block, const Brightness& picture,
                              const Brightness& reference) {
  if (!hasRoom(block.x, block.y, reference) || contrast(block, reference) < kLeastContrast) return {};
  double shift = -bestOffset(block, picture, reference, -kFarthest, kFarthest).value_or(0);
  for (int step = 0; step < kSteps; ++step)
    shift = std::clamp<double>(shift + refinement(block, picture, reference, shift), -kFarthest, kFarthest);
  return shift;
}

DisparityErrors disparityErrors(const EyePair& pictures, const EyePair& references) {
  const Brightness left(pictures.left), right(pictures.right);
  const Brightness trueLeft(references.left), trueRight(references.right);
  std::vector<double> errors;
  for (std::uint32_t y = 0; y + kSide <= left.height(); y += kSide)
    for (std::uint32_t x = 0; x + kSide <= left.width(); x += kSide) {
      const PictureBlock block{x, y};
      const auto inLeft = shiftOf(block, left, trueLeft);
      if (!inLeft) continue;
      const auto apart = bestOffset(block, trueLeft, trueRight, -kMostDisparity, kMostDisparity);
      if (!apart || residual(block, trueLeft, trueRight, *apart) > kMostResidual) continue;
      const PictureBlock seen{static_cast<std::uint32_t>(static_cast<int>(x) + *apart), y};
      if (const auto inRight = shiftOf(seen, right, trueRight))
        errors.push_back(std::abs(*inRight - *inLeft));
    }
  DisparityErrors all;
  all.blocks = errors.size();
  if (errors.empty()) return all;
  for (const double e : errors) all.mean += e / static_cast<double>(errors.size());
  std::ranges::sort(errors);
  all.p95 = errors[std::min(errors.size() - 1, errors.size() * 95 / 100)];
  return all;
}

}  // namespace stadion::bench
