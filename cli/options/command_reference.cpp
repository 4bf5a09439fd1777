#include "cli/options/command_reference.h"

#include "cli/options/command_programs.h"
#include "cli/options/option_table.h"
#include "engine/base/installed_files.h"
#include "pipeline/platform/child_process.h"
#include "show/base/standard_nodes.h"
#include "show/base/version.h"
#include "show/doctor/doctor.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace stadion {
namespace {

/// A command that is called with options of its own, such as "run" or "bench walls".
struct NamedCommand {
  std::string name;
  const CLI::App* app;
};

void addCommandsBelow(const CLI::App& app, const std::string& prefix, std::vector<NamedCommand>& commands) {
  for (const CLI::App* below : app.get_subcommands([](const CLI::App*) { return true; })) {
    const std::string name = prefix + below->get_name();
    if (below->get_subcommands([](const CLI::App*) { return true; }).empty())
      commands.push_back({name, below});
    else
      addCommandsBelow(*below, name + " ", commands);
  }
}

std::vector<NamedCommand> commandsOf(const CLI::App& program) {
  std::vector<NamedCommand> commands;
  addCommandsBelow(program, "", commands);
  return commands;
}

std::string nameOfOption(const CLI::Option& option) {
  return option.get_positional()       ? option.get_name(true, false)
         : option.get_lnames().empty() ? ""
                                       : "--" + option.get_lnames().front();
}

/// All but --help.
std::vector<const CLI::Option*> ownOptions(const CLI::App& command) {
  return command.get_options([&](const CLI::Option* o) { return o != command.get_help_ptr(); });
}

std::string usesOf(const CLI::App& program) {
  std::string text;
  for (const NamedCommand& command : commandsOf(program))
    for (const CLI::Option* option : ownOptions(*command.app))
      text += fmt::format("{}\t{}\t{}\t{}\n", nameOfOption(*option), command.name, option->get_description(),
                          option->get_group().empty() ? "hidden" : "shown");
  return text;
}

/// Returns the uses of another program's options. Throws if it has not been built.
std::string usesOfProgram(const std::string& program) {
  constexpr std::size_t kMostBytes = 4 << 20;
  const FileDescriptor out = makeMemoryFile();
  ChildProcess other;
  const bool starts = !other.start({helperProgram(program).string(), "manual", "uses"}, {-1, out.get(), -1});
  if (!starts || other.wait(std::chrono::minutes(1)) != 0)
    throw std::runtime_error(
        fmt::format("the options of {} cannot be listed, because it does not start; in a checkout, "
                    "`./stadion plan --help` and `./stadion bench --help` build what is missing",
                    program));
  return contentOf(out, kMostBytes);
}

/// Returns the parts of a text between separators.
std::vector<std::string> partsOf(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);) parts.push_back(part);
  return parts;
}

/// The commands whose help shows each option.
std::map<std::string, std::vector<std::string>> commandsByOption(const std::string& uses) {
  std::map<std::string, std::vector<std::string>> commands;
  for (const std::string& line : partsOf(uses, '\n'))
    if (const std::vector<std::string> parts = partsOf(line, '\t'); parts.size() == 4 && parts[3] == "shown")
      commands[parts[0]].push_back(parts[1]);
  return commands;
}

std::string inMarkdown(std::string_view text) {
  std::string escaped;
  for (const char c : text) escaped += c == '|' ? "\\|" : std::string(1, c);
  return escaped;
}

std::string valueText(const ValueGrammar& g) {
  const std::string limits = g.limits();
  return g.notation() + (limits.empty() ? "" : ", " + limits);
}

std::string markdownRow(const OptionRow& row, const std::vector<std::string>& commands) {
  const std::string value = row.isPositional() ? "" : inMarkdown(valueText(row.value));
  return fmt::format("| `{}` | {} | {} | {} |\n", row.name, value, inMarkdown(row.fullText()),
                     fmt::join(commands, ", "));
}

constexpr const char* kPageHead =
    R"(# Options

This page lists each option once: its value, its meaning and the commands that have it. `stadion manual options` writes
it. An option means the same in every command. Some commands accept fewer values or other limits; `--help` shows them
with the default.

- `--json` takes no value. Standard output is JSON, all else is on standard error.
- `--out DIR` receives everything that a command writes, but the files that have options of their own.
- `--trace FILE` is the event trace, `--track NODE` the path of a body.

An earlier spelling is an error (exit code 2) that names the present one.
)";

