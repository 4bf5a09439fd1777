#include "engine/hall_formats/share_grid.h"

#include <algorithm>

namespace stadion {
namespace {

constexpr std::string_view kPfmSpaces = " \t\r\n\v\f";
constexpr int kPfmHeadWords = 4;  ///< PF, width, height, scale

/// Returns where the numbers begin; the end if the head is not whole.
std::size_t numbersBeginAt(std::string_view bytes) {
  std::size_t at = 0;
  for (int word = 0; word < kPfmHeadWords; ++word) {
    at = std::min(bytes.find_first_not_of(kPfmSpaces, at), bytes.size());
    at = std::min(bytes.find_first_of(kPfmSpaces, at), bytes.size());
  }
  return std::min(at + (bytes.substr(at).starts_with("\r\n") ? 2 : 1), bytes.size());
}

}  // namespace

std::optional<PointGrid> readShareGrid(std::string_view bytes, const std::string& file, Diagnostics& out) {
  std::string flat(bytes);
  for (std::size_t at = numbersBeginAt(bytes); at + 12 <= flat.size(); at += 12)
    flat.replace(at + 8, 4, 4, '\0');
  return readPointGrid(flat, file, 1, out);
}

}  // namespace stadion
