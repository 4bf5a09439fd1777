#include "engine/unicode/characters.h"

#include "engine/unicode/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace stadion::unicode {
namespace {

constexpr char32_t kNotText = 0xFFFD, kJoinNot = 0x200C, kJoin = 0x200D;

bool among(std::span<const Range> ranges, char32_t code) {
  const auto after = std::ranges::upper_bound(ranges, code, {}, &Range::first);
  return after != ranges.begin() && code <= std::prev(after)->last;
}

/// Returns the row of a table that contains `code`; null if there is none.
template <class Row>
const Row* rowOf(std::span<const Row> rows, char32_t Row::*key, char32_t code) {
  const auto at = std::ranges::lower_bound(rows, code, {}, key);
  return at != rows.end() && (*at).*key == code ? &*at : nullptr;
}

/// Arabic, Syriac, Thaana, N'Ko, Mandaic and the like, which join letters in writing.
bool isJoinedLetter(char32_t c) {
  return ((c >= 0x620 && c < 0x900) || (c >= 0xFB50 && c < 0xFE00) || (c >= 0xFE70 && c < 0xFEFF) ||
          (c >= 0x1800 && c < 0x18B0) || (c >= 0x10D00 && c < 0x10D30) || (c >= 0x1E900 && c < 0x1E950)) &&
         !isHidden(c);
}

bool isJoiner(char32_t c) {
  return c == kJoinNot || c == kJoin;
}

/// Returns true if a script needs a joiner between these two.
bool mayJoin(char32_t before, char32_t after) {
  if (after == 0 || isHidden(after)) return false;
  return among(kViramas, before) || (isJoinedLetter(before) && isJoinedLetter(after));
}

/// Returns the plain ASCII form of a letter variant; 0 if it is none.
char32_t plainOf(char32_t c) {
  if (c >= 0xFF01 && c <= 0xFF5E) return c - 0xFF01 + 0x21;  // full width
  if (c >= 0x1D400 && c <= 0x1D6A3) {                        // mathematical alphabets
    const char32_t letter = (c - 0x1D400) % 52;
    return letter < 26 ? U'A' + letter : U'a' + letter - 26;
  }
  if (c >= 0x1D7CE && c <= 0x1D7FF) return U'0' + (c - 0x1D7CE) % 10;
  return 0;
}

void appendLook(std::string& look, char32_t c) {
  if (isHidden(c)) return;
  if (const char32_t plain = plainOf(c)) c = plain;
  if (const Alike* alike = rowOf(kAlike, &Alike::letter, c)) c = alike->shown;
  append(look, c);
}

/// Returns the visible characters.
std::u32string visibleIn(std::string_view word) {
  std::u32string codes;
  for (std::size_t bytes = 0; !word.empty(); word.remove_prefix(bytes))
    if (const char32_t c = firstCharacter(word, bytes); !isHidden(c)) codes += c;
  return codes;
}

/// The character at `i`, with the marks that stand on it.
std::string withMarks(const std::u32string& codes, std::size_t i) {
  std::string names = nameOf(codes[i]);
  while (++i < codes.size() && among(kMarks, codes[i])) names += " with " + nameOf(codes[i]);
  return names;
}

}  // namespace

char32_t firstCharacter(std::string_view text, std::size_t& bytes) {
  const auto byte = [&](std::size_t i) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i]));
  };
  const std::uint32_t lead = byte(0);
  const std::size_t size = lead < 0x80       ? 1
                           : lead >> 5 == 6  ? 2
                           : lead >> 4 == 14 ? 3
                           : lead >> 3 == 30 ? 4
                                             : 0;
  bytes = 1;
  if (size == 1) return lead;
  if (size == 0 || size > text.size()) return kNotText;
  char32_t c = lead & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return kNotText;
    c = c << 6 | (byte(i) & 0x3FU);
  }
  constexpr std::array<char32_t, 5> kFirst{0, 0, 0x80, 0x800, 0x10000};
  if (c < kFirst[size] || c > 0x10FFFF || (c >= 0xD800 && c < 0xE000)) return kNotText;
  bytes = size;
  return c;
}

