#pragma once
/// The text over the walls in a window: the frame budget, the help, and messages.
///
/// Threads  say() from any, the rest on the main thread.

#include "pipeline/picture/text_panel.h"
#include "profiling/record/live_budget.h"

#include <chrono>
#include <mutex>
#include <string>
#include <vector>

namespace stadion {

/// The figures of the frame budget.
struct HudFigures {
  std::string show;
  double seconds = 0;  ///< show time
  double rate = 60;    ///< frames a second that are wanted
  double speed = 1;
  bool paused = false;
  FrameBudget budget;
  std::vector<std::string> given;  ///< what the show and nodes give up at the moment, a line each
  std::uint64_t dropped = 0;       ///< frames that were due, but have not been shown
};

class ViewHud {
public:
  /// A line that disappears after some seconds.
  void say(const std::string& line);
  /// Lines that stay until others take their place; none takes them away.
  void setTrouble(const std::vector<std::string>& lines);

  bool helpShown = false, budgetShown = false;

  std::vector<PanelLine> budgetLines(const HudFigures& figures) const;
  std::vector<PanelLine> helpLines() const;
  /// Messages and trouble; none = empty.
  std::vector<PanelLine> messageLines() const;

private:
  using Clock = std::chrono::steady_clock;
  struct Message {
    std::string text;
    Clock::time_point until;
  };
  mutable std::mutex mutex_;
  std::vector<Message> messages_;
  std::vector<std::string> trouble_;
};

}  // namespace stadion
