#pragma once
/// Measures the costs of the stages, for a plan: processor time of the thread that runs all of them, and of
/// the threads that work for it meanwhile (the rasteriser's for Draw, the worker pool for App).
///
/// Expects a sequential run in which no other thread of the process works.
///
/// Threads  called on the thread of the frame loop; calls from pool threads are ignored.

#include "engine/core/frame_probe.h"
#include "profiling/plan/schedule.h"

#include <map>

namespace stadion::plan {

class CostProbe final : public FrameProbe {
public:
  /// `from`: the first frame that counts, since first use of data is slow. `portion`: Draw begins early once
  /// a list has so many items.
  CostProbe(std::size_t walls, std::uint64_t from, std::size_t portion)
      : walls_(walls), from_(from), portion_(portion) {}

  void began(Span what, std::uint64_t frame, std::uint32_t wall) override;
  void began(Span what, NodeRef node) override;
  void ended(Span what) override;
  void counted(Count what, std::uint64_t count, NodeRef node) override;

  /// Returns the complete frames, by their number.
  std::map<std::uint64_t, FrameCost> costs() const;
  /// Returns true if pictures are rasterised before their calls return, as in llvmpipe; else Draw waits at
  /// its end.
  bool waitsInTurn() const { return inTurn_ >= 0.5 * rastered_; }

private:
  struct Moment {
    double own = 0;      ///< processor time of this thread [ms]
    double process = 0;  ///< processor time of all threads
    double time = 0;
    static Moment now();
  };
  struct Seen {
    FrameCost cost;
    std::size_t drawn = 0;
    bool swapped = false;
  };

  void endStage(Span what, const Moment& now);
  void endDraw(WallCost& wall, const Moment& now);

  std::size_t walls_;
  std::uint64_t from_, frame_ = 0;
  std::size_t portion_;
  std::uint32_t wall_ = 0;
  Moment began_, fillBegan_;
  double fill_ = 0;                   ///< time of the newest Span::Fill: Cull's last one writes the list
  std::vector<Moment> picturesEnd_;   ///< times at which the pictures of the current wall ended
  double inTurn_ = 0, rastered_ = 0;  ///< in all
  std::map<std::uint64_t, Seen> frames_;
};

/// Returns the median of several runs of the same frames, for each frame and each figure.
std::vector<FrameCost> typicalCosts(const std::vector<std::map<std::uint64_t, FrameCost>>& runs);

/// Sets the number of rasteriser threads working at a time to that of the least disturbed tenth of the
/// frames: for machines without other load.
void assumeUndisturbed(std::vector<FrameCost>& frames);

/// Returns the costs for planning: the typical costs of these runs, undisturbed.
std::vector<FrameCost> plannedCosts(const std::vector<std::map<std::uint64_t, FrameCost>>& runs);

/// Returns true if other programs had the processors during the measurement: the rasteriser's threads, with a
/// millisecond or more to do, had less than half a processor together.
bool wasStarved(const std::vector<FrameCost>& frames);

}  // namespace stadion::plan
