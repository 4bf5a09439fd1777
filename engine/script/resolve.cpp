#include "engine/core/shared_rows.h"
#include "engine/plain_text/suggestion.h"
#include "engine/script/attribute_text.h"
#include "engine/script/document_writer.h"
#include "engine/script/finding_collector.h"
#include "engine/script/object_parts.h"
#include "engine/script/script.h"

#include <charconv>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>

namespace stadion {

namespace {

constexpr std::size_t kMostCandidates = 20'000;  // for suggestions
constexpr std::size_t kMostSuggestions = 20;

std::string withArticle(const std::string& words) {
  return fmt::format("{} {}", words.starts_with('o') || words.starts_with('e') ? "an" : "a", words);
}
std::string withArticle(const RegisteredType& type) {
  return withArticle(std::string(type.name()));
}

std::string commandsOf(const RegisteredType& type) {
  std::vector<std::string> words;
  for (const CommandSpec& command : type.commands()) words.emplace_back(command.name);
  return joinWithOr(words);
}

class Resolver {
public:
  Resolver(Document& document, const RelatedDocuments& surroundings, FindingCollector& report)
      : document_(document), surroundings_(surroundings), writer_(document), report_(report) {}

  void run() {
    for (const Declaration node : document_)
      writer_.resolveReferences(node.index(),
                                [&](Attr attr, const NodeReference& r, const EventMessage* message) {
                                  return resolve(node, attr, r, message);
                                });
    checkParents();
    checkOwners();
  }

private:
  using Resolution = DocumentWriter::Resolution;

  const Document& documentAt(std::uint32_t level) const {
    return level == 0 ? document_ : *surroundings_.enclosing[level - 1];
  }

  /// The node of the whole name, which may be a part of an object, or else of the part before the first "/".
  Resolution lookUp(std::string_view name) const {
    for (std::uint32_t level = 0; level <= surroundings_.enclosing.size(); ++level) {
      const Document& document = documentAt(level);
      if (const auto found = document.find(name)) return {found->index(), level, true};
      if (const auto found = document.find(name.substr(0, name.find('/')))) return {found->index(), level};
    }
    return {};
  }

  Resolution resolve(const Declaration& user, Attr attr, const NodeReference& reference,
                     const EventMessage* message) {
    const std::string_view first = reference.name.substr(0, reference.name.find('/'));
    const Resolution found = lookUp(reference.name);
    if (found.declaration == NodeReference::kNone) {
      if (!writer_.mayHaveLost(first)) reportUnresolved(reference, first, nullptr);
      return found;
    }
    const Declaration target = documentAt(found.level)[found.declaration];
    const auto final = enter(target, found.whole ? std::string_view{} : reference.inner(), reference);
    if (final && !mayUse(user, attr, reference, final->type(), message)) return {};
    return found;
  }

