#pragma once
/// The only way to change a document; used by the checker and by the resolution of names.

#include "engine/script/document.h"
#include "engine/script/event_message_reader.h"
#include "engine/script/syntax.h"

namespace stadion {

class DocumentWriter {
public:
  /// Expects that `document` outlives the writer.
  explicit DocumentWriter(Document& document) : document_(document) {}
  static Document empty(SourceText source, const NodeRegistry& types) { return {std::move(source), types}; }

  std::uint32_t beginNode(NodeRegistry::Index type, std::uint32_t where);
  void setName(TextSpan name);
  void addNumbers(Attr attr, ValueKind kind, std::uint32_t where, std::span<const double> numbers);
  void addIndex(Attr attr, ValueKind kind, std::uint32_t where, std::uint32_t index);  ///< flag, choice
  void addText(Attr attr, ValueKind kind, TextSpan text);
  void addReference(Attr attr, TextSpan name);
  void addMessage(TextSpan value, const ReadMessage& message);
  void setIncomplete() { document_.incomplete_ = true; }
  /// Remembers a name whose declaration is wrong, so that its users are not called wrong too.
  /// Beyond a number that an author could mend, any name may have been lost.
  void addLostName(std::string name);
  bool mayHaveLost(std::string_view name) const;

  /// Adds a node of the type of `original` with the values that it has of `attributes`.
  std::uint32_t addLike(std::uint32_t original, std::uint32_t where, std::span<const Attr> attributes);

  std::uint32_t offsetOf(std::uint32_t node) const { return document_.nodes_[node].where; }

  /// Sorts the names, gives back unused memory. `duplicate(first, again)` is called for each name that
  /// recurs.
  void finish(const std::function<void(std::uint32_t first, std::uint32_t again)>& duplicate);

  /// Visits every reference of a node once: `visit(attr, reference)`; for eventmessages the target and the
  /// field come as "eventmessage" and "hook", and with the message. What `visit` returns is stored.
  struct Resolution {
    std::uint32_t declaration = NodeReference::kNone;
    std::uint32_t level = 0;
    bool whole = false;  ///< the declaration is that of the whole name
  };
  using Visit =
      std::function<Resolution(Attr attr, const NodeReference& reference, const EventMessage* message)>;
  void resolveReferences(std::uint32_t node, const Visit& visit);

private:
  void add(Attr attr, ValueKind kind, std::uint32_t where, std::size_t data);
  std::uint32_t storeReference(TextSpan name);
  void store(std::uint32_t reference, Resolution resolution);

  Document& document_;
};

}  // namespace stadion
