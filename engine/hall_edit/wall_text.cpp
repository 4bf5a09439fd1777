#include "engine/hall_edit/wall_text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace stadion {
namespace {

constexpr double kDecimals = 1e6;

struct TextSpan {
  std::size_t begin, end;
};

bool isSeparator(char c) {
  return c == ' ' || c == '\t' || c == ',' || c == '\r';
}

/// Where the words of a statement lie in its line.
std::vector<TextSpan> spansOf(std::string_view line) {
  std::vector<TextSpan> words;
  const std::size_t end = std::min(line.find('#'), line.size());
  for (std::size_t i = 0; i < end;) {
    if (isSeparator(line[i])) {
      ++i;
      continue;
    }
    const std::size_t begin = i;
    while (i < end && !isSeparator(line[i])) ++i;
    words.push_back({begin, i});
  }
  return words;
}

std::string_view spanText(std::string_view line, const TextSpan& span) {
  return line.substr(span.begin, span.end - span.begin);
}

bool isNumber(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
  return end == word.data() + word.size() && problem == std::errc();
}

/// The index of the field's first number: a name may be the same word, but no number follows it.
std::optional<std::size_t> numbersOf(std::string_view line, const std::vector<TextSpan>& words,
                                     std::string_view field) {
  for (std::size_t i = 2; i + 1 < words.size(); ++i)
    if (spanText(line, words[i]) == field && isNumber(spanText(line, words[i + 1]))) return i + 1;
  return std::nullopt;
}

std::string joinedNumbers(std::span<const double> values) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    // Places of corners stand in pairs.
    if (i > 0) text += values.size() > 2 && i % 2 == 0 ? "  " : " ";
    text += numberText(values[i]);
  }
  return text;
}

}  // namespace

double asWritten(double value) {
  const double rounded = std::round(value * kDecimals) / kDecimals;
  return rounded == 0 ? 0 : rounded;
}

std::string numberText(double value) {
  std::string text = fmt::format("{:.6f}", asWritten(value));
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

WallText::WallText(std::string_view text) {
  for (std::size_t begin = 0;;) {
    const std::size_t end = text.find('\n', begin);
    lines_.emplace_back(text.substr(begin, end - begin));
    if (end == std::string_view::npos) return;
    begin = end + 1;
  }
}

std::optional<ChangedLine> WallText::set(std::string_view statement, std::string_view name,
                                         std::string_view field, std::span<const double> values) {
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    const std::string_view line = lines_[l];
    // A byte order mark may stand before the first statement, which is then no projector.
    const std::vector<TextSpan> words = spansOf(line);
    if (words.size() < 2 || spanText(line, words[0]) != statement || spanText(line, words[1]) != name)
      continue;
    ChangedLine change{l, lines_[l], lines_[l]};
    const auto first = numbersOf(line, words, field);
    if (!first) {
      change.after.insert(words.back().end, fmt::format("  {} {}", field, joinedNumbers(values)));
    } else {
      for (std::size_t i = values.size(); i-- > 0;) {
        if (*first + i >= words.size() || !isNumber(spanText(line, words[*first + i]))) return std::nullopt;
        const TextSpan& word = words[*first + i];
        change.after.replace(word.begin, word.end - word.begin, numberText(values[i]));
      }
    }
    lines_[l] = change.after;
    return change;
  }
  return std::nullopt;
}

std::string WallText::text() const {
  std::string all;
  for (std::size_t l = 0; l < lines_.size(); ++l) {
    if (l > 0) all += '\n';
    all += lines_[l];
  }
  return all;
}

}  // namespace stadion
