#include "engine/diagnostic.h"

#include <algorithm>
#include <string_view>

namespace stadion {

namespace {

constexpr std::size_t kWindow = 160;  // characters of a long line that are worth showing
constexpr std::size_t kLongestWord = 64;
constexpr std::size_t kMostComparisons = 1'000'000;  // of letters, in the search for one suggestion

const char* nameOf(Severity s) {
  switch (s) {
  case Severity::Error: return "error";
  case Severity::Warning: return "warning";
  case Severity::Note: return "note";
  }
  return "note";
}

bool continues(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

/// The bytes of each character of a UTF-8 line, without the line's end. Control characters other than the tab
/// become '?', so that a hostile file cannot steer the terminal.
std::vector<std::string> charactersOf(const std::string& line) {
  std::vector<std::string> result;
  for (const char c : line) {
    if (c == '\n' || c == '\r') break;
    const auto byte = static_cast<unsigned char>(c);
    if (continues(c) && !result.empty() && result.back().size() < 4)
      result.back() += c;
    else
      result.emplace_back(1, (byte < 0x20 && c != '\t') || byte == 0x7F ? '?' : c);
  }
  return result;
}

/// The line and, under it, a caret below `column`. A tab above stands as a tab below, whatever its width.
std::string pointAt(const std::string& excerpt, std::uint32_t column) {
  const auto characters = charactersOf(excerpt);
  const std::size_t caret = column > 0 ? column - 1 : 0;
  const std::size_t first = caret > kWindow / 2 && characters.size() > kWindow ? caret - kWindow / 2 : 0;
  const std::size_t end = std::min(characters.size(), first + kWindow);

  std::string line = first > 0 ? "..." : "";
  std::string below(line.size(), ' ');
  for (std::size_t i = first; i < end; ++i) {
    line += characters[i];
    if (i < caret) below += characters[i] == "\t" ? '\t' : ' ';
  }
  if (end < characters.size()) line += "...";
  if (column == 0 || caret > characters.size()) return "\n" + line;
  return "\n" + line + "\n" + below + "^";
}

/// Restricted Damerau-Levenshtein distance (a swap of neighbours is one slip), or `limit` if it is that or
/// more.
std::size_t editDistance(std::string_view a, std::string_view b, std::size_t limit) {
  const std::size_t gap = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
  if (gap >= limit) return limit;
  std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    std::size_t smallest = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = a[i - 1] == b[j - 1];
      next[j] = std::min({row[j] + 1, next[j - 1] + 1, row[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        next[j] = std::min(next[j], before[j - 2] + 1);
      smallest = std::min(smallest, next[j]);
    }
    if (smallest >= limit) return limit;
    std::swap(before, row);
    std::swap(row, next);
  }
  return row[b.size()];
}

}  // namespace

std::string format(const Diagnostic& d) {
  std::string result = d.where.file;
  if (d.where.line > 0) {
    if (!result.empty()) result += ':';
    result += std::to_string(d.where.line);
    if (d.where.column > 0) result.append(1, ':').append(std::to_string(d.where.column));
  }
  if (!result.empty()) result += ": ";
  result.append(nameOf(d.severity)).append(": ").append(d.message);
  if (!d.excerpt.empty()) result += pointAt(d.excerpt, d.where.column);
  return result;
}

void Diagnostics::error(SourcePosition where, std::string message, std::string excerpt) {
  add({Severity::Error, std::move(where), std::move(message), std::move(excerpt)});
}

void Diagnostics::warning(SourcePosition where, std::string message, std::string excerpt) {
  add({Severity::Warning, std::move(where), std::move(message), std::move(excerpt)});
}

void Diagnostics::note(SourcePosition where, std::string message, std::string excerpt) {
  add({Severity::Note, std::move(where), std::move(message), std::move(excerpt)});
}

void Diagnostics::add(Diagnostic d) {
  if (d.severity == Severity::Error) ++errors_;
  list_.push_back(std::move(d));
}

void Diagnostics::append(const Diagnostics& other) {
  const std::size_t count = other.list_.size();  // other may be this
  list_.reserve(list_.size() + count);
  for (std::size_t i = 0; i < count; ++i) add(other.list_[i]);
}

std::optional<std::string> closest(const std::string& word, const std::vector<std::string>& candidates) {
  if (word.empty() || word.size() > kLongestWord) return std::nullopt;
  std::size_t best = std::max<std::size_t>(1, word.size() / 3) + 1;  // a third of the letters may be wrong
  const std::string* found = nullptr;
  std::size_t comparisons = 0;
  for (const std::string& candidate : candidates) {
    const std::size_t gap = std::max(word.size(), candidate.size()) - std::min(word.size(), candidate.size());
    if (gap >= best) continue;
    comparisons += word.size() * candidate.size();
    if (comparisons > kMostComparisons) break;  // a hostile file must not cost seconds
    const std::size_t distance = editDistance(word, candidate, best);
    if (distance >= best) continue;
    best = distance;
    found = &candidate;
  }
  if (found == nullptr || best >= word.size()) return std::nullopt;
  return *found;
}

}  // namespace stadion
