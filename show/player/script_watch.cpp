#include "show/player/script_watch.h"

#include "engine/asset/roots.h"
#include "engine/script/script_texts.h"
#include "show/player/script_assets.h"

#include <algorithm>
#include <utility>

namespace stadion {
namespace {

AssetRoots rootsOf(const std::string& script, const std::vector<std::string>& further) {
  AssetRoots roots = AssetRoots::ofScript(script);
  for (const std::string& root : further) roots.add(root);
  return roots;
}

}  // namespace

ScriptWatch::ScriptWatch(std::string script, std::vector<std::string> assetRoots, SharedTypes types)
    : script_(std::move(script)), assetRoots_(std::move(assetRoots)), types_(std::move(types)) {
  reset();
}

ScriptWatch::Stamps ScriptWatch::readStamps() const {
  Stamps stamps;
  const auto note = [&](const std::string& name, const std::string& path) {
    std::error_code gone;
    Stamp s{path, std::filesystem::last_write_time(path, gone), 0};
    if (!gone) s.size = std::filesystem::file_size(path, gone);
    if (!gone) stamps.emplace(name, std::move(s));
  };
  note(script_, script_);
  const AssetRoots roots = rootsOf(script_, assetRoots_);
  for (const std::string& part : parts_)
    if (const auto found = roots.open(part)) note(part, found.value().path);
  for (const std::string& asset : assets_) note(asset, asset);
  return stamps;
}

bool ScriptWatch::somethingIsGone() const {
  return std::ranges::any_of(known_, [&](const auto& file) { return !seen_.contains(file.first); });
}

std::string ScriptWatch::whatChanged() const {
  for (const auto& [name, stamp] : known_)
    if (!seen_.contains(name)) return stamp.path + " is gone";
  for (const auto& [name, stamp] : seen_) {
    const auto before = known_.find(name);
    if (before == known_.end() || !(before->second == stamp)) return stamp.path + " was saved";
  }
  return {};
}

std::optional<std::string> ScriptWatch::changed() {
  Stamps now = readStamps();
  stayedFor_ = now == seen_ ? stayedFor_ + 1 : 0;
  seen_ = std::move(now);
  if (seen_ == known_ || stayedFor_ < (somethingIsGone() ? kGoneFor : 1)) return {};
  return whatChanged();
}

void ScriptWatch::reset() {
  parts_ = ScriptTexts::read(script_, rootsOf(script_, assetRoots_), *types_)->parts();
  std::vector<NamedFile> assets;
  addAssetsOf(script_, rootsOf(script_, assetRoots_), *types_, {}, assets);
  assets_.clear();
  for (const NamedFile& asset : assets) assets_.push_back(asset.file);
  known_ = seen_ = readStamps();
  stayedFor_ = 0;
}

}  // namespace stadion
