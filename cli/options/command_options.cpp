#include "cli/options/command_options.h"

#include "cli/options/option_table.h"
#include "pipeline/loop/frame_loop.h"
#include "pipeline/shader/look.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>
#include <string>

namespace stadion {
namespace {

const OptionRow& rowOf(const char* name) {
  const OptionRow* row = findOption(name);
  if (!row) throw std::logic_error(std::string("option_table.cpp has no row for ") + name);
  return *row;
}

template <class Variable>
constexpr bool kIsVector = false;
template <class Value>
constexpr bool kIsVector<std::vector<Value>> = true;

ValueGrammar narrowed(ValueGrammar g, const OptionLimits& limits, bool isVector) {
  g.least = limits.least.value_or(g.least);
  g.most = limits.most.value_or(g.most);
  if (!limits.words.empty()) g.words = limits.words;
  if (!isVector) g.times = ValueTimes::Once;
  if (isVector && g.times == ValueTimes::Once && g.count == 1) g.times = ValueTimes::Repeated;
  return g;
}

// What is read has been checked.

void assign(const std::string& text, std::string& value) {
  value = text;
}
void assign(const std::string& text, bool& value) {
  value = text == "on";
}
void assign(const std::string& text, double& value) {
  value = *readDecimal(text);
}
void assign(const std::string& text, std::optional<double>& value) {
  value = *readDecimal(text);
}
void assign(const std::string& text, Mode& value) {
  value = text == nameOf(Mode::Sequential) ? Mode::Sequential : Mode::Pipelined;
}
void assign(const std::string& text, Look& value) {
  value = text == nameOf(Look::Plain) ? Look::Plain : Look::Full;
}
template <std::integral Whole>
void assign(const std::string& text, Whole& value) {
  value = static_cast<Whole>(*readWhole(text));
}

template <class Value>
void assignAll(const std::vector<std::string>& words, Value& value) {
  if (!words.empty()) assign(words.back(), value);
}
template <class Value>
void assignAll(const std::vector<std::string>& words, std::vector<Value>& values) {
  values.clear();
  for (const std::string& word : words) assign(word, values.emplace_back());
}

std::string wordFor(const std::string& value) {
  return value;
}
std::string wordFor(bool value) {
  return value ? "on" : "off";
}
std::string wordFor(const std::optional<double>& value) {
  return value ? fmt::format("{}", *value) : "";
}
std::string wordFor(Mode value) {
  return nameOf(value);
}
std::string wordFor(Look value) {
  return nameOf(value);
}
template <class Number>
std::string wordFor(Number value) {
  return fmt::format("{}", value);
}

/// Empty if it is no value that could be given.
template <class Value>
std::string defaultText(const ValueGrammar& g, const Value& value) {
  const std::string text = wordFor(value);
  return g.allows(text) ? text : "";
}
template <class Value>
std::string defaultText(const ValueGrammar& g, const std::vector<Value>& values) {
  std::vector<std::string> texts;
  for (const Value& value : values) texts.push_back(defaultText(g, value));
  return fmt::format("{}", fmt::join(texts, g.count > 1 ? " " : ","));
}

/// "HZ (1 to 1000) [60]", as help shows it. The name of an argument is its notation already.
std::string signature(const OptionRow& row, const ValueGrammar& g, const std::string& standard) {
  std::string text = row.isPositional() ? " " : g.notation();
  if (const std::string limits = g.limits(); !limits.empty()) text += " (" + limits + ")";
  return standard.empty() ? text : text + " [" + standard + "]";
}

void describe(CLI::Option& option, const OptionRow& row, const ValueGrammar& g, const std::string& standard) {
  option.group(std::string(headingOf(row.group)));
  if (g.kind == OptionValueKind::Flag) {
    option.option_text(" ");  // else the column of values shows what it needs or excludes
    return;
  }
  option.type_name(g.notation())->option_text(signature(row, g, standard));
  option.check([g](const std::string& text) { return g.mistakeIn(text); });
  if (g.times == ValueTimes::List) option.delimiter(',');
  if (g.count > 1)
    option.expected(static_cast<int>(g.count));
  else if (g.times != ValueTimes::Once)
    option.expected(1, CLI::detail::expected_max_vector_size)
        ->allow_extra_args(g.times == ValueTimes::Several);
}

}  // namespace

BoundOption& BoundOption::required() {
  option_->required()->option_text(option_->get_option_text() + " REQUIRED");
  return *this;
}

BoundOption& BoundOption::needs(const char* other) {
  option_->needs(command_->get_option(other));
  return *this;
}

BoundOption& BoundOption::excludes(const char* other) {
  option_->excludes(command_->get_option(other));
  return *this;
}

BoundOption& BoundOption::notes(bool& given) {
  option_->each([&given](const std::string&) { given = true; });
  return *this;
}

BoundOption& BoundOption::valueMayBeMissing() {
  option_->option_text("[" + option_->get_type_name() + "]")->expected(0, 1);
  return *this;
}

template <class Variable>
BoundOption CommandOptions::add(const char* name, Variable& variable, const OptionLimits& limits) {
  const OptionRow& row = rowOf(name);
  const ValueGrammar g = narrowed(row.value, limits, kIsVector<Variable>);
  const CLI::callback_t take = [&variable](const CLI::results_t& words) {
    assignAll(words, variable);
    return true;
  };
  CLI::Option* option = command_.add_option(name, take, row.textFor(limits.words));
  describe(*option, row, g, defaultText(g, variable));
  return {command_, *option};
}

template <>
BoundOption CommandOptions::add(const char* name, bool& variable, const OptionLimits&) {
  const OptionRow& row = rowOf(name);
  const bool isFlag = row.value.kind == OptionValueKind::Flag;
  const CLI::callback_t take = [&variable](const CLI::results_t& words) {
    assignAll(words, variable);
    return true;
  };
  CLI::Option* option = isFlag ? command_.add_flag(name, variable, row.fullText())
                               : command_.add_option(name, take, row.fullText());
  describe(*option, row, row.value, isFlag ? "" : defaultText(row.value, variable));
  return {command_, *option};
}

BoundOption CommandOptions::addFunction(const char* name,
                                        std::function<void(const std::vector<std::string>&)> take) {
  const OptionRow& row = rowOf(name);
  const CLI::callback_t all = [take = std::move(take)](const CLI::results_t& words) {
    take(words);
    return true;
  };
  CLI::Option* option = command_.add_option(name, all, row.fullText());
  describe(*option, row, row.value, "");
  return {command_, *option};
}

template BoundOption CommandOptions::add(const char*, std::string&, const OptionLimits&);
template BoundOption CommandOptions::add(const char*, std::vector<std::string>&, const OptionLimits&);
template BoundOption CommandOptions::add(const char*, Mode&, const OptionLimits&);
template BoundOption CommandOptions::add(const char*, Look&, const OptionLimits&);
template BoundOption CommandOptions::add(const char*, int&, const OptionLimits&);
template BoundOption CommandOptions::add(const char*, unsigned&, const OptionLimits&);
template BoundOption CommandOptions::add(const char*, std::uint64_t&, const OptionLimits&);
template BoundOption CommandOptions::add(const char*, std::vector<std::uint64_t>&, const OptionLimits&);
template BoundOption CommandOptions::add(const char*, double&, const OptionLimits&);
template BoundOption CommandOptions::add(const char*, std::optional<double>&, const OptionLimits&);
template BoundOption CommandOptions::add(const char*, std::vector<double>&, const OptionLimits&);

}  // namespace stadion
