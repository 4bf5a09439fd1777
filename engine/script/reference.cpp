#include "engine/script/reference.h"

#include "engine/script/schema.h"

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

/// Without the bounds that only keep nonsense out, and that nobody meets.
NumberRange memorable(NumberRange range) {
  constexpr double kFarAway = 36000;
  if (range.least <= -kFarAway) range.least = -std::numeric_limits<double>::infinity();
  if (range.most >= kFarAway) range.most = std::numeric_limits<double>::infinity();
  return range;
}

/// "three numbers "x, y, z" [m], greater than 0; standard 1; may be repeated".
std::string termsOf(const AttributeSpec& spec) {
  std::string terms = spec.kind == ValueKind::Reference
                          ? fmt::format("the name of a node: {}", describe(spec.targets))
                          : formOf(spec);
  if (!spec.unit.empty()) terms += fmt::format(" [{}]", spec.unit);
  if (const std::string range = describe(memorable(spec.range), {}); !range.empty())
    terms.append(", ").append(range);
  if (spec.required) terms += "; required";
  if (!spec.standard.empty()) terms += fmt::format("; {} if not stated", spec.standard);
  if (spec.repeatable) terms += "; may be repeated";
  return terms;
}

std::string describeAttribute(const AttributeSpec& spec) {
  constexpr std::size_t kIndent = 20;
  const std::string margin(kIndent, ' ');
  return fmt::format("  {:<17} {}\n{}{}\n", nameOf(spec.attr), wrapped(spec.help, kIndent), margin,
                     wrapped(termsOf(spec), kIndent));
}

std::string describeAttributes(std::span<const AttributeSpec> specs) {
  std::string text;
  for (const AttributeSpec& spec : specs) text += describeAttribute(spec);
  return text;
}

std::string describeCommand(const CommandSpec& command) {
  return fmt::format("  {:<42} {}\n", command.form, wrapped(command.help, 45));
}

/// Events and commands of a kind, and its own attributes.
std::string describeOwn(const NodeSpec& node) {
  std::string text = fmt::format("{}: {}\n", nameOf(node.kind), node.help);
  if (node.single) text += "  at most one in a file\n";
  return text + describeAttributes(node.own);
}

std::string describeEvents(const NodeSpec& node) {
  std::string text;
  for (const Event event : node.events)
    text += fmt::format("  {:<17} {}\n", nameOf(event), wrapped(specOf(event).help, 20));
  return text;
}

std::string wordsOfCommands(NodeKind kind) {
  std::string text;
  for (std::size_t i = 0; i < kVerbCount; ++i)
    if (specOf(static_cast<Verb>(i)).receivers.has(kind))
      text += fmt::format("{}{}", text.empty() ? "" : ", ", kVerbNames[i]);
  return text;
}

}  // namespace

std::string languageReference(NodeKind kind) {
  const NodeSpec& node = specOf(kind);
  std::string text = describeOwn(node);
  if (node.placed) text.append("\n as every placed node\n").append(describeAttributes(placedAttributes()));
  text.append("\n as every node\n").append(describeAttributes(commonAttributes()));
  if (!node.events.empty()) text.append("\n events\n").append(describeEvents(node));
  text += "\n commands\n";
  for (std::size_t i = 0; i < kVerbCount; ++i)
    if (const CommandSpec& command = specOf(static_cast<Verb>(i)); command.receivers.has(kind))
      text += describeCommand(command);
  return text;
}

std::string languageReference() {
  std::string text(kPreface);
  text.append("\nEvery node\n").append(describeAttributes(commonAttributes()));
  text += fmt::format("\n{}\n", wrapped(fmt::format("Every placed node: {}", describe(placedKinds())), 0));
  text += describeAttributes(placedAttributes());
  for (std::size_t i = 0; i < kNodeKindCount; ++i) {
    const NodeSpec& node = specOf(static_cast<NodeKind>(i));
    text.append("\n").append(describeOwn(node));
    if (!node.events.empty()) text.append(" events\n").append(describeEvents(node));
    text += fmt::format(" commands: {}\n", wordsOfCommands(node.kind));
  }
  text += "\nCommands\n";
  for (std::size_t i = 0; i < kVerbCount; ++i) text += describeCommand(specOf(static_cast<Verb>(i)));
  return text;
}

}  // namespace stadion
