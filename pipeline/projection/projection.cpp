#include "pipeline/projection/projection.h"

#include "pipeline/projection/blended_hall.h"
#include "pipeline/projection/panorama_facets.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

namespace stadion {
namespace {

constexpr std::uint32_t kCell = PixelMap::kSide;
constexpr std::uint32_t kBlackPixel = 0xff000000;

/// Points relative to the map's origin, to places in the facet's picture; rows x, y, w.
using PlaceMatrix = std::array<std::array<float, 4>, 3>;

/// Without an origin, the map has directions: points at infinity, which no translation moves.
PlaceMatrix placesOf(const FacetPicture& facet, const std::optional<Vec3>& origin) {
  Mat4 shift = Mat4::Identity();
  if (origin)
    shift.topRightCorner<3, 1>() = *origin;
  else
    shift.col(3).setZero();
  const Mat4 clip = facet.clipFromRig * shift;
  const double halfWidth = 0.5 * facet.picture->width, halfHeight = 0.5 * facet.picture->height;
  const Eigen::RowVector4d x = clip.row(0), y = clip.row(1), w = clip.row(3);
  const std::array<Eigen::RowVector4d, 3> rows{halfWidth * (w + x) - 0.5 * w, halfHeight * (w - y) - 0.5 * w,
                                               w};
  PlaceMatrix places{};
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 4; ++c) places[r][c] = static_cast<float>(rows[r][static_cast<int>(c)]);
  return places;
}

WarpPoint placed(const PlaceMatrix& m, const MapPoint& p) {
  const auto row = [&](std::size_t r) { return m[r][0] * p.x + m[r][1] * p.y + m[r][2] * p.z + m[r][3]; };
  return {row(0), row(1), row(2), {p.share[0], p.share[1], p.share[2]}, {p.lift[0], p.lift[1], p.lift[2]}};
}

}  // namespace

struct Projection::Shown {
  std::vector<PlaceMatrix> places;   ///< by facet
  std::vector<FacetPixels> sources;  ///< by facet
  const WarpKernels& kernels;
  Picture& picture;
};

void Projection::draw(std::span<const FacetPicture> facets, Picture& shown, DrawPool* pool,
                      const WarpKernels& kernels) const {
  if (shown.width != map_.width || shown.height != map_.height) shown = Picture(map_.width, map_.height);
  Shown all{{}, {}, kernels, shown};
  for (const FacetPicture& facet : facets) {
    all.places.push_back(placesOf(facet, panorama_ ? std::nullopt : std::optional(map_.origin)));
    all.sources.push_back({facet.picture->rgba.data(), facet.picture->width, facet.picture->height});
  }
  const auto row = [&](std::size_t r) { drawRow(all, static_cast<std::uint32_t>(r)); };
  if (pool) return pool->run(map_.rows, row);
  for (std::size_t r = 0; r < map_.rows; ++r) row(r);
}

void Projection::drawRow(const Shown& shown, std::uint32_t row) const {
  const std::uint32_t rows = std::min(kCell, map_.height - row * kCell);
  std::uint32_t pixels[PixelMap::kPixels];
  for (std::uint32_t column = 0; column < map_.columns; ++column) {
    const std::size_t cell = std::size_t{row} * map_.columns + column;
    const std::uint32_t kind = map_.cells[cell], facet = facetOf_[cell];
    if (kind == PixelMap::kDark || facet >= shown.places.size()) {
      std::fill_n(pixels, PixelMap::kPixels, kBlackPixel);
    } else if (kind == PixelMap::kSmooth) {
      const std::size_t first = std::size_t{row} * (map_.columns + 1) + column,
                        next = first + map_.columns + 1;
      const PlaceMatrix& m = shown.places[facet];
      const WarpPoint corners[4]{placed(m, map_.corners[first]), placed(m, map_.corners[first + 1]),
                                 placed(m, map_.corners[next]), placed(m, map_.corners[next + 1])};
      shown.kernels.smooth(corners, shown.sources[facet], light_, pixels);
    } else {
      WarpPoint points[PixelMap::kPixels];
      for (std::uint32_t i = 0; i < PixelMap::kPixels; ++i)
        points[i] = placed(shown.places[facet], map_.pixels[kind + i]);
      shown.kernels.exact(points, shown.sources[facet], light_, pixels);
    }
    const std::size_t bytes = std::min(kCell, map_.width - column * kCell) * 4;
    for (std::uint32_t y = 0; y < rows; ++y)
      std::memcpy(shown.picture.at(column * kCell, row * kCell + y), pixels + y * kCell, bytes);
  }
}

class ProjectionMaking {
public:
  ProjectionMaking(const WallFile& hall, const BlendedHall& blended, DrawPool& pool)
      : hall_(hall), blended_(blended), pool_(pool) {}

