#include "engine/script/document_writer.h"

#include <algorithm>

namespace stadion {

std::uint32_t DocumentWriter::beginNode(NodeRegistry::Index type, std::uint32_t where) {
  document_.nodes_.push_back({where, static_cast<std::uint32_t>(document_.values_.size()), 0, 0, type});
  return document_.size() - 1;
}

void DocumentWriter::add(Attr attr, ValueKind kind, std::uint32_t where, std::size_t data) {
  document_.values_.push_back(
      {where, static_cast<std::uint32_t>(data), attr.id(), static_cast<std::uint32_t>(kind)});
}

void DocumentWriter::setName(TextSpan name) {
  document_.nodes_.back().name = name.offset;
  document_.nodes_.back().nameLength = static_cast<std::uint16_t>(name.length);
}

std::uint32_t DocumentWriter::addLike(std::uint32_t original, std::uint32_t where,
                                      std::span<const Attr> attributes) {
  std::vector<Document::Value> copies;
  for (const Document::Value& value : document_.valuesOf(original))
    if (std::ranges::find(attributes, value.attr()) != attributes.end()) copies.push_back(value);
  const std::uint32_t node = beginNode(document_.nodes_[original].type, where);
  document_.values_.insert(document_.values_.end(), copies.begin(), copies.end());
  return node;
}

void DocumentWriter::addNumbers(Attr attr, ValueKind kind, std::uint32_t where,
                                std::span<const double> numbers) {
  add(attr, kind, where, document_.numbers_.size());
  document_.numbers_.insert(document_.numbers_.end(), numbers.begin(), numbers.end());
}

void DocumentWriter::addIndex(Attr attr, ValueKind kind, std::uint32_t where, std::uint32_t index) {
  add(attr, kind, where, index);
}

void DocumentWriter::addText(Attr attr, ValueKind kind, TextSpan text) {
  add(attr, kind, text.offset, text.length);
}

std::uint32_t DocumentWriter::storeReference(TextSpan name) {
  document_.references_.push_back({name.offset, name.length, Document::kNone, 0, 0});
  return static_cast<std::uint32_t>(document_.references_.size() - 1);
}

void DocumentWriter::addReference(Attr attr, TextSpan name) {
  add(attr, ValueKind::Reference, name.offset, storeReference(name));
}

void DocumentWriter::addMessage(TextSpan value, const ReadMessage& read) {
  const auto at = [&](const Piece& piece) {
    return TextSpan{value.offset + static_cast<std::uint32_t>(piece.offset),
                    static_cast<std::uint32_t>(piece.text.size())};
  };
  Document::StoredMessage message{};
  message.delay = read.delay;
  message.latency = read.latency;
  message.where = value.offset;
  message.command = at(read.command).offset;
  message.target = storeReference(at(read.target));
  message.field = read.field.text.empty() ? Document::kNone : storeReference(at(read.field));
  message.tracker = at(read.tracker).offset;
  message.trackerLength = at(read.tracker).length;
  message.words = at(read.words).offset;
  message.wordsLength = at(read.words).length;
  message.event = read.event;
  message.commandId = read.spec->id;
  message.part = read.part;
  add("eventmessage", ValueKind::EventMessage, value.offset, document_.messages_.size());
  document_.messages_.push_back(message);
}

void DocumentWriter::addLostName(std::string name) {
  constexpr std::size_t kMostLostNames = 100;
  if (document_.lostNames_.size() == kMostLostNames) return setIncomplete();
  document_.lostNames_.push_back(std::move(name));
}

bool DocumentWriter::mayHaveLost(std::string_view name) const {
  const auto& lost = document_.lostNames_;
  return document_.incomplete_ || std::find(lost.begin(), lost.end(), name) != lost.end();
}

void DocumentWriter::finish(const std::function<void(std::uint32_t, std::uint32_t)>& duplicate) {
  auto& names = document_.byName_;
  names.clear();
  for (const Declaration node : document_)
    if (!node.name().empty()) names.push_back(node.index());
  std::stable_sort(names.begin(), names.end(), [this](std::uint32_t a, std::uint32_t b) {
    return document_[a].name() < document_[b].name();
  });
  std::size_t first = 0;
  for (std::size_t i = 1; i < names.size(); ++i) {
    if (document_[names[i]].name() != document_[names[first]].name())
      first = i;
    else
      duplicate(names[first], names[i]);
  }
  document_.nodes_.shrink_to_fit();
  document_.values_.shrink_to_fit();
  document_.numbers_.shrink_to_fit();
  document_.references_.shrink_to_fit();
  document_.messages_.shrink_to_fit();
  names.shrink_to_fit();
}

void DocumentWriter::store(std::uint32_t reference, Resolution resolution) {
  document_.references_[reference].declaration = resolution.declaration;
  document_.references_[reference].level = resolution.level & 0x7fffffffu;
  document_.references_[reference].whole = resolution.whole;
}

void DocumentWriter::resolveReferences(std::uint32_t node, const Visit& visit) {
  for (const Document::Value& value : document_.valuesOf(node)) {
    if (value.kind() == ValueKind::Reference) {
      store(value.data, visit(value.attr(), document_.referenceAt(value.data), nullptr));
    } else if (value.kind() == ValueKind::EventMessage) {
      const EventMessage message = document_.messageAt(value.data);
      const Document::StoredMessage& stored = document_.messages_[value.data];
      store(stored.target, visit("eventmessage", message.target, &message));
      if (stored.field != Document::kNone) store(stored.field, visit("hook", message.field, &message));
    }
  }
}

}  // namespace stadion
