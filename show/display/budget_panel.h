#pragma once
/// The frame budget as a panel of text, for windows and for walls on real displays.
///
/// Threads  pure functions.

#include "pipeline/loop/show_stages.h"
#include "pipeline/picture/text_panel.h"
#include "profiling/record/live_budget.h"

#include <string>
#include <vector>

namespace stadion {

/// The numbers of the frame budget.
struct BudgetNumbers {
  std::string show;
  double seconds = 0;  ///< show time
  double rate = 60;    ///< frames a second that are wanted
  double speed = 1;
  bool paused = false;
  FrameBudget budget;
  std::vector<std::string> given;  ///< present savings of the show and its nodes, a line each
  std::uint64_t dropped = 0;       ///< frames that were due, but have not been shown
};

std::vector<PanelLine> budgetLines(const BudgetNumbers& numbers);

/// Lays the lines over the upper left corner of each picture of a wall.
void layPanel(const std::vector<PanelLine>& lines, EyePictures& wall);

}  // namespace stadion
