#include "show/display/display_run.h"

#include "show/console/operator_keys.h"

#include <chrono>
#include <filesystem>
#include <thread>
#include <utility>

namespace stadion {
namespace {

constexpr std::chrono::milliseconds kNap{1};  ///< while there is nothing new to show

/// The same keys as in the terminal.
std::optional<OperatorCommand> windowOrderOf(Key key) {
  if (key == Key::Escape) return OperatorCommand{OperatorAction::End};
  return operatorCommandOf(key);
}

}  // namespace

std::unique_ptr<DisplayRun> DisplayRun::open(const ShowOptions& show, bool drawnWithOpenGl,
                                             StereoLayout layout, const WallFile& walls,
                                             const LiveBudget& budget, bool hud, SwapSync sync,
                                             Reporter& reporter, Diagnostics& findings) {
  std::unique_ptr<DisplayRun> run(new DisplayRun(show, walls, budget, hud, reporter));
  const WindowStereo stereo = windowStereo(layout);
  run->displays_ = WallDisplays::open(walls, windowSurface(drawnWithOpenGl, stereo), stereo, show.width,
                                      show.height, sync, findings);
  if (run->displays_ && !run->displays_->swapSync().empty()) reporter.say(run->displays_->swapSync());
  return run->displays_ ? std::move(run) : nullptr;
}

void DisplayRun::fitPictures(std::vector<WallViews>& walls) const {
  for (std::size_t i = 0; i < walls.size(); ++i) {
    if (!show_.size.empty() || walls_.walls[i].pixels.width > 0) continue;
    const auto [width, height] = displays_->pictureSize(i);
    walls[i].width = width;
    walls[i].height = height;
  }
}

FrameLoopOutcome DisplayRun::play(FrameLoop& loop, OperatorConsole& console) {
  FrameLoopOutcome outcome;
  std::vector<EyePictures> pictures;
  TimeSignature now;
  mailbox_.fetch(pictures, now);  // what the group before has left is not this one's
  std::atomic<bool> over = false;
  std::thread playing([&] {
    outcome = loop.run();
    over = true;
  });
  while (!over) {
    if (!takeKeys(console) || !mailbox_.fetch(pictures, now)) {
      std::this_thread::sleep_for(kNap);
      continue;
    }
    countUnshown(now.frame);
    if (hud_ && !pictures.empty()) layPanel(budgetLines(budgetNumbers(now, console)), pictures.front());
    displays_->show(pictures);
    console.pictureSeen();
    if (!std::exchange(shown_, true)) reporter_.hint("the walls are shown; Escape ends the show");
  }
  playing.join();
  return outcome;
}

BudgetNumbers DisplayRun::budgetNumbers(const TimeSignature& now, OperatorConsole& console) const {
  BudgetNumbers f;
  f.show = std::filesystem::path(show_.script).filename().string();
  f.seconds = toSeconds(now.time);
  f.rate = show_.rate;
  f.speed = console.playback().speed();
  f.paused = console.playback().paused();
  f.budget = budget_.now();
  f.dropped = unshown_;
  return f;
}

/// Frames that others have replaced before they were fetched. A new group begins at 0.
void DisplayRun::countUnshown(std::uint64_t frame) {
  if (frame > newest_ + 1) unshown_ += frame - newest_ - 1;
  if (frame < newest_) unshown_ = 0;
  newest_ = frame;
}

bool DisplayRun::takeKeys(OperatorConsole& console) {
  for (const Key key : displays_->poll()) {
    if (key == Key::F2) hud_ = !hud_;
    if (const auto order = windowOrderOf(key)) console.queue().post(*order);
  }
  const auto lost = displays_->lost();
  if (lost) mailbox_.close(*lost);  // the next frame's pictures are refused, and all stages stop
  return !lost;
}

}  // namespace stadion
