#pragma once
/// Draws each wall in a process of its own (the program `stadion-wall`).
///
/// A software rasteriser serialises all contexts of a process; of several processes it does not. And a driver
/// that crashes or hangs takes its own wall with it only: the process is replaced, and the wall keeps its
/// last picture until the new one has drawn.
///
/// Where every frame counts, a frame is drawn again by the new process until its pictures are there, and
/// nothing is lost; when four in a row have died of it, whoever killed them, or before they were ready, the
/// run ends. Where the newest counts, the other walls wait
/// for one that is late only so long (patience.h), and for what a new process draws first not at all; from
/// then on it shows what it has until it answers, and processes that die one after the other are started
/// after growing pauses (restarts.h).

#include "engine/asset/mesh_store.h"
#include "pipeline/process/wall_worker.h"
#include "pipeline/wall/drawing_here.h"
#include "pipeline/wall/wall_drawing.h"

#include <functional>
#include <memory>
#include <vector>

namespace stadion {

struct DrawingInWorkersParts {
  const MeshStore& meshes;
  std::vector<PictureSize> walls;
  std::vector<std::string> names;  ///< of the walls
  RenderQuality quality{};
  bool egl = false;                     ///< else OSMesa
  std::uint32_t rasteriserThreads = 0;  ///< of each process; 0: none but the one that draws
  bool everyFrame = true;
  double rate = 60;                                ///< [1/s]
  std::function<bool()> giveUp{};                  ///< once true, drawing ends with RunStopped
  std::function<void(const std::string&)> tell{};  ///< what became of a process; on its wall's Draw thread
  std::filesystem::path program = worker::wallProgram();
  std::vector<ProcessorSet> processors{};  ///< by wall: those that its process may use; none: all of them
};

class DrawingInWorkers final : public WallDrawing {
public:
  explicit DrawingInWorkers(DrawingInWorkersParts parts);
  ~DrawingInWorkers() override;

  Failure open(std::size_t wall) override;
  Failure warmUp(std::size_t wall, const DrawList& list) override;
  DrawOutcome draw(std::size_t wall, const DrawList& list, bool read) override;
  Failure read(std::size_t wall, std::uint32_t view, std::span<std::uint8_t> rgba) override;
  void close(std::size_t wall) override;
  ViewTotals totals(std::size_t wall) const override;
  std::string glDescription(std::size_t wall) const override;

  /// The process that draws the wall; 0 while there is none (for tests that kill it).
  int pid(std::size_t wall) const;

private:
  struct Wall;
  using Milliseconds = std::chrono::milliseconds;

  Failure drawEvery(Wall& wall, const DrawList& list, bool read, bool warmUp = false);
  DrawOutcome drawNewest(Wall& wall, const DrawList& list, bool read);
  Failure lookAfter(Wall& wall);
  static void begin(Wall& wall, const DrawList& list, bool read, bool warmUp = false);
  static Milliseconds patience(const Wall& wall);
  static void hasDrawn(Wall& wall, const ViewTotals& totals);
  void drewInTime(Wall& wall);
  bool await(Wall& wall, Milliseconds atMost);
  bool awaitInTime(Wall& wall);
  bool hangs(Wall& wall);
  std::chrono::milliseconds mostOf(const Wall& wall) const;
  Failure start(Wall& wall);
  void died(Wall& wall, const std::string& how);
  Failure answered(Wall& wall);
  void tell(const Wall& wall, const std::string& what) const;

  DrawingInWorkersParts parts_;
  worker::MeshParcels parcels_;
  std::vector<std::unique_ptr<Wall>> walls_;
};

}  // namespace stadion
