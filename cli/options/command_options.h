#pragma once
/// The options of one command: rows of the option table, bound to settings.
///
/// Ownership  values are written into the bound variables, which must stay where they are until the command
///            line has been read.
/// Errors     expects names that the table has; a wrong value ends the reading of the command line with a
///            message that names option, value and what is allowed.

#include "cli/options/value_grammar.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace stadion {

/// What a command accepts of a row's grammar. Members that are not set leave it as it is.
struct OptionLimits {
  std::optional<double> least{}, most{};
  std::string_view words{};
};

class BoundOption {
public:
  BoundOption(CLI::App& command, CLI::Option& option) : command_(&command), option_(&option) {}

  BoundOption& required();
  BoundOption& needs(const char* other);
  BoundOption& excludes(const char* other);
  /// Becomes true if the option is on the command line.
  BoundOption& notes(bool& given);
  /// The value may be missing.
  BoundOption& valueMayBeMissing();
  CLI::Option* option() const { return option_; }

private:
  CLI::App* command_;
  CLI::Option* option_;
};

class CommandOptions {
public:
  explicit CommandOptions(CLI::App& command) : command_(command) {}

  /// The variable's content is the default; help shows it if the grammar allows it. Defined for bool,
  /// std::string, int, unsigned, std::uint64_t, double, std::optional<double>, Mode, Look, and vectors of
  /// strings and numbers.
  /// A bool is a flag, or the word "on" or "off". Only a vector takes more than one value.
  template <class Variable>
  BoundOption add(const char* name, Variable& variable, const OptionLimits& limits = {});
  /// Receives all values.
  BoundOption addFunction(const char* name, std::function<void(const std::vector<std::string>&)> take);

private:
  CLI::App& command_;
};

template <>
BoundOption CommandOptions::add(const char* name, bool& variable, const OptionLimits& limits);

}  // namespace stadion
