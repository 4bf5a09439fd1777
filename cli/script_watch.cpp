#include "cli/script_watch.h"

#include "engine/asset/roots.h"
#include "engine/script/script.h"

#include <set>
#include <utility>

namespace stadion {

ScriptWatch::ScriptWatch(std::string script, std::vector<std::string> assetRoots)
    : script_(std::move(script)), assetRoots_(std::move(assetRoots)) {
  settle();
}

// The script, its sub-scenes, theirs, and so on.
void ScriptWatch::findFiles() {
  AssetRoots roots = AssetRoots::ofScript(script_);
  for (const std::string& root : assetRoots_) roots.add(root);
  std::vector<std::string> open{script_};
  std::set<std::string> seen;
  while (!open.empty()) {
    const std::string file = open.back();
    open.pop_back();
    if (!seen.insert(file).second) continue;
    auto source = SourceText::read(file);
    if (!source) continue;
    Diagnostics ignored;
    const Document document = parseScript(std::move(source.value()), ignored);
    for (const Declaration d : document) {
      if (d.kind() != NodeKind::Scene || d.text(Attr::File).empty()) continue;
      if (const auto found = roots.open(std::string(d.text(Attr::File)))) open.push_back(found.value().path);
    }
  }
  files_.assign(seen.begin(), seen.end());
}

ScriptWatch::Stamps ScriptWatch::look() const {
  Stamps stamps;
  for (const std::string& file : files_) {
    std::error_code gone;
    Stamp s;
    s.time = std::filesystem::last_write_time(file, gone);
    if (!gone) s.size = std::filesystem::file_size(file, gone);
    if (!gone) stamps[file] = s;
  }
  return stamps;
}

bool ScriptWatch::changed() {
  Stamps now = look();
  const bool stays = now == seen_;
  seen_ = std::move(now);
  // While a file is being replaced it may be missing for a moment.
  return stays && seen_ != known_ && seen_.size() == files_.size();
}

void ScriptWatch::settle() {
  findFiles();
  known_ = seen_ = look();
}

}  // namespace stadion
