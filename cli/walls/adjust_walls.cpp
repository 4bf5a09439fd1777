#include "cli/walls/adjust_walls.h"

#include "cli/exit_code.h"
#include "cli/terminal.h"
#include "show/adjust/adjust_pictures.h"
#include "show/base/stop_signal.h"
#include "show/display/wall_displays.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <poll.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace stadion {
namespace {

constexpr std::chrono::milliseconds kAdjustEvery{20};
constexpr std::size_t kMostCommand = 1000;  ///< of a command [bytes]

/// The lines of standard input.
class CommandLines {
public:
  /// Returns the next line; nothing if there is none yet, or `wait` and the input has ended.
  std::optional<std::string> next(bool wait, const std::atomic<bool>& stop) {
    for (;;) {
      if (const std::size_t end = read_.find('\n'); end != std::string::npos) {
        std::string line = read_.substr(0, end);
        read_.erase(0, end + 1);
        return line;
      }
      if (ended_ || !fill(wait)) {
        if (ended_ && !read_.empty()) return std::exchange(read_, {});
        if (ended_ || !wait || stop) return std::nullopt;
      }
    }
  }

private:
  bool fill(bool wait) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (::poll(&input, 1, wait ? 200 : 0) <= 0) return false;
    char bytes[512];
    const ssize_t count = ::read(STDIN_FILENO, bytes, sizeof bytes);
    if (count > 0) read_.append(bytes, static_cast<std::size_t>(count));
    if (read_.size() > kMostCommand && read_.find('\n') == std::string::npos) read_.resize(kMostCommand);
    ended_ = count <= 0;
    return count > 0;
  }

  std::string read_;
  bool ended_ = false;
};

class Adjusting {
public:
  Adjusting(HallAdjuster& adjuster, AdjustPictures& pictures, const AdjustOptions& options)
      : adjuster_(adjuster), pictures_(pictures), options_(options) {}

  void say() const {
    std::printf("%s\n", adjuster_.state().c_str());
    std::fflush(stdout);
  }

  /// Does what a line says.
  void take(const std::string& line) {
    const AdjustWords words = adjustCommandOf(line);
    if (words.command) return take(*words.command);
    if (words.problem.empty()) return;
    std::fprintf(stderr, "stadion: %s\n", words.problem.c_str());
    refused_ = true;
  }

  void take(const AdjustCommand& command) {
    const AdjustOutcome outcome = adjuster_.apply(command);
    if (outcome.changed) pictures_.change(adjuster_.hall(), *outcome.changed);
    refused_ = refused_ || outcome.refused;
    ended_ = outcome.ended;
    said_ = true;
    say();
    if (command.kind == AdjustCommand::Kind::Show) writePictures();
  }

  bool ended() const { return ended_; }
  bool refused() const { return refused_; }
  bool takeSaid() { return std::exchange(said_, false); }

private:
  void writePictures() {
    if (options_.out.empty()) {
      std::fprintf(stderr, "stadion: show needs a folder; start with --out DIR\n");
      refused_ = true;
      return;
    }
    while (pictures_.refresh(adjuster_.hall())) {
    }
    std::error_code none;
    std::filesystem::create_directories(options_.out, none);
    const WallFile& hall = adjuster_.hall();
    for (std::size_t i = 0; i < hall.walls.size(); ++i) {
      const WallEntry& e = hall.walls[i];
      const bool stated = e.pixels.width > 0;
      const std::vector<Picture> shown = pictures_.pictures(
          adjuster_, i, stated ? e.pixels.width : options_.width, stated ? e.pixels.height : options_.height);
      for (std::size_t eye = 0; eye < shown.size(); ++eye)
        if (const auto wrong =
                writePng(options_.out + "/" + e.wall.name + "-" + pictureName(eye) + ".png", shown[eye])) {
          std::fprintf(stderr, "stadion: %s\n", format(*wrong).c_str());
          refused_ = true;
          return;
        }
    }
  }

  HallAdjuster& adjuster_;
  AdjustPictures& pictures_;
  const AdjustOptions& options_;
  bool ended_ = false, refused_ = false, said_ = false;
};

