#include "engine/script/value.h"

#include "engine/unicode/characters.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace stadion {

namespace {

constexpr std::string_view kBlanks = " \t";

bool blank(char c) {
  return c == ' ' || c == '\t';
}

/// Reads one number that ends at a blank, a comma or the end.
std::optional<std::string> readNumber(std::string_view word, double& number, const std::string& what,
                                      const std::string& form) {
  std::string_view digits = word;
  if (digits.starts_with('+') && !digits.starts_with("+-")) digits.remove_prefix(1);
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool whole = end == digits.data() + digits.size() && !digits.empty();
  if (error == std::errc::invalid_argument || !whole)
    return fmt::format("{} must be {}, not \"{}\"", what, form, shortened(word));
  if (error == std::errc::result_out_of_range || !std::isfinite(number))
    return fmt::format("\"{}\" is not a finite number that can be represented", shortened(word));
  if (number == 0) number = 0;  // no negative zero
  return std::nullopt;
}

}  // namespace

std::optional<ValueError> readNumbers(std::string_view text, NumberList& numbers, const std::string& what,
                                      const std::string& form) {
  numbers.count = 0;
  std::size_t at = 0;
  bool comma = true;  // a number must follow, or may at the start
  while (true) {
    while (at < text.size() && blank(text[at])) ++at;
    if (at == text.size()) break;
    const std::size_t end = std::min(text.find_first_of(" \t,", at), text.size());
    const std::string_view word = text.substr(at, end - at);
    if (word.empty())
      return ValueError{at, fmt::format("{} must be {}: a number is missing here", what, form)};
    double number = 0;
    if (auto why = readNumber(word, number, what, form)) return ValueError{at, std::move(*why)};
    if (numbers.count == numbers.value.size())
      return ValueError{at, fmt::format("{} must be {}, but has more", what, form)};
    numbers.value[numbers.count] = number;
    numbers.offset[numbers.count++] = at;
    at = std::min(text.find_first_not_of(kBlanks, end), text.size());
    comma = at < text.size() && text[at] == ',';
    if (comma) ++at;
  }
  if (comma && numbers.count > 0)
    return ValueError{text.size() - 1, fmt::format("{} must be {}: a number is missing here", what, form)};
  return std::nullopt;
}

std::optional<bool> readFlag(std::string_view text) {
  if (text == "on" || text == "true" || text == "1") return true;
  if (text == "off" || text == "false" || text == "0") return false;
  return std::nullopt;
}

Piece takeUntil(char separator, std::string_view& rest, std::size_t& offset) {
  const std::size_t end = std::min(rest.find(separator), rest.size());
  std::string_view part = rest.substr(0, end);
  std::size_t start = offset;
  while (!part.empty() && blank(part.front())) {
    part.remove_prefix(1);
    ++start;
  }
  while (!part.empty() && blank(part.back())) part.remove_suffix(1);
  const std::size_t taken = std::min(end + 1, rest.size());
  rest.remove_prefix(taken);
  offset += taken;
  return {part, start};
}

Piece takeWord(std::string_view& rest, std::size_t& offset) {
  while (!rest.empty() && blank(rest.front())) {
    rest.remove_prefix(1);
    ++offset;
  }
  const std::size_t end = std::min(rest.find_first_of(kBlanks), rest.size());
  const Piece piece{rest.substr(0, end), offset};
  rest.remove_prefix(end);
  offset += end;
  return piece;
}

std::string shortened(std::string_view text) {
  constexpr std::size_t kMost = 40;
  if (text.size() <= kMost) return unicode::withHiddenShown(text);
  std::size_t end = kMost;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return unicode::withHiddenShown(text.substr(0, end)) + "...";
}

std::optional<ValueError> hiddenCharacter(std::string_view text) {
  const auto at = unicode::hiddenIn(text);
  if (!at) return std::nullopt;
  return ValueError{*at, fmt::format("\"{}\" has {}, which cannot be seen; leave it out", shortened(text),
                                     unicode::nameOfFirst(text.substr(*at)))};
}

}  // namespace stadion
