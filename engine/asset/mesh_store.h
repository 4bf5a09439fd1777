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

using MeshId = std::uint32_t;  ///< never used again after its mesh is gone
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

  /// Frees what nobody uses and no frame after `shownFrame` will draw. App, once a frame.
  void collect(std::uint64_t shownFrame);

  /// The ids freed since `cursor`, which moves on; Draw frees its GL objects with this.
  std::vector<MeshId> freedSince(std::size_t& cursor) const;

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
  std::vector<MeshId> freed_;
  MeshId next_ = 1;
};

}  // namespace stadion