  Result<std::shared_ptr<const Projection>> make(std::size_t entry) const {
    const Projector& p = *hall_.walls[entry].projector;
    auto made = std::make_shared<Projection>();
    made->eye_ = p.eye;
    made->light_ = blended_.lightOf(entry);
    if (p.lut && !p.lut->table.empty()) {
      made->table_ = std::make_unique<ProjectorTable>(p.lut->table, p.light);
      made->light_.table = &made->table_->forKernels();
    }
    made->facets_ = facetsOf(p, blended_.imageOf(entry), hall_.visitor);
    if (made->facets_.all.empty()) return unseen(entry);
    const auto lit = [&](double x, double y) { return blended_.litBy(entry, x, y); };
    made->map_ = makePixelMap(p.width, p.height, made->facets_.all[0].rectangle.centre(), lit, pool_);
    made->facetOf_ = facetsByCell(made->facets_, made->map_);
    return std::shared_ptr<const Projection>(std::move(made));
  }

private:
  Diagnostic unseen(std::size_t entry) const {
    const WallEntry& e = hall_.walls[entry];
    return {.where = {hall_.file, e.line, e.column},
            .message =
                fmt::format("projector \"{}\" lights nothing that visitors at {} {} {} see from within "
                            "{} m; check its pose, or move the visitor",
                            e.wall.name, hall_.visitor.eye.x(), hall_.visitor.eye.y(), hall_.visitor.eye.z(),
                            hall_.visitor.reach),
            .excerpt = e.excerpt};
  }

  static std::vector<std::uint8_t> facetsByCell(const Facets& facets, const PixelMap& map) {
    std::vector<std::uint8_t> byCell(map.cells.size(), 0xff);
    for (std::size_t f = 0; f < facets.all.size(); ++f) {
      const Facet& facet = facets.all[f];
      for (std::uint32_t row = facet.top / kCell; row * kCell < facet.bottom; ++row)
        for (std::uint32_t column = facet.left / kCell; column * kCell < facet.right; ++column)
          byCell[std::size_t{row} * map.columns + column] = static_cast<std::uint8_t>(f);
    }
    return byCell;
  }

  const WallFile& hall_;
  const BlendedHall& blended_;
  DrawPool& pool_;
};

/// Makes the projection of a panorama, which shares no screen with others.
class PanoramaMaking {
public:
  static Result<std::shared_ptr<const Projection>> make(const WallFile& hall, std::size_t entry,
                                                        DrawPool& pool) {
    const WallEntry& e = hall.walls[entry];
    const Panorama& p = *e.panorama;
    const Quat q_RP = rotationOf(p);
    auto made = std::make_shared<Projection>();
    made->panorama_ = {p.eye, p.at};
    made->light_ = warpLight({}, {1, 1, 1}, 0);
    const auto lit = [&](double x, double y) -> std::optional<LitPoint> {
      const auto direction = directionAt(p, Vec2(x / p.width, y / p.height));
      if (!direction) return std::nullopt;
      return LitPoint{q_RP * *direction, Vec3::Ones(), Vec3::Zero()};
    };
    made->map_ = makePixelMap(p.width, p.height, Vec3::Zero(), lit, pool, PixelMap::Edge::Sharp);
    auto facets = panoramaFacets(p, made->map_);
    if (!facets)
      return Diagnostic{
          .where = {hall.file, e.line, e.column},
          .message = fmt::format("panorama \"{}\" has too few pixels ({} x {}) to show its directions; "
                                 "give it more",
                                 e.wall.name, p.width, p.height),
          .excerpt = e.excerpt};
    made->facets_ = std::move(facets->facets);
    made->facetOf_ = std::move(facets->byCell);
    return std::shared_ptr<const Projection>(std::move(made));
  }
};

Result<std::vector<std::shared_ptr<const Projection>>> makeProjections(const WallFile& hall, DrawPool& pool,
                                                                       std::optional<std::size_t> only) {
  std::vector<std::shared_ptr<const Projection>> all(hall.walls.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!hall.walls[i].panorama || (only && *only != i)) continue;
    auto made = PanoramaMaking::make(hall, i, pool);
    if (!made) return made.error();
    all[i] = std::move(made.value());
  }
  const bool none =
      std::ranges::none_of(hall.walls, [](const WallEntry& e) { return e.projector.has_value(); });
  if (none) return all;
  const auto blended = BlendedHall::create(hall);
  if (!blended) return blended.error();
  const ProjectionMaking making(hall, *blended.value(), pool);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!hall.walls[i].projector || (only && *only != i)) continue;
    auto made = making.make(i);
    if (!made) return made.error();
    all[i] = std::move(made.value());
  }
  return all;
}

}  // namespace stadion
