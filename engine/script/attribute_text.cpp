#include "engine/script/attribute_text.h"

#include <fmt/format.h>

namespace stadion {

std::string joinWithOr(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += words[i];
  }
  return text;
}

std::string describe(const NodeRegistry& types, const NodeFilter& filter) {
  std::vector<std::string> words;
  for (const NodeRegistry::Index i : types.byName())
    if (filter.matches(types[i].type())) words.emplace_back(types[i].name());
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
  case ValueKind::Whole: return "a whole number";
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
