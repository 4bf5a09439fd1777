#pragma once
/// Counts of what a renderer draws. They are the same on every machine, so tests may pin them. A graphics card
/// draws the same in fewer calls (RenderQuality::submission).

#include "pipeline/draw_list/draw_list.h"

#include <array>
#include <cstdint>

namespace stadion {

/// Counts of one view's last picture.
struct DrawCounts {
  std::uint32_t calls = 0;      ///< draw calls
  std::uint32_t instances = 0;  ///< drawn meshes; an instance with two parts counts twice
  std::uint64_t triangles = 0;

  void add(const DrawCounts& c) {
    calls += c.calls;
    instances += c.instances;
    triangles += c.triangles;
  }
};

/// Sums over all pictures so far. Shadow maps are not counted.
struct DrawTotals {
  std::uint64_t frames = 0, calls = 0, instances = 0, triangles = 0;
  void add(const DrawCounts& c) { add({1, c.calls, c.instances, c.triangles}); }
  void add(const DrawTotals& t) {
    frames += t.frames;
    calls += t.calls;
    instances += t.instances;
    triangles += t.triangles;
  }
};

using ViewTotals = std::array<DrawTotals, DrawList::kMostViews>;  ///< by view of a wall

}  // namespace stadion
