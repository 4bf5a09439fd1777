#pragma once
/// The names of a show's nodes, including unloaded ones. If the same node loads a file again with the same
/// nodes in it, these count as the same nodes. They are identified by the number of the first load.
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
  /// The node below which the node is placed, in a sub-scene at least the scene node; invalid = World.
  NodeRef parent;
  double budget = 0;  ///< [ms]; 0 = none
  bool unloaded = false;
  bool operator==(const NodeName&) const = default;
};

class NodeNames {
public:
  /// Records the loads and unloads since the last call.
  void see(const Scene& scene);
  /// Returns nothing if there never was such a node.
  std::optional<NodeName> find(NodeRef node) const;
  /// Returns the number of the first load with the same nodes as this one; nothing if it is unknown.
  std::optional<std::uint32_t> firstLoad(std::uint32_t load) const;

private:
  struct File {
    std::string name;
    NodeRef owner;                ///< owner of the file's first load
    std::vector<NodeName> nodes;  ///< by position
    bool there = true;
  };

  static File read(const Scene& scene, const LoadedScene& load);
  void add(const Scene& scene, const LoadedScene& load);
  void forgetGone(const std::set<std::uint32_t>& there);
  /// Returns the file with that load's nodes; null if it is unknown.
  const File* fileOf(std::uint32_t load) const;
  std::string pathOf(NodeRef node) const;

  mutable std::mutex mutex_;
  std::map<std::uint32_t, File> files_;           ///< by number of the first load
  std::map<std::uint32_t, std::uint32_t> again_;  ///< later loads: number of the first
  std::uint64_t seen_ = ~std::uint64_t{0};
};

}  // namespace stadion
