#include "pipeline/target/graphics_card.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <system_error>
#include <unistd.h>

namespace stadion {
namespace {

bool isNumberedFile(std::string_view name, std::string_view prefix) {
  if (!name.starts_with(prefix) || name.size() == prefix.size()) return false;
  return std::ranges::all_of(name.substr(prefix.size()),
                             [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; });
}

/// The first by name, so that each run finds the same one.
std::optional<std::string> firstUsable(const std::filesystem::path& folder, std::string_view prefix) {
  std::optional<std::string> first;
  std::error_code unread;
  for (std::filesystem::directory_iterator at(folder, unread), end; !unread && at != end;
       at.increment(unread)) {
    const std::string file = at->path().string();
    if (isNumberedFile(at->path().filename().string(), prefix) && access(file.c_str(), R_OK | W_OK) == 0 &&
        (!first || file < *first))
      first = file;
  }
  return first;
}

}  // namespace

std::optional<std::string> graphicsCardFile(const std::filesystem::path& devices) {
  if (auto node = firstUsable(devices / "dri", "renderD")) return node;
  return firstUsable(devices, "nvidia");
}

}  // namespace stadion
