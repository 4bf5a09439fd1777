#include "engine/display/covered_rectangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace stadion {
namespace {

constexpr int kLitSteps = 32;             ///< of a grid over the output
constexpr double kLeastRectangle = 1e-3;  ///< [m]

/// A range of two coordinates.
struct PlaneBounds {
  Vec2 lo = Vec2::Constant(1e300), hi = Vec2::Constant(-1e300);
  void include(const Vec2& p) {
    lo = lo.cwiseMin(p);
    hi = hi.cwiseMax(p);
  }
  /// Makes room for a rectangle that can be drawn.
  void widen() {
    for (int axis = 0; axis < 2; ++axis)
      if (hi[axis] - lo[axis] < kLeastRectangle) {
        const double middle = 0.5 * (lo[axis] + hi[axis]);
        lo[axis] = middle - 0.5 * kLeastRectangle;
        hi[axis] = middle + 0.5 * kLeastRectangle;
      }
  }
  bool empty() const { return lo.x() > hi.x(); }
};

Wall rectangleOn(const Vec3& origin, const Vec3& right, const Vec3& up, const PlaneBounds& bounds) {
  const auto at = [&](double x, double y) -> Vec3 { return origin + x * right + y * up; };
  Wall wall;
  wall.lowerLeft = at(bounds.lo.x(), bounds.lo.y());
  wall.lowerRight = at(bounds.hi.x(), bounds.lo.y());
  wall.upperLeft = at(bounds.lo.x(), bounds.hi.y());
  return wall;
}

struct LitPoint {
  Vec2 share;
  Vec3 p;
};

std::vector<LitPoint> litPoints(const PixelRays& rays) {
  std::vector<LitPoint> all;
  for (int row = 0; row <= kLitSteps; ++row)
    for (int column = 0; column <= kLitSteps; ++column) {
      const Vec2 share(static_cast<double>(column) / kLitSteps, static_cast<double>(row) / kLitSteps);
      if (const auto p = rays.pointLit(share)) all.push_back({share, *p});
    }
  return all;
}

/// Cuts off what lies beyond one edge of the rectangle from 0 to `most`.
std::vector<Vec2> cut(const std::vector<Vec2>& polygon, int axis, double edge, double sign) {
  std::vector<Vec2> rest;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double inA = sign * (a[axis] - edge), inB = sign * (b[axis] - edge);
    if (inA >= 0) rest.push_back(a);
    if ((inA >= 0) != (inB >= 0)) rest.push_back(a + (b - a) * (inA / (inA - inB)));
  }
  return rest;
}

/// The bounds of what a lens lights of a plane, if its whole picture meets the plane.
std::optional<PlaneBounds> boundsOfLens(const PixelRays& rays, const Wall& wall, const WallBasis& b) {
  std::vector<Vec2> picture;
  for (const Vec2& share : {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1), Vec2(0, 1)}) {
    const Vec3 along = *rays.direction(share), from = rays.lens()->p;
    const double t = b.normal.dot(wall.lowerLeft - from) / b.normal.dot(along);
    if (!(t > 0) || !(t < 1e6)) return std::nullopt;
    const Vec3 r = from + t * along - wall.lowerLeft;
    picture.emplace_back(r.dot(b.right), r.dot(b.up));
  }
  for (const int axis : {0, 1}) {
    picture = cut(picture, axis, 0, 1);
    picture = cut(picture, axis, axis == 0 ? b.width : b.height, -1);
  }
  PlaneBounds bounds;
  for (const Vec2& p : picture) bounds.include(p);
  return bounds;
}

std::optional<Wall> onPlane(const Projector& projector, const PixelRays& rays, const Wall& wall,
                            const WallBasis& b) {
  std::optional<PlaneBounds> bounds;
  if (std::holds_alternative<LensImage>(projector.image)) bounds = boundsOfLens(rays, wall, b);
  if (!bounds) {
    bounds.emplace();
    for (const LitPoint& lit : litPoints(rays)) {
      const Vec3 r = lit.p - wall.lowerLeft;
      bounds->include(Vec2(r.dot(b.right), r.dot(b.up)));
    }
  }
  if (bounds->empty()) return std::nullopt;
  bounds->widen();
  return rectangleOn(wall.lowerLeft, b.right, b.up, *bounds);
}

