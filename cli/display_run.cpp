#include "cli/display_run.h"

#include "cli/operator_keys.h"

#include <chrono>
#include <cstdio>
#include <thread>

namespace stadion {
namespace {

constexpr std::chrono::milliseconds kNap{1};  ///< while there is nothing new to show

WindowStereo windowStereoOf(StereoLayout layout) {
  switch (layout) {
  case StereoLayout::Pair: return WindowStereo::Quad;
  case StereoLayout::SideBySide: return WindowStereo::SideBySide;
  case StereoLayout::TopBottom: return WindowStereo::TopBottom;
  case StereoLayout::Anaglyph: return WindowStereo::Anaglyph;
  case StereoLayout::Interlaced: return WindowStereo::Interlaced;
  case StereoLayout::Off: break;
  }
  return WindowStereo::Mono;
}

/// The same keys as in the terminal.
std::optional<OperatorCommand> orderOf(Key key) {
  if (key == Key::Escape) return OperatorCommand{OperatorAction::End};
  if (key == Key::Enter) return operatorCommandOf('\n');
  const auto code = static_cast<std::uint32_t>(key);
  if (code >= 127) return {};
  const char c = static_cast<char>(code);
  return operatorCommandOf(c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c);
}

}  // namespace

std::unique_ptr<DisplayRun> DisplayRun::open(const RunOptions& options, const WallFile& walls,
                                             Diagnostics& findings) {
  std::unique_ptr<DisplayRun> run(new DisplayRun(options, walls));
  run->displays_ = WallDisplays::open(walls, windowStereoOf(options.layout), options.show.width,
                                      options.show.height, findings);
  return run->displays_ ? std::move(run) : nullptr;
}

void DisplayRun::fitPictures(std::vector<WallView>& views) const {
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!options_.show.size.empty() || walls_.walls[i].pixels.width > 0) continue;
    const auto [width, height] = displays_->pictureSize(i);
    views[i].width = width, views[i].height = height;
  }
}

FrameLoopOutcome DisplayRun::play(FrameLoop& loop, OperatorQueue& orders) {
  FrameLoopOutcome outcome;
  std::atomic<bool> over = false;
  std::thread playing([&] {
    outcome = loop.run();
    over = true;
  });
  std::vector<EyePictures> pictures;
  TimeSignature shown;
  bool told = false;
  while (!over) {
    const std::vector<Key> keys = displays_->poll();
    if (!told && !pictures.empty()) {
      std::fprintf(stderr, "the walls are shown; Escape ends the show\n");
      told = true;
    }
    for (const Key key : keys)
      if (const auto order = orderOf(key)) orders.post(*order);
    if (mailbox_.fetch(pictures, shown))
      displays_->show(pictures);
    else
      std::this_thread::sleep_for(kNap);
  }
  playing.join();
  return outcome;
}

}  // namespace stadion
