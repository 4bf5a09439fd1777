#include "cli/walls/wall_pattern.h"

#include "cli/exit_code.h"
#include "cli/terminal.h"
#include "pipeline/picture/test_pattern.h"
#include "show/base/stop_signal.h"
#include "show/display/wall_displays.h"
#include "show/player/player.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <thread>

namespace stadion {
namespace {

constexpr std::chrono::milliseconds kLookEvery{20};

EyePictures patternOf(const WallFile& walls, std::size_t wall, bool stereo, std::uint32_t width,
                      std::uint32_t height) {
  EyePictures p;
  if (!stereo) p.eyes.push_back(testPattern(walls, wall, {}, width, height));
  if (stereo)
    for (const Eye eye : kEyes) p.eyes.push_back(testPattern(walls, wall, eye, width, height));
  return p;
}

int writePatterns(const WallFile& walls, const PatternOptions& options) {
  std::error_code none;
  std::filesystem::create_directories(options.out, none);
  for (std::size_t i = 0; i < walls.walls.size(); ++i) {
    const WallEntry& entry = walls.walls[i];
    const bool stated = entry.pixels.width > 0;
    const EyePictures p = patternOf(walls, i, options.stereo, stated ? entry.pixels.width : options.width,
                                    stated ? entry.pixels.height : options.height);
    for (std::size_t e = 0; e < p.eyes.size(); ++e) {
      const std::string path = options.out + "/" + entry.wall.name + "-" + eyeName(kEyes[e]) + ".png";
      if (const auto wrong = writePng(path, p.eyes[e])) {
        std::fprintf(stderr, "stadion: %s\n", format(*wrong).c_str());
        return kBadInput;
      }
      std::printf("%s\n", path.c_str());
    }
  }
  return kOk;
}

}  // namespace

int showPattern(const WallFile& walls, const PatternOptions& options, const std::atomic<bool>& stop) {
  if (!options.out.empty()) return writePatterns(walls, options);
  Diagnostics findings;
  const auto displays = WallDisplays::open(walls, windowSurface(false, options.windowStereo),
                                           options.windowStereo, options.width, options.height, findings);
  printFindings(findings);
  if (!displays) return kBadInput;
  std::vector<EyePictures> pictures(walls.walls.size());
  std::fprintf(stderr, "the test pattern stays until Escape or Ctrl-C\n");
  for (;;) {
    bool changed = false;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const auto [width, height] = displays->pictureSize(i);
      if (!pictures[i].eyes.empty() && pictures[i].eyes[0].width == width &&
          pictures[i].eyes[0].height == height)
        continue;
      pictures[i] = patternOf(walls, i, options.windowStereo != WindowStereo::Mono, width, height);
      changed = true;
    }
    displays->show(pictures);
    const std::vector<Key> keys = displays->poll();
    if (changed) std::fprintf(stderr, "the walls are shown\n");
    if (std::ranges::find(keys, Key::Escape) != keys.end()) return kOk;
    if (stop) return kStopped + stopSignal();
    if (const auto lost = displays->lost()) {
      std::fprintf(stderr, "stadion: %s\n", lost->c_str());
      return kInternalFault;
    }
    std::this_thread::sleep_for(kLookEvery);
  }
}

}  // namespace stadion
