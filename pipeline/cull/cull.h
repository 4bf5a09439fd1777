#pragma once
/// From what a wall may see of a frame (room_cull.h) to its draw list.
///
/// Threads  one at a time for each wall: any thread that holds a lease on the view's slot.

#include "engine/frame_probe.h"
#include "pipeline/cull/draw_order.h"
#include "pipeline/cull/level_choice.h"
#include "pipeline/cull/room_cull.h"
#include "pipeline/cull/still_casters.h"
#include "pipeline/draw/draw_list.h"
#include "pipeline/state/scene_state.h"

namespace stadion {

/// What the walls of a show share; borrowed.
struct CullParts {
  RoomCull& room;
  StillCasters* still = nullptr;         ///< null: no shadows are drawn
  std::span<const WallPixels> pixels{};  ///< of the walls that show what the visitor sees
  const MeshStore* meshes = nullptr;     ///< null: meshes are drawn in full
  FrameProbe* probe = nullptr;
  bool oneSample = false;  ///< of each pixel: what lies between their middles is left out
};

enum class EyeOrder { LeftRight, Swapped };

/// Fills a wall's draw lists, frame by frame, and keeps what memory that takes.
class WallCull {
public:
  /// Of wall number `wall` of the room.
  WallCull(const CullParts& parts, std::uint32_t wall);

  /// Negative `eyeSeparation`: as the wall has it.
  void fill(const SlotView& state, double eyeSeparation, DrawList& out, EyeOrder order = EyeOrder::LeftRight);

private:
  void lookThrough(const SlotView& state, const WallSeen& seen, double eyeSeparation, DrawList& out) const;
  void addItems(const WallSeen& seen, DrawList& out);
  void addCasters(const SlotView& state, DrawList& out) const;
  void tell(const SlotView& state, const WallSeen& seen, double eyeSeparation, const DrawList& out) const;

  CullParts parts_;
  std::uint32_t wall_;
  std::optional<LevelChoice> levels_;
  DrawOrder order_;
};

}  // namespace stadion
