#include "engine/panorama/panorama.h"

#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kOnRim = 1e-12;  ///< a place this near to the circle is in it [diameters]

/// The place in units of the circle's diameter, to the right and up.
Vec2 placeInCircle(const Panorama& p, const Vec2& share) {
  const double diameter = std::min(p.width, p.height);
  return {(share.x() - 0.5) * p.width / diameter, (0.5 - share.y()) * p.height / diameter};
}

std::optional<Vec3> ofDomeMaster(const Panorama& p, const Vec2& share) {
  const Vec2 place = placeInCircle(p, share);
  const double away = place.norm();
  if (away > 0.5 + kOnRim) return std::nullopt;
  if (away == 0) return Vec3(0, 1, 0);
  const auto [sine, cosine] = det::sincos(away * p.across);
  return Vec3(sine * place.x() / away, cosine, sine * place.y() / away);
}

Vec3 ofEquirectangular(const Panorama& p, const Vec2& share) {
  const auto [sinA, cosA] = det::sincos((share.x() - 0.5) * p.across);
  const auto [sinE, cosE] = det::sincos((0.5 - share.y()) * p.upright);
  return {cosE * sinA, cosE * cosA, sinE};
}

Vec3 ofCube(const Vec2& share) {
  const double column = std::clamp(std::floor(3 * share.x()), 0.0, 2.0);
  const double row = std::clamp(std::floor(2 * share.y()), 0.0, 1.0);
  const CubeSide& side = cubeSides()[static_cast<std::size_t>(3 * row + column)];
  return side.normal + (2 * (3 * share.x() - column) - 1) * side.right +
         (1 - 2 * (2 * share.y() - row)) * side.up;
}

Vec2 inCube(const Vec3& d) {
  const auto& sides = cubeSides();
  const auto nearest =
      std::ranges::max_element(sides, {}, [&](const CubeSide& side) { return side.normal.dot(d); });
  const auto number = static_cast<unsigned>(nearest - sides.begin());
  const double far = nearest->normal.dot(d);
  const double s = nearest->right.dot(d) / far, t = nearest->up.dot(d) / far;
  return {(number % 3 + 0.5 * (1 + s)) / 3, (number / 3 + 0.5 * (1 - t)) / 2};
}

}  // namespace

const std::array<CubeSide, 6>& cubeSides() {
  static const std::array<CubeSide, 6> kSides{{{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                                               {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                               {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                               {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}},
                                               {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                               {{0, -1, 0}, {-1, 0, 0}, {0, 0, 1}}}};
  return kSides;
}

Quat rotationOf(const Panorama& panorama) {
  const double overhead = panorama.kind == PanoramaKind::DomeMaster ? 0.5 * kPi : 0;
  return (det::expRotation(Vec3(0, 0, -panorama.turn)) *
          det::expRotation(Vec3(overhead - panorama.tilt, 0, 0)))
      .normalized();
}

std::optional<Vec3> directionAt(const Panorama& panorama, const Vec2& share) {
  switch (panorama.kind) {
  case PanoramaKind::DomeMaster: return ofDomeMaster(panorama, share);
  case PanoramaKind::Equirectangular: return ofEquirectangular(panorama, share);
  case PanoramaKind::Cube: return ofCube(share);
  }
  return std::nullopt;
}

std::optional<Vec2> shareOf(const Panorama& panorama, const Vec3& direction) {
  if (panorama.kind == PanoramaKind::Cube) return inCube(direction);
  if (panorama.kind == PanoramaKind::DomeMaster) {
    const Vec2 aside(direction.x(), direction.z());
    const double away = det::atan2(aside.norm(), direction.y()) / panorama.across;
    if (away > 0.5) return std::nullopt;
    const Vec2 place = aside.norm() > 0 ? Vec2(away / aside.norm() * aside) : Vec2(0, 0);
    const double diameter = std::min(panorama.width, panorama.height);
    return Vec2(0.5 + place.x() * diameter / panorama.width, 0.5 - place.y() * diameter / panorama.height);
  }
  const double azimuth = det::atan2(direction.x(), direction.y());
  const double elevation = det::atan2(direction.z(), direction.head<2>().norm());
  const Vec2 share(0.5 + azimuth / panorama.across, 0.5 - elevation / panorama.upright);
  if (share.minCoeff() < 0 || share.maxCoeff() > 1) return std::nullopt;
  return share;
}

double pixelAngle(const Panorama& panorama) {
  switch (panorama.kind) {
  case PanoramaKind::DomeMaster: return panorama.across / std::min(panorama.width, panorama.height);
  case PanoramaKind::Equirectangular:
    return std::min(panorama.across / panorama.width, panorama.upright / panorama.height);
  case PanoramaKind::Cube: return 4.0 / panorama.height;
  }
  return 0;
}

bool sizeFits(const Panorama& panorama) {
  if (panorama.kind != PanoramaKind::Cube) return true;
  return panorama.height % (2 * kCubeStep) == 0 &&
         std::uint64_t{panorama.width} * 2 == std::uint64_t{panorama.height} * 3;
}

Panorama withWidth(const Panorama& panorama, std::uint32_t width) {
  Panorama resized = panorama;
  if (panorama.kind == PanoramaKind::Cube) {
    const std::uint32_t side = std::max(1u, width / 3 / kCubeStep) * kCubeStep;
    resized.width = 3 * side;
    resized.height = 2 * side;
    return resized;
  }
  resized.width = width;
  resized.height =
      std::max(1u, static_cast<std::uint32_t>(std::uint64_t{panorama.height} * width / panorama.width));
  return resized;
}

}  // namespace stadion
