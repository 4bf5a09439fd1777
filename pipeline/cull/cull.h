#pragma once
/// From what a wall may see of a frame (room_cull.h) to its draw list.
///
/// Threads  one at a time for each wall: any thread that holds a lease on the view's slot.

#include "engine/core/frame_probe.h"
#include "pipeline/cull/draw_order.h"
#include "pipeline/cull/level_choice.h"
#include "pipeline/cull/room_cull.h"
#include "pipeline/cull/still_casters.h"
#include "pipeline/draw_list/draw_list.h"
#include "pipeline/state/scene_state.h"

namespace stadion {

/// Parts that the walls of a show share; borrowed.
struct CullParts {
  RoomCull& room;
  StillCasters* still = nullptr;         ///< null: no shadows are drawn
  std::span<const WallPixels> pixels{};  ///< pictures of the walls that show what the visitor sees
  const MeshStore* meshes = nullptr;     ///< null: meshes are drawn in full
  FrameProbe* probe = nullptr;
  /// Pixels have one sample each, so Cull leaves out objects that lie between the middles of pixels.
  bool oneSample = false;
};

struct CullOptions {
  EyeChoice eyes{};    ///< the chosen eyes; equal for all walls of a frame
  bool black = false;  ///< nothing is drawn, and no light is there
};

/// Fills a wall's draw lists, frame by frame, and keeps what memory that takes.
class WallCull {
public:
  /// Expects that the room has a wall of number `wall`.
  WallCull(const CullParts& parts, std::uint32_t wall);

  /// Fills all but the ticket. The items come last, and ListFilling, if there is one, hears of each.
  void fill(const SlotView& state, const CullOptions& options, DrawList& out);

private:
  void lookThrough(const SlotView& state, const VisibleSet& seen, DrawList& out) const;
  void choose(const SlotView& state, const VisibleSet& seen, const DrawList& out);
  void addCasters(const SlotView& state, DrawList& out) const;
  void write(DrawList& out) const;
  void reportCounts(const SlotView& state, const VisibleSet& seen, const EyeChoice& choice,
                    const DrawList& out) const;

  CullParts parts_;
  std::uint32_t wall_;
  std::optional<LevelChoice> levels_;
  DrawOrder order_;
  std::vector<DrawnRecord> opaque_, transparent_;
  std::vector<InstanceRecord> added_;  ///< by the wall's camera
};

}  // namespace stadion
