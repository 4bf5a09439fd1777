#include "engine/script/checker.h"

#include "engine/core/shared_rows.h"
#include "engine/plain_text/suggestion.h"
#include "engine/script/attribute_text.h"
#include "engine/script/declaration_check.h"
#include "engine/script/file_path.h"
#include "engine/text/text_mesh.h"
#include "engine/unicode/characters.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <fmt/format.h>

namespace stadion {

namespace {

constexpr NumberRange kTimeOfKey{0, 1e6};

const AttributeSpec* findAttribute(const RegisteredType& type, std::string_view word) {
  const AttributeSpec* spec = type.find(Attr::of(word));
  return spec && spec->name == word ? spec : nullptr;
}

/// The types that have such an attribute; empty if none has.
std::string typesThatHave(std::string_view word, const NodeRegistry& types) {
  std::vector<std::string> names;
  for (const NodeRegistry::Index i : types.byName())
    if (findAttribute(types[i], word) != nullptr) names.emplace_back(types[i].name());
  return joinWithOr(names);
}

/// The numbers of numbers that a value may have.
bool countIsRight(ValueKind kind, std::size_t count) {
  switch (kind) {
  case ValueKind::Number:
  case ValueKind::Whole: return count == 1;
  case ValueKind::Scale: return count == 1 || count == 3;
  case ValueKind::Sphere: return count == 4;
  case ValueKind::Box: return count == 6;
  case ValueKind::Key: return count == 4 || count == 7;
  case ValueKind::Distances: return count >= 1;
  default: return count == 3;
  }
}

/// What the i-th number of a value is called, its unit and its range.
struct Element {
  std::string name;
  std::string_view unit;
  NumberRange range;
};

Element elementOf(const AttributeSpec& spec, std::size_t i) {
  const auto part = [&](const char* of) { return fmt::format("{} of {}", of, spec.name); };
  switch (spec.kind) {
  case ValueKind::Sphere:
    return i < 3 ? Element{part("the centre"), "m", kPlaceRange}
                 : Element{part("the radius"), "m", spec.range};
  case ValueKind::Box:
    return i < 3 ? Element{part("the centre"), "m", kPlaceRange} : Element{part("an edge"), "m", spec.range};
  case ValueKind::Key:
    if (i == 0) return {part("the time"), "s", kTimeOfKey};
    return i < 4 ? Element{part("the position"), "m", spec.range}
                 : Element{part("the orientation"), "degrees", kTurnRange};
  default: return {std::string(spec.name), spec.unit, spec.range};
  }
}

/// What a number outside the range must be.
std::string demand(const NumberRange& range, double x, std::string_view unit) {
  constexpr double kMemorable = 1000;  // a range that an author can keep in mind is listed whole
  constexpr double kNone = std::numeric_limits<double>::infinity();
  if (range.most <= kMemorable && range.least >= -kMemorable) return describe(range, unit);
  return x > range.most ? describe(NumberRange{-kNone, range.most}, unit)
                        : describe(NumberRange{range.least, kNone, range.above}, unit);
}

/// Why a node of this type cannot give that up; empty if it can.
std::string faultOfDegradation(const RegisteredType& type, const NodeRegistry& types, std::string_view word) {
  const bool drawn = word == "lod" || word == "hide";
  if (drawn ? type.has(Trait::Placed) : kPacedTypes.matches(type.type())) return {};
  if (drawn)
    return fmt::format("\"{}\" is for what has a place in the world; {} has none", word, type.name());
  return fmt::format("\"{}\" is for {}, which run on their own from frame to frame; {} does not", word,
                     describe(types, kPacedTypes), type.name());
}

bool contains(const NumberRange& range, double x) {
  return (range.above ? x > range.least : x >= range.least) && x <= range.most;
}

/// Where a comma stands without a word before it, or after the last one; npos if nowhere.
std::size_t strayComma(std::string_view list) {
  std::size_t last = list.npos;
  bool word = false;  // since the last comma
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i] == ',' && !word) return i;
    if (list[i] == ',') {
      last = i;
      word = false;
    }
    word = word || std::string_view(", \t\r\n").find(list[i]) == std::string_view::npos;
  }
  return word ? list.npos : last;
}

}  // namespace

