#pragma once
/// The show's present meshes, by id.
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

/// Follows from the mesh's content, so it is the same on every replica, for any history of loads and frees.
/// Draw lists sorted by it are thus the same everywhere. Two meshes that would get the same id by chance (1
/// in 4 billion) get different ones, in the order in which they come.
using MeshId = std::uint32_t;
constexpr MeshId kNoMesh = 0;

class MeshStore {
public:
  /// Takes the mesh, or finds the one with the same content, and counts one use of it.
  MeshId add(std::unique_ptr<const Mesh> mesh);
  void retain(MeshId id);
  /// Releases one use. After the last one, the mesh is freed once frame `lastFrame` has been shown.
  void release(MeshId id, std::uint64_t lastFrame);

  /// Returns the mesh, or nullptr if it was freed.
  const Mesh* find(MeshId id) const;
  /// Returns the ids of meshes in use, in ascending order.
  std::vector<MeshId> used() const;
  /// Returns true if a mesh of this content exists under this id, used or not. It returns no pointer, since
  /// an unused mesh may be freed at any moment.
  bool holds(MeshId id, std::uint64_t hash) const;

  /// Frees meshes without uses that no frame after `shownFrame` will draw. App, once a frame.
  void collect(std::uint64_t shownFrame);

  /// Returns the number of meshes freed so far. While it stays the same, every mesh found earlier still
  /// exists.
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
