#pragma once
/// Who the nodes of a show are, also those that have been unloaded since.
///
/// Threads  see() on the App thread; names may be asked for by another thread at the same time.

#include "engine/node_kind.h"
#include "engine/scene/scene.h"

#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace stadion {

struct NodeName {
  std::string path;  ///< "arena/ball": names of scene nodes, then its own; "object:17" if it has none
  std::string file;
  std::uint32_t line = 0;
  NodeKind kind = NodeKind::Object;
  NodeRef parent;     ///< what it is placed below, in a sub-scene at least the scene node; invalid = World
  double budget = 0;  ///< [ms]; 0 = none
  bool unloaded = false;
};

class NodeNames {
public:
  /// Looks at what has come and gone since it looked last.
  void see(const Scene& scene);
  /// Nothing if there never was such a node.
  std::optional<NodeName> find(NodeRef node) const;

private:
  struct File {
    std::string name;
    NodeRef owner;
    std::vector<NodeName> nodes;  ///< by position
    bool there = true;
  };

  void add(const Scene& scene, const Load& load);
  std::string pathOf(NodeRef node) const;

  mutable std::mutex mutex_;
  std::map<std::uint32_t, File> files_;
  std::uint64_t seen_ = ~std::uint64_t{0};
};

}  // namespace stadion
