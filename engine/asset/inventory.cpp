#include "engine/asset/inventory.h"

#include <algorithm>
#include <array>

namespace stadion {
namespace {

constexpr std::array kUses{ContentUse::Used, ContentUse::Approximated, ContentUse::LeftOut};
constexpr std::size_t kRoomForEnd = 80;  ///< [bytes] for the line that says how many are missing

std::string lineOf(const ContentItem& item) {
  std::string line = std::string(nameOf(item.use)) + ": " + item.text;
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < ' '; }, ' ');
  return line + "\n";
}

}  // namespace

std::string_view nameOf(ContentUse use) {
  return use == ContentUse::Used ? "used" : use == ContentUse::Approximated ? "approximated" : "left out";
}

std::vector<std::string> ModelInventory::texts(ContentUse use) const {
  std::vector<std::string> texts;
  for (const ContentItem& item : items_)
    if (item.use == use) texts.push_back(item.text);
  return texts;
}

std::string ModelInventory::asText(std::size_t mostBytes) const {
  std::string text;
  for (std::size_t i = 0; i < items_.size(); ++i) {
    const std::string line = lineOf(items_[i]);
    if (text.size() + line.size() + kRoomForEnd > mostBytes)
      return text + lineOf({ContentUse::LeftOut, std::to_string(items_.size() - i) +
                                                     " more lines of this list, which is too long"});
    text += line;
  }
  return text;
}

ModelInventory ModelInventory::fromText(std::string_view text) {
  ModelInventory inventory;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    for (const ContentUse use : kUses) {
      const std::string_view name = nameOf(use);
      if (line.starts_with(name) && line.substr(name.size()).starts_with(": "))
        inventory.add(use, std::string(line.substr(name.size() + 2)));
    }
  }
  return inventory;
}

}  // namespace stadion
