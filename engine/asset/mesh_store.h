#pragma once
/// Which meshes the show holds at the moment, by id.
///
/// Ownership  the store owns every mesh. App adds, retains and releases; Draw looks up.
/// Threads    every function may be called from any thread. The pointer that find() returns stays valid until
///            the frame in which the mesh was last used has been shown on all walls (see collect).

#include "engine/asset/mesh.h"

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace stadion {

/// Follows from the mesh's content: the same on every replica, whatever came and went before and whenever
/// memory was freed, so that what is ordered by it (draw lists) is the same everywhere. Two meshes that would
/// get the same one by chance (1 in 4 billion) get different ones, in the order in which they come.
using MeshId = std::uint32_t;
constexpr MeshId kNoMesh = 0;

class MeshStore {
public:
  /// Takes the mesh, or finds the one with the same content, and counts one use of it.
  MeshId add(std::unique_ptr<const Mesh> mesh);
  void retain(MeshId id);
  /// Gives up one use; with the last one, the mesh goes once frame `lastFrame` has been shown.
  void release(MeshId id, std::uint64_t lastFrame);

  /// The mesh, or nullptr if it is gone.
  const Mesh* find(MeshId id) const;
  /// Those that are in use, in ascending order.
  std::vector<MeshId> used() const;
  /// Whether a mesh of this content is there under this id, used or not: what nobody uses may go the next
  /// moment, so a pointer to it would be no good.
  bool holds(MeshId id, std::uint64_t hash) const;

  /// Frees what nobody uses and no frame after `shownFrame` will draw. App, once a frame.
  void collect(std::uint64_t shownFrame);

  /// How many meshes have been freed so far. While it stays the same, every mesh that was found is still
  /// there.
  std::uint64_t freedCount() const;

  std::size_t size() const;

private:
  struct Entry {
    std::unique_ptr<const Mesh> mesh;
    std::uint32_t uses = 0;
    std::uint64_t lastFrame = 0;
  };

  mutable std::mutex mutex_;
  std::map<MeshId, Entry> entries_;
  std::map<std::uint64_t, MeshId> byHash_;
  std::vector<MeshId> unused_;
  std::uint64_t freedCount_ = 0;
};

}  // namespace stadion
