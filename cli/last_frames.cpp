#include "cli/last_frames.h"

#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace stadion {
namespace {

/// One that is not there yet. If there is no folder for it, making the file fails and says so.
std::string temporaryFile() {
  std::error_code none;
  std::filesystem::path folder = std::filesystem::temp_directory_path(none);
  if (none) {
    const char* named = std::getenv("TMPDIR");
    folder = named ? named : "/tmp";
  }
  const std::string stem = "stadion-" + std::to_string(getpid());
  std::filesystem::path file = folder / (stem + ".frames");
  for (int n = 2; std::filesystem::exists(std::filesystem::symlink_status(file, none)); ++n)
    file = folder / fmt::format("{}-{}.frames", stem, n);
  return file.string();
}

}  // namespace

BlackBoxOptions temporaryLastFrames(std::vector<std::string> walls) {
  BlackBoxOptions box;
  box.file = temporaryFile(), box.rate = 0, box.wanted = false;
  box.walls = std::move(walls);
  return box;
}

BlackBoxOptions lastFramesOf(const RunOptions& o, const Player& player, std::vector<std::string> walls) {
  const FrameLoopOptions loop = o.loopOptions(player);
  BlackBoxOptions box = temporaryLastFrames({});
  box.wanted = !o.blackBox.empty();
  if (box.wanted) box.file = o.blackBox;
  box.rate = loop.pace == Pace::Free ? 0 : loop.rate;
  box.walls = std::move(walls);
  box.sequential = loop.mode == Mode::Sequential;
  return box;
}

bool lastFramesCanBeKept(const RunOptions& o, Diagnostics& findings) {
  if (o.blackBox.empty()) return true;
  const NodeNames none;
  const auto tried = BlackBox::create({.file = o.blackBox}, none);
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
