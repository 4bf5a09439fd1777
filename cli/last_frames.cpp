#include "cli/last_frames.h"

#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace stadion {
namespace {

std::string temporaryFile() {
  const auto name = "stadion-" + std::to_string(getpid()) + ".frames";
  return (std::filesystem::temp_directory_path() / name).string();
}

}  // namespace

BlackBoxOptions lastFramesOf(const RunOptions& o, const Player& player, std::vector<std::string> walls) {
  const FrameLoopOptions loop = o.loopOptions(player);
  BlackBoxOptions box;
  box.file = o.blackBox.empty() ? temporaryFile() : o.blackBox;
  box.rate = loop.pace == Pace::Free ? 0 : loop.rate;
  box.walls = std::move(walls);
  return box;
}

std::string lateFramesText(const BlackBox& box) {
  if (box.late() == 0) return "";
  std::string causes;
  for (const auto& [cause, count] : box.verdicts())
    causes += fmt::format("{}{} {}", causes.empty() ? "" : ", ", count, nameOf(cause));
  return fmt::format("late frames: {}\nthe last {} frames: stadion profile --black-box {}\n", causes,
                     BlackBox::kFrames, box.file());
}

}  // namespace stadion