int byCommands(Adjusting& adjusting, const HallAdjuster& adjuster, const std::atomic<bool>& stop) {
  CommandLines lines;
  adjusting.say();
  while (!adjusting.ended()) {
    const auto line = lines.next(true, stop);
    if (!line) break;
    adjusting.take(*line);
  }
  if (stop) return kStopped + stopSignal();
  if (!adjusting.ended() && adjuster.unsaved()) {
    std::fprintf(stderr, "stadion: the commands have ended, and changes are not saved\n");
    return kBadInput;
  }
  return adjusting.refused() ? kBadInput : kOk;
}

/// Windows with the pattern, and what is pressed in them.
class AdjustWindows {
public:
  AdjustWindows(HallAdjuster& adjuster, AdjustPictures& pictures, WallDisplays& displays)
      : adjuster_(adjuster), pictures_(pictures), displays_(displays), shown_(adjuster.hall().walls.size()) {}

  /// Shows what has changed. `marks`: what is chosen, or its place, may have changed.
  void show(bool marks) {
    const WallFile& hall = adjuster_.hall();
    const auto remade = pictures_.refresh(hall);
    for (std::size_t i = 0; i < shown_.size(); ++i) {
      const auto [width, height] = displays_.pictureSize(i);
      const bool fits = !shown_[i].eyes.empty() &&
                        (!hall.walls[i].isFlat() ||
                         (shown_[i].eyes[0].width == width && shown_[i].eyes[0].height == height));
      const bool marked = marks && (i == adjuster_.chosen() || i == before_);
      if (fits && !marked && remade != i) continue;
      shown_[i].eyes = pictures_.pictures(adjuster_, i, width, height);
      if (hall.walls[i].output) displays_.setShape(i, hall.walls[i].output->shape);
    }
    before_ = adjuster_.chosen();
    displays_.show(shown_);
  }

private:
  HallAdjuster& adjuster_;
  AdjustPictures& pictures_;
  WallDisplays& displays_;
  std::vector<EyePictures> shown_;
  std::size_t before_ = 0;  ///< entry that was chosen when the windows were last drawn
};

int inWindows(Adjusting& adjusting, HallAdjuster& adjuster, AdjustPictures& pictures, WallDisplays& displays,
              const std::atomic<bool>& stop) {
  AdjustWindows windows(adjuster, pictures, displays);
  CommandLines lines;
  windows.show(true);
  std::fprintf(
      stderr,
      "the walls are shown; keys: Tab projector, 1-4 pins, 5-8 edges, arrows, U undo, R redo, S save, "
      "Q quit\n");
  adjusting.say();
  while (!adjusting.ended()) {
    for (const WindowEvent& press : displays.pollPresses())
      if (const auto command = adjustCommandOf(press); command && !adjusting.ended())
        adjusting.take(*command);
    while (!adjusting.ended()) {
      const auto line = lines.next(false, stop);
      if (!line) break;
      adjusting.take(*line);
    }
    if (stop) return kStopped + stopSignal();
    if (const auto lost = displays.lost()) {
      std::fprintf(stderr, "stadion: %s\n", lost->c_str());
      return kInternalFault;
    }
    windows.show(adjusting.takeSaid());
    std::this_thread::sleep_for(kAdjustEvery);
  }
  return kOk;
}

}  // namespace

int adjustWalls(const WallFile& walls, const AdjustOptions& options, const std::atomic<bool>& stop) {
  Diagnostics findings;
  auto adjuster = HallAdjuster::open(walls);
  if (!adjuster) {
    findings.add(adjuster.error());
    return exitWith(findings, kBadInput);
  }
  const bool stereo = !options.commands && options.windowStereo != WindowStereo::Mono;
  const auto pictures = AdjustPictures::create(walls, options.pattern, stereo);
  if (!pictures) {
    findings.add(pictures.error());
    return exitWith(findings, kBadInput);
  }
  Adjusting adjusting(adjuster.value(), *pictures.value(), options);
  if (options.commands) return byCommands(adjusting, adjuster.value(), stop);
  const auto displays =
      WallDisplays::open(walls, windowSurface(false, options.windowStereo), options.windowStereo,
                         options.width, options.height, SwapSync::Off, findings);
  printFindings(findings);
  if (!displays) return kBadInput;
  return inWindows(adjusting, adjuster.value(), *pictures.value(), *displays, stop);
}

}  // namespace stadion