Checker::Checker(Document& document, FindingCollector& report)
    : document_(document), writer_(document), report_(report) {
  const auto positionOf = [](std::string_view name) {
    const auto at = std::ranges::find(kCommonRows, name, &AttributeSpec::name);
    return static_cast<std::size_t>(at - std::begin(kCommonRows));
  };
  priority_ = positionOf("priority");
  onOverrun_ = positionOf("onoverrun");
}

void Checker::take(const RawDeclaration& raw) {
  if (report_.full()) return writer_.setIncomplete();
  const auto index = types().find(text(raw.type));
  if (!index) return takeUnknown(raw);
  const RegisteredType& type = types()[*index];
  const std::uint32_t node = writer_.beginNode(*index, raw.type.offset);
  Seen seen;
  for (const RawAttribute& attribute : raw.attributes) takeAttribute(type, attribute, seen);
  if (!raw.complete) return writer_.setIncomplete();
  checkRequired(type, raw.type, seen);
  const Declaration declaration = document_[node];
  DeclarationCheck check(declaration, raw, report_);
  if (type.type().check != nullptr) type.type().check(check);
  if (seen[priority_] && !seen[onOverrun_])
    report_.error(raw.type.offset, "priority orders the nodes that give something up, and this node "
                                   "gives up nothing: add onoverrun, or remove priority");
}

void Checker::takeUnknown(const RawDeclaration& raw) {
  if (!raw.complete)
    writer_.setIncomplete();  // its syntax error says more than its type
  else
    report_.error(raw.type.offset, fmt::format("\"{}\" is not a node type{}", shortened(text(raw.type)),
                                               didYouMean(text(raw.type), types().names())));
  for (const RawAttribute& attribute : raw.attributes)
    if (text(attribute.name) == "name" && !report_.full())
      writer_.addLostName(std::string(text(attribute.value)));
}

void Checker::takeAttribute(const RegisteredType& type, const RawAttribute& raw, Seen& seen) {
  if (report_.full()) return;
  const AttributeSpec* spec = findAttribute(type, text(raw.name));
  if (spec == nullptr) return reportUnknown(type, raw);
  const std::size_t bit = type.positionOf(*spec);
  if (seen[bit] && !spec->repeatable)
    return report_.error(raw.name.offset,
                         fmt::format("\"{}\" is given twice; {} takes one", spec->name, type.name()));
  seen[bit] = true;
  takeValue(type, *spec, raw.value);
}

void Checker::reportUnknown(const RegisteredType& type, const RawAttribute& raw) {
  if (report_.full()) return;
  const std::string_view word = text(raw.name);
  std::vector<std::string> words;
  for (const AttributeSpec& spec : type.attributes()) words.emplace_back(spec.name);
  const std::string elsewhere = typesThatHave(word, types());
  report_.error(raw.name.offset,
                fmt::format("\"{}\" is not an attribute of {}{}", shortened(word), type.name(),
                            elsewhere.empty() ? didYouMean(word, words) : "; it belongs to " + elsewhere));
}

/// Files may be called anything, and what is written may have any blanks; names and messages are looked at
/// part by part.
bool Checker::reportHidden(const AttributeSpec& spec, TextSpan value) {
  constexpr std::array kElsewhere{ValueKind::NewName, ValueKind::Tracker, ValueKind::Reference,
                                  ValueKind::File,    ValueKind::Words,   ValueKind::EventMessage};
  if (std::ranges::find(kElsewhere, spec.kind) != kElsewhere.end()) return false;
  const auto hidden = hiddenCharacter(text(value));
  if (hidden)
    report_.error(value.offset + static_cast<std::uint32_t>(hidden->offset),
                  fmt::format("{}: {}", spec.name, hidden->message));
  return hidden.has_value();
}

