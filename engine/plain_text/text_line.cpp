#include "engine/plain_text/text_line.h"

#include "engine/unicode/characters.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <system_error>

namespace stadion {
namespace {

constexpr std::size_t kMaxExcerpt = 4096;
constexpr std::size_t kMaxName = 32;

bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == ',' || c == '\r';
}
bool continuesCharacter(char c) {
  return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}  // UTF-8

/// Whether a byte and those that continue it are one character, and none that steers a terminal.
bool canBeShown(std::string_view bytes) {
  const auto first = static_cast<unsigned char>(bytes[0]);
  const std::size_t size = first < 0x80 ? 1 : first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : 4;
  if (first >= 0xf8 || bytes.size() != size) return false;
  char32_t c = size == 1 ? first : first & (0x7fU >> size);
  for (const char more : bytes.substr(1)) c = c << 6 | (static_cast<unsigned char>(more) & 0x3fU);
  const bool control = c < 0x20 || (c >= 0x7f && c < 0xa0);
  const bool half = c >= 0xd800 && c < 0xe000;  // of a character of UTF-16
  constexpr std::array<char32_t, 5> kFirst{0, 0, 0x80, 0x800, 0x10000};
  return !control && !half && c >= kFirst[size] && c <= 0x10ffff;
}

void splitWords(std::string_view line, std::vector<Word>& words) {
  words.clear();
  std::uint32_t column = 1;
  for (std::size_t i = 0; i < line.size() && line[i] != '#';) {
    if (isBlank(line[i])) {
      ++i;
      ++column;
      continue;
    }
    const std::size_t begin = i;
    const std::uint32_t beginColumn = column;
    for (; i < line.size() && !isBlank(line[i]) && line[i] != '#'; ++i)
      if (!continuesCharacter(line[i])) ++column;
    words.push_back({line.substr(begin, i - begin), beginColumn});
  }
}

bool isNameCharacter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
         c == '.';
}

}  // namespace

LineReader::LineReader(std::string_view text, std::string file, Diagnostics& out)
    : text_(text), file_(std::move(file)), out_(out) {
  if (text_.substr(0, 3) == "\xef\xbb\xbf") text_.remove_prefix(3);  // byte order mark
}

bool LineReader::next() {
  while (position_ < text_.size() && errors_ < kMaxErrors) {
    const std::size_t end = std::min(text_.find('\n', position_), text_.size());
    current_ = text_.substr(position_, end - position_);
    position_ = end + 1;
    ++line_;
    splitWords(current_, words_);
    if (!words_.empty()) return true;
  }
  return false;
}

std::string LineReader::excerpt() const {
  std::string_view line = current_;
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return printable(line, kMaxExcerpt);
}

std::uint32_t LineReader::endColumn() const {
  if (words_.empty()) return 1;
  std::uint32_t column = words_.back().column;
  for (const char c : words_.back().text) column += continuesCharacter(c) ? 0 : 1;
  return column;
}

void LineReader::error(std::uint32_t column, std::string message) {
  if (errors_ >= kMaxErrors) return;
  out_.error(at(column), std::move(message), excerpt());
  if (++errors_ == kMaxErrors)
    out_.note({file_, line_, 0}, "too many errors, the rest of the file was not read");
}

void LineReader::warning(std::uint32_t column, std::string message) {
  out_.warning(at(column), std::move(message), excerpt());
}

bool LineReader::reportHidden(const Word& word) {
  const auto at = unicode::hiddenIn(word.text);
  if (!at) return false;
  std::uint32_t column = word.column;
  for (const char c : word.text.substr(0, *at)) column += continuesCharacter(c) ? 0 : 1;
  error(column, fmt::format("{} has {}, which cannot be seen; leave it out", quotedWord(word.text),
                            unicode::nameOfFirst(word.text.substr(*at))));
  return true;
}

