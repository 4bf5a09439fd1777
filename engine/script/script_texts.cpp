#include "engine/script/script_texts.h"

#include "engine/asset/roots.h"
#include "engine/plain_file.h"
#include "engine/script/script.h"

namespace stadion {
namespace {

/// The files of a script's scene nodes.
std::vector<std::string> partsNamedIn(const Result<SourceText>& source) {
  // Most large scripts hold nothing but objects; they need not be parsed for this.
  if (!source || source.value().text().find("scene") == std::string_view::npos) return {};
  Diagnostics ignored;  // told when it is checked or loaded
  const Document document = parseScript(SourceText(source.value()), ignored);
  std::vector<std::string> names;
  for (const Declaration d : document)
    if (d.kind() == NodeKind::Scene && !d.text(Attr::File).empty()) names.emplace_back(d.text(Attr::File));
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

std::shared_ptr<const ScriptTexts> ScriptTexts::read(const std::string& script, const AssetRoots& roots) {
  std::shared_ptr<ScriptTexts> texts(new ScriptTexts(SourceText::read(script)));
  std::vector<std::string> open = partsNamedIn(texts->show_);
  while (!open.empty()) {
    const std::string name = std::move(open.back());
    open.pop_back();
    if (texts->parts_.contains(name)) continue;
    const auto at = texts->parts_.emplace(name, readPart(name, roots)).first;
    for (std::string& inner : partsNamedIn(at->second)) open.push_back(std::move(inner));
  }
  return texts;
}

Result<SourceText> ScriptTexts::part(const std::string& name) const {
  if (const auto known = parts_.find(name); known != parts_.end()) return known->second;
  return Result<SourceText>::failure("no script of the show named " + name + " when the show was read");
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