void append(std::string& text, char32_t c) {
  const auto put = [&](char32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
  if (c < 0x80) return put(c);
  if (c < 0x800) {
    put(0xC0 | c >> 6);
    return put(0x80 | (c & 0x3F));
  }
  if (c < 0x10000) {
    put(0xE0 | c >> 12);
    put(0x80 | (c >> 6 & 0x3F));
    return put(0x80 | (c & 0x3F));
  }
  put(0xF0 | c >> 18);
  put(0x80 | (c >> 12 & 0x3F));
  put(0x80 | (c >> 6 & 0x3F));
  put(0x80 | (c & 0x3F));
}

bool isHidden(char32_t code) {
  const bool ascii = (code >= 0x20 && code < 0x7F) || (code >= '\t' && code <= '\r');  // with its blanks
  return !ascii && (among(kBlanks, code) || among(kNothing, code));
}

std::optional<std::size_t> hiddenIn(std::string_view word) {
  char32_t before = 0;
  for (std::size_t at = 0, bytes = 0; at < word.size(); at += bytes) {
    const char32_t c = firstCharacter(word.substr(at), bytes);
    if (isHidden(c)) {
      std::size_t next = 0;
      const char32_t after = at + bytes < word.size() ? firstCharacter(word.substr(at + bytes), next) : 0;
      if (!isJoiner(c) || !mayJoin(before, after)) return at;
    }
    before = c;
  }
  return {};
}

std::string nameOf(char32_t code) {
  std::string text = fmt::format("U+{:04X}", static_cast<std::uint32_t>(code));
  if (const CharacterName* named = rowOf(kNames, &CharacterName::code, code)) return text + " " + named->name;
  if (code >= 0xFE00 && code <= 0xFE0F)
    return text + fmt::format(" VARIATION SELECTOR-{}", static_cast<std::uint32_t>(code) - 0xFE00 + 1);
  if (code >= 0xE0100 && code <= 0xE01EF)
    return text + fmt::format(" VARIATION SELECTOR-{}", static_cast<std::uint32_t>(code) - 0xE0100 + 17);
  if (code >= 0xE0020 && code <= 0xE007F) return text + " (a tag character)";
  if (code < 0x20 || (code >= 0x7F && code < 0xA0)) return text + " (a control character)";
  return text;
}

std::string withoutHidden(std::string_view text) {
  std::string visible;
  for (std::size_t bytes = 0; !text.empty(); text.remove_prefix(bytes))
    if (!isHidden(firstCharacter(text, bytes))) visible += text.substr(0, bytes);
  return visible;
}

std::string nameOfFirst(std::string_view text) {
  std::size_t bytes = 0;
  return nameOf(firstCharacter(text, bytes));
}

std::string skeleton(std::string_view word) {
  std::string look;
  for (std::size_t bytes = 0; !word.empty(); word.remove_prefix(bytes)) {
    const char32_t c = firstCharacter(word, bytes);
    const Composition* pieces = c < 0xC0 ? nullptr : rowOf(kComposed, &Composition::whole, c);
    if (!pieces) appendLook(look, c);
    for (std::size_t i = 0; pieces && i < pieces->parts.size() && pieces->parts[i] != 0; ++i)
      appendLook(look, pieces->parts[i]);
  }
  return look;
}

std::string differenceOf(std::string_view word, std::string_view other) {
  const std::u32string ours = visibleIn(word), theirs = visibleIn(other);
  if (ours == theirs) {
    const std::string_view with = word.size() > other.size() ? word : other;
    for (std::size_t at = 0, bytes = 0; at < with.size(); at += bytes)
      if (const char32_t c = firstCharacter(with.substr(at), bytes); isHidden(c))
        return fmt::format("{} has {}, which cannot be seen",
                           with.data() == word.data() ? "this one" : "that one", nameOf(c));
    return {};
  }
  const auto [here, there] = std::ranges::mismatch(ours, theirs);
  auto i = static_cast<std::size_t>(here - ours.begin());
  const auto end = [&](const std::u32string& codes) { return i >= codes.size() || among(kMarks, codes[i]); };
  while (i > 0 && (end(ours) || end(theirs))) --i;  // an accent belongs to its letter
  if (i >= ours.size() || i >= theirs.size()) return {};
  return fmt::format("this one has {}, that one {}", withMarks(ours, i), withMarks(theirs, i));
}

unsigned columnsOf(char32_t code) {
  if (code < 0x300) return among(kNothing, code) && code != '\t' ? 0 : 1;
  if (among(kNothing, code) || among(kMarks, code)) return 0;
  return among(kWide, code) ? 2 : 1;
}

std::string withHiddenShown(std::string_view text) {
  std::string shown;
  char32_t before = 0;
  for (std::size_t bytes = 0; !text.empty(); text.remove_prefix(bytes)) {
    const char32_t c = firstCharacter(text, bytes);
    std::size_t next = 0;
    const char32_t after = bytes < text.size() ? firstCharacter(text.substr(bytes), next) : 0;
    const bool needed = isJoiner(c) && mayJoin(before, after);
    if (c >= 0xA0 && isHidden(c) && !needed)
      shown += fmt::format("<U+{:04X}>", static_cast<std::uint32_t>(c));
    else
      shown += text.substr(0, bytes);
    before = c;
  }
  return shown;
}

}  // namespace stadion::unicode
