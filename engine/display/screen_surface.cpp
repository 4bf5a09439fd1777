#include "engine/display/screen_surface.h"

#include "engine/display/output.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kOnEdge = 1e-9;  ///< a point this near to an edge is on the screen [m, rad or share]

/// Where a ray enters and leaves a round body, in multiples of its direction.
struct Passage {
  double in, out;
};

/// The roots of a t^2 + 2 b t + c = 0, without cancellation.
std::optional<Passage> passage(double a, double b, double c) {
  const double discriminant = b * b - a * c;
  if (!(a > 0) || !(discriminant >= 0)) return std::nullopt;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  if (q == 0) return Passage{0, 0};
  const double one = q / a, two = c / q;
  return Passage{std::min(one, two), std::max(one, two)};
}

bool between(double angle, double left, double right) {
  const double turn = 2 * kPi;
  double beyond = std::fmod(angle - left, turn);
  if (beyond < 0) beyond += turn;
  return beyond <= right - left + kOnEdge || beyond >= turn - kOnEdge;
}

bool onScreen(const CylinderScreen& s, const Vec3& p) {
  const Vec3 r = p - s.centre;
  return r.z() >= s.bottom - kOnEdge && r.z() <= s.top + kOnEdge &&
         between(det::atan2(r.x(), r.y()), s.left, s.right);
}

bool onScreen(const SphereScreen& s, const Vec3& p) {
  const Vec3 r = p - s.centre;
  const auto [sine, cosine] = det::sincos(s.tilt);
  const Vec3 upright(r.x(), cosine * r.y() - sine * r.z(), sine * r.y() + cosine * r.z());
  const double elevation = det::atan2(upright.z(), upright.head<2>().norm());
  return elevation >= s.lowest - kOnEdge && elevation <= s.highest + kOnEdge &&
         between(det::atan2(upright.x(), upright.y()), s.left, s.right);
}

/// The point where the ray leaves the body, if it is on the screen and the screen's back is not before it.
template <class Round>
std::optional<Vec3> fromInside(const Round& screen, const std::optional<Passage>& way, const Vec3& origin,
                               const Vec3& direction) {
  if (!way || !(way->out > 0)) return std::nullopt;
  if (way->in > 0 && onScreen(screen, origin + way->in * direction)) return std::nullopt;
  const Vec3 p = origin + way->out * direction;
  return onScreen(screen, p) ? std::optional(p) : std::nullopt;
}

std::optional<Vec3> hitRound(const CylinderScreen& s, const Vec3& origin, const Vec3& direction) {
  const Vec2 o = (origin - s.centre).head<2>(), d = direction.head<2>();
  return fromInside(s, passage(d.dot(d), o.dot(d), o.dot(o) - s.radius * s.radius), origin, direction);
}

std::optional<Vec3> hitRound(const SphereScreen& s, const Vec3& origin, const Vec3& direction) {
  const Vec3 o = origin - s.centre;
  return fromInside(s, passage(direction.dot(direction), o.dot(direction), o.dot(o) - s.radius * s.radius),
                    origin, direction);
}

bool inRange(double value, double most) {
  return value >= -kOnEdge && value <= most + kOnEdge;
}

std::optional<Vec3> hitPlane(const Wall& wall, const WallBasis& b, const Vec3& origin,
                             const Vec3& direction) {
  const double towards = b.normal.dot(direction);
  const double t = b.normal.dot(wall.lowerLeft - origin) / towards;
  if (!(t > 0) || !std::isfinite(t)) return std::nullopt;
  const Vec3 p = origin + t * direction, r = p - wall.lowerLeft;
  return inRange(r.dot(b.right), b.width) && inRange(r.dot(b.up), b.height) ? std::optional(p) : std::nullopt;
}

}  // namespace

ScreenSurface::ScreenSurface(const Screen& screen) : screen_(&screen) {
  if (const auto* wall = std::get_if<Wall>(&screen.surface)) plane_ = basis(*wall);
  if (const auto* mesh = std::get_if<MeshScreen>(&screen.surface)) tree_ = MeshRayTree(*mesh);
}