  /// The node that the rest of the name leads to; nothing if that cannot be known or was reported.
  std::optional<Declaration> enter(Declaration node, std::string_view rest, const NodeReference& reference) {
    while (!rest.empty()) {
      if (!node.is(Trait::Encloses)) {
        reportNothingInside(node, reference);
        return std::nullopt;
      }
      const Document* inside = surroundings_.subScene ? surroundings_.subScene(node) : nullptr;
      if (inside == nullptr) return std::nullopt;
      if (const auto part = inside->find(rest)) return part;
      const std::size_t end = std::min(rest.find('/'), rest.size());
      const auto next = inside->find(rest.substr(0, end));
      if (!next) {
        if (!inside->incomplete()) reportUnresolved(reference, rest.substr(0, end), inside);
        return std::nullopt;
      }
      node = *next;
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return node;
  }

  void reportNothingInside(const Declaration& node, const NodeReference& reference) {
    if (node.takes("part"))
      report_.error(
          reference.where,
          fmt::format("\"{}\": a part of the object \"{}\" is named in the script of that object, {}",
                      reference.name, node.name(), node.document().file()));
    else
      report_.error(
          reference.where,
          fmt::format("\"{}\": \"{}\" is {}; only a scene has nodes inside, and only an object has parts",
                      reference.name, node.name(), withArticle(node.type())));
  }

  /// A number that a command sets must be in the range of the attribute that has the command's name.
  bool mayBe(const RegisteredType& type, const EventMessage& message) {
    const CommandSpec& command = *document_.types().command(message.commandId);
    const AttributeSpec* spec =
        command.argument == ArgumentKind::Faded ? type.find(Attr::of(command.name)) : nullptr;
    if (spec == nullptr) return true;
    double number = 0;
    std::from_chars(message.words.data(), message.words.data() + message.words.size(), number);
    if (number >= spec->range.least && number <= spec->range.most) return true;
    report_.error(message.command, fmt::format("{} must be {}, not {}", command.name,
                                               describe(spec->range, spec->unit), number));
    return false;
  }

  bool mayUse(const Declaration& user, Attr attr, const NodeReference& reference, const RegisteredType& type,
              const EventMessage* message) {
    const NodeRegistry& types = document_.types();
    const bool field = attr == "hook" && message != nullptr;  // the argument of a hook or unhook command
    const auto commandName = [&] { return types.command(message->commandId)->name; };
    if (message != nullptr && !field) {
      if (type.takes(message->commandId)) return mayBe(type, *message);
      report_.error(message->command,
                    fmt::format("\"{}\" is {}, which does not take \"{}\"; it takes {}", reference.name,
                                withArticle(type), commandName(), commandsOf(type)));
      return false;
    }
    const AttributeSpec* spec = field ? nullptr : user.type().find(attr);
    const NodeFilter& allowed = field ? kFieldTypes : spec->targets;
    if (allowed.matches(type.type())) return true;
    report_.error(reference.where,
                  fmt::format("\"{}\" is {}; {} takes the name of {}", reference.name, withArticle(type),
                              field ? commandName() : spec->name, withArticle(describe(types, allowed))));
    return false;
  }

  void reportUnresolved(const NodeReference& reference, std::string_view part, const Document* inside) {
    std::string suggestion;
    if (suggestions_ < kMostSuggestions) {
      ++suggestions_;
      suggestion = inside != nullptr ? didYouMean(part, namesIn(*inside)) : didYouMean(part, visibleNames());
    }
    report_.error(reference.where,
                  fmt::format("there is no node named \"{}\"{}{}", part,
                              inside != nullptr ? fmt::format(" in {}", inside->file()) : "", suggestion));
  }

  static std::vector<std::string> namesIn(const Document& document) {
    std::vector<std::string> names;
    for (const Declaration node : document)
      if (!node.name().empty() && names.size() < kMostCandidates) names.emplace_back(node.name());
    return names;
  }

  const std::vector<std::string>& visibleNames() {
    if (!visible_.empty()) return visible_;
    for (std::uint32_t level = 0; level <= surroundings_.enclosing.size(); ++level)
      for (std::string& name : namesIn(documentAt(level))) visible_.push_back(std::move(name));
    return visible_;
  }

  /// The parent in this file, or kNone.
  std::uint32_t parentOf(std::uint32_t node) const {
    const auto parent = document_[node].reference("parent");
    const bool here = parent && parent->resolved() && parent->level == 0 && parent->inner().empty();
    return here ? parent->declaration : NodeReference::kNone;
  }

  void checkParents() {
    std::vector<std::uint32_t> visitedBy(document_.size(), NodeReference::kNone);
    for (std::uint32_t start = 0; start < document_.size(); ++start) {
      std::uint32_t node = start;
      while (node != NodeReference::kNone && visitedBy[node] == NodeReference::kNone) {
        visitedBy[node] = start;
        node = parentOf(node);
      }
      if (node != NodeReference::kNone && visitedBy[node] == start) reportCircle(node);
    }
  }

  void reportCircle(std::uint32_t node) {
    constexpr int kMostNames = 6;
    std::uint32_t first = node;  // the one written first is the one to point at
    for (std::uint32_t next = parentOf(node); next != node; next = parentOf(next))
      first = std::min(first, next);
    std::string chain = fmt::format("\"{}\"", document_[first].name());
    int names = 1;
    for (std::uint32_t next = parentOf(first); next != first && names < kMostNames;
         next = parentOf(next), ++names)
      chain += fmt::format(" is below \"{}\", which", document_[next].name());
    chain += fmt::format(" is below {}",
                         names == kMostNames ? "others" : fmt::format("\"{}\"", document_[first].name()));
    report_.error(document_[first].reference("parent")->where, "parents form a circle: " + chain);
  }

  void checkOwners() {
    std::unordered_map<std::string_view, std::uint32_t> ownerOf;
    for (const Declaration node : document_) {
      if (!node.is(Trait::Collides)) continue;
      const bool dynamics = node.is(Trait::OwnsBodies);
      std::unordered_set<std::string_view> colliders;
      for (const NodeReference& collider : node.references("collider")) colliders.insert(collider.name);
      for (const NodeReference& body : node.references("collidee")) {
        if (colliders.contains(body.name))
          report_.error(body.where,
                        fmt::format("\"{}\" is collider of this node as well; it would collide with "
                                    "itself{}",
                                    body.name,
                                    dynamics ? " (collidees meet each other without being colliders)" : ""));
        if (!dynamics) continue;
        const auto [entry, isNew] = ownerOf.emplace(body.name, node.index());
        if (isNew) continue;
        const Declaration owner = document_[entry->second];
        const bool same = owner.index() == node.index();
        report_.error(body.where,
                      same ? fmt::format("\"{}\" is collidee of this node twice", body.name)
                           : fmt::format("\"{}\" is already collidee of the dynamics node in line {}; a body "
                                         "belongs to one",
                                         body.name, owner.line()));
      }
    }
  }

  Document& document_;
  const RelatedDocuments& surroundings_;
  DocumentWriter writer_;
  FindingCollector& report_;
  std::vector<std::string> visible_;
  std::size_t suggestions_ = 0;
};

}  // namespace

void resolveNames(Document& document, const RelatedDocuments& surroundings, Diagnostics& findings) {
  declareParts(document);
  FindingCollector report(document.source(), findings);
  Resolver(document, surroundings, report).run();
}

}  // namespace stadion
