#include "show/player/show_of_part.h"

#include "engine/asset/roots.h"
#include "engine/script/script.h"

#include <algorithm>

namespace stadion {
namespace {

namespace fs = std::filesystem;

constexpr int kFoldersUp = 3;
constexpr std::size_t kMostScripts = 500;  ///< in one folder, and in one show

std::vector<fs::path> scriptsIn(const fs::path& folder) {
  std::vector<fs::path> scripts;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->path().extension() == ".evs" && scripts.size() < kMostScripts) scripts.push_back(at->path());
  std::ranges::sort(scripts);
  return scripts;
}

/// Adds a script and those that it loads, directly or through others.
void addFiles(const fs::path& script, const AssetRoots& roots, const NodeRegistry& types,
              std::set<fs::path>& files) {
  std::error_code error;
  if (files.size() >= kMostScripts || !files.insert(fs::weakly_canonical(script, error)).second) return;
  auto source = SourceText::read(script.string());
  if (!source) return;
  Diagnostics ignored;
  const Document document = parseScript(std::move(source.value()), types, ignored);
  for (const Declaration d : document) {
    if (!d.is(Trait::Encloses) || d.text("file").empty()) continue;
    if (const auto below = roots.open(std::string(d.text("file"))))
      addFiles(below.value().path, roots, types, files);
  }
}

/// As a user in the working folder would write it.
std::string asWritten(const fs::path& file) {
  const fs::path near = file.lexically_proximate(fs::current_path());
  return near.empty() || *near.begin() == ".." ? file.string() : near.string();
}

}  // namespace

std::set<fs::path> filesOf(const fs::path& script, const fs::path& show,
                           const std::vector<std::string>& assetRoots, const NodeRegistry& types) {
  AssetRoots roots = AssetRoots::ofScript(show);
  for (const std::string& root : assetRoots) roots.add(root);
  std::set<fs::path> files;
  addFiles(script, roots, types, files);
  return files;
}

std::optional<std::string> showAround(const std::string& file, const std::vector<std::string>& assetRoots,
                                      const NodeRegistry& types) {
  std::error_code error;
  const fs::path own = fs::weakly_canonical(file, error);
  if (error || !fs::exists(own, error)) return std::nullopt;
  fs::path folder = own.parent_path();
  for (int up = 0; up <= kFoldersUp; ++up, folder = folder.parent_path()) {
    for (const fs::path& script : scriptsIn(folder))
      if (script != own && filesOf(script, script, assetRoots, types).contains(own)) return asWritten(script);
    if (folder == folder.root_path()) break;
  }
  return std::nullopt;
}

}  // namespace stadion
