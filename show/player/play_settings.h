#pragma once
/// When the frames of a show are played: each one or the newest, by the clock or as fast as possible.

#include "pipeline/target/swap_group.h"
#include "profiling/budget/stress_filter.h"
#include "show/player/player.h"

namespace stadion {

struct PlaySettings {
  /// Every frame is played and shown, because its result is kept or because an input log says when it was.
  /// Else the show is live: it follows the clock, and a frame that comes late is left out.
  bool everyFrame = false;
  Pace pace = Pace::Lock;              ///< Free: as fast as possible
  bool display = false;                ///< the walls are shown on their real outputs
  bool hud = false;                    ///< the frame budget is shown on the first of them
  SwapSync swapSync = SwapSync::Auto;  ///< what the driver does so that windows swap together
  bool windows = false;                ///< a person looks at the walls in windows, and is the visitor
  std::size_t mostInFlight = 0;        ///< frames in flight at most; 0: as many as the stages hold
  bool drawBeginsEarly =
      true;            ///< Draw begins with the first part of a frame's list; else it waits for all of it
  bool guard = false;  ///< writes of a stage to what it may only read end the show
  bool degradationControl =
      true;                ///< a live show applies what its script says (onoverrun) if frames take too long
  StressOptions stress{};  ///< stress control of the whole show

  /// Returns true if every frame counts in this show: because of `everyFrame`, or because its input log holds
  /// what a clock decided.
  bool everyFrameCounts(const Player& player) const;
  /// Returns true if the show is the same in every run: every frame counts, or a log alone decides what
  /// happens.
  bool repeats(const Player& player) const;
  FrameLoopOptions loopOptions(const Player& player) const;
};

}  // namespace stadion
