#pragma once
/// One script, checked: its declarations with typed values, each knowing where it was written.
///
///   Diagnostics findings;
///   auto document = parseScript(std::move(source), types, findings);       // script.h
///   resolveNames(document, surroundings, findings);
///   for (const Declaration node : document)
///     if (node.kind() == "dynobject") node.number("density");
///
/// Units     those of the node types: metres, seconds, kilograms, degrees.
/// Ownership the document owns its text and values and borrows the registry. Declarations and string views
///           borrow from the document. They become invalid when it is moved.
/// Errors    accessors expect an attribute that this node type has, and that is stated or has a default. The
///           checker has reported broken values; they are absent here.
/// Threads   constant once names are resolved.

#include "engine/core/node_registry.h"
#include "engine/maths/maths.h"
#include "engine/script/event_message.h"
#include "engine/script/source_text.h"

#include <array>
#include <optional>

namespace stadion {

class Document;

/// A key of a path.
struct PathKey {
  double time = 0;                  ///< [s] from the start of the path
  Vec3 position = Vec3::Zero();     ///< [m]
  Vec3 orientation = Vec3::Zero();  ///< [degrees] about X, then Y, then Z
};

struct BoxValue {
  Vec3 centre = Vec3::Zero();  ///< [m]
  Vec3 edges = Vec3::Zero();   ///< full lengths [m]
};

/// A declaration of a document. A light handle; pass it by value.
class Declaration {
public:
  Declaration(const Document& document, std::uint32_t index) : document_(&document), index_(index) {}

  const Document& document() const { return *document_; }
  std::uint32_t index() const { return index_; }  ///< position in the file's order, from 0
  const RegisteredType& type() const;
  NodeKind kind() const { return type().type().kind; }
  bool is(Trait trait) const { return type().has(trait); }
  /// The declaration's type has this attribute.
  bool takes(Attr attr) const { return type().find(attr) != nullptr; }
  std::string_view name() const;  ///< empty if it has none
  SourcePosition where() const;   ///< position of the type word
  std::uint32_t line() const;     ///< cheaper than where()

  /// Offset in the text of the first value of this attribute, of the type word if it is not stated.
  std::uint32_t offset(Attr attr) const;
  bool has(Attr attr) const;  ///< stated in the script
  SourcePosition
  /// Position of the attribute's value, or of the first value if repeated; of the type word if not stated.
  where(Attr attr) const;
  std::string excerpt(Attr attr) const;  ///< the line of where(attr), for a Diagnostic

  double number(Attr attr) const;
  std::optional<double> optionalNumber(Attr attr) const;  ///< number of an attribute without a standard value
  Vec3 vec3(Attr attr) const;                             ///< Vec3, Direction, Colour, Scale (always three)
  bool flag(Attr attr) const;
  std::string_view
  text(Attr attr) const;  ///< NewName, Tracker, File, Words, and the word of a Choice; empty if neither
  /// The values of a repeatable attribute with text, in the order of the script.
  std::vector<std::string_view> texts(Attr attr) const;
  /// The position of the word among the attribute's choices, as an enumeration in the same order.
  template <class E>
  E choice(Attr attr) const {
    return static_cast<E>(choiceIndex(attr).value());
  }
  template <class E>
  std::optional<E> optionalChoice(Attr attr) const {
    const auto index = choiceIndex(attr);
    return index ? std::optional<E>(static_cast<E>(*index)) : std::nullopt;
  }
  /// Returns the words of an attribute of kind Choices, as an enumeration.
  template <class E>
  std::vector<E> choices(Attr attr) const {
    std::vector<E> list;
    for (const std::size_t index : choiceIndices(attr)) list.push_back(static_cast<E>(index));
    return list;
  }
  std::vector<double> distances(Attr attr) const;  ///< empty if not stated
  std::optional<stadion::Sphere> sphere(Attr attr) const;
  std::optional<BoxValue> box(Attr attr) const;

  std::optional<NodeReference> reference(Attr attr) const;
  std::vector<NodeReference> references(Attr attr) const;  ///< in the order of the script
  std::vector<PathKey> keys() const;
  std::vector<EventMessage> eventMessages() const;

private:
  friend class Document;
  std::optional<std::size_t> choiceIndex(Attr attr) const;
  std::vector<std::size_t> choiceIndices(Attr attr) const;

  const Document* document_;
  std::uint32_t index_;
};

class Document {
public:
  const SourceText& source() const { return source_; }
  const NodeRegistry& types() const { return *types_; }
  const std::string& file() const { return source_.file(); }
  std::uint32_t size() const { return static_cast<std::uint32_t>(nodes_.size()); }
  Declaration operator[](std::uint32_t index) const { return {*this, index}; }

  /// The declaration of this name, the first if there are several.
  std::optional<Declaration> find(std::string_view name) const;

  /// True if a part of the script could not be read, so that names may be missing.
  bool incomplete() const { return incomplete_; }

  class Iterator {
  public:
    Iterator(const Document& document, std::uint32_t index) : document_(&document), index_(index) {}
    Declaration operator*() const { return {*document_, index_}; }
    Iterator& operator++() {
      ++index_;
      return *this;
    }
    bool operator!=(const Iterator& other) const { return index_ != other.index_; }

  private:
    const Document* document_;
    std::uint32_t index_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size()}; }

  std::size_t bytesHeld() const;  ///< memory, the text included

private:
  friend class Declaration;
  friend class DocumentWriter;

  static constexpr std::uint32_t kNone = NodeReference::kNone;

  struct Node {
    std::uint32_t where;       // offset of the type word
    std::uint32_t firstValue;  // into values_, up to the next node's
    std::uint32_t name;        // offset of the name
    std::uint16_t nameLength;  // 0: none
    NodeRegistry::Index type;
  };

  struct Value {
    std::uint32_t where;  // offset of the value in the text
    // numbers: index of the first in numbers_; text: length; flag and choice: the value itself;
    // references: index in references_; event messages: index in messages_
    std::uint32_t data;
    std::uint32_t attrId : 24;
    std::uint32_t kindId : 8;

    Attr attr() const { return Attr::numbered(attrId); }
    ValueKind kind() const { return static_cast<ValueKind>(kindId); }
  };

  struct StoredReference {
    std::uint32_t where;
    std::uint32_t length;
    std::uint32_t declaration;
    std::uint32_t level : 31;
    std::uint32_t whole : 1;
  };

  struct StoredMessage {
    Nanoseconds delay, latency;
    std::uint32_t where;
    std::uint32_t command;
    std::uint32_t target;  // into references_
    std::uint32_t field;   // into references_, or kNone
    std::uint32_t tracker;
    std::uint32_t trackerLength;
    std::uint32_t words;
    std::uint32_t wordsLength;
    Event event;
    CommandId commandId;
    AttachPart part;
  };

  Document(SourceText source, const NodeRegistry& types) : source_(std::move(source)), types_(&types) {}

  std::span<const Value> valuesOf(std::uint32_t node) const;
  const Value* find(std::uint32_t node, Attr attr) const;
  NodeReference referenceAt(std::uint32_t index) const;
  EventMessage messageAt(std::uint32_t index) const;

  SourceText source_;
  const NodeRegistry* types_;
  std::vector<Node> nodes_;
  std::vector<Value> values_;
  std::vector<double> numbers_;
  std::vector<StoredReference> references_;
  std::vector<StoredMessage> messages_;
  std::vector<std::uint32_t> byName_;   // named nodes, sorted by name, then by position
  std::vector<std::string> lostNames_;  // of declarations that could not be understood
  bool incomplete_ = false;
};

}  // namespace stadion
