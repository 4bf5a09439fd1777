#include "show/simulation/simulated_projector.h"

#include "engine/maths/angles.h"
#include "engine/maths/eigen.h"
#include "engine/maths/functions.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kTile = 32;  ///< [pixels]

/// The curve of a display (IEC 61966-2-1, or a power).
double displayCurve(double value, double gamma) {
  if (gamma > 0) return value <= 0 ? 0 : det::pow(value, gamma);
  return value <= 0.04045 ? value / 12.92 : det::pow((value + 0.055) / 1.055, 2.4);
}

}  // namespace

SimulatedProjector::SimulatedProjector(const Projector& projector, const SimulatedScreen& screen)
    : projector_(projector), screen_(screen) {
  const ProjectorLight& lamp = projector.light;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t v = 0; v < 256; ++v)
      light_[c][v] = lamp.black +
                     (lamp.white[c] - lamp.black) * displayCurve(static_cast<double>(v) / 255, lamp.gamma[c]);
  if (const auto* pins = std::get_if<PinnedImage>(&projector.image)) solvePins(*pins);
  if (screen.mesh() && std::holds_alternative<LensImage>(projector.image)) sortTriangles();
}

void SimulatedProjector::solvePins(const PinnedImage& image) {
  // Eight equations for the homography whose last number is 1.
  Eigen::Matrix<double, 8, 8> equations;
  Eigen::Matrix<double, 8, 1> values;
  constexpr double kCorners[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (int i = 0; i < 4; ++i) {
    const double x = kCorners[i][0], y = kCorners[i][1];
    const Vec2& pin = image.pins[static_cast<std::size_t>(i)];
    equations.row(2 * i) << x, y, 1, 0, 0, 0, -pin.x() * x, -pin.x() * y;
    equations.row(2 * i + 1) << 0, 0, 0, x, y, 1, -pin.y() * x, -pin.y() * y;
    values[2 * i] = pin.x();
    values[2 * i + 1] = pin.y();
  }
  const Eigen::Matrix<double, 8, 1> h = equations.fullPivLu().solve(values);
  outputFromScreen_ << h[0], h[1], h[2], h[3], h[4], h[5], h[6], h[7], 1;
  screenFromOutput_ = outputFromScreen_.inverse();
}

const Pose* SimulatedProjector::lens() const {
  if (const auto* l = std::get_if<LensImage>(&projector_.image)) return &l->X_RP;
  if (const auto* f = std::get_if<FisheyeImage>(&projector_.image)) return &f->X_RP;
  return nullptr;
}

std::optional<LightRay> SimulatedProjector::rayAt(double x, double y) const {
  const double w = width(), h = height();
  Vec3 along;
  if (const auto* l = std::get_if<LensImage>(&projector_.image)) {
    const double across = 1 / (l->throwRatio * w), upright = across * l->pixelAspect;
    along = Vec3((x - 0.5 * w + l->shift.x() * w) * across, 1, (0.5 * h - y + l->shift.y() * h) * upright);
  } else {
    const auto& f = std::get<FisheyeImage>(projector_.image);
    const Vec2 aside(x - 0.5 * w, 0.5 * h - y);
    const double radius = 0.5 * std::min(w, h), away = aside.norm();
    if (away > radius) return std::nullopt;
    const double angle = away / radius * 0.5 * f.angle;
    const Vec2 unit = away > 0 ? Vec2(aside / away) : Vec2(1, 0);
    along = Vec3(unit.x() * det::sin(angle), det::cos(angle), unit.y() * det::sin(angle));
  }
  return LightRay{lens()->p, (lens()->q * along).normalized()};
}

Vec2 SimulatedProjector::placeIn(const LensImage& l, const Vec3& p) const {
  const double focal = l.throwRatio * width();
  return {(0.5 - l.shift.x()) * width() + focal * p.x() / p.y(),
          (0.5 + l.shift.y()) * height() - focal / l.pixelAspect * p.z() / p.y()};
}

void SimulatedProjector::sortTriangles() {
  const auto& l = std::get<LensImage>(projector_.image);
  const MeshScreen& m = *screen_.mesh();
  tileColumns_ = static_cast<std::size_t>(std::ceil(width() / kTile));
  const auto tileRows = static_cast<std::size_t>(std::ceil(height() / kTile));
  tiles_.resize(tileColumns_ * tileRows);
  for (std::uint32_t i = 0; i < m.triangles.size(); ++i) {
    Vec2 lo = Vec2::Constant(1e300), hi = Vec2::Constant(-1e300);
    bool before = false, behind = false;
    for (const std::uint32_t corner : m.triangles[i]) {
      const Vec3 p = l.X_RP.q.conjugate() * (m.points[corner] - l.X_RP.p);
      if (p.y() < 1e-3) {
        behind = true;
        continue;
      }
      before = true;
      const Vec2 at = placeIn(l, p);
      lo = lo.cwiseMin(at);
      hi = hi.cwiseMax(at);
    }
    if (!before) continue;
    if (behind) {
      lo = Vec2::Zero();
      hi = Vec2(width(), height());
    }
    const auto tile = [](double place, std::size_t count) {
      return static_cast<std::size_t>(
          std::clamp(std::floor(place / kTile), 0.0, static_cast<double>(count) - 1));
    };
    if (hi.x() < -1 || hi.y() < -1 || lo.x() > width() + 1 || lo.y() > height() + 1) continue;
    for (std::size_t r = tile(lo.y() - 1, tileRows); r <= tile(hi.y() + 1, tileRows); ++r)
      for (std::size_t c = tile(lo.x() - 1, tileColumns_); c <= tile(hi.x() + 1, tileColumns_); ++c)
        tiles_[r * tileColumns_ + c].push_back(i);
  }
}

const std::vector<std::uint32_t>* SimulatedProjector::trianglesNear(double x, double y) const {
  if (tiles_.empty() || x < 0 || y < 0 || x >= width() || y >= height()) return nullptr;
  return &tiles_[static_cast<std::size_t>(y / kTile) * tileColumns_ + static_cast<std::size_t>(x / kTile)];
}

std::optional<Vec3> SimulatedProjector::pointAt(double x, double y) const {
  if (const auto* image = std::get_if<MeasuredImage>(&projector_.image)) return measuredAt(*image, x, y);
  if (std::holds_alternative<PinnedImage>(projector_.image)) {
    const Vec3 s = screenFromOutput_ * Vec3(x / width(), y / height(), 1);
    const Vec2 shares = s.head<2>() / s.z();
    const bool on = shares.minCoeff() > -1e-9 && shares.maxCoeff() < 1 + 1e-9;
    return on ? std::optional(screen_.planePoint(shares.x(), shares.y())) : std::nullopt;
  }
  const auto ray = rayAt(x, y);
  return ray ? screen_.meets(*ray, trianglesNear(x, y)) : std::nullopt;
}

std::optional<Vec3> SimulatedProjector::measuredAt(const MeasuredImage& image, double x, double y) const {
  const double column = x / width() * image.columns - 0.5, row = y / height() * image.rows - 0.5;
  const int c = std::clamp(static_cast<int>(std::floor(column)), 0, static_cast<int>(image.columns) - 2);
  const int r = std::clamp(static_cast<int>(std::floor(row)), 0, static_cast<int>(image.rows) - 2);
  const auto at = [&](int dc, int dr) -> const Vec3& {
    return image.points[static_cast<std::size_t>(r + dr) * image.columns + static_cast<std::size_t>(c + dc)];
  };
  const auto blend = [](const Vec3& a, const Vec3& b, double s) -> Vec3 { return a + s * (b - a); };
  const Vec3 p = blend(blend(at(0, 0), at(1, 0), column - c), blend(at(0, 1), at(1, 1), column - c), row - r);
  return p.allFinite() ? std::optional(p) : std::nullopt;
}

std::optional<Vec2> SimulatedProjector::throughLens(const Vec3& point) const {
  const auto& l = std::get<LensImage>(projector_.image);
  const Vec3 p = l.X_RP.q.conjugate() * (point - l.X_RP.p);
  if (p.y() <= 0) return std::nullopt;
  return placeIn(l, p);
}

std::optional<Vec2> SimulatedProjector::throughFisheye(const FisheyeImage& image, const Vec3& point) const {
  const Vec3 p = image.X_RP.q.conjugate() * (point - image.X_RP.p);
  const Vec2 aside(p.x(), p.z());
  const double radius = 0.5 * std::min(width(), height());
  const double away = det::atan2(aside.norm(), p.y()) / (0.5 * image.angle) * radius;
  if (away > radius) return std::nullopt;
  const Vec2 unit = aside.norm() > 0 ? Vec2(aside.normalized()) : Vec2(1, 0);
  return Vec2(0.5 * width() + away * unit.x(), 0.5 * height() - away * unit.y());
}

std::optional<Vec2> SimulatedProjector::amongMeasured(const Vec3& point) const {
  // The nearest of some places, then steps along the surface.
  constexpr int kStarts = 24;
  Vec2 place = Vec2::Zero();
  double nearest = HUGE_VAL;
  for (int r = 0; r < kStarts; ++r)
    for (int c = 0; c < kStarts; ++c) {
      const Vec2 start((c + 0.5) / kStarts * width(), (r + 0.5) / kStarts * height());
      const auto p = pointAt(start.x(), start.y());
      if (!p || (*p - point).norm() >= nearest) continue;
      nearest = (*p - point).norm();
      place = start;
    }
  for (int step = 0; step < 20; ++step) {
    const auto p = pointAt(place.x(), place.y());
    const auto right = pointAt(place.x() + 0.25, place.y()), below = pointAt(place.x(), place.y() + 0.25);
    if (!p || !right || !below) return std::nullopt;
    Eigen::Matrix<double, 3, 2> slope;
    slope << (*right - *p) * 4, (*below - *p) * 4;
    const Vec2 move = (slope.transpose() * slope).ldlt().solve(slope.transpose() * (point - *p));
    if (!move.allFinite()) return std::nullopt;
    place += move;
    if (move.norm() < 1e-4) break;
  }
  return place;
}

std::optional<Vec2> SimulatedProjector::placeOf(const Vec3& point) const {
  std::optional<Vec2> place;
  if (std::holds_alternative<LensImage>(projector_.image))
    place = throughLens(point);
  else if (const auto* f = std::get_if<FisheyeImage>(&projector_.image))
    place = throughFisheye(*f, point);
  else if (std::holds_alternative<MeasuredImage>(projector_.image))
    place = amongMeasured(point);
  else {
    const Vec2 shares = screen_.planeShares(point);
    const Vec3 s = outputFromScreen_ * Vec3(shares.x(), shares.y(), 1);
    place = Vec2(s.x() / s.z() * width(), s.y() / s.z() * height());
  }
  if (!place || place->minCoeff() < 0 || place->x() > width() || place->y() > height()) return std::nullopt;
  // Something may stand before the point. Outer pixels reach half a pixel beyond their centres.
  const Vec2 inside = place->cwiseMax(Vec2(1e-6, 1e-6)).cwiseMin(Vec2(width() - 1e-6, height() - 1e-6));
  const auto back = pointAt(inside.x(), inside.y());
  // Measured points lie near the screen, not on it.
  const double near = lens() ? 1e-4 * (1 + (point - lens()->p).norm()) : 5e-3;
  return back && (*back - point).norm() < near ? place : std::nullopt;
}

}  // namespace stadion
