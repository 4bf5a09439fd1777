#include "engine/script/reference.h"

#include "engine/core/shared_rows.h"
#include "engine/script/attribute_text.h"

#include <algorithm>

#include <fmt/format.h>

namespace stadion {

namespace {

constexpr std::string_view kPreface = R"(The EVS world description language

  nodetype( attribute = value, attribute = "value, with, commas", ... )   # comment

A comment runs from # to the end of its line. A value with blanks or commas stands in quotes, straight or
typographic. Numbers of a vector are separated by commas or blanks. Names are resolved after the whole file has been
read, so the order of declarations does not matter: a name means the node of this file, else one of the files around
it; "arena/ball" means the node "ball" in the file of the scene node "arena". Lengths are metres, times seconds, masses
kilograms, angles degrees; +X is right, +Y forward, +Z up. No place is farther than 1000 km away.

An eventmessage is "event, target, command [arguments] [, delay in seconds] [, latency=seconds]". The command takes
effect at the exact time of the event + delay + latency, but not before the next frame: with a latency of at least a
frame's time it does so alike at every frame rate.
)";

std::string wrapped(std::string_view text, std::size_t indent) {
  constexpr std::size_t kWidth = 110;
  std::string result;
  std::size_t column = indent;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    if (column > indent && column + 1 + end > kWidth) {
      result.append(1, '\n').append(indent, ' ');
      column = indent;
    } else if (column > indent) {
      result += ' ';
      ++column;
    }
    result += text.substr(0, end);
    column += end;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return result;
}

/// Returns the range without bounds that only keep nonsense out; authors never meet these.
NumberRange memorable(NumberRange range) {
  constexpr double kFarAway = 36000;
  if (range.least <= -kFarAway) range.least = -std::numeric_limits<double>::infinity();
  if (range.most >= kFarAway) range.most = std::numeric_limits<double>::infinity();
  return range;
}

/// "three numbers "x, y, z" [m], greater than 0; standard 1; may be repeated".
std::string termsOf(const AttributeSpec& spec, const NodeRegistry& types) {
  std::string terms = spec.kind == ValueKind::Reference
                          ? fmt::format("the name of a node: {}", describe(types, spec.targets))
                          : formOf(spec);
  if (!spec.unit.empty()) terms += fmt::format(" [{}]", spec.unit);
  if (const std::string range = describe(memorable(spec.range), {}); !range.empty())
    terms.append(", ").append(range);
  if (spec.required) terms += "; required";
  if (!spec.standard.empty()) terms += fmt::format("; {} if not stated", spec.standard);
  if (spec.repeatable) terms += "; may be repeated";
  return terms;
}

std::string describeAttribute(const AttributeSpec& spec, const NodeRegistry& types) {
  constexpr std::size_t kIndent = 20;
  const std::string margin(kIndent, ' ');
  return fmt::format("  {:<17} {}\n{}{}\n", spec.name, wrapped(spec.help, kIndent), margin,
                     wrapped(termsOf(spec, types), kIndent));
}

std::string describeAttributes(std::span<const AttributeSpec> specs, const NodeRegistry& types) {
  std::string text;
  for (const AttributeSpec& spec : specs) text += describeAttribute(spec, types);
  return text;
}

std::string describeCommand(const CommandSpec& command) {
  return fmt::format("  {:<42} {}\n", command.form, wrapped(command.help, 45));
}

/// What a type is, and its own attributes.
std::string describeOwn(const RegisteredType& node, const NodeRegistry& types) {
  std::string text = fmt::format("{}: {}\n", node.name(), node.type().help);
  if (node.has(Trait::Single)) text += "  at most one in a file\n";
  return text + describeAttributes(node.type().attributes, types);
}

std::string describeEvents(const RegisteredType& node) {
  std::string text;
  for (const EventSpec& row : node.type().events) {
    const std::string form = fmt::format("{}{}{}", row.event.name(), row.word.empty() ? "" : " ", row.word);
    text += fmt::format("  {:<17} {}\n", form, wrapped(row.help, 20));
  }
  return text;
}

std::string wordsOfCommands(const RegisteredType& node) {
  std::string text;
  for (const CommandSpec& command : node.commands())
    text += fmt::format("{}{}", text.empty() ? "" : ", ", command.name);
  return text;
}

}  // namespace

std::string languageReference(const NodeRegistry& types, const RegisteredType& node) {
  std::string text = describeOwn(node, types);
  if (node.has(Trait::Placed))
    text.append("\n as every placed node\n").append(describeAttributes(kPlacedRows, types));
  if (node.type().traits.meets(kPaintedTraits))
    text.append("\n as every node with a model\n").append(describeAttributes(kPaintRows, types));
  text.append("\n as every node\n").append(describeAttributes(kCommonRows, types));
  if (!node.type().events.empty()) text.append("\n events\n").append(describeEvents(node));
  text += "\n commands\n";
  for (const CommandSpec& command : node.commands()) text += describeCommand(command);
  return text;
}

std::string languageReference(const NodeRegistry& types) {
  std::string text(kPreface);
  text.append("\nEvery node\n").append(describeAttributes(kCommonRows, types));
  text += fmt::format("\n{}\n",
                      wrapped(fmt::format("Every placed node: {}", describe(types, {{Trait::Placed}})), 0));
  text += describeAttributes(kPlacedRows, types);
  text += fmt::format("\nEvery node with a model: {}\n", describe(types, {kPaintedTraits}));
  text += describeAttributes(kPaintRows, types);
  for (const NodeRegistry::Index i : types.byName()) {
    const RegisteredType& node = types[i];
    text.append("\n").append(describeOwn(node, types));
    if (!node.type().events.empty()) text.append(" events\n").append(describeEvents(node));
    text += fmt::format(" commands: {}\n", wordsOfCommands(node));
  }
  text += "\nCommands\n";
  for (const CommandSpec* command : types.commands()) text += describeCommand(*command);
  return text;
}

}  // namespace stadion
