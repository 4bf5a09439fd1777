#pragma once
/// Models that stay in memory from one group's show to the next, so that they need not be read again.
///
/// A model's key is its file on the disk (device, inode, size, time of change) and its import options. An
/// edited model is imported again. (An edited texture in a file of its own is not noticed.)
///
/// Ownership  owns the store that the shows use, and counts one use of each mesh in it.
/// Threads    one loader's at a time.

#include "engine/asset/format.h"
#include "engine/asset/mesh_store.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>

namespace stadion {

class ImportedMeshes {
public:
  /// A file and a way to import it.
  struct Key {
    std::uint64_t device = 0, inode = 0, size = 0;
    std::int64_t changed = 0;  ///< [ns]
    double unit = 0;           ///< 0 = the file's own
    int up = -1;               ///< UpAxis; -1 = the file's own
    std::uint32_t levels = 0;  ///< number of simplified levels requested
    ModelForm form = ModelForm::Object;
    std::string nodes{};  ///< textOf(NodeSelection)

    auto operator<=>(const Key&) const = default;
    /// Returns the key of an open file; nothing if it is unknown.
    static std::optional<Key> of(int file, const ImportOptions& options);
  };

  ImportedMeshes() = default;
  ImportedMeshes(const ImportedMeshes&) = delete;
  ImportedMeshes& operator=(const ImportedMeshes&) = delete;

  MeshStore& store() { return store_; }
  /// Returns the mesh and counts one more use of it, or returns kNoMesh.
  MeshId find(const Key& key);
  void keep(const Key& key, MeshId mesh);
  std::size_t size() const { return known_.size(); }

private:
  MeshStore store_;
  std::map<Key, MeshId> known_;
};

}  // namespace stadion
