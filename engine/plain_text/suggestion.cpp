#include "engine/plain_text/suggestion.h"

#include "engine/unicode/characters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>

namespace stadion {
namespace {

constexpr std::size_t kLongestWord = 64;
constexpr std::size_t kLongestLook = 1024;     // of a word whose look is compared [bytes]
constexpr std::size_t kMostLetters = 200'000;  // whose looks are compared, in the search for one suggestion
constexpr std::size_t kMostComparisons = 1'000'000;  // of letters, in the search for one suggestion

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

std::string didYouMean(std::string_view word, const std::vector<std::string>& candidates,
                       const std::string& otherwise) {
  std::string small(word);
  for (char& c : small)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c | 0x20);
  auto found = closest(std::string(word), candidates);
  if (!found) found = closest(small, candidates);
  return found ? "; " + didYouMeanOne(std::string(word), *found) : otherwise;
}

std::string didYouMeanOrKnown(std::string_view word, const std::vector<std::string>& candidates) {
  const auto near = closest(std::string(word.substr(0, kLongestWord)), candidates);
  return near ? "; " + didYouMeanOne(std::string(word), *near)
              : fmt::format("; known are {}", fmt::join(candidates, ", "));
}

}  // namespace stadion
