#pragma once
/// Source pictures of programs that draw a view first and warp it afterwards, as places on a screen: a pixel
/// that shows a direction of the view lights the point of the screen in that direction.
///
/// Frames   rig space. Units: metres; shares of the source picture from its upper left corner.
/// Threads  plain values and pure functions.

#include "engine/hall_formats/warp_mesh.h"

#include <functional>

namespace stadion {

/// Returns the point of the screen that belongs to a share of the source picture; NaN if there is none.
using SourceView = std::function<Vec3(const Vec2& share)>;

/// A flat picture.
SourceView planeView(const Wall& wall);

/// Makes measured points of a warp; `size` is that of the output. Nothing if the mesh takes too long.
struct WarpedImage {
  MeasuredImage image;
  std::optional<LightMap> light;
};
std::optional<WarpedImage> warpedImage(const WarpMesh& mesh, const SourceView& view, const std::string& file,
                                       std::uint32_t width, std::uint32_t height);

/// Samples a view without a warp.
MeasuredImage sampledImage(const SourceView& view, std::uint32_t columns, std::uint32_t rows);

/// Returns the rectangle, `distance` before the eye, that the view with these angles shows. The angles are
/// within a quarter turn.
Wall wallOfView(const WarpView& view, const Vec3& eye, double distance);

/// Returns true if left < right and down < up, all within 89.9 degrees.
bool isFlatView(const WarpView& view);

}  // namespace stadion
