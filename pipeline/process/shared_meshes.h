#pragma once
/// The meshes of a show as bytes, in memory that all wall processes map. A mesh is there once, while a
/// process uses it.
///
/// Layout   the size of the mesh file (8 bytes), the file (engine/asset/mesh_file.h), the number of simplified
///          levels, the levels.
/// Threads  any, at once. Expects that a mesh stays in the store until take() returns.

#include "engine/asset/mesh_store.h"
#include "pipeline/process/list_bytes.h"
#include "pipeline/state/extents.h"
#include "pipeline/state/shared_segment.h"

#include <map>
#include <memory>
#include <mutex>
#include <optional>

namespace stadion::wall_process {

class SharedMeshes {
public:
  explicit SharedMeshes(const MeshStore& meshes);

  /// Returns where the mesh lies, and writes it there if it is new. Each call needs a giveBack(). Returns
  /// nothing if the store has no such mesh.
  std::optional<SharedMeshPlace> take(MeshId id, std::uint64_t hash);
  /// Ends one use of the mesh. The last one discards its bytes: a later take() writes them again.
  void giveBack(const SharedMeshPlace& place);

  int descriptor() const { return segment_.descriptor(); }

private:
  struct Entry {
    SharedMeshPlace place;
    std::uint64_t hash = 0;
    std::size_t users = 0;
  };

  const MeshStore& meshes_;
  std::mutex mutex_;
  SharedSegment segment_;
  Extents extents_;
  std::map<std::uint64_t, Entry> entries_;  ///< by offset
};

/// Reads a mesh; null if the bytes are damaged.
std::unique_ptr<const Mesh> meshOf(std::span<const std::byte> bytes);

}  // namespace stadion::wall_process
