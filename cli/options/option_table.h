#pragma once
/// All options of all commands, of `stadion`, `stadion-measure` and `stadion-bench` alike. A name has one
/// grammar and one help text, whichever command has it. Help, man pages, shell completion and docs/options.md
/// are made from this table.

#include "cli/options/value_grammar.h"

#include <optional>
#include <span>
#include <string>

namespace stadion {

enum class OptionGroup : std::uint8_t {
  Inputs,  ///< positional arguments
  Show,
  Length,
  Drawing,
  Output,
  Measurement,
  Load,
  Operator,
  Trackers,
  Cluster,
  Supervision,
  Bodies,
  Benches,
  Internal,  ///< for the program itself and its tests; help and documents do not list it
};

struct OptionRow {
  std::string_view name;  ///< "--rate", or "SHOW" for a positional argument
  ValueGrammar value;
  std::string_view text;  ///< of help and documents
  OptionGroup group;

  bool isPositional() const { return !name.starts_with('-'); }
  bool isInternal() const { return group == OptionGroup::Internal; }
  /// The text, and that the option may be repeated.
  std::string fullText() const;
  /// Without explanations of words that a command does not accept. `accepted`: "pair|off"; empty: all.
  std::string textFor(std::string_view accepted) const;
};

std::span<const OptionRow> optionTable();
/// Null if there is no such row.
const OptionRow* findOption(std::string_view name);
/// Returns the message about a flag with a value, such as --json=x, among the words of a command line, if
/// there is one.
std::optional<std::string> flagWithValueIn(std::span<const std::string> words);
/// The heading in help and documents. Empty for internal options.
std::string_view headingOf(OptionGroup group);

}  // namespace stadion