void Checker::takeValue(const RegisteredType& type, const AttributeSpec& spec, TextSpan value) {
  if (reportHidden(spec, value)) return;
  switch (spec.kind) {
  case ValueKind::Flag: return takeFlag(spec, value);
  case ValueKind::Choice: return takeChoice(spec, value);
  case ValueKind::Choices: return takeChoices(type, spec, value);
  case ValueKind::NewName:
  case ValueKind::Tracker:
  case ValueKind::Reference: return takeWord(spec, value);
  case ValueKind::File: return takeFile(spec, value);
  case ValueKind::Words: return takeWords(spec, value);
  case ValueKind::Coefficients: return takeCoefficients(spec, value);
  case ValueKind::EventMessage: return takeMessage(type, value);
  default: return takeNumbers(spec, value);
  }
}

void Checker::takeNumbers(const AttributeSpec& spec, TextSpan value) {
  NumberList numbers;
  const std::string name(spec.name);
  if (const auto failure = readNumbers(text(value), numbers, name, formOf(spec)))
    return report_.error(value.offset + static_cast<std::uint32_t>(failure->offset), failure->message);
  if (!countIsRight(spec.kind, numbers.count)) return reportCount(spec, value, numbers.count);
  if (!numbersInRange(spec, value, numbers) || !momentsArePossible(spec, value, numbers)) return;
  if (spec.kind == ValueKind::Distances) return takeDistances(spec, value, numbers);
  if (spec.kind == ValueKind::Whole && numbers.value[0] != std::floor(numbers.value[0]))
    return report_.error(value.offset,
                         fmt::format("{} must be a whole number, not {}", spec.name, numbers.value[0]));
  if (spec.kind == ValueKind::Scale && numbers.count == 1)
    numbers.value[1] = numbers.value[2] = numbers.value[0];
  const std::size_t stored = spec.kind == ValueKind::Scale ? 3
                             : spec.kind == ValueKind::Key ? 7
                                                           : numbers.count;
  writer_.addNumbers(spec.attr, spec.kind, value.offset, std::span(numbers.value).first(stored));
}

void Checker::reportCount(const AttributeSpec& spec, TextSpan value, std::size_t count) {
  std::string found = count == 0 ? "empty" : fmt::format("{} number{}", count, count == 1 ? "" : "s");
  if (spec.kind == ValueKind::Number && text(value).find(',') != std::string_view::npos)
    found += "; the decimal sign is \".\"";
  report_.error(value.offset, fmt::format("{} must be {}, not {}", spec.name, formOf(spec), found));
}

bool Checker::numbersInRange(const AttributeSpec& spec, TextSpan value, const NumberList& numbers) {
  bool allZero = true;
  for (std::size_t i = 0; i < numbers.count; ++i) {
    if (numbers.value[i] != 0) allZero = false;
    const Element element = elementOf(spec, i);
    if (contains(element.range, numbers.value[i])) continue;
    report_.error(value.offset + static_cast<std::uint32_t>(numbers.offset[i]),
                  fmt::format("{} must be {}, not {}", element.name,
                              demand(element.range, numbers.value[i], element.unit), numbers.value[i]));
    return false;
  }
  if (spec.kind == ValueKind::Direction && allZero) {
    report_.error(value.offset, fmt::format("{} must not be zero", spec.name));
    return false;
  }
  return true;
}

