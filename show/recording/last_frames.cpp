#include "show/recording/last_frames.h"

#include "profiling/record/black_box_folder.h"

#include <fmt/format.h>

namespace stadion {

BlackBoxOptions unaskedLastFrames(std::vector<std::string> walls) {
  BlackBoxOptions box;
  box.file = BlackBoxFolder::ofThisUser().newFile();
  box.rate = 0;
  box.wanted = false;
  box.walls = std::move(walls);
  return box;
}

BlackBoxOptions lastFramesOf(const PlaySettings& play, const std::string& file, const Player& player,
                             std::vector<std::string> walls) {
  const FrameLoopOptions loop = play.loopOptions(player);
  BlackBoxOptions box;
  if (file.empty())
    box = unaskedLastFrames(std::move(walls));
  else {
    box.file = file;
    box.walls = std::move(walls);
  }
  box.rate = loop.pace == Pace::Free ? 0 : loop.rate;
  box.sequential = loop.mode == Mode::Sequential;
  return box;
}

bool lastFramesCanBeKept(const std::string& file, Diagnostics& findings) {
  if (file.empty()) return true;
  const NodeNames none;
  const auto tried = BlackBox::create({.file = file}, none);
  if (!tried) findings.add(tried.error());
  return static_cast<bool>(tried);
}

std::string lateFramesText(const BlackBox& box) {
  if (!box.stays()) return "";
  const std::string where =
      fmt::format("the last {} frames: stadion profile --black-box {}\n", BlackBox::kFrames, box.file());
  if (box.late() == 0) return where;
  std::string causes;
  for (const auto& [cause, count] : box.verdicts())
    causes += fmt::format("{}{} {}", causes.empty() ? "" : ", ", count, nameOf(cause));
  return fmt::format("late frames: {}\n{}", causes, where);
}

}  // namespace stadion
