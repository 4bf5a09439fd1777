#pragma once
/// A wall as it is shown, and from where it is looked at.
///
/// Frames   R is the rig, World axes relative to an origin near the viewer.
/// Threads  plain values and pure functions.

#include "engine/display/frustum.h"
#include "pipeline/cull/free_camera.h"
#include "pipeline/cull/head_reach.h"
#include "pipeline/draw_list/draw_list.h"

#include <array>
#include <cstdint>

namespace stadion {

struct WallView {
  Wall wall;
  DepthRange depth;
  double eyeSeparation = 0.064;             ///< [m]
  bool stereo = true;                       ///< false: one eye, in the middle
  std::uint32_t width = 800, height = 600;  ///< of one eye's picture [pixels]
  const FreeCamera* camera = nullptr;       ///< it looks, not the visitor; `wall` does not count then
  HeadReach reach{};                        ///< how far the visitor's head may go after Cull
};

/// The eyes that look through a wall in a frame.
struct WallEyes {
  const Wall* wall = nullptr;
  DepthRange depth;
  std::array<Vec3, 2> eyes{Vec3::Zero(), Vec3::Zero()};  ///< left, right; in R [m]
  std::uint32_t count = 0;                               ///< 1: in the middle
  Pose X_WR;
  Vec3 origin = Vec3::Zero();  ///< where the head is, in World [m]
  double margin = 0;           ///< how far each eye may go [m]

  /// What they can see together, wherever they go, relative to the origin.
  ConvexVolume volume() const;
  void setUp(DrawList& list) const;
};

/// Negative `eyeSeparation`: as the view has it. Borrows the view, or `from`, if somebody else looks.
WallEyes eyesOf(const ViewerRecord& viewer, const WallView& view, double eyeSeparation,
                const CameraView* from = nullptr);

}  // namespace stadion
