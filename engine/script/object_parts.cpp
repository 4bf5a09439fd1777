#include "engine/script/object_parts.h"

#include "engine/script/document_writer.h"

#include <algorithm>
#include <map>

namespace stadion {
namespace {

/// What a part has from its object: how the file is read, drawn and stood in for.
constexpr Attr kFromObject[] = {"file",      "draw",   "unit", "up",   "shape",
                                "tolerance", "levels", "tint", "emit", "opacity"};

/// Each name with a "/", and the offset of its first use.
using Paths = std::map<std::string, std::uint32_t, std::less<>>;

Paths pathsIn(Document& document) {
  Paths paths;
  DocumentWriter writer(document);
  const auto look = [&](Attr, const NodeReference& r, const EventMessage*) -> DocumentWriter::Resolution {
    if (!r.inner().empty()) paths.try_emplace(std::string(r.name), r.where);
    return {};
  };
  for (std::uint32_t i = 0; i < document.size(); ++i) writer.resolveReferences(i, look);
  return paths;
}

std::size_t lengthOfObject(std::string_view path) {
  return path.find('/');
}

/// The object whose part a path names.
std::optional<Declaration> objectOf(const Document& document, std::string_view path) {
  const auto object = document.find(path.substr(0, lengthOfObject(path)));
  return object && object->takes("part") ? object : std::nullopt;
}

/// The length of the longest path above this one that is named too, or of the object's name.
std::size_t lengthOfParent(const Paths& paths, std::string_view path) {
  for (std::size_t end = path.rfind('/'); end > lengthOfObject(path); end = path.rfind('/', end - 1))
    if (paths.contains(path.substr(0, end))) return end;
  return lengthOfObject(path);
}

}  // namespace

bool isPartByUse(const Declaration& object) {
  return object.name().find('/') != std::string_view::npos;
}

void declareParts(Document& document) {
  Paths paths = pathsIn(document);
  std::erase_if(paths, [&](const auto& p) { return !objectOf(document, p.first); });
  if (paths.empty()) return;
  DocumentWriter writer(document);
  for (const auto& [path, where] : paths) {
    const auto length = static_cast<std::uint32_t>(path.size());
    const auto object = static_cast<std::uint32_t>(lengthOfObject(path));
    writer.addLike(objectOf(document, path)->index(), where, kFromObject);
    writer.setName({where, length});
    writer.addText("part", ValueKind::Words, {where + object + 1, length - object - 1});
    writer.addReference("parent", {where, static_cast<std::uint32_t>(lengthOfParent(paths, path))});
  }
  writer.finish([](std::uint32_t, std::uint32_t) {});
}

std::string partOf(const Declaration& object) {
  if (!object.takes("part")) return {};
  std::string part(object.text("part"));
  if (!isPartByUse(object)) return part;
  const auto whole = objectOf(object.document(), object.name());
  const std::string above = whole ? partOf(*whole) : std::string();
  return above.empty() ? part : above + "/" + part;
}

std::vector<std::string> partsWithout(const Declaration& object) {
  std::vector<std::string> parts;
  if (!object.takes("part") || object.name().empty()) return parts;
  const std::string_view name = object.name().substr(0, lengthOfObject(object.name()));
  const Document& document = object.document();
  for (std::uint32_t i = document.size(); i-- > 0;) {
    const Declaration other = document[i];  // the parts come last
    if (!isPartByUse(other)) break;
    if (i != object.index() && other.name().substr(0, lengthOfObject(other.name())) == name)
      parts.push_back(partOf(other));
  }
  std::ranges::reverse(parts);
  return parts;
}

}  // namespace stadion
