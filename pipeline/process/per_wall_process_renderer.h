#pragma once
/// Draws each wall in a process of its own (the program `stadion-wall`).
///
/// A software rasteriser serialises all contexts of one process, but not those of several processes. A driver
/// that crashes or hangs ends only the process of its wall. A new process replaces it, and the wall keeps its
/// last picture until the new process has drawn.
///
/// Every   if every frame counts, a new process draws the frame again until its pictures are there. If four
///         processes in a row die on one frame, or before they are ready, the run ends.
/// Latest  if the newest frame counts, the other walls wait for a late wall for a limited time
///         (answer_deadline.h). They do not wait for the first picture of a new process. The late wall shows
///         its last picture until its process answers. After repeated crashes, a process starts after a
///         growing pause (restarts.h).

#include "engine/asset/mesh_store.h"
#include "pipeline/platform/processor_set.h"
#include "pipeline/process/wall_process.h"
#include "pipeline/shader/look.h"
#include "pipeline/wall/wall_renderer.h"

#include <functional>
#include <memory>
#include <vector>

namespace stadion {

struct PerWallProcessParts {
  const MeshStore& meshes;
  std::vector<WallPicture> walls;
  std::vector<std::string> names;  ///< names of the walls
  RenderQuality quality{};
  RendererKind renderer = RendererKind::OsMesa;
  /// Rasteriser threads of each process; 0: the drawing thread makes the pixels.
  std::uint32_t rasteriserThreads = 0;
  bool everyFrame = true;
  double rate = 60;                ///< [1/s]
  std::function<bool()> giveUp{};  ///< once true, drawing ends with RunStopped
  /// Receives reports about a process; called on its wall's Draw thread.
  std::function<void(const std::string&)> tell{};
  std::filesystem::path program = wall_process::wallProgram();
  std::vector<ProcessorSet> processors{};  ///< by wall: those that its process may use; none: all of them
};

class PerWallProcessRenderer final : public WallRenderer {
public:
  explicit PerWallProcessRenderer(PerWallProcessParts parts);
  ~PerWallProcessRenderer() override;

  Failure open(std::size_t wall) override;
  Failure warmUp(std::size_t wall, const DrawList& list) override;
  DrawOutcome draw(std::size_t wall, const DrawList& list, bool read) override;
  Failure read(std::size_t wall, std::uint32_t view, std::span<std::uint8_t> rgba) override;
  void close(std::size_t wall) override;
  ViewTotals totals(std::size_t wall) const override;
  std::string drawnBy(std::size_t wall) const override;

  /// The process that draws the wall; 0 if there is none (for tests that kill it).
  int pid(std::size_t wall) const;

private:
  struct Wall;
  using Milliseconds = std::chrono::milliseconds;

  Failure drawEvery(Wall& wall, const DrawList& list, bool read, bool warmUp = false);
  DrawOutcome drawNewest(Wall& wall, const DrawList& list, bool read);
  Failure lookAfter(Wall& wall);
  static void begin(Wall& wall, const DrawList& list, bool read, bool warmUp = false);
  static Milliseconds deadlineOf(const Wall& wall);
  static void hasDrawn(Wall& wall, const ViewTotals& totals);
  void drewInTime(Wall& wall);
  bool await(Wall& wall, Milliseconds atMost);
  bool awaitInTime(Wall& wall);
  static void noteProgress(Wall& wall);
  bool hangs(const Wall& wall) const;
  std::chrono::milliseconds longestFrameOf(const Wall& wall) const;
  Failure start(Wall& wall);
  void died(Wall& wall, const std::string& how);
  Failure answered(Wall& wall);
  void report(const Wall& wall, const std::string& what) const;

  PerWallProcessParts parts_;
  wall_process::SharedMeshes sharedMeshes_;
  std::vector<std::unique_ptr<Wall>> walls_;
};

}  // namespace stadion
