#include "show/player/show_files.h"

#include "engine/base/installed_files.h"
#include "show/player/player.h"

#include <filesystem>

namespace stadion {

std::string inputLogOf(const std::string& script, const std::string& input) {
  if (!input.empty()) return input == "none" ? "" : input;
  if (script.empty()) return {};
  const auto beside = std::filesystem::path(script).replace_extension(".input");
  std::error_code unknown;
  return std::filesystem::exists(beside, unknown) ? beside.string() : "";
}

std::string wallFileOf(const std::string& walls) {
  const bool isPath = walls.find('/') != walls.npos || walls.ends_with(".walls");
  return isPath ? walls : shareFolder() + "/walls/" + walls + ".walls";
}

std::vector<NamedFile> filesOf(const ShowOptions& show) {
  return {{"the show", show.script, false},
          {"--walls", wallFileOf(show.walls), false},
          {show.input.empty() ? "the log beside the show" : "--input", inputLogOf(show.script, show.input),
           false}};
}

}  // namespace stadion
