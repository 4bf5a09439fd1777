#pragma once
/// The meshes of a show as bytes, in memory that the walls' workers map: each is written once, whoever needs
/// it.
///
/// Layout   a mesh file (engine/asset/mesh_file.h), then its simplified levels.
/// Threads  any, at once; a mesh that is asked for must be in the store until the call returns.

#include "engine/asset/mesh_store.h"
#include "pipeline/process/list_bytes.h"
#include "pipeline/state/extents.h"
#include "pipeline/state/shared_segment.h"

#include <map>
#include <memory>
#include <mutex>
#include <optional>

namespace stadion::worker {

class MeshParcels {
public:
  explicit MeshParcels(const MeshStore& meshes);

  /// Where the mesh lies, for one who will give it back; nothing if the store has none of that id.
  std::optional<MeshPlace> take(MeshId id, std::uint64_t hash);
  void giveBack(const MeshPlace& place);

  int descriptor() const { return segment_.descriptor(); }

private:
  struct Parcel {
    MeshPlace place;
    std::uint64_t hash = 0;
    std::size_t users = 0;
  };

  const MeshStore& meshes_;
  std::mutex mutex_;
  SharedSegment segment_;
  Extents extents_;
  std::map<std::uint64_t, Parcel> parcels_;  ///< by offset
};

/// Reads what lies there; null if it is not a mesh.
std::unique_ptr<const Mesh> meshOf(std::span<const std::byte> bytes);

}  // namespace stadion::worker
