#include "engine/script/script_texts.h"

#include "engine/asset/roots.h"
#include "engine/base/plain_file.h"
#include "engine/core/state_hash.h"
#include "engine/script/script.h"

namespace stadion {
namespace {

constexpr std::size_t kLarge = std::size_t{1} << 20;  // [bytes]

std::uint64_t hashOf(const SourceText& source) {
  StateHash hash;
  hash.add(source.text());
  return hash.value();
}

/// The files of a script's scene nodes.
std::vector<std::string> partsNamedIn(const Result<SourceText>& source, const NodeRegistry& types) {
  // Most large scripts hold nothing but objects; they need not be parsed for this.
  if (!source || source.value().text().find("scene") == std::string_view::npos) return {};
  Diagnostics ignored;  // told when it is checked or loaded
  const Document document = parseScript(SourceText(source.value()), types, ignored);
  std::vector<std::string> names;
  for (const Declaration d : document)
    if (d.is(Trait::Encloses) && !d.text("file").empty()) names.emplace_back(d.text("file"));
  return names;
}

}  // namespace

Result<SourceText> ScriptTexts::readPart(const std::string& name, const AssetRoots& roots) {
  auto found = roots.open(name);
  if (!found) return found.error();
  const auto bytes = readPlainFile(found.value().file.get(), found.value().path, SourceText::kMostBytes);
  if (!bytes) return bytes.error();
  return SourceText::make(found.value().path, bytes.value());
}

std::shared_ptr<const ScriptTexts> ScriptTexts::read(const std::string& script, const AssetRoots& roots,
                                                     const NodeRegistry& types) {
  std::shared_ptr<ScriptTexts> texts(new ScriptTexts(SourceText::read(script)));
  std::vector<std::string> open = partsNamedIn(texts->show_, types);
  while (!open.empty()) {
    const std::string name = std::move(open.back());
    open.pop_back();
    if (texts->parts_.contains(name)) continue;
    const auto at =
        texts->parts_.emplace(name, Part{std::make_shared<const Result<SourceText>>(readPart(name, roots))})
            .first;
    for (std::string& inner : partsNamedIn(*at->second.text, types)) open.push_back(std::move(inner));
  }
  return texts;
}

Result<SourceText> ScriptTexts::part(const std::string& name) const {
  if (const auto known = parts_.find(name); known != parts_.end()) return *known->second.text;
  return Result<SourceText>::failure("no script of the show named " + name + " when the show was read");
}

Result<SourceText> ScriptTexts::part(const std::string& name, const AssetRoots& roots) const {
  const auto known = parts_.find(name);
  if (known == parts_.end() || !known->second.leftOut) return part(name);
  auto again = readPart(name, roots);
  if (again && hashOf(again.value()) != *known->second.leftOut)
    return Result<SourceText>::failure(
        name + " has changed since the show was read, so it is not loaded; put it back, or start "
               "the show again");
  return again;
}

std::shared_ptr<const ScriptTexts> ScriptTexts::without(const std::string& name) const {
  std::shared_ptr<ScriptTexts> rest(new ScriptTexts(*this));
  const auto at = rest->parts_.find(name);
  if (at == rest->parts_.end()) return rest;
  Part& part = at->second;
  if (!*part.text || part.text->value().text().size() < kLarge) return rest;
  part.leftOut = hashOf(part.text->value());
  part.text = std::make_shared<const Result<SourceText>>(Result<SourceText>::failure(name + " is not kept"));
  return rest;
}

std::shared_ptr<const ScriptTexts> ScriptTexts::withoutShow() const {
  std::shared_ptr<ScriptTexts> rest(
      new ScriptTexts(Result<SourceText>::failure("the show's own script has been read already")));
  rest->parts_ = parts_;
  return rest;
}

std::vector<std::string> ScriptTexts::parts() const {
  std::vector<std::string> names;
  for (const auto& [name, text] : parts_) names.push_back(name);
  return names;
}

}  // namespace stadion
