#include "engine/core/node_registry.h"

#include "engine/core/shared_rows.h"

#include <algorithm>

#include <fmt/format.h>

namespace stadion {
namespace {

bool isPlainWord(std::string_view word) {
  const auto plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  return !word.empty() && std::ranges::all_of(word, plain) && !(word[0] >= '0' && word[0] <= '9');
}

template <class Row>
void appendRows(std::vector<Row>& list, std::span<const Row> rows) {
  list.insert(list.end(), rows.begin(), rows.end());
}

/// What is wrong with a type by itself; empty if nothing is.
std::string faultAlone(const RegisteredType& added) {
  const NodeType& type = added.type();
  if (!isPlainWord(type.name))
    return fmt::format("\"{}\" is not a word of small letters and digits", type.name);
  if (type.make == nullptr) return fmt::format("\"{}\" has no function that makes a node", type.name);
  if (added.attributes().size() > RegisteredType::kMostAttributes)
    return fmt::format("\"{}\" has more than {} attributes", type.name, RegisteredType::kMostAttributes);
  for (const AttributeSpec& row : added.attributes()) {
    if (!isPlainWord(row.name))
      return fmt::format("\"{}\": the attribute \"{}\" is not a word of small letters and digits", type.name,
                         row.name);
    if (added.find(row.attr) != &row)
      return fmt::format(
          "\"{}\": the attribute \"{}\" is already one of this type, or \"{}\" has the same number",
          type.name, row.name, added.find(row.attr)->name);
  }
  for (const CommandSpec& row : type.commands)
    if (!isPlainWord(row.name))
      return fmt::format("\"{}\": the command \"{}\" is not a word of small letters and digits", type.name,
                         row.name);
  for (const EventSpec& row : type.events)
    if (!isPlainWord(row.event.name()))
      return fmt::format("\"{}\": the event \"{}\" is not a word of small letters and digits", type.name,
                         row.event.name());
  return {};
}

}  // namespace

RegisteredType::RegisteredType(const NodeType& type, std::string source)
    : type_(&type), source_(std::move(source)) {
  appendRows<AttributeSpec>(attributes_, kCommonRows);
  if (has(Trait::Placed)) appendRows<AttributeSpec>(attributes_, kPlacedRows);
  appendRows(attributes_, type.attributes);
  if (type.traits.meets(kPaintedTraits)) appendRows<AttributeSpec>(attributes_, kPaintRows);
  if (has(Trait::Switched)) appendRows<CommandSpec>(commands_, kSwitchCommands);
  if (has(Trait::Placed)) appendRows<CommandSpec>(commands_, kPlacedCommands);
  if (type.traits.meets(kPaintedTraits)) appendRows<CommandSpec>(commands_, kPaintCommands);
  appendRows<CommandSpec>(commands_, kCommonCommands);
  appendRows(commands_, type.commands);
  for (const AttributeSpec& row : attributes_)
    if (row.acts) actsBy_.push_back(row.attr);
  table_.assign(4 * kMostAttributes, 0);
  for (std::size_t i = 0; i < attributes_.size() && i < kMostAttributes; ++i) {
    if (find(attributes_[i].attr) != nullptr) continue;
    std::size_t at = attributes_[i].attr.id() % table_.size();
    while (table_[at] != 0) at = (at + 1) % table_.size();
    table_[at] = static_cast<std::uint8_t>(i + 1);
  }
}

const AttributeSpec* RegisteredType::find(Attr attr) const {
  constexpr std::size_t kSize = 4 * kMostAttributes;
  for (std::size_t at = attr.id() % kSize; table_[at] != 0; at = (at + 1) % kSize)
    if (const AttributeSpec& row = attributes_[table_[at] - 1U]; row.attr == attr) return &row;
  return nullptr;
}

bool RegisteredType::takes(CommandId command) const {
  return std::ranges::find(commands_, command, &CommandSpec::id) != commands_.end();
}

std::optional<std::string> NodeRegistry::add(const NodeType& type, const std::string& source) {
  RegisteredType added(type, source);
  if (std::string fault = faultAlone(added); !fault.empty()) return fault;
  if (auto fault = faultOf(added)) return fault;
  const auto index = static_cast<Index>(types_.size());
  byId_[type.kind.id()] = index;
  types_.push_back(std::move(added));
  byName_.insert(std::ranges::lower_bound(byName_, type.name, {}, [&](Index i) { return types_[i].name(); }),
                 index);
  listWords();
  return std::nullopt;
}

/// What is wrong with a type beside those that are registered.
std::optional<std::string> NodeRegistry::faultOf(const RegisteredType& added) const {
  const NodeType& type = added.type();
  if (const auto known = byId_.find(type.kind.id()); known != byId_.end()) {
    const RegisteredType& taken = types_[known->second];
    if (taken.name() == type.name)
      return fmt::format("the node type \"{}\" is already there, from {}", type.name, taken.source());
    return fmt::format("the names \"{}\" and \"{}\" have the same number; choose another name", type.name,
                       taken.name());
  }
  for (const RegisteredType& other : types_)
    for (const AttributeSpec& row : added.attributes())
      if (const AttributeSpec* same = other.find(row.attr); same && same->name != row.name)
        return fmt::format("the attributes \"{}\" and \"{}\" have the same number; choose another name",
                           row.name, same->name);
  for (const CommandSpec& row : added.commands())
    if (const CommandSpec* same = command(row.id);
        same && (same->name != row.name || same->argument != row.argument))
      return fmt::format("the command \"{}\" of \"{}\" is already there with other arguments: {}", row.name,
                         type.name, same->form);
  for (const EventSpec& row : type.events)
    for (const EventSpec* other : events_)
      if (other->event == row.event && other->event.name() != row.event.name())
        return fmt::format("the events \"{}\" and \"{}\" have the same number; choose another name",
                           row.event.name(), other->event.name());
  return std::nullopt;
}

void NodeRegistry::listWords() {
  commands_.clear();
  events_.clear();
  const auto list = [&](std::span<const CommandSpec> rows) {
    for (const CommandSpec& row : rows)
      if (command(row.id) == nullptr) commands_.push_back(&row);
  };
  list(kSwitchCommands);
  list(kPlacedCommands);
  list(kPaintCommands);
  list(kCommonCommands);
  for (const Index i : byName_) {
    list(types_[i].type().commands);
    for (const EventSpec& row : types_[i].type().events)
      if (!isEvent(row.event.name())) events_.push_back(&row);
  }
}

std::optional<NodeRegistry::Index> NodeRegistry::find(std::string_view name) const {
  const auto at = byId_.find(hashOfWord(name));
  if (at == byId_.end() || types_[at->second].name() != name) return std::nullopt;
  return at->second;
}

const RegisteredType* NodeRegistry::named(std::string_view name) const {
  const auto index = find(name);
  return index ? &types_[*index] : nullptr;
}

std::vector<std::string> NodeRegistry::names() const {
  std::vector<std::string> words;
  for (const Index i : byName_) words.emplace_back(types_[i].name());
  return words;
}

const CommandSpec* NodeRegistry::command(std::string_view name) const {
  const CommandSpec* found = command(commandNamed(name));
  return found && found->name == name ? found : nullptr;
}

const CommandSpec* NodeRegistry::command(CommandId command) const {
  const auto at = std::ranges::find(commands_, command, &CommandSpec::id);
  return at == commands_.end() ? nullptr : *at;
}

bool NodeRegistry::isEvent(std::string_view name) const {
  return std::ranges::any_of(events_, [&](const EventSpec* row) { return row->event.name() == name; });
}

std::string NodeRegistry::pluginsInWords() const {
  std::string words;
  for (const PluginIdentity& p : plugins_)
    words += fmt::format("{}{} {} ({})", words.empty() ? "" : ", ", p.name, p.version, p.hash);
  return words;
}

}  // namespace stadion