/// Matter that is far from one axis is far from at least one of the others.
bool Checker::momentsArePossible(const AttributeSpec& spec, TextSpan value, const NumberList& numbers) {
  constexpr double kRounding = 1 + 1e-9;
  if (spec.kind != ValueKind::Moments) return true;
  for (std::size_t i = 0; i < 3; ++i) {
    const double one = numbers.value[i], next = numbers.value[(i + 1) % 3], last = numbers.value[(i + 2) % 3];
    if (one <= (next + last) * kRounding) continue;
    report_.error(value.offset + static_cast<std::uint32_t>(numbers.offset[i]),
                  fmt::format("{}: no body has such moments: each is at most the sum of the other two, but "
                              "{} is more than {} + {}",
                              spec.name, one, next, last));
    return false;
  }
  return true;
}

void Checker::takeFlag(const AttributeSpec& spec, TextSpan value) {
  if (const auto flag = readFlag(text(value)))
    return writer_.addIndex(spec.attr, spec.kind, value.offset, *flag ? 1 : 0);
  report_.error(value.offset,
                fmt::format("{} must be on or off, not \"{}\"", spec.name, shortened(text(value))));
}

void Checker::takeChoice(const AttributeSpec& spec, TextSpan value) {
  const auto found = std::find(spec.choices.begin(), spec.choices.end(), text(value));
  if (found != spec.choices.end())
    return writer_.addIndex(spec.attr, spec.kind, value.offset,
                            static_cast<std::uint32_t>(found - spec.choices.begin()));
  report_.error(value.offset,
                fmt::format("{} must be {}, not \"{}\"", spec.name, formOf(spec), shortened(text(value))));
}

/// Words between commas or blanks.
void Checker::takeChoices(const RegisteredType& type, const AttributeSpec& spec, TextSpan value) {
  constexpr std::string_view kBetween = ", \t\r\n";
  const std::string_view all = text(value);
  std::vector<std::string_view> words;
  for (std::size_t at = all.find_first_not_of(kBetween); at < all.size();
       at = all.find_first_not_of(kBetween, at)) {
    const std::string_view word = all.substr(at, all.find_first_of(kBetween, at) - at);
    const auto where = value.offset + static_cast<std::uint32_t>(at);
    const std::vector<std::string> known(spec.choices.begin(), spec.choices.end());
    if (std::ranges::find(spec.choices, word) == spec.choices.end())
      return report_.error(where, fmt::format("{} must be {}, not \"{}\"{}", spec.name, formOf(spec),
                                              shortened(word), didYouMean(word, known)));
    if (std::ranges::find(words, word) != words.end())
      return report_.error(where, fmt::format("{}: \"{}\" is given twice", spec.name, word));
    if (const std::string why = faultOfDegradation(type, types(), word); !why.empty())
      return report_.error(where, fmt::format("{}: {}", spec.name, why));
    words.push_back(word);
    at += word.size();
  }
  if (words.empty())
    return report_.error(value.offset, fmt::format("{} must be {}, not empty", spec.name, formOf(spec)));
  if (const std::size_t comma = strayComma(all); comma != all.npos)
    return report_.error(value.offset + static_cast<std::uint32_t>(comma),
                         fmt::format("{}: a word is missing beside this comma", spec.name));
  writer_.addText(spec.attr, spec.kind, value);
}

void Checker::takeDistances(const AttributeSpec& spec, TextSpan value, const NumberList& numbers) {
  for (std::size_t i = 1; i < numbers.count; ++i)
    if (!(numbers.value[i] > numbers.value[i - 1]))
      return report_.error(
          value.offset + static_cast<std::uint32_t>(numbers.offset[i]),
          fmt::format("{} must grow, but {} follows {}", spec.name, numbers.value[i], numbers.value[i - 1]));
  std::array<double, 8> stored{static_cast<double>(numbers.count)};
  std::copy_n(numbers.value.begin(), numbers.count, stored.begin() + 1);
  writer_.addNumbers(spec.attr, spec.kind, value.offset, std::span(stored).first(numbers.count + 1));
}

