#pragma once
/// Counts of a run's frames that are not in every summary: spheres tested and seen, casters of shadows,
/// pixels, impacts, contacts, substeps, records published. They count work, not time, and are equal on every
/// machine.
///
/// Threads  called on the threads that do the work; read when the run is over.
/// Errors   none.

#include "engine/core/frame_probe.h"

#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

namespace stadion::regression {

class WorkCounts final : public FrameProbe {
public:
  void began(Span what, std::uint64_t frame, std::uint32_t wall) override;
  void began(Span what, NodeRef node) override;
  void ended(Span) override {}
  void counted(Count what, std::uint64_t amount, NodeRef node) override;

  /// Returns the sums over all frames, by name: "tested front", "pixels front left", "contacts".
  std::map<std::string, double> totals(const std::vector<std::string>& walls) const;

private:
  /// A thread's position.
  struct Place {
    std::uint32_t wall = kNoWall;
    int eye = -1;  ///< 0 left or the only one, 1 right; -1: in none
  };

  mutable std::mutex mutex_;  ///< guards the members below
  std::map<std::thread::id, Place> places_;
  std::map<std::tuple<Count, std::uint32_t, int>, std::uint64_t> totals_;
};

}  // namespace stadion::regression
