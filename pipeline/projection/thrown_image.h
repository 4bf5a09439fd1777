#pragma once
/// The picture of a projector on its screen, in both directions: which point a place of the output lights,
/// and which place of the output lights a point.
///
/// Frames   R is the rig. A place of the output is a share of its width and height from the upper left corner
///          (engine/display/projector.h).
/// Units    metres.
/// Ownership  borrows the projector and the surface.
/// Threads  constant after it was made; then any.

#include "engine/display/projector.h"
#include "engine/display/screen_surface.h"
#include "pipeline/projection/measured_grid.h"

#include <optional>

namespace stadion {

class ThrownImage {
public:
  ThrownImage(const Projector& projector, const ScreenSurface& surface);

  /// Returns the point of the screen in R; nothing: no light from there reaches the screen.
  std::optional<Vec3> pointAt(const Vec2& share) const { return rays_.pointLit(share); }
  /// Returns the share that lights the point of the screen; nothing: none does. A point that hides behind
  /// another part of the screen is not lit.
  std::optional<Vec2> shareOf(const Vec3& point) const;
  /// Returns how far the share is from the edges of the picture, where ramps begin: 0 on them and beyond, at most 1
  /// in its middle.
  double depthAt(const Vec2& share) const;

private:
  std::optional<Vec2> shareInLens(const Vec3& point) const;

  const Projector& projector_;
  const ScreenSurface& surface_;
  PixelRays rays_;
  MeasuredGrid grid_;  ///< of a measured image
  Mat3 fromPins_ = Mat3::Identity(),
       toPins_ = Mat3::Identity();  ///< shares of the output to those of the screen
};

}  // namespace stadion
