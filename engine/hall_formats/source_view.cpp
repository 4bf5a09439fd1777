#include "engine/hall_formats/source_view.h"

#include "engine/hall_formats/hall_builder.h"
#include "engine/maths/angles.h"
#include "engine/maths/functions.h"

#include <algorithm>
#include <limits>

namespace stadion {

SourceView planeView(const Wall& wall) {
  return [wall](const Vec2& share) -> Vec3 {
    return wall.lowerLeft + share.x() * (wall.lowerRight - wall.lowerLeft) +
           (1 - share.y()) * (wall.upperLeft - wall.lowerLeft);
  };
}

std::optional<WarpedImage> warpedImage(const WarpMesh& mesh, const SourceView& view, const std::string& file,
                                       std::uint32_t width, std::uint32_t height) {
  const auto [columns, rows] = gridSizeFor(width, height);
  const auto grid = sampleWarp(mesh, columns, rows);
  if (!grid) return std::nullopt;
  WarpedImage warped;
  warped.image.file = file;
  warped.image.columns = columns;
  warped.image.rows = rows;
  warped.image.points.reserve(grid->source.size());
  for (const Vec2& share : grid->source)
    warped.image.points.push_back(
        share.allFinite() ? view(share) : Vec3(Vec3::Constant(std::numeric_limits<double>::quiet_NaN())));
  warped.light = lightOf(*grid);
  return warped;
}

MeasuredImage sampledImage(const SourceView& view, std::uint32_t columns, std::uint32_t rows) {
  MeasuredImage image;
  image.columns = columns;
  image.rows = rows;
  image.points.reserve(std::size_t{columns} * rows);
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column)
      image.points.push_back(view({(column + 0.5) / columns, (row + 0.5) / rows}));
  return image;
}

Wall wallOfView(const WarpView& view, const Vec3& eye, double distance) {
  const double left = det::tan(view.left), right = det::tan(view.right);
  const double up = det::tan(view.up), down = det::tan(view.down);
  return wallOfEdges(eye + distance * (view.q_RP * Vec3(left, 1, down)),
                     distance * (right - left) * (view.q_RP * Vec3::UnitX()),
                     distance * (up - down) * (view.q_RP * Vec3::UnitZ()));
}

bool isFlatView(const WarpView& view) {
  constexpr double kWidest = 89.9 * kDegree;
  const auto within = [](double angle) { return angle > -kWidest && angle < kWidest; };
  return within(view.left) && within(view.right) && within(view.up) && within(view.down) &&
         view.right - view.left > 1e-4 && view.up - view.down > 1e-4;
}

}  // namespace stadion
