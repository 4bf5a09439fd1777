#pragma once
/// The loaded files of a scene and their nodes: finds nodes by reference and by name, and tells what is below
/// what.
///
/// A static object has no node. The first find() of one makes a node of it and takes the object out of its
/// chunk: it is promoted.
///
/// Ownership  owns the installed loads and so their nodes.
/// Threads    App only.
/// Errors     lookups of nodes that are not loaded return null or an invalid reference.

#include "engine/scene/loaded_scene.h"
#include "engine/scene/placements.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace stadion {

class StateFields;

class SceneTree {
public:
  /// Receives the changes of static objects that become nodes.
  class Host {
  public:
    virtual ~Host() = default;
    /// The object is no longer shown by its chunk.
    virtual void leftChunk(ChunkId chunk, std::uint32_t index) = 0;
    /// The new node enters, with its home at X_WN.
    virtual void promoted(Node& node, const Affine& X_WN) = 0;
  };
  static constexpr Nanoseconds kNever = std::numeric_limits<Nanoseconds>::max();

  explicit SceneTree(Host& host) : host_(host) {}

  // Lookups.

  /// The node, or null if it is not loaded. Promotes a static object.
  Node* find(NodeRef ref);
  /// Resolves a name or path as seen from `from`: in its file, then in the files that loaded it. The path
  /// "scene/name" looks into a sub-scene; a part of an object, "hall/roof", is a node of its own.
  NodeRef resolve(const std::string& name, NodeRef from) const;
  /// Resolves the first part of a path. `inside` gets the rest, for resolveInside().
  NodeRef resolveFirst(const std::string& name, NodeRef from, std::string& inside) const;
  /// Follows the rest of a path, such as "arena/ball", from a scene node to what is loaded now.
  NodeRef resolveInside(NodeRef from, std::string_view path) const;
  const LoadedScene* load(std::uint32_t number) const;
  LoadedScene* load(std::uint32_t number);
  const std::map<std::uint32_t, std::unique_ptr<LoadedScene>>& loads() const { return loads_; }
  /// Returns the node below which `ref` is placed: its parent, in a sub-scene at least the scene node.
  /// Invalid = World.
  NodeRef parentOf(NodeRef ref) const;
  /// The placement of `parent` for a node in `child`'s file.
  PlacementId placementFor(NodeRef parent, NodeRef child);
  /// When the load (or what loaded it) is unloaded, as far as that happens in this frame; else kNever.
  Nanoseconds endOf(std::uint32_t load) const;
  /// Changes whenever a load comes or goes: names may resolve differently.
  std::uint64_t version() const { return version_; }
  void forEachNode(const std::function<void(const Node&)>& f) const;
  void forEachLoad(const std::function<void(const LoadedScene&)>& f) const;

  // Changes.

  /// Promotes every static object below `ref`, so that it can move.
  void promoteBelow(NodeRef ref);
  /// Promotes a static object of the load; `moved` is what moved it since its chunk was made.
  Node* promote(LoadedScene& load, std::size_t index, const Affine& moved = Affine::Identity());
  /// Makes a node of a static object, which does not enter: it is restored.
  Node& makeNode(LoadedScene& load, std::size_t index);

  // For the scene alone.

  LoadedScene& install(std::unique_ptr<LoadedScene> load);
  std::unique_ptr<LoadedScene> remove(std::uint32_t number);
  /// Announces that the load goes at `at`, in this frame.
  void end(std::uint32_t number, Nanoseconds at);
  /// Adds a load that is being restored; the version is restored apart.
  void restore(std::unique_ptr<LoadedScene> load);
  void stateOfVersion(StateFields& f);

private:
  bool isBelow(NodeRef ref, NodeRef ancestor) const;

  Host& host_;
  std::map<std::uint32_t, std::unique_ptr<LoadedScene>> loads_;  ///< by number
  std::uint64_t version_ = 0;
};

}  // namespace stadion
