#pragma once
/// Who the nodes of a show are, also those that have been unloaded since. A file that comes again, asked for
/// by the same node and with the same nodes in it, brings the same nodes: they are known by the number of its
/// first load.
///
/// Threads  see() on the App thread; names may be asked for by another thread at the same time.

#include "engine/scene/scene.h"

#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace stadion {

struct NodeName {
  std::string path;  ///< "arena/ball": names of scene nodes, then its own; "object:17" if it has none
  std::string file;
  std::uint32_t line = 0;
  std::string_view type = "object";  ///< the name of its node type
  NodeRef parent;     ///< what it is placed below, in a sub-scene at least the scene node; invalid = World
  double budget = 0;  ///< [ms]; 0 = none
  bool unloaded = false;
  bool operator==(const NodeName&) const = default;
};

class NodeNames {
public:
  /// Looks at what has come and gone since it looked last.
  void see(const Scene& scene);
  /// Nothing if there never was such a node.
  std::optional<NodeName> find(NodeRef node) const;
  /// The number of the first load that brought the nodes which this one brought; nothing if nobody knows it.
  std::optional<std::uint32_t> firstLoad(std::uint32_t load) const;

private:
  struct File {
    std::string name;
    NodeRef owner;                ///< as it was loaded first
    std::vector<NodeName> nodes;  ///< by position
    bool there = true;
  };

  static File read(const Scene& scene, const Load& load);
  void add(const Scene& scene, const Load& load);
  void forgetGone(const std::set<std::uint32_t>& there);
  /// Of the file with that load's nodes; null if nobody knows them.
  const File* fileOf(std::uint32_t load) const;
  std::string pathOf(NodeRef node) const;

  mutable std::mutex mutex_;
  std::map<std::uint32_t, File> files_;           ///< by number of the first load
  std::map<std::uint32_t, std::uint32_t> again_;  ///< later loads: number of the first
  std::uint64_t seen_ = ~std::uint64_t{0};
};

}  // namespace stadion
