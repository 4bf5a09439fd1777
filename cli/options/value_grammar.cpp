#include "cli/options/value_grammar.h"

#include "engine/plain_text/number_text.h"

#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace stadion {
namespace {

template <class Number>
std::optional<Number> readAll(std::string_view text) {
  Number value{};
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "pair|off" as "pair or off".
std::string spokenList(std::string_view words) {
  std::string text;
  for (std::size_t bar; (bar = words.find('|')) != words.npos; words.remove_prefix(bar + 1))
    text += fmt::format("{}{}", text.empty() ? "" : ", ", words.substr(0, bar));
  return text.empty() ? std::string(words) : fmt::format("{} or {}", text, words);
}

bool isSize(std::string_view text, double least, double most) {
  const auto sides = parseSize(std::string(text));
  const auto fits = [&](double side) { return side >= least && side <= most; };
  return sides && fits(sides->first) && fits(sides->second);
}

/// A value that is not a number is neither below nor above.
template <class Number>
bool isWithin(const std::optional<Number>& value, double least, double most) {
  return value && static_cast<double>(*value) >= least && static_cast<double>(*value) <= most;
}

bool fits(const ValueGrammar& g, std::string_view text) {
  switch (g.kind) {
  case OptionValueKind::Flag: return true;
  case OptionValueKind::Text:
  case OptionValueKind::File:
  case OptionValueKind::Folder: return !text.empty();
  case OptionValueKind::Word: return hasWord(g.words, text);
  case OptionValueKind::Whole: return hasWord(g.words, text) || isWithin(readWhole(text), g.least, g.most);
  case OptionValueKind::Number: return hasWord(g.words, text) || isWithin(readDecimal(text), g.least, g.most);
  case OptionValueKind::Size: return isSize(text, g.least, g.most);
  case OptionValueKind::Frames: return readFrames(text).has_value();
  }
  return false;
}

/// What is allowed, after "is not".
std::string allowed(const ValueGrammar& g) {
  const std::string words = g.words.empty() ? "" : spokenList(g.words) + ", nor ";
  switch (g.kind) {
  case OptionValueKind::Flag: return {};
  case OptionValueKind::Text: return fmt::format("a {}: it is empty", g.shape);
  case OptionValueKind::File: return "the name of a file: it is empty";
  case OptionValueKind::Folder: return "the name of a folder: it is empty";
  case OptionValueKind::Word: return spokenList(g.words);
  case OptionValueKind::Whole:
    return fmt::format("{}a whole number from {:.13g} to {:.13g}", words, g.least, g.most);
  case OptionValueKind::Number: return fmt::format("{}a number from {} to {}", words, g.least, g.most);
  case OptionValueKind::Size:
    return fmt::format("WIDTHxHEIGHT in pixels from {0}x{0} to {1}x{1}, such as 800x600", g.least, g.most);
  case OptionValueKind::Frames: return "a range of frames A..B, such as 100..160";
  }
  return {};
}

}  // namespace

std::optional<double> readDecimal(std::string_view text) {
  const auto value = readAll<double>(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::uint64_t> readWhole(std::string_view text) {
  return readAll<std::uint64_t>(text);
}

std::optional<std::pair<std::uint64_t, std::uint64_t>> readFrames(std::string_view text) {
  const std::size_t dots = text.find("..");
  if (dots == text.npos) return std::nullopt;
  const auto first = readWhole(text.substr(0, dots)), last = readWhole(text.substr(dots + 2));
  if (!first || !last || *first > *last) return std::nullopt;
  return std::pair{*first, *last};
}

bool hasWord(std::string_view words, std::string_view word) {
  for (std::size_t bar; (bar = words.find('|')) != words.npos; words.remove_prefix(bar + 1))
    if (words.substr(0, bar) == word) return true;
  return !word.empty() && words == word;
}

std::string ValueGrammar::mistakeIn(std::string_view text) const {
  return fits(*this, text) ? std::string() : fmt::format("\"{}\" is not {}", text, allowed(*this));
}

std::string ValueGrammar::notation() const {
  std::string text(kind == OptionValueKind::Word ? words : shape);
  if (kind != OptionValueKind::Word && !words.empty()) text = fmt::format("{}|{}", words, shape);
  if (times == ValueTimes::List) text += ",...";
  if (times == ValueTimes::Several) text += "...";
  return text;
}

std::string ValueGrammar::limits() const {
  if (kind == OptionValueKind::Size) return fmt::format("{0}x{0} to {1}x{1}", least, most);
  if (kind != OptionValueKind::Whole && kind != OptionValueKind::Number) return {};
  return fmt::format("{:.13g} to {:.13g}", least, most);
}

}  // namespace stadion
