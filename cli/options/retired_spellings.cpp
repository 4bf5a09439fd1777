#include "cli/options/retired_spellings.h"

#include "cli/options/value_grammar.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace stadion {
namespace {

// Kinds of values: any other text is a word that the value is.
constexpr std::string_view kNumber = "<number>", kList = "<list>", kWord = "<word>", kNodeName = "<node>";

constexpr RetiredSpelling kRetired[] = {
    {"run|cluster", "--trace-events", "", "--trace FILE"},
    {"run|cluster", "--trace", kNodeName,
     "--track NODE; --trace FILE is the event trace, FILE with an ending such as .json"},
    {"profile|merge-traces", "--trace", kNodeName, "--trace FILE with an ending such as .json"},
    {"profile", "--html", "", "--out DIR, which receives profile.html"},
    {"profile", "--no-draw", "", "--gl none"},
    {"plan", "--svg", "", "--out DIR, which receives plan.svg"},
    {"plan", "--walls", kNumber, "--wall-count N"},
    {"regress", "--junit", "", "--out DIR, which receives junit.xml"},
    {"nodes", "--editor", "", "--out DIR"},
    {"view", "--shots", "", "--out DIR"},
    {"view|walls", "--stereo", "mono", "--stereo off"},
    {"view|walls", "--stereo", "quad", "--stereo pair"},
    {"fit", "--tolerance", "", "--within PERCENT"},
    {"fit", "--table", "", "--out DIR, which receives the table"},
    {"calibrate", "--walls", kList, "--walls once for each room"},
    {"bench flight", "--json", kWord,
     "--json without a file: it prints to standard output; --out DIR writes flight.json"},
    {"bench budgets", "--seconds", "", "--stall-time S"},
    {"bench recording", "--most", "", "--within PERCENT"},
    {"bench walls", "--only", "", "--scenes a,b,c"},
    {"bench walls", "--walls", "", "--wall-count N"},
    {"bench walls", "--nodes", "", "--scene-nodes N"},
    {"bench walls", "--pictures", "", "--out DIR"},
};

/// A bare word may name a node: no ending, no folder before it. (A folder of that name is a mistake of
/// another kind.)
bool mayNameNode(std::string_view value) {
  std::error_code none;
  return !value.empty() && value.find_first_of("./") == value.npos &&
         !std::filesystem::is_directory(value, none);
}

bool isOfKind(std::string_view kind, std::string_view value) {
  if (kind == kNumber) return readDecimal(value).has_value();
  if (kind == kList) return value.find(',') != value.npos;
  if (kind == kWord) return !value.empty() && !value.starts_with('-');
  if (kind == kNodeName) return mayNameNode(value);
  return kind.empty() || kind == value;
}

struct CommandPlace {
  std::string command;   ///< "run", "bench walls"
  std::size_t last = 0;  ///< the word that ends its name
};

bool hasRetiredOptions(const std::string& command) {
  return std::ranges::any_of(kRetired,
                             [&](const RetiredSpelling& r) { return hasWord(r.commands, command); });
}

/// The name of a bench may stand behind options, and behind the values of retired ones.
CommandPlace commandIn(std::span<const std::string> words) {
  if (words.empty()) return {};
  CommandPlace place{words[0]};
  if (words[0] != "bench") return place;
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (words[i].starts_with('-')) continue;
    const CommandPlace bench{"bench " + words[i], i};
    if (i == 1 || hasRetiredOptions(bench.command)) return bench;
    if (place.last == 0) place = bench;
  }
  return place;
}

}  // namespace

std::span<const RetiredSpelling> retiredSpellings() {
  return kRetired;
}

std::optional<std::string> retiredSpellingIn(std::span<const std::string> words) {
  const auto [command, last] = commandIn(words);
  for (std::size_t i = 1; i < words.size() && words[i] != "--"; ++i) {
    const std::string_view word = words[i];
    if (!word.starts_with("--")) continue;
    const std::size_t equals = word.find('=');
    const std::size_t behind = i + 1 == last ? i + 2 : i + 1;
    const std::string_view next = behind < words.size() ? std::string_view(words[behind]) : "";
    const std::string_view option = word.substr(0, equals),
                           value = equals == word.npos ? next : word.substr(equals + 1);
    for (const RetiredSpelling& r : kRetired)
      if (r.option == option && hasWord(r.commands, command) && isOfKind(r.value, value))
        return fmt::format("{}{} is an earlier spelling; the present one is {}", option,
                           r.value.empty() ? "" : fmt::format(" {}", value), r.now);
  }
  return std::nullopt;
}

}  // namespace stadion
