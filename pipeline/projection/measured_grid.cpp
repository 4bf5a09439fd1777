#include "pipeline/projection/measured_grid.h"

#include <algorithm>
#include <cmath>

namespace stadion {
namespace {

constexpr double kCellsPerCube = 2;
constexpr double kNearCell = 0.5;        ///< greatest distance of a point from its triangle, in cubes
constexpr double kWidestCell = 8;        ///< of a cell, in cubes
constexpr double kTriangleEdge = 1e-6;   ///< of a triangle, so that no point falls between two
constexpr std::int64_t kAxis = 1 << 20;  ///< cubes along an axis

constexpr std::uint32_t kMostCells = 256;  ///< along each side

std::uint64_t packed(std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto part = [](std::int64_t v) { return static_cast<std::uint64_t>(v + kAxis / 2) & (kAxis - 1); };
  return part(x) << 40 | part(y) << 20 | part(z);
}

std::int64_t cubeAlong(double metres, double side) {
  return static_cast<std::int64_t>(std::floor(metres / side));
}

/// Places along a side of `count` points: the border, then every few points, then the border.
std::vector<double> placesAlong(std::uint32_t count) {
  const std::uint32_t stride = (count + kMostCells - 1) / kMostCells;
  std::vector<double> places{-0.5};
  for (std::uint32_t i = 0; i + 1 < count; i += stride) places.push_back(i);
  places.push_back(count - 1);
  places.push_back(count - 0.5);
  return places;
}

bool isWhole(double place) {
  return place == std::floor(place);
}

}  // namespace

MeasuredGrid::MeasuredGrid(const MeasuredImage& image) {
  if (image.columns < 2 || image.rows < 2) return;
  take(image);
  continueOnce();  // beyond the screen's edge and the image's border
  continueOnce();  // to the corners of the image
  setSide();
  const auto cells = static_cast<std::uint32_t>((columns_.size() - 1) * (rows_.size() - 1));
  for (std::uint32_t cell = 0; cell < cells; ++cell) add(cell);
}

void MeasuredGrid::take(const MeasuredImage& image) {
  columns_ = placesAlong(image.columns);
  rows_ = placesAlong(image.rows);
  for (const double row : rows_)
    for (const double column : columns_) {
      const bool measured = isWhole(row) && isWhole(column);
      const std::size_t at =
          measured ? static_cast<std::size_t>(row) * image.columns + static_cast<std::size_t>(column) : 0;
      const Vec3& point = image.points[at];
      points_.push_back(measured && point.allFinite() ? point : Vec3(Vec3::Constant(std::nan(""))));
    }
}

/// Continues each row and column of points by one point, as a straight line.
void MeasuredGrid::continueOnce() {
  const std::vector<Vec3> before = points_;
  const auto width = static_cast<std::ptrdiff_t>(columns_.size()),
             height = static_cast<std::ptrdiff_t>(rows_.size());
  for (std::ptrdiff_t r = 0; r < height; ++r)
    for (std::ptrdiff_t c = 0; c < width; ++c) {
      const auto at = static_cast<std::size_t>(r * width + c);
      if (before[at].allFinite()) continue;
      Vec3 sum = Vec3::Zero();
      int count = 0;
      const auto from = [&](std::ptrdiff_t dc, std::ptrdiff_t dr) {
        if (c + 2 * dc < 0 || c + 2 * dc >= width || r + 2 * dr < 0 || r + 2 * dr >= height) return;
        const Vec3 &a = before[static_cast<std::size_t>((r + dr) * width + c + dc)],
                   &b = before[static_cast<std::size_t>((r + 2 * dr) * width + c + 2 * dc)];
        if (!a.allFinite() || !b.allFinite()) return;
        const std::vector<double>& places = dc != 0 ? columns_ : rows_;
        const auto i = static_cast<std::size_t>(dc != 0 ? c : r), step = static_cast<std::size_t>(dc + dr);
        sum += a + (a - b) * ((places[i] - places[i + step]) / (places[i + step] - places[i + 2 * step]));
        ++count;
      };
      from(1, 0);
      from(-1, 0);
      from(0, 1);
      from(0, -1);
      if (count > 0) points_[at] = sum / count;
    }
}

void MeasuredGrid::setSide() {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i + 1 < points_.size(); ++i) {
    const double length = (points_[i + 1] - points_[i]).norm();
    if ((i + 1) % columns_.size() == 0 || !std::isfinite(length)) continue;
    sum += length;
    ++count;
  }
  if (count > 0 && sum > 0) side_ = kCellsPerCube * sum / static_cast<double>(count);
}

MeasuredGrid::Corner MeasuredGrid::cornerOf(std::uint32_t column, std::uint32_t row) const {
  return {{columns_[column], rows_[row]}, points_[std::size_t{row} * columns_.size() + column]};
}

void MeasuredGrid::add(std::uint32_t cell) {
  const auto across = static_cast<std::uint32_t>(columns_.size() - 1);
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const std::uint32_t k : {0u, 1u, 2u, 3u}) {
    const Vec3 p = cornerOf(cell % across + k % 2, cell / across + k / 2).point;
    if (!p.allFinite()) return;
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  low.array() -= kNearCell * side_;
  high.array() += kNearCell * side_;
  // A cell that spans many cubes is a jump from one part of the screen to another.
  if ((high - low).maxCoeff() > kWidestCell * side_) return;
  for (std::int64_t x = cubeAlong(low.x(), side_); x <= cubeAlong(high.x(), side_); ++x)
    for (std::int64_t y = cubeAlong(low.y(), side_); y <= cubeAlong(high.y(), side_); ++y)
      for (std::int64_t z = cubeAlong(low.z(), side_); z <= cubeAlong(high.z(), side_); ++z)
        cells_[packed(x, y, z)].push_back(cell);
}

void MeasuredGrid::tryTriangle(const Vec3& point, const std::array<Corner, 3>& corners,
                               std::optional<Found>& best) const {
  const Vec3 u = corners[1].point - corners[0].point, v = corners[2].point - corners[0].point,
             w = point - corners[0].point;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), wu = w.dot(u), wv = w.dot(v);
  const double area = uu * vv - uv * uv;
  if (!(area > 0)) return;
  const double s = (vv * wu - uv * wv) / area, t = (uu * wv - uv * wu) / area;
  if (s < -kTriangleEdge || t < -kTriangleEdge || s + t > 1 + kTriangleEdge) return;
  const double distance = (w - s * u - t * v).norm();
  if (distance > kNearCell * side_ || (best && best->distance <= distance)) return;
  const Vec2& place = corners[0].place;
  best = Found{place + s * (corners[1].place - place) + t * (corners[2].place - place), distance};
}

std::optional<Vec2> MeasuredGrid::placeOf(const Vec3& point) const {
  const auto cells = cells_.find(
      packed(cubeAlong(point.x(), side_), cubeAlong(point.y(), side_), cubeAlong(point.z(), side_)));
  if (cells == cells_.end()) return std::nullopt;
  const auto across = static_cast<std::uint32_t>(columns_.size() - 1);
  std::optional<Found> best;
  for (const std::uint32_t cell : cells->second) {
    const std::uint32_t c = cell % across, r = cell / across;
    const Corner first = cornerOf(c, r), last = cornerOf(c + 1, r + 1);
    tryTriangle(point, {first, cornerOf(c + 1, r), last}, best);
    tryTriangle(point, {first, last, cornerOf(c, r + 1)}, best);
  }
  if (!best) return std::nullopt;
  return best->place;
}

}  // namespace stadion
