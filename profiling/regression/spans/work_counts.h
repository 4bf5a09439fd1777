#pragma once
/// What a run's frames counted beside what every summary has: spheres tested and seen, casters of shadows,
/// pixels, impacts, contacts, substeps, records published. Work, not time: the same on every machine.
///
/// Threads  told on the threads that do the work; read when the run is over.
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

  /// Of all frames, by name: "tested front", "pixels front left", "contacts".
  std::map<std::string, double> totals(const std::vector<std::string>& walls) const;

private:
  /// Where a thread is.
  struct Place {
    std::uint32_t wall = kNoWall;
    int eye = -1;  ///< 0 left or the only one, 1 right; -1: in none
  };

  mutable std::mutex mutex_;  ///< of what follows
  std::map<std::thread::id, Place> places_;
  std::map<std::tuple<Count, std::uint32_t, int>, std::uint64_t> totals_;
};

}  // namespace stadion::regression
