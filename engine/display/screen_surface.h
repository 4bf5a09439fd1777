#pragma once
/// Which point of a screen a ray meets, and which point a pixel of a projector lights.
///
/// A plane and a mesh can be met from both sides: projectors may stand behind them. A cylinder and a sphere
/// are met from inside. A ray that meets their back first lights nothing.
///
/// Frames     rig space R (+X right, +Y forward, +Z up).
/// Units      metres, radians; shares of the output from its upper left corner, as in projector.h.
/// Ownership  ScreenSurface and PixelRays borrow the screen and the projector.
/// Threads    const use from any number of threads.

#include "engine/display/mesh_ray_tree.h"
#include "engine/display/projector.h"
#include "engine/display/screen.h"

#include <optional>

namespace stadion {

/// Answers many rays to one screen. Expects a plane with an area.
class ScreenSurface {
public:
  explicit ScreenSurface(const Screen& screen);

  /// Returns the first point of the screen that the ray meets. `direction` has any length but 0.
  std::optional<Vec3> hit(const Vec3& origin, const Vec3& direction) const;
  const Screen& screen() const { return *screen_; }
  /// Returns the axes of a plane screen.
  const WallBasis& plane() const { return plane_; }

private:
  const Screen* screen_;
  WallBasis plane_;
  MeshRayTree tree_;
};

/// Answers which points the pixels of one projector light.
class PixelRays {
public:
  PixelRays(const Projector& projector, const ScreenSurface& surface);

  /// Returns the point that the pixel at `share` lights; nothing if its light misses the screen. The formulas
  /// continue a little beyond 0..1.
  std::optional<Vec3> pointLit(const Vec2& share) const;
  /// Returns the direction of the light in R, not of unit length; nothing for images without a lens and
  /// outside of a fisheye's circle.
  std::optional<Vec3> direction(const Vec2& share) const;
  /// Returns the pose of the lens, if the image has one.
  const Pose* lens() const;

private:
  std::optional<Vec3> pinned(const Vec2& share) const;
  std::optional<Vec3> measured(const MeasuredImage& image, const Vec2& share) const;

  const Projector& projector_;
  const ScreenSurface& surface_;
  Mat3 screenFromOutput_ = Mat3::Identity();  ///< of corner pins
};

/// One ray. For many rays to a mesh use ScreenSurface.
std::optional<Vec3> hit(const Screen& screen, const Vec3& origin, const Vec3& direction);

/// One pixel. For many pixels use PixelRays.
std::optional<Vec3> pointLit(const Projector& projector, const Screen& screen, const Vec2& share);

}  // namespace stadion
