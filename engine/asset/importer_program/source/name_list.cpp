#include "engine/asset/importer_program/source/name_list.h"

#include <algorithm>

namespace stadion::importer {
namespace {

constexpr std::size_t kLongestName = 60;  ///< [bytes]
constexpr std::size_t kMostNames = 3;

bool continues(char c) {
  return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

}  // namespace

std::string inQuotes(std::string_view name) {
  std::size_t end = std::min(name.size(), kLongestName);
  while (end < name.size() && end > 0 && continues(name[end])) --end;  // not within a character
  std::string text = "\"";
  for (const char c : name.substr(0, end)) text += static_cast<unsigned char>(c) < ' ' || c == 0x7f ? '?' : c;
  return text + (end < name.size() ? "...\"" : "\"");
}

std::string counted(std::size_t count, std::string_view one, std::string_view several) {
  std::string text = std::to_string(count) + " ";
  if (count == 1) return text.append(one);
  return several.empty() ? text.append(one).append("s") : text.append(several);
}

std::string nameList(const std::vector<std::string>& names) {
  std::string text;
  std::size_t shown = 0;
  for (const std::string& name : names) {
    if (name.empty() || shown == kMostNames) continue;
    text += (shown++ > 0 ? ", " : "") + inQuotes(name);
  }
  if (shown > 0 && shown < names.size()) text += " and " + std::to_string(names.size() - shown) + " more";
  return text;
}

std::string listed(const std::vector<std::string>& names, std::string_view one, std::string_view several) {
  const std::string shown = nameList(names);
  return counted(names.size(), one, several) + (shown.empty() ? "" : " (" + shown + ")");
}

}  // namespace stadion::importer
