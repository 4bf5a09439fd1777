#include "profiling/record/node_names.h"

#include <algorithm>

namespace stadion {
namespace {

/// Repeated loads that are unloaded are still known by their numbers, up to this many, for late readers.
constexpr std::size_t kMostGone = 64;

}  // namespace

void NodeNames::see(const Scene& scene) {
  if (seen_ == scene.tree().version()) return;
  seen_ = scene.tree().version();
  const std::lock_guard lock(mutex_);
  std::set<std::uint32_t> there;
  scene.tree().forEachLoad([&](const LoadedScene& load) { there.insert(load.number); });
  for (auto& [number, file] : files_) file.there = there.contains(number);
  for (const auto& [number, first] : again_)
    if (there.contains(number)) files_[first].there = true;
  scene.tree().forEachLoad([&](const LoadedScene& load) {
    if (!fileOf(load.number)) add(scene, load);
  });
  forgetGone(there);
}

NodeNames::File NodeNames::read(const Scene& scene, const LoadedScene& load) {
  File file;
  file.name = load.file;
  file.owner = load.owner;
  file.nodes.resize(load.nodes.size());
  for (const auto& [name, position] : load.names) file.nodes[position].path = name;
  for (std::uint32_t i = 0; i < file.nodes.size(); ++i) {
    NodeName& n = file.nodes[i];
    n.file = load.file;
    n.line = load.lines[i];
    if (load.nodes[i]) n.type = load.nodes[i]->type().name;
    n.parent = scene.tree().parentOf({load.number, i});
    if (const auto terms = load.terms.find(i); terms != load.terms.end()) n.budget = terms->second.budget;
    if (n.path.empty()) n.path = std::string(n.type) + ":" + std::to_string(n.line);
  }
  return file;
}

void NodeNames::add(const Scene& scene, const LoadedScene& load) {
  File file = read(scene, load);
  const auto asFirst = [&](NodeRef& ref, std::uint32_t first) {
    if (ref.load == load.number)
      ref.load = first;
    else if (const auto at = again_.find(ref.load); at != again_.end())
      ref.load = at->second;
  };
  asFirst(file.owner, load.number);
  for (NodeName& n : file.nodes) asFirst(n.parent, load.number);
  for (auto& [first, known] : files_) {
    if (known.there || known.name != file.name || known.owner != file.owner) continue;
    std::vector<NodeName> nodes = file.nodes;
    for (NodeName& n : nodes) asFirst(n.parent, first);
    if (nodes != known.nodes) continue;
    known.there = true;
    again_[load.number] = first;
    return;
  }
  files_[load.number] = std::move(file);
}

void NodeNames::forgetGone(const std::set<std::uint32_t>& there) {
  for (auto at = again_.begin(); at != again_.end() && again_.size() > there.size() + kMostGone;)
    at = there.contains(at->first) ? std::next(at) : again_.erase(at);
}

std::optional<std::uint32_t> NodeNames::firstLoad(std::uint32_t load) const {
  const std::lock_guard lock(mutex_);
  if (const auto at = again_.find(load); at != again_.end()) return at->second;
  if (files_.contains(load)) return load;
  return {};
}

const NodeNames::File* NodeNames::fileOf(std::uint32_t load) const {
  const auto again = again_.find(load);
  const auto at = files_.find(again == again_.end() ? load : again->second);
  return at == files_.end() ? nullptr : &at->second;
}

std::optional<NodeName> NodeNames::find(NodeRef node) const {
  const std::lock_guard lock(mutex_);
  const File* file = fileOf(node.load);
  if (!file || node.position >= file->nodes.size()) return {};
  NodeName found = file->nodes[node.position];
  found.path = pathOf(node);
  found.unloaded = !file->there;
  return found;
}

std::string NodeNames::pathOf(NodeRef node) const {
  const File* file = fileOf(node.load);
  if (!file || node.position >= file->nodes.size()) return {};
  const std::string& own = file->nodes[node.position].path;
  const std::string above = file->owner.valid() ? pathOf(file->owner) : std::string();
  return above.empty() ? own : above + "/" + own;
}

}  // namespace stadion
