#include "pipeline/projection/panorama_facets.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace stadion {
namespace {

constexpr std::size_t kMostParts = 12;           ///< halves of the box's sides
constexpr std::uint8_t kNoFacet = 0xff;          ///< of a dark cell
constexpr std::uint32_t kMostSidePixels = 8192;  ///< a side of a facet's picture
constexpr double kFlattestRay = 0.2;             ///< cosine of the flattest ray to a side
constexpr double kPixelsAround = 3;              ///< beyond a rectangle, for the filter

/// What the cells of one part of the box show, on the plane of its side.
struct PartExtent {
  Vec2 low = Vec2::Constant(1e300), high = Vec2::Constant(-1e300);
  bool used() const { return low.x() <= high.x(); }
};

class PanoramaBox {
public:
  PanoramaBox(const Panorama& panorama, const PixelMap& map, bool halves)
      : panorama_(panorama), map_(map), halves_(halves), axes_(rotationOf(panorama).toRotationMatrix()) {}

  std::optional<PanoramaFacets> run() {
    made_.byCell.assign(map_.cells.size(), kNoFacet);
    for (std::size_t cell = 0; cell < map_.cells.size(); ++cell)
      if (map_.cells[cell] != PixelMap::kDark && !take(cell)) return std::nullopt;
    if (!place()) return std::nullopt;
    return std::move(made_);
  }

private:
  /// Two parts a side; whole sides use the first.
  std::size_t partOf(const Vec3& d) const {
    const auto& sides = cubeSides();
    const auto side = static_cast<std::size_t>(
        std::ranges::max_element(sides, {}, [&](const CubeSide& s) { return s.normal.dot(d); }) -
        sides.begin());
    if (!halves_) return 2 * side;
    return 2 * side + (acrossCut(sides[side]).dot(d) > 0 ? 1 : 0);
  }

  /// The cut runs round the middle of the picture, so that a half may be wholly beyond its border.
  static const Vec3& acrossCut(const CubeSide& side) {
    return std::fabs(side.up.y()) > 0.5 ? side.up : side.right;
  }
  static bool isUpright(const CubeSide& side) { return &acrossCut(side) == &side.right; }

  /// The directions in P that the cell shows.
  void gather(std::size_t cell) {
    directions_.clear();
    const auto add = [&](const MapPoint& p) {
      directions_.push_back(axes_.transpose() * Vec3(p.x, p.y, p.z));
    };
    const std::uint32_t kind = map_.cells[cell];
    if (kind != PixelMap::kSmooth) {
      for (std::uint32_t i = 0; i < PixelMap::kPixels; ++i)
        if (const MapPoint& p = map_.pixels[kind + i]; p.share[0] > 0) add(p);
      return;
    }
    const std::size_t row = cell / map_.columns, column = cell % map_.columns;
    const std::size_t first = row * (map_.columns + 1) + column;
    for (const std::size_t corner : {first, first + 1, first + map_.columns + 1, first + map_.columns + 2})
      add(map_.corners[corner]);
  }

  bool take(std::size_t cell) {
    gather(cell);
    Vec3 middle = Vec3::Zero();
    for (const Vec3& d : directions_) middle += d.normalized();
    const std::size_t part = partOf(middle);
    made_.byCell[cell] = static_cast<std::uint8_t>(part);
    const CubeSide& side = cubeSides()[part / 2];
    for (const Vec3& d : directions_) {
      const double far = side.normal.dot(d);
      if (!(far > kFlattestRay * d.norm())) return false;
      const Vec2 at(side.right.dot(d) / far, side.up.dot(d) / far);
      parts_[part].low = parts_[part].low.cwiseMin(at);
      parts_[part].high = parts_[part].high.cwiseMax(at);
    }
    return true;
  }

  /// Makes the rectangles, and numbers them without gaps. False if there are none, or too many.
  bool place() {
    const bool exact = panorama_.kind == PanoramaKind::Cube;
    const double pitch = pixelAngle(panorama_);
    std::array<std::uint8_t, kMostParts> numbers{};
    Vec2 pixels = Vec2::Zero();
    for (std::size_t part = 0; part < kMostParts; ++part) {
      PartExtent& e = parts_[part];
      if (!e.used()) continue;
      if (made_.facets.all.size() == Facets::kMost) return false;
      numbers[part] = static_cast<std::uint8_t>(made_.facets.all.size());
      e.low = exact ? Vec2(-1, -1) : Vec2(e.low.array() - kPixelsAround * pitch);
      e.high = exact ? Vec2(1, 1) : Vec2(e.high.array() + kPixelsAround * pitch);
      made_.facets.all.push_back({rectangleOf(part, pixels), 0, 0, 0, 0});
    }
    const auto side = [&](double size) {
      return static_cast<std::uint32_t>(
          std::clamp(std::ceil(size / pitch - 1e-6), 16.0, double{kMostSidePixels}));
    };
    made_.facets.width = exact ? panorama_.height / 2 : side(pixels.x());
    made_.facets.height = exact ? panorama_.height / 2 : side(pixels.y());
    for (std::uint8_t& facet : made_.byCell)
      if (facet != kNoFacet) facet = numbers[facet];
    return !made_.facets.all.empty();
  }

  /// The rectangle of a part in R; `most` grows to its size. Halves lie with their long side across.
  Wall rectangleOf(std::size_t part, Vec2& most) const {
    const CubeSide& side = cubeSides()[part / 2];
    const PartExtent& e = parts_[part];
    const auto corner = [&](double s, double t) -> Vec3 {
      return axes_ * (side.normal + s * side.right + t * side.up);
    };
    const Vec2 size = e.high - e.low;
    const bool turned = halves_ && isUpright(side);
    most = most.cwiseMax(turned ? Vec2(size.y(), size.x()) : size);
    const Vec2 &lo = e.low, &hi = e.high;
    if (turned) return {{}, corner(hi.x(), lo.y()), corner(hi.x(), hi.y()), corner(lo.x(), lo.y())};
    return {{}, corner(lo.x(), lo.y()), corner(hi.x(), lo.y()), corner(lo.x(), hi.y())};
  }

  const Panorama& panorama_;
  const PixelMap& map_;
  const bool halves_;
  const Mat3 axes_;  ///< of P in R
  std::array<PartExtent, kMostParts> parts_;
  std::vector<Vec3> directions_;  ///< of the cell that is looked at
  PanoramaFacets made_;
};

}  // namespace

std::optional<PanoramaFacets> panoramaFacets(const Panorama& panorama, const PixelMap& map) {
  auto best = PanoramaBox(panorama, map, false).run();
  if (panorama.kind == PanoramaKind::Cube) return best;
  auto halves = PanoramaBox(panorama, map, true).run();
  if (halves && (!best || costOf(halves->facets) < costOf(best->facets))) best = std::move(halves);
  return best;
}

}  // namespace stadion