std::optional<Vec3> ScreenSurface::hit(const Vec3& origin, const Vec3& direction) const {
  if (const auto* wall = std::get_if<Wall>(&screen_->surface))
    return hitPlane(*wall, plane_, origin, direction);
  if (const auto* cylinder = std::get_if<CylinderScreen>(&screen_->surface))
    return hitRound(*cylinder, origin, direction);
  if (const auto* sphere = std::get_if<SphereScreen>(&screen_->surface))
    return hitRound(*sphere, origin, direction);
  const auto t = tree_.firstHit(std::get<MeshScreen>(screen_->surface), origin, direction);
  return t ? std::optional<Vec3>(origin + *t * direction) : std::nullopt;
}

PixelRays::PixelRays(const Projector& projector, const ScreenSurface& surface)
    : projector_(projector), surface_(surface) {
  if (const auto* image = std::get_if<PinnedImage>(&projector.image))
    if (const auto outputFromScreen = squareToQuad(image->pins))
      screenFromOutput_ = outputFromScreen->inverse();
}

const Pose* PixelRays::lens() const {
  if (const auto* image = std::get_if<LensImage>(&projector_.image)) return &image->X_RP;
  if (const auto* image = std::get_if<FisheyeImage>(&projector_.image)) return &image->X_RP;
  return nullptr;
}

std::optional<Vec3> PixelRays::direction(const Vec2& share) const {
  const double width = projector_.width, height = projector_.height;
  if (const auto* image = std::get_if<LensImage>(&projector_.image)) {
    const double w = 1 / image->throwRatio, h = image->pixelAspect * w * height / width;
    return image->X_RP.q *
           Vec3((share.x() - 0.5 + image->shift.x()) * w, 1, (0.5 - share.y() + image->shift.y()) * h);
  }
  const auto* image = std::get_if<FisheyeImage>(&projector_.image);
  if (!image) return std::nullopt;
  const double smaller = std::min(width, height);
  const double right = (share.x() - 0.5) * width / smaller, up = (0.5 - share.y()) * height / smaller;
  const double away = Vec2(right, up).norm();
  if (away > 0.5 + kOnEdge) return std::nullopt;
  if (away == 0) return image->X_RP.q * Vec3(0, 1, 0);
  const auto [sine, cosine] = det::sincos(away * image->angle);
  return image->X_RP.q * Vec3(sine * right / away, cosine, sine * up / away);
}

std::optional<Vec3> PixelRays::pointLit(const Vec2& share) const {
  if (std::holds_alternative<PinnedImage>(projector_.image)) return pinned(share);
  if (const auto* image = std::get_if<MeasuredImage>(&projector_.image)) return measured(*image, share);
  const auto along = direction(share);
  return along ? surface_.hit(lens()->p, *along) : std::nullopt;
}

std::optional<Vec3> PixelRays::pinned(const Vec2& share) const {
  const auto* wall = std::get_if<Wall>(&surface_.screen().surface);
  if (!wall) return std::nullopt;
  const Vec3 s = screenFromOutput_ * Vec3(share.x(), share.y(), 1);
  const double x = s.x() / s.z(), y = s.y() / s.z();
  if (!inRange(x, 1) || !inRange(y, 1)) return std::nullopt;
  const WallBasis& b = surface_.plane();
  return wall->lowerLeft + x * b.width * b.right + (1 - y) * b.height * b.up;
}

std::optional<Vec3> PixelRays::measured(const MeasuredImage& image, const Vec2& share) const {
  if (image.columns < 2 || image.rows < 2 || image.points.empty()) return std::nullopt;
  const double x = share.x() * image.columns - 0.5, y = share.y() * image.rows - 0.5;
  const double c = std::clamp(std::floor(x), 0.0, image.columns - 2.0);
  const double r = std::clamp(std::floor(y), 0.0, image.rows - 2.0);
  const std::size_t at = static_cast<std::size_t>(r) * image.columns + static_cast<std::size_t>(c);
  const Vec3* upper = &image.points[at];
  const Vec3* lower = upper + image.columns;
  const double s = x - c, t = y - r;
  const Vec3 p = (1 - t) * ((1 - s) * upper[0] + s * upper[1]) + t * ((1 - s) * lower[0] + s * lower[1]);
  return p.allFinite() ? std::optional(p) : std::nullopt;
}

std::optional<Vec3> hit(const Screen& screen, const Vec3& origin, const Vec3& direction) {
  return ScreenSurface(screen).hit(origin, direction);
}

std::optional<Vec3> pointLit(const Projector& projector, const Screen& screen, const Vec2& share) {
  const ScreenSurface surface(screen);
  return PixelRays(projector, surface).pointLit(share);
}

}  // namespace stadion
