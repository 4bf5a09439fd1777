#include "pipeline/load/imported_meshes.h"

#include <sys/stat.h>

namespace stadion {

std::optional<ImportedMeshes::Key> ImportedMeshes::Key::of(int file, const ImportOptions& options) {
  struct stat s {};
  if (fstat(file, &s) != 0) return {};
  return Key{s.st_dev,
             s.st_ino,
             static_cast<std::uint64_t>(s.st_size),
             std::int64_t{s.st_mtim.tv_sec} * 1'000'000'000 + s.st_mtim.tv_nsec,
             options.unit.value_or(0),
             options.up ? static_cast<int>(*options.up) : -1,
             0,
             options.form,
             textOf(options.nodes)};
}

MeshId ImportedMeshes::find(const Key& key) {
  const auto at = known_.find(key);
  if (at == known_.end()) return kNoMesh;
  store_.retain(at->second);
  return at->second;
}

void ImportedMeshes::keep(const Key& key, MeshId mesh) {
  if (known_.try_emplace(key, mesh).second) store_.retain(mesh);
}

}  // namespace stadion
