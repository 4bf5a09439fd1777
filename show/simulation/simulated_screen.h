#pragma once
/// A screen as the simulator sees it: where light meets it, and points all over it.
///
/// This code and the drawing share no geometry, only the definitions in screen.h. Planes and meshes are met
/// from both sides, cylinders and spheres from inside. The back of a cylinder or sphere stops light.
///
/// Frames     R is the rig.
/// Units      metres, radians.
/// Ownership  borrows the screen.
/// Threads    const use from any number of threads.

#include "engine/display/screen.h"

#include <optional>
#include <vector>

namespace stadion {

/// A line of light from a point.
struct LightRay {
  Vec3 from, along;  ///< in R; `along` has unit length
};

class SimulatedScreen {
public:
  explicit SimulatedScreen(const Screen& screen);

  /// Returns the first point of the screen on the ray. `candidates` are the triangles of a mesh that may be
  /// met; null: all.
  std::optional<Vec3> meets(const LightRay& ray,
                            const std::vector<std::uint32_t>* candidates = nullptr) const;
  /// Returns points that stand for equal areas, at least `count`, in a regular order.
  std::vector<Vec3> points(std::size_t count) const;
  const MeshScreen* mesh() const { return std::get_if<MeshScreen>(&screen_->surface); }
  /// Returns the point of a plane screen at shares of its width and height from its upper left corner.
  Vec3 planePoint(double x, double y) const;
  /// Returns the shares for a point of the plane.
  Vec2 planeShares(const Vec3& p) const;

private:
  std::optional<Vec3> meetsPlane(const LightRay& ray) const;
  std::optional<Vec3> meetsMesh(const LightRay& ray, const std::vector<std::uint32_t>* candidates) const;

  const Screen* screen_;
  Vec3 corner_ = Vec3::Zero(), across_ = Vec3::Zero(),
       down_ = Vec3::Zero();  ///< of a plane, from its upper left
};

}  // namespace stadion
