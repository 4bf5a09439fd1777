#pragma once
/// From a frame's scene state to a wall's draw list.
///
/// One pass serves both eyes: an instance is kept if its bounding sphere may touch what any of them can see.
///
/// Threads  pure but for `out`; any thread that holds a lease on the view's slot.

#include "engine/display/frustum.h"
#include "engine/frame_probe.h"
#include "pipeline/cull/free_camera.h"
#include "pipeline/cull/level_choice.h"
#include "pipeline/cull/still_casters.h"
#include "pipeline/draw/draw_list.h"
#include "pipeline/state/scene_state.h"

namespace stadion {

/// A wall as it is shown.
struct WallView {
  Wall wall;
  DepthRange depth;
  double eyeSeparation = 0.064;             ///< [m]
  bool stereo = true;                       ///< false: one eye, in the middle
  std::uint32_t width = 800, height = 600;  ///< of one eye's picture [pixels]
  const FreeCamera* camera = nullptr;       ///< it looks, not the visitor; `wall` does not count then
};

struct CullCounts {
  std::uint64_t tested = 0, kept = 0;
};

/// Fills `out` for wall number `index`, reusing its memory. `still` is the same for all walls. Without
/// `levels` meshes are drawn in full.
CullCounts cullWall(const SlotView& state, const WallView& view, std::uint32_t index, StillCasters& still,
                    DrawList& out, FrameProbe* probe = nullptr, LevelChoice* levels = nullptr);

}  // namespace stadion