/// The axes of the picture on a curved screen: how points move on average as the share moves.
std::optional<Wall> onCurve(const PixelRays& rays, const Vec3& eye) {
  const std::vector<LitPoint> lit = litPoints(rays);
  if (lit.empty()) return std::nullopt;
  Vec3 middle = Vec3::Zero();
  Vec2 share = Vec2::Zero();
  for (const LitPoint& l : lit) {
    middle += l.p / static_cast<double>(lit.size());
    share += l.share / static_cast<double>(lit.size());
  }
  Vec3 right = Vec3::Zero(), up = Vec3::Zero();
  for (const LitPoint& l : lit) {
    right += (l.share - share).x() * (l.p - middle);
    up -= (l.share - share).y() * (l.p - middle);
  }
  if (right.norm() < 1e-12) right = Vec3(1, 0, 0);
  right.normalize();
  up -= up.dot(right) * right;
  if (up.norm() < 1e-12)
    up = right.cross(Vec3(0, 0, 1)).norm() > 0.1 ? Vec3(Vec3(0, 0, 1) - right.z() * right)
                                                 : Vec3(Vec3(0, 1, 0) - right.y() * right);
  up.normalize();
  if (right.cross(up).dot(eye - middle) < 0) right = -right;
  PlaneBounds bounds;
  for (const LitPoint& l : lit) bounds.include(Vec2((l.p - middle).dot(right), (l.p - middle).dot(up)));
  bounds.widen();
  return rectangleOn(middle, right, up, bounds);
}

/// A rectangle that is a metre wide, a metre before the visitor.
Wall beforeVisitor(const Vec3& eye, double height) {
  const Vec3 lowerLeft = eye + Vec3(-0.5, 1, -0.5 * height);
  return {{}, lowerLeft, lowerLeft + Vec3(1, 0, 0), lowerLeft + Vec3(0, 0, height)};
}

}  // namespace

std::optional<Wall> coveredRectangle(const Projector& projector, const ScreenSurface& surface,
                                     const Vec3& eye) {
  const PixelRays rays(projector, surface);
  if (const auto* wall = std::get_if<Wall>(&surface.screen().surface))
    return onPlane(projector, rays, *wall, surface.plane());
  return onCurve(rays, eye);
}

bool isComplete(const Screen& screen) {
  if (const auto* mesh = std::get_if<MeshScreen>(&screen.surface)) return !mesh->triangles.empty();
  const auto* wall = std::get_if<Wall>(&screen.surface);
  if (!wall) return true;
  const Vec3 lower = wall->lowerRight - wall->lowerLeft, left = wall->upperLeft - wall->lowerLeft;
  return lower.norm() > 1e-9 && left.norm() > 1e-9 &&
         lower.cross(left).norm() >= 1e-6 * lower.norm() * left.norm();
}

bool isComplete(const Projector& projector) {
  const auto* measured = std::get_if<MeasuredImage>(&projector.image);
  return !measured || !measured->points.empty();
}

void placeRectangles(WallFile& hall) {
  std::vector<std::unique_ptr<ScreenSurface>> surfaces;
  for (const Screen& screen : hall.screens)
    surfaces.push_back(isComplete(screen) ? std::make_unique<ScreenSurface>(screen) : nullptr);
  const Vec3& eye = hall.visitor.eye;
  for (WallEntry& entry : hall.walls) {
    if (entry.isFlat()) continue;
    std::optional<Wall> wall;
    if (entry.panorama) {
      wall = beforeVisitor(eye, static_cast<double>(entry.panorama->height) / entry.panorama->width);
    } else {
      const auto& surface = surfaces[entry.projector->screen];
      if (surface && isComplete(*entry.projector)) wall = coveredRectangle(*entry.projector, *surface, eye);
    }
    if (!wall) wall = beforeVisitor(eye, 1);
    wall->name = std::move(entry.wall.name);
    entry.wall = std::move(*wall);
  }
}

}  // namespace stadion