std::string optionsPage(const CLI::App& program) {
  const auto commands =
      commandsByOption(usesOf(program) + usesOfProgram("stadion-measure") + usesOfProgram("stadion-bench"));
  std::string page = kPageHead;
  std::string_view heading;
  for (const OptionRow& row : optionTable()) {
    const auto used = commands.find(std::string(row.name));
    if (row.isInternal() || used == commands.end()) continue;
    if (heading != headingOf(row.group))
      page += fmt::format("\n## {}\n\n| option | value | meaning | commands |\n|---|---|---|---|\n",
                          heading = headingOf(row.group));
    page += markdownRow(row, used->second);
  }
  return page;
}

/// For troff: hyphens are signs, and no line begins as a command of troff does.
std::string inTroff(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    const bool begins = escaped.empty() || escaped.back() == '\n';
    if (begins && (c == '.' || c == '\'')) escaped += "\\&";
    escaped += c == '-' ? "\\-" : c == '\\' ? "\\e" : std::string(1, c);
  }
  return escaped;
}

std::string manOfCommand(const CLI::App& program, const NamedCommand& command) {
  std::vector<std::string> options, arguments;
  for (const CLI::Option* option : ownOptions(*command.app)) {
    const OptionRow* row = findOption(nameOfOption(*option));
    if (row && !option->get_group().empty())
      (row->isPositional() ? arguments : options).emplace_back(row->name);
  }
  std::string text = fmt::format(".SS stadion {} {}\n{}.\n", inTroff(command.name), fmt::join(arguments, " "),
                                 inTroff(command.app->get_description()));
  if (!options.empty()) text += fmt::format(".PP\n{}\n", inTroff(fmt::format("{}", fmt::join(options, " "))));
  std::string footer = command.app->get_footer();
  if (footer == program.get_footer()) footer.clear();  // inherited: the command has no text of its own
  constexpr std::string_view kOfCheckout = "  ./";     // begins an example; an installed program is in PATH
  for (std::size_t at = 0; (at = footer.find(kOfCheckout, at)) != footer.npos;)
    footer.replace(at, kOfCheckout.size(), "  ");
  return footer.empty() ? text : text + ".PP\n.nf\n" + inTroff(footer) + "\n.fi\n";
}

/// A line may break behind each word of "a|b|c".
std::string mayBreak(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '|' ? "|\\:" : std::string(1, c);
  return out;
}

std::string manOfOptions(const std::string& uses) {
  const auto commands = commandsByOption(uses);
  std::string text, heading;
  for (const OptionRow& row : optionTable()) {
    if (row.isInternal() || !commands.contains(std::string(row.name))) continue;
    if (heading != headingOf(row.group)) text += fmt::format(".SS {}\n", heading = headingOf(row.group));
    const std::string value = row.isPositional() ? "" : mayBreak(inTroff(valueText(row.value)));
    text += fmt::format(".TP\n.B {}\n.RI {}\n{}\n", inTroff(row.name),
                        value.empty() ? "\"\"" : '"' + value + '"', inTroff(row.fullText()));
  }
  return text;
}

std::string programOf(const NamedCommand& command) {
  const CommandElsewhere* c = findElsewhere(command.name.substr(0, command.name.find(' ')));
  return c ? std::string(c->program) : "stadion";
}

std::string manPage(const CLI::App& program) {
  const std::string name = programOf(commandsOf(program).front());
  std::string page = fmt::format(".TH {} 1 \"\" \"stadion {}\" \"User commands\"\n.SH NAME\n{} \\- {}\n",
                                 name, kVersion, inTroff(name), inTroff(program.get_description()));
  page += ".SH SYNOPSIS\nstadion COMMAND [OPTION...] [ARGUMENT...]\n.SH COMMANDS\n";
  for (const NamedCommand& command : commandsOf(program)) {
    page += manOfCommand(program, command);
    if (const std::string other = programOf(command); other != name)
      page += fmt::format(".PP\nIts options are in {}(1).\n", inTroff(other));
  }
  page += ".SH OPTIONS\nAn option means the same in every command.\n" + manOfOptions(usesOf(program));
  return page + ".SH EXIT STATUS\n.nf\n" + inTroff(kExitStatusText) + "\n.fi\n";
}

/// Those of `words` that begin like the last word of the command line.
std::string beginningWith(const std::string& typed, const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words)
    if (word.starts_with(typed)) text += word + "\n";
  return text;
}

/// The command that the words before the last one name.
const CLI::App& commandOf(const CLI::App& program, std::span<const std::string> words) {
  const CLI::App* command = &program;
  for (const std::string& word : words)
    for (const CLI::App* below : command->get_subcommands([](const CLI::App*) { return true; }))
      if (below->get_name() == word) {
        command = below;
        break;
      }
  return *command;
}

