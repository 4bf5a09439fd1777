#pragma once
/// The node types that a show may use. The engine registers its own, dynamics adds its own, and a plugin or
/// an embedding program may add more. It is passed to whatever reads or builds a show.
///
/// Threads  filled by one thread; constant afterwards.

#include "engine/core/node_type.h"

#include <bitset>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace stadion {

/// A node type with the attributes and commands that follow from its traits.
class RegisteredType {
public:
  static constexpr std::size_t kMostAttributes = 128;
  using AttributeSet = std::bitset<kMostAttributes>;

  RegisteredType(const NodeType& type, std::string source);

  const NodeType& type() const { return *type_; }
  std::string_view name() const { return type_->name; }
  bool has(Trait trait) const { return type_->traits.has(trait); }
  const std::string& source() const { return source_; }  ///< "engine", "dynamics", the name of a plugin

  /// The attribute of this type, or nullptr if it has none of that name.
  const AttributeSpec* find(Attr attr) const;
  std::size_t positionOf(const AttributeSpec& own) const {
    return static_cast<std::size_t>(&own - attributes_.data());
  }
  /// Common, placed, own, in this order.
  std::span<const AttributeSpec> attributes() const { return attributes_; }
  /// Switch, placed, common, own, in this order.
  std::span<const CommandSpec> commands() const { return commands_; }
  bool takes(CommandId command) const;
  /// Attributes that name nodes which this one acts on: a plain object that is named so has a node of its
  /// own.
  std::span<const Attr> actsBy() const { return actsBy_; }

private:
  const NodeType* type_;
  std::string source_;
  std::vector<AttributeSpec> attributes_;
  std::vector<CommandSpec> commands_;
  std::vector<Attr> actsBy_;
  std::vector<std::uint8_t> table_;  ///< open addressing by the attribute's number: position + 1, or 0
};

/// A plugin that a registry holds types of.
struct PluginIdentity {
  std::string name, version;
  std::string hash;  ///< hash of the plugin's file, hexadecimal
  bool operator==(const PluginIdentity&) const = default;
};

class NodeRegistry {
public:
  using Index = std::uint16_t;

  /// Adds a type; `source` says in messages where it is from. Returns why it cannot be added.
  std::optional<std::string> add(const NodeType& type, const std::string& source);
  void addPlugin(PluginIdentity plugin) { plugins_.push_back(std::move(plugin)); }

  std::size_t size() const { return types_.size(); }
  const RegisteredType& operator[](Index index) const { return types_[index]; }
  std::optional<Index> find(std::string_view name) const;
  const RegisteredType* named(std::string_view name) const;
  /// In the order of their names, whatever order they were added in.
  const std::vector<Index>& byName() const { return byName_; }
  std::vector<std::string> names() const;  ///< likewise

  /// Every command that some type takes: those of traits first, then by type.
  const std::vector<const CommandSpec*>& commands() const { return commands_; }
  const CommandSpec* command(std::string_view name) const;
  const CommandSpec* command(CommandId command) const;
  /// Every event that some type posts, by type.
  const std::vector<const EventSpec*>& events() const { return events_; }
  bool isEvent(std::string_view name) const;

  /// In the order in which they were loaded.
  const std::vector<PluginIdentity>& plugins() const { return plugins_; }
  /// "spring 1.0 (16 hexadecimal digits), ..."; empty without plugins.
  std::string pluginsInWords() const;

private:
  std::optional<std::string> faultOf(const RegisteredType& added) const;
  void listWords();

  std::vector<RegisteredType> types_;
  std::unordered_map<std::uint32_t, Index> byId_;
  std::vector<Index> byName_;
  std::vector<const CommandSpec*> commands_;
  std::vector<const EventSpec*> events_;
  std::vector<PluginIdentity> plugins_;
};

/// Adds the types of one source, and keeps the first fault.
class NodeRegistrar {
public:
  NodeRegistrar(NodeRegistry& registry, std::string source)
      : registry_(registry), source_(std::move(source)) {}

  void add(const NodeType& type) {
    auto fault = registry_.add(type, source_);
    if (!fault_) fault_ = std::move(fault);
  }
  const std::optional<std::string>& fault() const { return fault_; }

private:
  NodeRegistry& registry_;
  std::string source_;
  std::optional<std::string> fault_;
};

}  // namespace stadion
