#pragma once
/// What a model file holds, and what becomes of it in a show.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stadion {

/// What becomes of a part of a file's content.
enum class ContentUse {
  Used,
  Approximated,  ///< drawn in a simpler way, which the text names
  LeftOut,       ///< the show is without it
};

/// Part of a file's content, in words for the author.
struct ContentItem {
  ContentUse use = ContentUse::Used;
  std::string text;  ///< "2 lights (\"sun\", \"lamp\")"; one line
};

/// The content of one model file, with what is not used.
class ModelInventory {
public:
  void add(ContentUse use, std::string text) { items_.push_back({use, std::move(text)}); }
  const std::vector<ContentItem>& items() const { return items_; }

  /// The texts of one kind, in the order in which they were added.
  std::vector<std::string> texts(ContentUse use) const;

  /// Returns the content as lines of text. A text that would be longer than `mostBytes` ends after a whole
  /// line, and one more line says how many are missing. Expects at least 100 bytes.
  std::string asText(std::size_t mostBytes) const;
  /// Reads such lines. Lines of another form are ignored, because the text comes from another process.
  static ModelInventory fromText(std::string_view text);

private:
  std::vector<ContentItem> items_;
};

/// "used", "approximated" or "left out".
std::string_view nameOf(ContentUse use);

}  // namespace stadion
