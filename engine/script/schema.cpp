#include "engine/script/schema.h"

#include "engine/script/schema_table.h"

#include <fmt/format.h>

namespace stadion {

KindSet placedKinds() {
  return schema_table::kPlacedKinds;
}
KindSet fieldKinds() {
  return schema_table::kFieldKinds;
}

KindSet pacedKinds() {
  return schema_table::kPacedKinds;
}

KindSet lodLevelKinds() {
  using enum NodeKind;
  return {Group, Transform, Lod, Object, DynObject, Text, Path, Sway, Scene};
}

std::span<const AttributeSpec> commonAttributes() {
  return schema_table::kCommon;
}
std::span<const AttributeSpec> placedAttributes() {
  return schema_table::kPlaced;
}

const NodeSpec& specOf(NodeKind kind) {
  return schema_table::kNodes[static_cast<std::size_t>(kind)];
}
const CommandSpec& specOf(Verb verb) {
  return schema_table::kCommands[static_cast<std::size_t>(verb)];
}
const EventSpec& specOf(Event event) {
  return schema_table::kEvents[static_cast<std::size_t>(event)];
}

namespace {

const AttributeSpec* findIn(std::span<const AttributeSpec> rows, Attr attr) {
  for (const AttributeSpec& row : rows)
    if (row.attr == attr) return &row;
  return nullptr;
}

void append(std::vector<const AttributeSpec*>& list, std::span<const AttributeSpec> rows) {
  for (const AttributeSpec& row : rows) list.push_back(&row);
}

}  // namespace

const AttributeSpec* specOf(NodeKind kind, Attr attr) {
  const NodeSpec& node = specOf(kind);
  if (const auto* row = findIn(schema_table::kCommon, attr)) return row;
  if (node.placed)
    if (const auto* row = findIn(schema_table::kPlaced, attr)) return row;
  return findIn(node.own, attr);
}

std::vector<const AttributeSpec*> attributesOf(NodeKind kind) {
  const NodeSpec& node = specOf(kind);
  std::vector<const AttributeSpec*> list;
  append(list, schema_table::kCommon);
  if (node.placed) append(list, schema_table::kPlaced);
  append(list, node.own);
  return list;
}

std::string joinWithOr(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

std::string describe(KindSet kinds) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < kNodeKindCount; ++i)
    if (kinds.has(static_cast<NodeKind>(i))) words.emplace_back(kNodeKindNames[i]);
  return joinWithOr(words);
}

std::string describe(const NumberRange& range, std::string_view unit) {
  const bool below = range.least > -std::numeric_limits<double>::infinity();
  const bool above = range.most < std::numeric_limits<double>::infinity();
  const std::string tail = unit.empty() || unit.find(' ') != unit.npos ? "" : fmt::format(" {}", unit);
  if (below && above && range.above)
    return fmt::format("greater than {} and at most {}{}", range.least, range.most, tail);
  if (below && above) return fmt::format("from {} to {}{}", range.least, range.most, tail);
  if (below) return fmt::format("{} {}{}", range.above ? "greater than" : "at least", range.least, tail);
  if (above) return fmt::format("at most {}{}", range.most, tail);
  return {};
}

std::string formOf(const AttributeSpec& spec) {
  switch (spec.kind) {
  case ValueKind::Number: return "a number";
  case ValueKind::Vector:
  case ValueKind::Direction: return "three numbers \"x, y, z\"";
  case ValueKind::Colour: return "three numbers \"r, g, b\"";
  case ValueKind::Moments: return "three numbers, about the longest, the middle and the shortest axis";
  case ValueKind::Scale: return "one number or three";
  case ValueKind::Sphere: return "four numbers \"x, y, z, radius\"";
  case ValueKind::Box: return "six numbers \"x, y, z, sx, sy, sz\"";
  case ValueKind::Key: return "seven numbers \"t, x, y, z, rx, ry, rz\", or the first four";
  case ValueKind::Flag: return "on or off";
  case ValueKind::Choice: return joinWithOr({spec.choices.begin(), spec.choices.end()});
  case ValueKind::Choices:
    return fmt::format("one or more of {}, in the order that counts",
                       joinWithOr({spec.choices.begin(), spec.choices.end()}));
  case ValueKind::Distances: return "up to seven numbers \"a, b, ...\", growing";
  case ValueKind::NewName: return "one word";
  case ValueKind::Tracker: return "the name of a tracker";
  case ValueKind::Reference: return "the name of a node";
  case ValueKind::File: return "a file name";
  case ValueKind::Words: return "any text; \\n ends a line";
  case ValueKind::Coefficients: return "numbers \"a, b, ...\" or one word";
  case ValueKind::EventMessage: return "\"event, target, command [arguments] [, delay] [, latency=seconds]\"";
  }
  return {};
}

}  // namespace stadion
