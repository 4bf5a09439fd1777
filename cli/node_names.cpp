#include "cli/node_names.h"

#include "engine/node_kind.h"

namespace stadion {

void NodeNames::see(const Scene& scene) {
  if (version_ == scene.loadsVersion()) return;
  version_ = scene.loadsVersion();
  std::uint32_t last = 0;
  scene.forEachNode([&](const Node& node) {
    const std::uint32_t number = node.self().load;
    if (number == last || files_.contains(number)) return;
    last = number;
    learn(*scene.load(number));
  });
}

void NodeNames::learn(const Load& load) {
  File& file = files_[load.number];
  file.name = load.file, file.lines = load.lines;
  file.called.resize(load.lines.size());
  for (const auto& node : load.nodes)
    if (node) file.called[node->self().position] = "(" + std::string(nameOf(node->kind())) + ")";
  for (const auto& [name, position] : load.names) file.called[position] = name;
  // Who loaded it was there before.
  if (const auto owner = files_.find(load.owner.load); owner != files_.end())
    file.path = owner->second.path + owner->second.called[load.owner.position] + "/";
}

std::string NodeNames::of(NodeRef node) const {
  const auto at = files_.find(node.load);
  if (at == files_.end() || node.position >= at->second.lines.size()) return "?";
  const File& file = at->second;
  return file.path + file.called[node.position] + " " + file.name + ":" +
         std::to_string(file.lines[node.position]);
}

}  // namespace stadion
