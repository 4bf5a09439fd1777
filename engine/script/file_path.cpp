#include "engine/script/file_path.h"

#include <algorithm>
#include <vector>

namespace stadion {

namespace {

bool isDrive(std::string_view path) {
  return path.size() >= 2 && path[1] == ':' && ((path[0] | 0x20) >= 'a' && (path[0] | 0x20) <= 'z');
}

/// The parts of a relative path after "." and ".." are worked out; leading ".." stay.
std::vector<std::string_view> normalised(std::string_view path) {
  std::vector<std::string_view> parts;
  while (!path.empty()) {
    const std::size_t end = std::min(path.find('/'), path.size());
    const std::string_view part = path.substr(0, end);
    path.remove_prefix(std::min(end + 1, path.size()));
    if (part.empty() || part == ".") continue;
    if (part == ".." && !parts.empty() && parts.back() != "..")
      parts.pop_back();
    else
      parts.push_back(part);
  }
  return parts;
}

}  // namespace

std::optional<std::string> faultOfPath(std::string_view path) {
  const auto control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  if (std::any_of(path.begin(), path.end(), control)) return "contains a control character";
  if (path.find('\\') != path.npos) return "contains \"\\\"; folders are separated by \"/\"";
  if (path.starts_with('/') || path.starts_with('~') || isDrive(path))
    return "is an absolute path; files are named relative to the script or to ../assets";
  const auto parts = normalised(path);
  const bool up = !parts.empty() && parts[0] == "..";
  const bool inAssets = up && parts.size() > 2 && parts[1] == "assets";
  if (up && !inAssets) return "leads out of the show's folders";
  if (parts.empty() || path.ends_with('/')) return "names a folder, not a file";
  return std::nullopt;
}

std::string endingOf(std::string_view path) {
  const std::size_t slash = path.rfind('/');
  if (slash != path.npos) path.remove_prefix(slash + 1);
  const std::size_t dot = path.rfind('.');
  if (dot == path.npos) return {};
  std::string ending(path.substr(dot + 1));
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c | 0x20);
  return ending;
}

}  // namespace stadion
