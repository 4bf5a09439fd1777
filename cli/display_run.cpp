#include "cli/display_run.h"

#include <algorithm>
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

FrameLoopOutcome DisplayRun::play(FrameLoop& loop, const std::function<void()>& end) {
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
    if (std::ranges::find(keys, Key::Escape) != keys.end()) end();
    if (mailbox_.fetch(pictures, shown))
      displays_->show(pictures);
    else
      std::this_thread::sleep_for(kNap);
  }
  playing.join();
  return outcome;
}

}  // namespace stadion
