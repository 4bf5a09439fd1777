#pragma once
/// What draws the walls, in which layout, and from which pose of the head.

#include "pipeline/loop/show_stages.h"
#include "pipeline/picture/stereo.h"
#include "show/player/show_renderer.h"

#include <optional>
#include <vector>

namespace stadion {

struct DrawSettings {
  RendererSettings renderer{};
  StereoLayout layout = StereoLayout::Pair;
  std::optional<bool> processes{};  ///< a process for each wall, or a thread; null: what measured faster
  /// True: each wall is drawn on processors of its own; null: the setting that measured faster.
  std::optional<bool> pinned{};
  std::optional<unsigned> rasteriserThreads{};  ///< if the environment gives them
  std::optional<Nanoseconds> ahead{};           ///< how far the head is predicted, as HeadTiming has it
  std::optional<HeadReach> latch{};             ///< Draw takes the newest pose of the head, within this reach

  /// How the head's pose is kept young. The walls are culled for it.
  HeadTiming headFor(std::vector<WallViews>& walls) const;
};

}  // namespace stadion
