#include "cli/walls/wall_pattern.h"

#include "cli/exit_code.h"
#include "cli/terminal.h"
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

int writePatterns(const WallFile& walls, HallPatterns& patterns, const PatternOptions& options) {
  std::error_code none;
  std::filesystem::create_directories(options.out, none);
  for (std::size_t i = 0; i < walls.walls.size(); ++i) {
    const WallEntry& entry = walls.walls[i];
    const bool stated = entry.pixels.width > 0;
    const std::vector<Picture> pictures =
        patterns.pictures(i, options.pattern, stated ? entry.pixels.width : options.width,
                          stated ? entry.pixels.height : options.height);
    const std::size_t first = entry.projector && entry.projector->eye == Eye::Right ? 1 : 0;
    for (std::size_t e = 0; e < pictures.size(); ++e) {
      const std::string path = options.out + "/" + entry.wall.name + "-" + eyeName(kEyes[first + e]) + ".png";
      if (const auto wrong = writePng(path, pictures[e])) {
        std::fprintf(stderr, "stadion: %s\n", format(*wrong).c_str());
        return kBadInput;
      }
      std::printf("%s\n", path.c_str());
    }
  }
  return kOk;
}

/// True if the pictures are there and fit the output, or have a size of their own.
bool fits(const EyePictures& pictures, const WallEntry& entry, std::uint32_t width, std::uint32_t height) {
  if (pictures.eyes.empty()) return false;
  return !entry.isFlat() || (pictures.eyes[0].width == width && pictures.eyes[0].height == height);
}

}  // namespace

int showPattern(const WallFile& walls, const PatternOptions& options, const std::atomic<bool>& stop) {
  Diagnostics findings;
  const bool stereo = options.out.empty() ? options.windowStereo != WindowStereo::Mono : options.stereo;
  const auto patterns = HallPatterns::create(walls, stereo);
  if (!patterns) {
    findings.add(patterns.error());
    return exitWith(findings, kBadInput);
  }
  if (!options.out.empty()) return writePatterns(walls, *patterns.value(), options);
  const auto displays =
      WallDisplays::open(walls, windowSurface(false, options.windowStereo), options.windowStereo,
                         options.width, options.height, SwapSync::Off, findings);
  printFindings(findings);
  if (!displays) return kBadInput;
  std::vector<EyePictures> pictures(walls.walls.size());
  std::fprintf(stderr, "the test pattern stays until Escape or Ctrl-C\n");
  for (;;) {
    bool changed = false;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      const auto [width, height] = displays->pictureSize(i);
      if (fits(pictures[i], walls.walls[i], width, height)) continue;
      pictures[i].eyes = patterns.value()->pictures(i, options.pattern, width, height);
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
