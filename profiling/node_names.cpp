#include "profiling/node_names.h"

namespace stadion {

void NodeNames::see(const Scene& scene) {
  if (seen_ == scene.loadsVersion()) return;
  seen_ = scene.loadsVersion();
  const std::lock_guard lock(mutex_);
  for (auto& [number, file] : files_) file.there = false;
  scene.forEachLoad([&](const Load& load) {
    if (!files_.contains(load.number)) add(scene, load);
    files_[load.number].there = true;
  });
}

void NodeNames::add(const Scene& scene, const Load& load) {
  File& file = files_[load.number];
  file.name = load.file, file.owner = load.owner;
  file.nodes.resize(load.nodes.size());
  for (const auto& [name, position] : load.names) file.nodes[position].path = name;
  for (std::uint32_t i = 0; i < file.nodes.size(); ++i) {
    NodeName& n = file.nodes[i];
    n.file = load.file, n.line = load.lines[i];
    if (load.nodes[i]) n.kind = load.nodes[i]->kind();
    n.parent = scene.parentOf({load.number, i});
    if (const auto terms = load.terms.find(i); terms != load.terms.end()) n.budget = terms->second.budget;
    if (n.path.empty()) n.path = std::string(nameOf(n.kind)) + ":" + std::to_string(n.line);
  }
}

std::optional<NodeName> NodeNames::find(NodeRef node) const {
  const std::lock_guard lock(mutex_);
  const auto at = files_.find(node.load);
  if (at == files_.end() || node.position >= at->second.nodes.size()) return {};
  NodeName found = at->second.nodes[node.position];
  found.path = pathOf(node);
  found.unloaded = !at->second.there;
  return found;
}

std::string NodeNames::pathOf(NodeRef node) const {
  const auto at = files_.find(node.load);
  if (at == files_.end() || node.position >= at->second.nodes.size()) return {};
  const std::string& own = at->second.nodes[node.position].path;
  const std::string above = at->second.owner.valid() ? pathOf(at->second.owner) : std::string();
  return above.empty() ? own : above + "/" + own;
}

}  // namespace stadion
