#pragma once
/// A run on real displays: the frame loop plays on threads of its own, while the main thread owns the
/// windows.
///
/// Threads  main.

#include "pipeline/loop/picture_mailbox.h"
#include "show/console/operator_console.h"
#include "show/display/budget_panel.h"
#include "show/display/wall_displays.h"

#include <atomic>
#include <memory>

namespace stadion {

class DisplayRun {
public:
  /// Opens the outputs. Null if one cannot be opened; the findings say which and why.
  /// `drawnWithOpenGl`: true if the walls are drawn with OpenGL; then the windows may use OpenGL too.
  /// `budget` must outlive the run. `hud`: true if the frame budget is shown from the start.
  static std::unique_ptr<DisplayRun> open(const ShowOptions& show, bool drawnWithOpenGl, StereoLayout layout,
                                          const WallFile& walls, const LiveBudget& budget, bool hud,
                                          SwapSync sync, Reporter& reporter, Diagnostics& findings);

  PictureSink& sink() { return mailbox_; }
  /// The walls' pictures fill their outputs pixel by pixel, unless --size or the wall file says otherwise.
  void fitPictures(std::vector<WallViews>& walls) const;
  /// Plays the loop to its end. Keys pressed in the windows are the operator's (docs/operator.md); F2 shows
  /// or hides the frame budget on the first wall; Escape ends the run.
  FrameLoopOutcome play(FrameLoop& loop, OperatorConsole& console);
  /// Keys pressed since the last call become commands. False if the display was lost: then the run fails.
  bool takeKeys(OperatorConsole& console);
  /// Why nothing can be shown any more; nothing while it can.
  std::optional<std::string> lost() const { return displays_->lost(); }

private:
  DisplayRun(const ShowOptions& show, const WallFile& walls, const LiveBudget& budget, bool hud,
             Reporter& reporter)
      : show_(show), walls_(walls), budget_(budget), reporter_(reporter), hud_(hud) {}
  BudgetNumbers budgetNumbers(const TimeSignature& now, OperatorConsole& console) const;
  void countUnshown(std::uint64_t frame);

  const ShowOptions& show_;
  const WallFile walls_;  ///< a copy: the next group's show has walls of its own
  const LiveBudget& budget_;
  Reporter& reporter_;
  std::unique_ptr<WallDisplays> displays_;
  bool hud_;
  std::uint64_t newest_ = 0, unshown_ = 0;  ///< frame that is shown; frames that were not
  PictureMailbox mailbox_;
  bool shown_ = false;  ///< a picture has been shown
};

}  // namespace stadion
