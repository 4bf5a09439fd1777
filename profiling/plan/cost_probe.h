#pragma once
/// Measures what the stages cost, for a plan: processor time of the thread that runs all of them, and of the
/// threads that work for it meanwhile (the rasteriser's for Draw, the crew for App).
///
/// Expects a sequential run, in which nobody else of the process works.
///
/// Threads  told on the thread of the frame loop; what the crew tells is not looked at.

#include "engine/core/frame_probe.h"
#include "profiling/plan/schedule.h"

#include <map>

namespace stadion::plan {

class CostProbe final : public FrameProbe {
public:
  /// `from`: frames before it are left out, since what is touched for the first time is slow.
  CostProbe(std::size_t walls, std::uint64_t from) : walls_(walls), from_(from) {}

  void began(Span what, std::uint64_t frame, std::uint32_t wall) override;
  void began(Span what, NodeRef node) override;
  void ended(Span what) override;

  /// The frames that are complete, by their number.
  std::map<std::uint64_t, FrameCost> costs() const;
  /// Whether pictures are rasterised before their calls return, as llvmpipe does; else while Draw waits at
  /// its end.
  bool waitsInTurn() const { return inTurn_ >= 0.5 * rastered_; }

private:
  struct Moment {
    double own = 0;      ///< processor time of this thread [ms]
    double process = 0;  ///< of all threads
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
  std::uint32_t wall_ = 0;
  Moment began_;
  std::vector<Moment> picturesEnd_;   ///< of the wall that is drawn
  double inTurn_ = 0, rastered_ = 0;  ///< in all
  std::map<std::uint64_t, Seen> frames_;
};

/// Frame by frame, figure by figure, the middle one of several runs of the same frames.
std::vector<FrameCost> typicalCosts(const std::vector<std::map<std::uint64_t, FrameCost>>& runs);

/// So many of the rasteriser's threads work at a time as in the tenth of the frames that was disturbed least:
/// for machines on which nobody else works.
void assumeUndisturbed(std::vector<FrameCost>& frames);

/// What is planned with: the typical costs of these runs, undisturbed.
std::vector<FrameCost> plannedCosts(const std::vector<std::map<std::uint64_t, FrameCost>>& runs);

/// Whether others had the processors while it was measured: the rasteriser's threads, with a millisecond or
/// more to do, had less than half a processor together.
bool wasStarved(const std::vector<FrameCost>& frames);

}  // namespace stadion::plan
