#include "pipeline/projection/thrown_image.h"

#include "engine/display/output.h"
#include "engine/maths/functions.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr double kSamePoint = 1e-3;  ///< of the distance to the projector: nearer points are one

bool isInside(const Vec2& share) {
  return (share.array() >= 0).all() && (share.array() <= 1).all();
}

Vec2 shareByLens(const LensImage& lens, double heightByWidth, const Vec3& p_P) {
  const double width = 1 / lens.throwRatio, height = width * heightByWidth;
  return {p_P.x() / p_P.y() / width + 0.5 - lens.shift.x(),
          0.5 + lens.shift.y() - p_P.z() / p_P.y() / height};
}

/// Where the light comes from. Expects a lens.
const Vec3& lampOf(const Projector& projector) {
  const auto* lens = std::get_if<LensImage>(&projector.image);
  return lens ? lens->X_RP.p : std::get<FisheyeImage>(projector.image).X_RP.p;
}

/// The distance from the fisheye's middle, in radii of its circle.
double radiusAt(const Projector& projector, const Vec2& share) {
  const double least = std::min(projector.width, projector.height);
  return Vec2((share.x() - 0.5) * projector.width, (share.y() - 0.5) * projector.height).norm() /
         (0.5 * least);
}

}  // namespace

ThrownImage::ThrownImage(const Projector& projector, const ScreenSurface& surface)
    : projector_(projector), surface_(surface), rays_(projector, surface) {
  if (const auto* measured = std::get_if<MeasuredImage>(&projector.image)) grid_ = MeasuredGrid(*measured);
  if (const auto* pinned = std::get_if<PinnedImage>(&projector.image))
    if (const auto map = squareToQuad(pinned->pins)) toPins_ = *map;
}

std::optional<Vec2> ThrownImage::shareInLens(const Vec3& point) const {
  if (const auto* lens = std::get_if<LensImage>(&projector_.image)) {
    const Vec3 p_P = lens->X_RP.inverse() * point;
    if (p_P.y() <= 0) return std::nullopt;
    return shareByLens(*lens, lens->pixelAspect * projector_.height / projector_.width, p_P);
  }
  const auto& fisheye = std::get<FisheyeImage>(projector_.image);
  const Vec3 p_P = fisheye.X_RP.inverse() * point;
  const double aside = Vec2(p_P.x(), p_P.z()).norm();
  const double radius = det::atan2(aside, p_P.y()) / (0.5 * fisheye.angle);
  const double least = std::min(projector_.width, projector_.height);
  const Vec2 way = aside > 0 ? Vec2(p_P.x() / aside, -p_P.z() / aside) : Vec2(0, 0);
  return Vec2(0.5 + 0.5 * radius * least / projector_.width * way.x(),
              0.5 + 0.5 * radius * least / projector_.height * way.y());
}

std::optional<Vec2> ThrownImage::shareOf(const Vec3& point) const {
  if (const auto* measured = std::get_if<MeasuredImage>(&projector_.image)) {
    const auto place = grid_.placeOf(point);
    if (!place) return std::nullopt;
    return Vec2((place->x() + 0.5) / measured->columns, (place->y() + 0.5) / measured->rows);
  }
  if (std::holds_alternative<PinnedImage>(projector_.image)) {
    const Wall& wall = std::get<Wall>(surface_.screen().surface);
    const WallBasis& b = surface_.plane();
    const Vec3 p = point - wall.lowerLeft;
    const Vec3 at = toPins_ * Vec3(p.dot(b.right) / b.width, 1 - p.dot(b.up) / b.height, 1);
    const Vec2 share = at.head<2>() / at.z();
    return at.z() > 0 && isInside(share) ? std::optional<Vec2>(share) : std::nullopt;
  }
  const auto share = shareInLens(point);
  if (!share || !isInside(*share)) return std::nullopt;
  const auto first = pointAt(*share);
  const double distance = (point - lampOf(projector_)).norm();
  if (!first || (*first - point).norm() > kSamePoint * distance) return std::nullopt;
  return share;
}

double ThrownImage::depthAt(const Vec2& share) const {
  const auto& [left, right, top, bottom] = projector_.blend.edges;
  const double across = std::min(share.x() - left, 1 - right - share.x()) / (1 - left - right);
  const double down = std::min(share.y() - top, 1 - bottom - share.y()) / (1 - top - bottom);
  const double rectangle = 4 * std::max(0.0, across) * std::max(0.0, down);
  if (!std::holds_alternative<FisheyeImage>(projector_.image)) return rectangle;
  return std::max(0.0, 1 - radiusAt(projector_, share));
}

}  // namespace stadion