void Checker::takeWord(const AttributeSpec& spec, TextSpan value) {
  if (value.length == 0)
    return report_.error(value.offset, fmt::format("{} must be {}, not empty", spec.name, formOf(spec)));
  const bool reference = spec.kind == ValueKind::Reference;
  if (const auto fault = reference ? faultOfReference(text(value)) : faultOfName(text(value))) {
    if (spec.kind == ValueKind::NewName) writer_.addLostName(unicode::withoutHidden(text(value)));
    return report_.error(value.offset + static_cast<std::uint32_t>(fault->offset),
                         fmt::format("{}: \"{}\" {}", spec.name, shortened(text(value)), fault->message));
  }
  if (reference)
    writer_.addReference(spec.attr, value);
  else if (spec.kind == ValueKind::NewName)
    writer_.setName(value);
  else
    writer_.addText(spec.attr, spec.kind, value);
}

void Checker::takeWords(const AttributeSpec& spec, TextSpan value) {
  if (value.length > kLongestWords)
    return report_.error(value.offset, fmt::format("{} may have {} bytes at most, not {}", spec.name,
                                                   kLongestWords, value.length));
  writer_.addText(spec.attr, spec.kind, value);
}

/// Takes the coefficients as they are: their count and range are checked with the model.
void Checker::takeCoefficients(const AttributeSpec& spec, TextSpan value) {
  const bool letter = value.length > 0 && std::isalpha(static_cast<unsigned char>(text(value).front()));
  if (letter && !faultOfName(text(value))) return writer_.addText(spec.attr, spec.kind, value);
  NumberList numbers;
  const std::string name(spec.name);
  if (const auto failure = readNumbers(text(value), numbers, name, formOf(spec)))
    return report_.error(value.offset + static_cast<std::uint32_t>(failure->offset), failure->message);
  if (numbers.count == 0)
    return report_.error(value.offset, fmt::format("{} must be {}, not empty", name, formOf(spec)));
  writer_.addText(spec.attr, spec.kind, value);
}

void Checker::takeFile(const AttributeSpec& spec, TextSpan value) {
  if (value.length == 0)
    return report_.error(value.offset, fmt::format("{} must be a file name, not empty", spec.name));
  if (const auto fault = faultOfPath(text(value)))
    return report_.error(value.offset, fmt::format("\"{}\" {}", shortened(text(value)), *fault));
  writer_.addText(spec.attr, spec.kind, value);
}

void Checker::takeMessage(const RegisteredType& type, TextSpan value) {
  ReadMessage message;
  const std::vector<ValueError> faults = readEventMessage(text(value), type, types(), message);
  for (const ValueError& fault : faults)
    report_.error(value.offset + static_cast<std::uint32_t>(fault.offset), fault.message);
  if (faults.empty()) writer_.addMessage(value, message);
}

void Checker::checkRequired(const RegisteredType& type, TextSpan where, const Seen& seen) {
  for (const AttributeSpec& spec : type.attributes())
    if (spec.required && !seen[type.positionOf(spec)])
      report_.error(where.offset, fmt::format("{} has no \"{}\", which it must have: {}", type.name(),
                                              spec.name, spec.help));
}

void Checker::finish() {
  writer_.finish([this](std::uint32_t first, std::uint32_t again) {
    const Declaration before = document_[first];
    const auto name = document_[again].name();
    report_.error(static_cast<std::uint32_t>(name.data() - document_.source().text().data()),
                  fmt::format("the name \"{}\" is already taken by the {} in line {}", shortened(name),
                              before.type().name(), before.line()));
  });
  std::vector<std::uint32_t> firstOf(types().size(), NodeReference::kNone);
  for (const Declaration node : document_) {
    if (!node.is(Trait::Single)) continue;
    auto& first = firstOf[*types().find(node.type().name())];
    if (first == NodeReference::kNone) {
      first = node.index();
    } else {
      report_.error(writer_.offsetOf(node.index()),
                    fmt::format("a script has at most one {}; the first is in line {}", node.type().name(),
                                document_[first].line()));
    }
  }
}

}  // namespace stadion