std::optional<double> LineReader::number(const Word& word, std::string_view what) {
  std::string_view text = word.text;
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || problem == std::errc::invalid_argument) {
    if (reportHidden(word)) return std::nullopt;
    error(word.column, fmt::format("{} is not a number ({})", quotedWord(word.text), what));
    return std::nullopt;
  }
  if (problem != std::errc() || !std::isfinite(value)) {
    error(word.column, fmt::format("{} is not a finite number in range ({})", quotedWord(word.text), what));
    return std::nullopt;
  }
  return value;
}

std::optional<std::uint64_t> LineReader::count(const Word& word, std::string_view what, std::uint64_t lo,
                                               std::uint64_t hi) {
  const std::string_view text = word.text;
  std::uint64_t value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || problem != std::errc() || value < lo || value > hi) {
    error(word.column,
          fmt::format("{} must be a whole number from {} to {}, not {}", what, lo, hi, quotedWord(text)));
    return std::nullopt;
  }
  return value;
}

std::optional<Nanoseconds> LineReader::seconds(const Word& word, std::string_view what) {
  constexpr std::uint64_t kLongest = 1'000'000'000;  // [s], some 31 years
  const std::string_view text = word.text;
  const std::size_t point = std::min(text.find('.'), text.size());
  const std::string_view whole = text.substr(0, point);
  const std::string_view fraction = point < text.size() ? text.substr(point + 1) : std::string_view();
  const auto digits = [](std::string_view s) {
    return s.find_first_not_of("0123456789") == std::string_view::npos;
  };
  if (!digits(whole) || !digits(fraction) || whole.size() + fraction.size() == 0) {
    error(word.column, fmt::format("{} must be seconds, such as 1.25, not {}", what, quotedWord(text)));
    return std::nullopt;
  }
  if (fraction.size() > 9) {
    error(word.column,
          fmt::format("{} {} is finer than a nanosecond; keep nine decimals", what, quotedWord(text)));
    return std::nullopt;
  }
  std::uint64_t s = 0, ns = 0;
  const auto problem = std::from_chars(whole.data(), whole.data() + whole.size(), s).ec;
  if (problem == std::errc::result_out_of_range || s > kLongest) {
    error(word.column, fmt::format("{} {} is too large", what, quotedWord(text)));
    return std::nullopt;
  }
  for (std::size_t i = 0; i < 9; ++i)
    ns = ns * 10 + (i < fraction.size() ? static_cast<std::uint64_t>(fraction[i] - '0') : 0);
  return static_cast<Nanoseconds>(s * 1'000'000'000 + ns);
}

std::optional<std::string> LineReader::name(const Word& word, std::string_view what) {
  const std::string_view text = word.text;
  bool good = !text.empty() && text.size() <= kMaxName && text[0] != '.' && text[0] != '-';
  for (const char c : text) good = good && isNameCharacter(c);
  if (good) return std::string(text);
  if (reportHidden(word)) return std::nullopt;
  const auto foreign =
      std::ranges::find_if(text, [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
  const std::string_view rest = text.substr(static_cast<std::size_t>(foreign - text.begin()));
  error(word.column,
        fmt::format("{} is not a good name for {}; use up to {} letters, digits, '-', '_' and '.'{}",
                    quotedWord(text), what, kMaxName,
                    rest.empty() ? "" : fmt::format("; it has {}", unicode::nameOfFirst(rest))));
  return std::nullopt;
}

std::string formatSeconds(Nanoseconds ns) {
  std::string text = fmt::format("{}.{:09}", ns / 1'000'000'000, ns % 1'000'000'000);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string printable(std::string_view text, std::size_t limit) {
  std::string shown;
  std::size_t characters = 0;
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end) {
    for (end = begin + 1; end < text.size() && continuesCharacter(text[end]);) ++end;
    if (++characters > limit) return shown + "...";
    const std::string_view character = text.substr(begin, end - begin);
    if (character == "\t")
      shown += ' ';
    else if (canBeShown(character))
      shown += character;
    else
      shown += '?';
  }
  return shown;
}

std::string quotedWord(std::string_view word) {
  return fmt::format("\"{}\"", printable(unicode::withHiddenShown(word), 40));
}

}  // namespace stadion
