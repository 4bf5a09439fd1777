#include "engine/script/document.h"

#include "engine/script/value.h"

#include <algorithm>
#include <cassert>

namespace stadion {

namespace {

/// The numbers of a standard value; they are ours and well formed.
NumberList standardNumbers(const AttributeSpec& spec) {
  NumberList numbers;
  readNumbers(spec.standard, numbers, {}, {});
  return numbers;
}

Vec3 vec3From(const double* numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

// --- Declaration
// -----------------------------------------------------------------------------------------------

const RegisteredType& Declaration::type() const {
  return (*document_->types_)[document_->nodes_[index_].type];
}

std::string_view Declaration::name() const {
  const auto& node = document_->nodes_[index_];
  return document_->source_.slice(node.name, node.nameLength);
}

SourcePosition Declaration::where() const {
  return document_->source_.position(document_->nodes_[index_].where);
}
std::uint32_t Declaration::line() const {
  return document_->source_.line(document_->nodes_[index_].where);
}

bool Declaration::has(Attr attr) const {
  return document_->find(index_, attr) != nullptr;
}

std::uint32_t Declaration::offset(Attr attr) const {
  const auto& node = document_->nodes_[index_];
  if (attr == "name" && node.nameLength > 0) return node.name;
  const auto* value = document_->find(index_, attr);
  return value != nullptr ? value->where : node.where;
}

SourcePosition Declaration::where(Attr attr) const {
  return document_->source_.position(offset(attr));
}
std::string Declaration::excerpt(Attr attr) const {
  return document_->source_.excerpt(offset(attr));
}

std::optional<double> Declaration::optionalNumber(Attr attr) const {
  if (const auto* value = document_->find(index_, attr)) return document_->numbers_[value->data];
  const AttributeSpec* spec = type().find(attr);
  if (spec == nullptr || spec->standard.empty()) return std::nullopt;
  return standardNumbers(*spec).value[0];
}

double Declaration::number(Attr attr) const {
  const auto value = optionalNumber(attr);
  assert(value);
  return value.value_or(0);
}

Vec3 Declaration::vec3(Attr attr) const {
  if (const auto* value = document_->find(index_, attr)) return vec3From(&document_->numbers_[value->data]);
  const AttributeSpec* spec = type().find(attr);
  assert(spec != nullptr && !spec->standard.empty());
  if (spec == nullptr) return Vec3::Zero();
  const NumberList numbers = standardNumbers(*spec);
  return numbers.count == 1 ? Vec3::Constant(numbers.value[0]) : vec3From(numbers.value.data());
}

bool Declaration::flag(Attr attr) const {
  if (const auto* value = document_->find(index_, attr)) return value->data != 0;
  const AttributeSpec* spec = type().find(attr);
  assert(spec != nullptr && spec->kind == ValueKind::Flag);
  return spec != nullptr && readFlag(spec->standard).value_or(false);
}

std::optional<std::size_t> Declaration::choiceIndex(Attr attr) const {
  if (const auto* value = document_->find(index_, attr)) return value->data;
  const AttributeSpec* spec = type().find(attr);
  if (spec == nullptr || spec->standard.empty()) return std::nullopt;
  const auto found = std::find(spec->choices.begin(), spec->choices.end(), spec->standard);
  return static_cast<std::size_t>(found - spec->choices.begin());
}

std::vector<std::size_t> Declaration::choiceIndices(Attr attr) const {
  const AttributeSpec* spec = type().find(attr);
  std::vector<std::size_t> indices;
  if (spec == nullptr) return indices;
  std::string words(text(attr));
  std::replace_if(
      words.begin(), words.end(), [](char c) { return c == ',' || c == '\r' || c == '\n'; }, ' ');
  std::string_view rest = words;
  std::size_t offset = 0;
  for (Piece word = takeWord(rest, offset); !word.text.empty(); word = takeWord(rest, offset)) {
    const auto found = std::find(spec->choices.begin(), spec->choices.end(), word.text);
    indices.push_back(static_cast<std::size_t>(found - spec->choices.begin()));
  }
  return indices;
}

std::vector<double> Declaration::distances(Attr attr) const {
  const auto* value = document_->find(index_, attr);
  if (value == nullptr) return {};
  const double* numbers = &document_->numbers_[value->data];
  return {numbers + 1, numbers + 1 + static_cast<std::size_t>(numbers[0])};
}

std::string_view Declaration::text(Attr attr) const {
  if (attr == "name") return name();
  const AttributeSpec* spec = type().find(attr);
  const auto* value = document_->find(index_, attr);
  if (spec == nullptr || value == nullptr) return spec != nullptr ? spec->standard : std::string_view{};
  if (value->kind() == ValueKind::Choice) return spec->choices[value->data];
  return document_->source_.slice(value->where, value->data);
}

std::optional<stadion::Sphere> Declaration::sphere(Attr attr) const {
  const auto* value = document_->find(index_, attr);
  if (value == nullptr) return std::nullopt;
  const double* numbers = &document_->numbers_[value->data];
  return stadion::Sphere{vec3From(numbers), numbers[3]};
}

std::optional<BoxValue> Declaration::box(Attr attr) const {
  const auto* value = document_->find(index_, attr);
  if (value == nullptr) return std::nullopt;
  const double* numbers = &document_->numbers_[value->data];
  return BoxValue{vec3From(numbers), vec3From(numbers + 3)};
}

std::optional<NodeReference> Declaration::reference(Attr attr) const {
  const auto* value = document_->find(index_, attr);
  if (value == nullptr) return std::nullopt;
  return document_->referenceAt(value->data);
}

std::vector<std::string_view> Declaration::texts(Attr attr) const {
  std::vector<std::string_view> result;
  for (const auto& value : document_->valuesOf(index_))
    if (value.attr() == attr) result.push_back(document_->source_.slice(value.where, value.data));
  return result;
}

std::vector<NodeReference> Declaration::references(Attr attr) const {
  std::vector<NodeReference> result;
  for (const auto& value : document_->valuesOf(index_))
    if (value.attr() == attr) result.push_back(document_->referenceAt(value.data));
  return result;
}

std::vector<PathKey> Declaration::keys() const {
  std::vector<PathKey> result;
  for (const auto& value : document_->valuesOf(index_)) {
    if (value.attr() != "key") continue;
    const double* numbers = &document_->numbers_[value.data];
    result.push_back({numbers[0], vec3From(numbers + 1), vec3From(numbers + 4)});
  }
  return result;
}

std::vector<EventMessage> Declaration::eventMessages() const {
  std::vector<EventMessage> result;
  for (const auto& value : document_->valuesOf(index_))
    if (value.attr() == "eventmessage") result.push_back(document_->messageAt(value.data));
  return result;
}

// --- Document
// --------------------------------------------------------------------------------------------------

std::span<const Document::Value> Document::valuesOf(std::uint32_t node) const {
  const std::size_t first = nodes_[node].firstValue;
  const std::size_t end = node + 1 < nodes_.size() ? nodes_[node + 1].firstValue : values_.size();
  return std::span(values_).subspan(first, end - first);
}

const Document::Value* Document::find(std::uint32_t node, Attr attr) const {
  for (const Value& value : valuesOf(node))
    if (value.attr() == attr) return &value;
  return nullptr;
}

std::optional<Declaration> Document::find(std::string_view name) const {
  const auto nameOfNode = [this](std::uint32_t node) {
    return source_.slice(nodes_[node].name, nodes_[node].nameLength);
  };
  const auto found =
      std::lower_bound(byName_.begin(), byName_.end(), name,
                       [&](std::uint32_t node, std::string_view n) { return nameOfNode(node) < n; });
  if (name.empty() || found == byName_.end() || nameOfNode(*found) != name) return std::nullopt;
  return (*this)[*found];
}

NodeReference Document::referenceAt(std::uint32_t index) const {
  const StoredReference& stored = references_[index];
  return {source_.slice(stored.where, stored.length), stored.level, stored.declaration, stored.where,
          stored.whole != 0};
}

EventMessage Document::messageAt(std::uint32_t index) const {
  const StoredMessage& stored = messages_[index];
  EventMessage message;
  message.event = stored.event;
  message.target = referenceAt(stored.target);
  message.commandId = stored.commandId;
  message.part = stored.part;
  if (stored.field != kNone) message.field = referenceAt(stored.field);
  message.tracker = source_.slice(stored.tracker, stored.trackerLength);
  message.words = source_.slice(stored.words, stored.wordsLength);
  message.delay = stored.delay;
  message.latency = stored.latency;
  message.where = stored.where;
  message.command = stored.command;
  return message;
}

std::size_t Document::bytesHeld() const {
  const auto held = [](const auto& list) { return list.capacity() * sizeof(list[0]); };
  return sizeof(*this) + source_.bytesHeld() + held(nodes_) + held(values_) + held(numbers_) +
         held(references_) + held(messages_) + held(byName_);
}

}  // namespace stadion
