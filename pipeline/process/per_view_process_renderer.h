#pragma once
/// Draws each view of each wall in a process of its own, all views of a wall at once. On many processors a
/// wall with two views takes half the time. On few processors none is idle while the most expensive wall is
/// finished. Each process would draw the shadow maps that the views share, so this serves the plain look.
///
/// Threads  one of its own for each view but the first of each wall.

#include "pipeline/process/per_wall_process_renderer.h"
#include "pipeline/process/processor_places.h"

#include <memory>
#include <vector>

namespace stadion {

class PerViewProcessRenderer final : public WallRenderer {
public:
  /// `views`: how many each wall has, from 1 to DrawList::kMostViews.
  PerViewProcessRenderer(PerWallProcessParts parts, const std::vector<std::uint32_t>& views);
  ~PerViewProcessRenderer() override;

  Failure open(std::size_t wall) override;
  Failure warmUp(std::size_t wall, const DrawList& list) override;
  DrawOutcome draw(std::size_t wall, const DrawList& list, bool read) override;
  Failure read(std::size_t wall, std::uint32_t view, std::span<std::uint8_t> rgba) override;
  void close(std::size_t wall) override;
  ViewTotals totals(std::size_t wall) const override;
  std::string drawnBy(std::size_t wall) const override;
  /// The process that draws that view.
  int pid(std::size_t wall, std::uint32_t view) const;

private:
  struct View;
  struct Wall;

  DrawOutcome drawView(View& view, bool read);

  const ProcessorSet processors_;
  wall_process::ProcessorPlaces places_;
  bool bindsProcesses_;  ///< to one at a time; else they have threads for more, or processors of their own
  std::vector<std::unique_ptr<Wall>> walls_;
  std::unique_ptr<PerWallProcessRenderer> views_;  ///< draws each view as a wall with one view
};

}  // namespace stadion
