#include "show/simulation/simulated_screen.h"

#include "engine/maths/angles.h"
#include "engine/maths/eigen.h"
#include "engine/maths/functions.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kRim = 1e-7;  ///< points so near beyond an edge are on the screen [m, rad or share]

/// Where a line passes a centre, and how far from there it meets a circle or sphere about it.
struct Chord {
  double nearest = 0, half = 0;  ///< in multiples of the direction
  bool meets = false;
};

template <class Vector>
Chord chordOf(const Vector& from, const Vector& along, double radius) {
  Chord chord;
  const double square = along.squaredNorm();
  if (square < 1e-18) return chord;
  chord.nearest = -from.dot(along) / square;
  const double away = (from + chord.nearest * along).squaredNorm(), rest = radius * radius - away;
  chord.meets = rest >= 0;
  chord.half = chord.meets ? std::sqrt(rest / square) : 0;
  return chord;
}

bool inSector(double x, double y, double left, double right) {
  const double azimuth = det::atan2(x, y);
  for (int turns = -3; turns <= 3; ++turns) {
    const double a = azimuth + 2 * kPi * turns;
    if (a >= left - kRim && a <= right + kRim) return true;
  }
  return false;
}

bool contains(const CylinderScreen& s, const Vec3& p) {
  const Vec3 q = p - s.centre;
  return q.z() > s.bottom - kRim && q.z() < s.top + kRim && inSector(q.x(), q.y(), s.left, s.right);
}

/// From the rig to the sphere before its tilt.
Vec3 untilted(const SphereScreen& s, const Vec3& q) {
  // The tilt takes (0, 0, 1) to (0, sin, cos); its inverse takes that back.
  const double sine = det::sin(s.tilt), cosine = det::cos(s.tilt);
  return {q.x(), q.y() * cosine - q.z() * sine, q.y() * sine + q.z() * cosine};
}

Vec3 tilted(const SphereScreen& s, const Vec3& q) {
  const double sine = det::sin(s.tilt), cosine = det::cos(s.tilt);
  return {q.x(), q.y() * cosine + q.z() * sine, q.z() * cosine - q.y() * sine};
}

bool contains(const SphereScreen& s, const Vec3& p) {
  const Vec3 q = untilted(s, p - s.centre);
  const double elevation = det::asin(q.z() / s.radius);
  return elevation > s.lowest - kRim && elevation < s.highest + kRim &&
         inSector(q.x(), q.y(), s.left, s.right);
}

template <class Round>
std::optional<Vec3> meetsRound(const Round& s, const LightRay& ray, const Chord& chord) {
  if (!chord.meets || chord.nearest + chord.half <= 0) return std::nullopt;
  const Vec3 leaves = ray.from + (chord.nearest + chord.half) * ray.along;
  const bool comesFromOutside = chord.nearest - chord.half > 0;
  if (comesFromOutside && contains(s, ray.from + (chord.nearest - chord.half) * ray.along))
    return std::nullopt;
  return contains(s, leaves) ? std::optional(leaves) : std::nullopt;
}

/// Side of the line from a to b on which the ray passes: a volume.
double side(const Vec3& a, const Vec3& b, const Vec3& along) {
  return a.cross(b).dot(along);
}

}  // namespace

SimulatedScreen::SimulatedScreen(const Screen& screen) : screen_(&screen) {
  const auto* wall = std::get_if<Wall>(&screen.surface);
  if (!wall) return;
  // Where corners are not square, the lower edge counts.
  across_ = wall->lowerRight - wall->lowerLeft;
  const Vec3 edge = wall->upperLeft - wall->lowerLeft;
  const Vec3 up = edge - across_ * (edge.dot(across_) / across_.squaredNorm());
  corner_ = wall->lowerLeft + up;
  down_ = -up;
}

Vec3 SimulatedScreen::planePoint(double x, double y) const {
  return corner_ + x * across_ + y * down_;
}

Vec2 SimulatedScreen::planeShares(const Vec3& p) const {
  const Vec3 q = p - corner_;
  return {q.dot(across_) / across_.squaredNorm(), q.dot(down_) / down_.squaredNorm()};
}

std::optional<Vec3> SimulatedScreen::meets(const LightRay& ray,
                                           const std::vector<std::uint32_t>* candidates) const {
  if (std::holds_alternative<Wall>(screen_->surface)) return meetsPlane(ray);
  if (const auto* s = std::get_if<CylinderScreen>(&screen_->surface)) {
    const Vec2 from = (ray.from - s->centre).head<2>(), along = ray.along.head<2>();
    return meetsRound(*s, ray, chordOf(from, along, s->radius));
  }
  if (const auto* s = std::get_if<SphereScreen>(&screen_->surface))
    return meetsRound(*s, ray, chordOf(Vec3(ray.from - s->centre), ray.along, s->radius));
  return meetsMesh(ray, candidates);
}

