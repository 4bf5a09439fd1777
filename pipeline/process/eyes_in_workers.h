#pragma once
/// Draws each eye of each wall in a process of its own, both at once: on many processors a wall is there in
/// half the time, and on few of them none is idle while the dearest wall is finished. Shadow maps, which both
/// eyes share, would be drawn twice: it is for the plain look.
///
/// Threads  one of its own for each wall with two eyes.

#include "pipeline/process/drawing_in_workers.h"
#include "pipeline/process/processor_places.h"

#include <memory>
#include <vector>

namespace stadion {

class EyesInWorkers final : public WallDrawing {
public:
  /// `eyes`: how many each wall has, 1 or 2.
  EyesInWorkers(DrawingInWorkersParts parts, const std::vector<std::uint32_t>& eyes);
  ~EyesInWorkers() override;

  Failure open(std::size_t wall) override;
  Failure warmUp(std::size_t wall, const DrawList& list) override;
  DrawOutcome draw(std::size_t wall, const DrawList& list, bool read) override;
  Failure read(std::size_t wall, std::uint32_t eye, std::span<std::uint8_t> rgba) override;
  void close(std::size_t wall) override;
  std::array<DrawTotals, 2> totals(std::size_t wall) const override;
  std::string glDescription(std::size_t wall) const override;
  /// Who draws that eye.
  int pid(std::size_t wall, std::uint32_t eye) const;

private:
  struct Wall;

  DrawOutcome drawEye(Wall& wall, std::uint32_t eye, bool read);

  const ProcessorSet processors_;
  worker::ProcessorPlaces places_;
  bool bindsProcesses_;  ///< to one at a time; else they have threads for more, or processors of their own
  std::vector<std::unique_ptr<Wall>> walls_;
  std::unique_ptr<DrawingInWorkers> eyes_;  ///< each as a wall with one eye
};

}  // namespace stadion