std::vector<std::string> namesIn(const CLI::App& command, bool options) {
  std::vector<std::string> names;
  for (const CLI::App* below : command.get_subcommands([](const CLI::App*) { return true; }))
    if (!options) names.push_back(below->get_name());
  for (const CLI::Option* option : command.get_options())
    if (options && option->nonpositional() && !option->get_group().empty())
      names.push_back(nameOfOption(*option));
  return names;
}

/// The rooms that ship with Stadion, by the names that take the place of a wall file.
std::vector<std::string> roomNames() {
  std::vector<std::string> names;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(shareFolder() + "/walls", none))
    if (entry.path().extension() == ".walls") names.push_back(entry.path().stem());
  std::ranges::sort(names);
  return names;
}

std::vector<std::string> topicNames() {
  const auto topics = doctorTopics();
  std::vector<std::string> names(topics.begin(), topics.end());
  names.emplace_back("cluster");
  return names;
}

/// What may stand in the place of a file's name. Nothing if only files may.
std::vector<std::string> namesBesideFiles(std::string_view option) {
  if (option == "--walls" || option == "WALLS") return roomNames();
  return option == "--for" ? topicNames() : std::vector<std::string>();
}

/// Of the option's value: its words, or which files, with the names that may take their place.
std::string valuesOf(const CLI::Option& option, const OptionRow& row, const std::string& typed) {
  const std::vector<std::string> names = namesBesideFiles(row.name);
  if (row.value.kind == OptionValueKind::File || !names.empty())
    return ":files\n" + beginningWith(typed, names);
  if (row.value.kind == OptionValueKind::Folder) return ":folders\n";
  std::vector<std::string> words;
  for (const std::string& word : partsOf(option.get_type_name(), '|'))
    if (hasWord(row.value.words, word)) words.push_back(word);
  return beginningWith(typed, words);
}

/// The option and what is typed of its value.
struct TypedValue {
  std::string option, value;
};

/// Returns nothing if the last word is no value of an option. bash makes words of "--pace=f" at the sign:
/// "--pace", "=", "f".
std::optional<TypedValue> typedValue(std::span<const std::string> words) {
  const auto fromEnd = [&](std::size_t i) {
    return i < words.size() ? words[words.size() - 1 - i] : std::string();
  };
  const std::string typed = fromEnd(0);
  if (typed == "=") return TypedValue{fromEnd(1), ""};
  if (fromEnd(1) == "=") return TypedValue{fromEnd(2), typed};
  if (const std::size_t equals = typed.find('='); typed.starts_with("--") && equals != typed.npos)
    return TypedValue{typed.substr(0, equals), typed.substr(equals + 1)};
  if (fromEnd(1).starts_with("--")) return TypedValue{fromEnd(1), typed};
  return std::nullopt;
}

/// Of the first argument: which files, with the names that may take their place.
std::string argumentsOf(const CLI::App& command, const std::string& typed) {
  const std::string files = ":files\n";
  for (const CLI::Option* option : ownOptions(command)) {
    if (!option->get_positional()) continue;
    const std::string name = nameOfOption(*option);
    if (name == "TYPE") return beginningWith(typed, standardNodes()->names());
    return files + beginningWith(typed, namesBesideFiles(name));
  }
  return files;
}

std::string completion(const CLI::App& program, std::span<const std::string> words) {
  const std::string typed = words.empty() ? "" : words.back();
  const CLI::App& command = commandOf(program, words.empty() ? words : words.first(words.size() - 1));
  if (const auto given = typedValue(words)) {
    const CLI::Option* option = command.get_option_no_throw(given->option);
    const OptionRow* row = findOption(given->option);
    if (option && row && row->value.kind != OptionValueKind::Flag)
      return valuesOf(*option, *row, given->value);
  }
  if (typed.starts_with('-')) return beginningWith(typed, namesIn(command, true));
  const std::vector<std::string> below = namesIn(command, false);
  return below.empty() ? argumentsOf(command, typed) : beginningWith(typed, below);
}

}  // namespace

std::optional<std::string> referenceAnswer(const CLI::App& program, std::span<const std::string> words) {
  if (words.empty()) return std::nullopt;
  if (words[0] == "complete") return completion(program, words.subspan(1));
  if (words[0] != "manual") return std::nullopt;
  const std::string page = words.size() == 2 ? words[1] : "";
  if (page == "man") return manPage(program);
  if (page == "options") return optionsPage(program);
  if (page == "uses") return usesOf(program);
  throw std::runtime_error(
      "`manual` takes one word: man (a man page), options (the page of all options) or uses "
      "(which command has which option)");
}

}  // namespace stadion