std::optional<Vec3> SimulatedScreen::meetsPlane(const LightRay& ray) const {
  // from + t along = corner + x across + y down
  Mat3 columns;
  columns << across_, down_, -ray.along;
  const double determinant = columns.determinant();
  if (std::fabs(determinant) < 1e-12 * across_.norm() * down_.norm()) return std::nullopt;
  const Vec3 solution = columns.inverse() * (ray.from - corner_);
  const bool on = solution.z() > 0 && solution.x() > -kRim && solution.x() < 1 + kRim &&
                  solution.y() > -kRim && solution.y() < 1 + kRim;
  return on ? std::optional<Vec3>(planePoint(solution.x(), solution.y())) : std::nullopt;
}

std::optional<Vec3> SimulatedScreen::meetsMesh(const LightRay& ray,
                                               const std::vector<std::uint32_t>* candidates) const {
  const MeshScreen& m = std::get<MeshScreen>(screen_->surface);
  double nearest = HUGE_VAL;
  const auto look = [&](std::uint32_t triangle) {
    const auto& t = m.triangles[triangle];
    const Vec3 a = m.points[t[0]] - ray.from, b = m.points[t[1]] - ray.from, c = m.points[t[2]] - ray.from;
    const double u = side(b, c, ray.along), v = side(c, a, ray.along), w = side(a, b, ray.along);
    const double sum = u + v + w;
    if (sum == 0 || std::min({u / sum, v / sum, w / sum}) < -1e-9) return;
    const double t0 = ((u * a + v * b + w * c) / sum).dot(ray.along);
    if (t0 > 0 && t0 < nearest) nearest = t0;
  };
  if (candidates)
    for (const std::uint32_t i : *candidates) look(i);
  else
    for (std::uint32_t i = 0; i < m.triangles.size(); ++i) look(i);
  return nearest < HUGE_VAL ? std::optional<Vec3>(ray.from + nearest * ray.along) : std::nullopt;
}

namespace {

/// Rows and columns for about `count` points on a sheet of this shape.
struct Lattice {
  std::size_t columns, rows;
  Lattice(std::size_t count, double width, double height) {
    const double wanted = std::sqrt(static_cast<double>(count) * std::max(1e-3, width / height));
    columns = std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(wanted)));
    rows = std::max<std::size_t>(2, (count + columns - 1) / columns);
  }
  template <class Make>
  std::vector<Vec3> fill(const Make& make) const {
    std::vector<Vec3> all;
    for (std::size_t r = 0; r < rows; ++r)
      for (std::size_t c = 0; c < columns; ++c)
        all.push_back(make((static_cast<double>(c) + 0.5) / static_cast<double>(columns),
                           (static_cast<double>(r) + 0.5) / static_cast<double>(rows)));
    return all;
  }
};

std::vector<Vec3> meshPoints(const MeshScreen& m, std::size_t count) {
  const auto doubleArea = [&](const std::array<std::uint32_t, 3>& t) {
    return (m.points[t[1]] - m.points[t[0]]).cross(m.points[t[2]] - m.points[t[0]]).norm();
  };
  double total = 0;
  for (const auto& t : m.triangles) total += doubleArea(t);
  std::vector<Vec3> all;
  double owed = 0;
  for (const auto& t : m.triangles) {
    owed += static_cast<double>(count) * doubleArea(t) / total;
    // A triangle gets its points in rows that halve it from corner to edge.
    const auto own = static_cast<int>(owed + 0.5);
    owed -= own;
    for (int k = 0; k < own; ++k) {
      const double s = std::sqrt((k + 0.5) / own), r = std::fmod(0.5 + k * 0.6180339887498949, 1);
      all.push_back((1 - s) * m.points[t[0]] + s * ((1 - r) * m.points[t[1]] + r * m.points[t[2]]));
    }
  }
  return all;
}

}  // namespace

std::vector<Vec3> SimulatedScreen::points(std::size_t count) const {
  if (const auto* m = mesh()) return meshPoints(*m, count);
  if (std::holds_alternative<Wall>(screen_->surface))
    return Lattice(count, across_.norm(), down_.norm()).fill([&](double x, double y) {
      return planePoint(x, y);
    });
  if (const auto* s = std::get_if<CylinderScreen>(&screen_->surface))
    return Lattice(count, s->radius * (s->right - s->left), s->top - s->bottom)
        .fill([&](double x, double y) -> Vec3 {
          const double azimuth = s->left + x * (s->right - s->left);
          return s->centre + Vec3(s->radius * det::sin(azimuth), s->radius * det::cos(azimuth),
                                  s->bottom + y * (s->top - s->bottom));
        });
  const SphereScreen& s = std::get<SphereScreen>(screen_->surface);
  const double low = det::sin(s.lowest), high = det::sin(s.highest);
  return Lattice(count, s.right - s.left, high - low).fill([&](double x, double y) -> Vec3 {
    const double azimuth = s.left + x * (s.right - s.left), z = low + y * (high - low);
    const double level = std::sqrt(1 - z * z);
    return s.centre + s.radius * tilted(s, Vec3(level * det::sin(azimuth), level * det::cos(azimuth), z));
  });
}

}  // namespace stadion
