#include "pipeline/projection/blended_hall.h"

#include "engine/maths/functions.h"
#include "engine/maths/srgb.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace stadion {
namespace {

constexpr double kLeastWeight = 1e-12;     ///< so that the border of a lone picture has all its light
constexpr std::uint32_t kBlackSteps = 32;  ///< samples of a picture along each side, for its blacks

/// The parts of a projector's range that give light 1.
Vec3 liftOf(const ProjectorLight& light) {
  return {1 / (light.white[0] - light.black), 1 / (light.white[1] - light.black),
          1 / (light.white[2] - light.black)};
}

/// The share that the map, which lies over the whole output, has at a place.
Vec3 shareIn(const LightMap& map, const Vec2& place) {
  const auto along = [](double share, std::uint32_t size) {
    return std::clamp(share * size - 0.5, 0.0, double(size - 1));
  };
  const double u = along(place.x(), map.width), v = along(place.y(), map.height);
  const auto column = static_cast<std::uint32_t>(u), row = static_cast<std::uint32_t>(v);
  const auto at = [&](std::uint32_t c, std::uint32_t r) -> Vec3 {
    const std::size_t first =
        (std::size_t{std::min(r, map.height - 1)} * map.width + std::min(c, map.width - 1)) * map.channels;
    const auto value = [&](std::size_t channel) {
      const double share = map.values[first + (map.channels == 3 ? channel : 0)] / 65535.0;
      return map.gamma == 1 || share == 0 ? share : det::pow(share, map.gamma);
    };
    return {value(0), value(1), value(2)};
  };
  const double s = u - column, t = v - row;
  return (1 - t) * ((1 - s) * at(column, row) + s * at(column + 1, row)) +
         t * ((1 - s) * at(column, row + 1) + s * at(column + 1, row + 1));
}

LightMap mapOf(const Picture& picture) {
  LightMap map{picture.width, picture.height, 3, {}, 1};
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
    for (std::size_t c = 0; c < 3; ++c)
      map.values.push_back(static_cast<std::uint16_t>(257 * picture.rgba[i + c]));
  return map;
}

}  // namespace

double displayValue(double light, double gamma) {
  if (light <= 0) return 0;
  return gamma > 0 ? det::pow(light, 1 / gamma) : srgbFromLinear(light);
}

Result<std::unique_ptr<BlendedHall>> BlendedHall::create(const WallFile& hall) {
  std::unique_ptr<BlendedHall> blended(new BlendedHall(hall));
  if (auto problem = blended->readMasks()) return *problem;
  return blended;
}

BlendedHall::BlendedHall(const WallFile& hall)
    : hall_(hall), images_(hall.walls.size()), masks_(hall.walls.size()) {
  for (const Screen& screen : hall.screens) surfaces_.push_back(std::make_unique<ScreenSurface>(screen));
  bool first = true;
  for (std::size_t i = 0; i < hall.walls.size(); ++i) {
    if (!hall.walls[i].projector) continue;
    const Projector& p = projector(i);
    images_[i] = std::make_unique<ThrownImage>(p, *surfaces_[p.screen]);
    for (std::size_t c = 0; c < 3; ++c)
      white_[c] = first ? p.light.white[c] : std::min(white_[c], p.light.white[c]);
    first = false;
  }
  findBrightestBlack();
}

std::optional<Diagnostic> BlendedHall::readMasks() {
  for (std::size_t i = 0; i < hall_.walls.size(); ++i) {
    if (!hall_.walls[i].projector || projector(i).blend.mask.empty()) continue;
    const std::filesystem::path folder = std::filesystem::path(hall_.file).parent_path();
    auto mask = readPng((folder / projector(i).blend.mask).string());
    if (!mask) return mask.error();
    masks_[i] = mapOf(mask.value());
  }
  return std::nullopt;
}

bool BlendedHall::mayShare(std::size_t a, std::size_t b) const {
  if (a == b || !images_[b]) return false;
  const Projector &pa = projector(a), &pb = projector(b);
  return pa.screen == pb.screen && (!pa.eye || !pb.eye || *pa.eye == *pb.eye);
}

/// The light of all black pixels at the point, which `entry` lights.
double BlendedHall::blackAt(std::size_t entry, const Vec3& point) const {
  double black = projector(entry).light.black;
  for (std::size_t other = 0; other < images_.size(); ++other)
    if (mayShare(entry, other) && projector(other).light.black > 0 && images_[other]->shareOf(point))
      black += projector(other).light.black;
  return black;
}

void BlendedHall::findBrightestBlack() {
  for (std::size_t i = 0; i < images_.size(); ++i) {
    if (!images_[i] || projector(i).light.black <= 0) continue;
    for (std::uint32_t y = 0; y <= kBlackSteps; ++y)
      for (std::uint32_t x = 0; x <= kBlackSteps; ++x)
        if (const auto point = images_[i]->pointAt(Vec2(x, y) / kBlackSteps))
          black_ = std::max(black_, blackAt(i, *point));
  }
}

/// Returns the product of the masks.
Vec3 BlendedHall::maskAt(std::size_t entry, const Vec2& place) const {
  const ProjectorBlend& blend = projector(entry).blend;
  Vec3 mask = blend.alpha ? shareIn(*blend.alpha, place) : Vec3(Vec3::Ones());
  if (masks_[entry].width > 0) mask = mask.cwiseProduct(shareIn(masks_[entry], place));
  return mask;
}

Vec3 BlendedHall::betaAt(std::size_t entry, const Vec2& place) const {
  const auto& beta = projector(entry).blend.beta;
  return beta ? shareIn(*beta, place) : Vec3(Vec3::Zero());
}

std::optional<LitPoint> BlendedHall::litBy(std::size_t entry, double x, double y) const {
  const Projector& p = projector(entry);
  const Vec2 place(x / p.width, y / p.height);
  const auto point = images_[entry]->pointAt(place);
  if (!point) return std::nullopt;
  const auto weightOf = [](double depth) { return depth * depth + kLeastWeight; };
  double all = weightOf(images_[entry]->depthAt(place)), share = 1;
  if (p.blend.computed) {
    const double own = all;
    for (std::size_t other = 0; other < images_.size(); ++other) {
      if (!mayShare(entry, other) || !projector(other).blend.computed) continue;
      if (const auto there = images_[other]->shareOf(*point))
        all += weightOf(images_[other]->depthAt(*there));
    }
    share = own / all;
  }
  const Vec3 beta = betaAt(entry, place);
  LitPoint lit{*point, share * maskAt(entry, place).cwiseProduct(Vec3::Ones() - beta), beta};
  if (black_ > 0) lit.lift += share * std::max(0.0, black_ - blackAt(entry, *point)) * liftOf(p.light);
  return lit;
}

WarpLight BlendedHall::lightOf(std::size_t entry) const {
  return warpLight(projector(entry).light, white_, black_);
}

WarpLight warpLight(const ProjectorLight& light, const std::array<double, 3>& white, double black) {
  WarpLight warp;
  for (std::size_t v = 0; v < 256; ++v)
    warp.linear[v] = static_cast<float>(linearFromSrgb(static_cast<double>(v) / 255));
  for (std::size_t c = 0; c < 3; ++c) {
    const double range = light.white[c] - light.black;
    warp.gain[c] = static_cast<float>((white[c] - black) / range);
    for (std::size_t step = 0; step <= kWarpSteps; ++step) {
      const double root = static_cast<double>(step) / kWarpSteps;
      warp.encoded[c][step] =
          static_cast<std::uint8_t>(displayValue(root * root, light.gamma[c]) * 255 + 0.5);
    }
  }
  return warp;
}

}  // namespace stadion
