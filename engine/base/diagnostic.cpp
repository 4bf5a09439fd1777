#include "engine/base/diagnostic.h"

#include "engine/unicode/characters.h"
#include "engine/unicode/likeness.h"

#include <algorithm>
#include <string_view>

namespace stadion {

namespace {

constexpr std::size_t kWindow = 160;  // characters of a long line that are worth showing
constexpr std::size_t kLongestWord = 64;
constexpr std::size_t kLongestLook = 1024;    // of a word whose look is compared [bytes]
constexpr std::size_t kMostLetters = 200'000;  // whose looks are compared, in the search for one suggestion
constexpr std::size_t kMostComparisons = 1'000'000;  // of letters, in the search for one suggestion

const char* nameOf(Severity s) {
  switch (s) {
  case Severity::Error: return "error";
  case Severity::Warning: return "warning";
  case Severity::Note: return "note";
  }
  return "note";
}

/// A character of a line, as it is shown.
struct Shown {
  std::string bytes;
  std::size_t columns;
};

/// The characters of a UTF-8 line, without the line's end. What would steer the terminal, or could not be
/// seen below the caret, is shown as '?': control characters, those of writing directions, and what has no
/// width. Joiners and variation selectors stay, where they do not matter.
std::vector<Shown> charactersOf(std::string_view line, std::size_t caret) {
  std::vector<Shown> result;
  std::size_t bytes = 0;
  for (; !line.empty() && line[0] != '\n' && line[0] != '\r'; line.remove_prefix(bytes)) {
    const char32_t c = unicode::firstCharacter(line, bytes);
    const std::size_t columns = unicode::columnsOf(c);
    const bool harmless = c == 0x200C || c == 0x200D || (c >= 0xFE00 && c <= 0xFE0F);
    const bool hidden = c != '\t' && columns == 0 && (unicode::isHidden(c) || c < 0x20);
    if (hidden && !(harmless && result.size() != caret))
      result.push_back({"?", 1});
    else
      result.push_back({std::string(line.substr(0, bytes)), columns});
  }
  return result;
}

/// The line and, under it, a caret below `column`. A tab above stands as a tab below, whatever its width.
std::string pointAt(const std::string& excerpt, std::uint32_t column) {
  const std::size_t caret = column > 0 ? column - 1 : 0;
  const std::vector<Shown> characters = charactersOf(excerpt, caret);
  const std::size_t first = caret > kWindow / 2 && characters.size() > kWindow ? caret - kWindow / 2 : 0;
  const std::size_t end = std::min(characters.size(), first + kWindow);

  std::string line = first > 0 ? "..." : "";
  std::string below(line.size(), ' ');
  for (std::size_t i = first; i < end; ++i) {
    line += characters[i].bytes;
    if (i < caret) below += characters[i].bytes == "\t" ? "\t" : std::string(characters[i].columns, ' ');
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

/// The first candidate that looks like the word and is not the same.
std::optional<std::string> lookAlike(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string look = unicode::skeleton(word);
  if (look.empty() || word.size() > kLongestLook) return std::nullopt;
  std::size_t letters = 0;
  for (const std::string& candidate : candidates) {
    letters += candidate.size();
    if (letters > kMostLetters) break;
    if (candidate != word && unicode::skeleton(candidate) == look) return candidate;
  }
  return std::nullopt;
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
  if (const auto alike = lookAlike(word, candidates)) return alike;
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

std::string didYouMeanOne(const std::string& word, const std::string& candidate) {
  std::string text = "did you mean \"" + unicode::withHiddenShown(candidate) + "\"?";
  if (unicode::skeleton(word) != unicode::skeleton(candidate)) return text;
  const std::string difference = unicode::differenceOf(word, candidate);
  return difference.empty() ? text : text + " They look alike: " + difference;
}

}  // namespace stadion
