#pragma once
/// The text over the walls in a window: the help and messages, and which panels are shown.
///
/// Threads  say() from any, the rest on the main thread.

#include "pipeline/picture/text_panel.h"

#include <chrono>
#include <mutex>
#include <string>
#include <vector>

namespace stadion {

class ViewHud {
public:
  /// A line that disappears after some seconds.
  void say(const std::string& line);
  /// Lines that stay until others take their place; none takes them away.
  void setTrouble(const std::vector<std::string>& lines);

  bool helpShown = false, budgetShown = false;

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
